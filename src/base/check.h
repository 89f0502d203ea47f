#pragma once
// Checks against programming errors. EXPECT comes before the work of a function, ENSURE after it; both are always on and stay
// outside hot loops. DCHECK is for hot loops and vanishes in release builds. User input is never checked with these.

#include <fmt/format.h>

#include <stdexcept>

namespace sunfleck::detail {

template <class A, class B>
[[noreturn]] void check_failed(const char* kind, const char* text, const char* file, int line, const A& a, const B& b) {
  throw std::logic_error(fmt::format("{}:{}: {}({}) failed: {} against {}", file, line, kind, text, a, b));
}

}  // namespace sunfleck::detail

#define SUNFLECK_CHECK(kind, a, op, b)                                                                 \
  do {                                                                                                 \
    const auto& check_a = (a);                                                                         \
    const auto& check_b = (b);                                                                         \
    if (!(check_a op check_b))                                                                         \
      ::sunfleck::detail::check_failed(kind, #a " " #op " " #b, __FILE__, __LINE__, check_a, check_b); \
  } while (false)

#define EXPECT(a, op, b) SUNFLECK_CHECK("EXPECT", a, op, b)
#define ENSURE(a, op, b) SUNFLECK_CHECK("ENSURE", a, op, b)
#ifdef NDEBUG
#define DCHECK(a, op, b) static_cast<void>(0)
#else
#define DCHECK(a, op, b) SUNFLECK_CHECK("DCHECK", a, op, b)
#endif
