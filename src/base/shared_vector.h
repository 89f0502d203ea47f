#pragma once
// A vector whose copies share its elements until one of them is changed.

#include <cstddef>
#include <initializer_list>
#include <memory>
#include <utility>
#include <vector>

namespace sunfleck {

// Offers what callers use of std::vector. Access through a non-const object counts as a change: it first gives the object
// elements of its own, unless it has them already. Copies may be used by different threads, like copies of a std::vector.
template <class T>
class SharedVector {
 public:
  using value_type = T;
  using Vector = std::vector<T>;

  SharedVector() = default;
  SharedVector(Vector values) : values_(std::make_shared<Vector>(std::move(values))) {}  // NOLINT(google-explicit-constructor)
  SharedVector(std::initializer_list<T> values) : values_(std::make_shared<Vector>(values)) {}

  // Returns the elements.
  [[nodiscard]] const Vector& get() const {
    static const Vector none;
    return values_ ? *values_ : none;
  }
  operator const Vector&() const { return get(); }  // NOLINT(google-explicit-constructor)
  // Returns elements that no other object shares.
  [[nodiscard]] Vector& own() {
    if (!values_) values_ = std::make_shared<Vector>();
    if (values_.use_count() > 1) values_ = std::make_shared<Vector>(*values_);
    return *values_;
  }

  // Returns the elements; those of a non-const object may be changed.
  [[nodiscard]] static const Vector& of(const SharedVector& values) { return values.get(); }
  [[nodiscard]] static Vector& of(SharedVector& values) { return values.own(); }

  [[nodiscard]] std::size_t size() const { return get().size(); }
  [[nodiscard]] bool empty() const { return get().empty(); }
  [[nodiscard]] const T* data() const { return get().data(); }
  [[nodiscard]] const T& operator[](std::size_t k) const { return (*values_)[k]; }
  [[nodiscard]] const T& back() const { return get().back(); }
  [[nodiscard]] auto begin() const { return get().begin(); }
  [[nodiscard]] auto end() const { return get().end(); }

  [[nodiscard]] T& operator[](std::size_t k) { return own()[k]; }
  [[nodiscard]] T& back() { return own().back(); }
  [[nodiscard]] auto begin() { return own().begin(); }
  [[nodiscard]] auto end() { return own().end(); }
  void push_back(T value) { own().push_back(std::move(value)); }
  void reserve(std::size_t size) { own().reserve(size); }

  friend bool operator==(const SharedVector& a, const SharedVector& b) { return a.values_ == b.values_ || a.get() == b.get(); }

 private:
  std::shared_ptr<Vector> values_;  // null: empty
};

}  // namespace sunfleck
