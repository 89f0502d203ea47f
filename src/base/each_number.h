#pragma once
// Passes on the numbers that a struct consists of, so that its own `visit` is the only list of them.

#include <type_traits>
#include <utility>

namespace sunfleck {

// Calls `visit` with every number of the values that it is given: with those of a list one after the other, and with those of
// a struct in the order of its static function `visit(value, archive)`, which passes its members to the archive.
template <class Visit>
class EachNumber {
 public:
  explicit EachNumber(Visit visit) : visit_(std::move(visit)) {}

  template <class... T>
  void operator()(T&... values) const {
    (pass(values), ...);
  }

 private:
  template <class T>
  void pass(T& value) const {
    if constexpr (std::is_arithmetic_v<T>) {
      visit_(value);
    } else if constexpr (requires { value.begin(); }) {
      for (auto& part : value) pass(part);
    } else {
      T::visit(value, *this);
    }
  }

  Visit visit_;
};

}  // namespace sunfleck
