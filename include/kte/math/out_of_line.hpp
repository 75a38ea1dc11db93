#pragma once

#include <kte/math/dual.hpp>

#include <concepts>
#include <limits>

/// Dual numbers whose arithmetic is not inlined. Used for the formulas of elements in derivatives of runtime chains,
/// which would otherwise take ten times as long to compile (docs/decisions/12-compiled.md).
namespace kte {

/// A dual `number` whose operations are functions, not inlined.
template <class D>
struct out_of_line {
  D number;

  out_of_line() = default;
  out_of_line(const D& x) : number(x) {}  // NOLINT(google-explicit-constructor)
  template <class A>
  requires std::is_arithmetic_v<A> out_of_line(const A& x) : number(x) {}  // NOLINT(google-explicit-constructor)

  out_of_line& operator+=(const out_of_line& b) { return *this = *this + b; }
  out_of_line& operator-=(const out_of_line& b) { return *this = *this - b; }
  out_of_line& operator*=(const out_of_line& b) { return *this = *this * b; }
  out_of_line& operator/=(const out_of_line& b) { return *this = *this / b; }

  [[gnu::noinline]] friend out_of_line operator+(const out_of_line& a, const out_of_line& b) {
    return {a.number + b.number};
  }
  [[gnu::noinline]] friend out_of_line operator-(const out_of_line& a, const out_of_line& b) {
    return {a.number - b.number};
  }
  [[gnu::noinline]] friend out_of_line operator*(const out_of_line& a, const out_of_line& b) {
    return {a.number * b.number};
  }
  [[gnu::noinline]] friend out_of_line operator/(const out_of_line& a, const out_of_line& b) {
    return {a.number / b.number};
  }
  [[gnu::noinline]] friend out_of_line operator-(const out_of_line& a) { return {-a.number}; }
  friend out_of_line operator+(const out_of_line& a) { return a; }
  friend bool operator==(const out_of_line& a, const out_of_line& b) { return a.number == b.number; }
  friend bool operator<(const out_of_line& a, const out_of_line& b) { return a.number < b.number; }
  friend bool operator>(const out_of_line& a, const out_of_line& b) { return a.number > b.number; }
  friend bool operator<=(const out_of_line& a, const out_of_line& b) { return a.number <= b.number; }
  friend bool operator>=(const out_of_line& a, const out_of_line& b) { return a.number >= b.number; }
};

template <class D>
[[gnu::noinline]] void sincos(const out_of_line<D>& x, out_of_line<D>& sine, out_of_line<D>& cosine) {
  sincos(x.number, sine.number, cosine.number);
}
#define KTE_OUT_OF_LINE(function)                                      \
  template <class D>                                                   \
  [[gnu::noinline]] out_of_line<D> function(const out_of_line<D>& x) { \
    return {function(x.number)};                                       \
  }
KTE_OUT_OF_LINE(sqrt)
KTE_OUT_OF_LINE(abs)
KTE_OUT_OF_LINE(sin)
KTE_OUT_OF_LINE(cos)
KTE_OUT_OF_LINE(tan)
KTE_OUT_OF_LINE(asin)
KTE_OUT_OF_LINE(acos)
KTE_OUT_OF_LINE(atan)
KTE_OUT_OF_LINE(exp)
KTE_OUT_OF_LINE(log)
KTE_OUT_OF_LINE(tanh)
#undef KTE_OUT_OF_LINE
#define KTE_OUT_OF_LINE(function)                                                                 \
  template <class D>                                                                              \
  [[gnu::noinline]] out_of_line<D> function(const out_of_line<D>& x, const out_of_line<D>& y) {   \
    return {function(x.number, y.number)};                                                        \
  }                                                                                               \
  template <class D, class A>                                                                     \
  requires std::is_arithmetic_v<A> out_of_line<D> function(const out_of_line<D>& x, const A& y) { \
    return function(x, out_of_line<D>(y));                                                        \
  }                                                                                               \
  template <class D, class A>                                                                     \
  requires std::is_arithmetic_v<A> out_of_line<D> function(const A& x, const out_of_line<D>& y) { \
    return function(out_of_line<D>(x), y);                                                        \
  }
KTE_OUT_OF_LINE(atan2)
KTE_OUT_OF_LINE(hypot)
KTE_OUT_OF_LINE(pow)
KTE_OUT_OF_LINE((min))
KTE_OUT_OF_LINE((max))
#undef KTE_OUT_OF_LINE
template <class D>
[[nodiscard]] bool isfinite(const out_of_line<D>& x) {
  return isfinite(x.number);
}
template <class D>
[[nodiscard]] bool isnan(const out_of_line<D>& x) {
  return isnan(x.number);
}

}  // namespace kte

template <class D>
struct std::numeric_limits<kte::out_of_line<D>> : std::numeric_limits<D> {};
