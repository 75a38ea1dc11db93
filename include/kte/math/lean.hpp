#pragma once

#include <kte/math/dual.hpp>

#include <concepts>
#include <limits>

/// Dual numbers whose arithmetic is not inlined: for the many formulas of elements in derivatives of runtime chains,
/// which would else take ten times as long to compile as the formulas themselves (docs/decisions/12-compiled.md).
namespace kte {

template <class D>
struct lean {
  D number;

  lean() = default;
  lean(const D& x) : number(x) {}  // NOLINT(google-explicit-constructor)
  template <class A>
  requires std::is_arithmetic_v<A> lean(const A& x) : number(x) {}  // NOLINT(google-explicit-constructor)

  lean& operator+=(const lean& b) { return *this = *this + b; }
  lean& operator-=(const lean& b) { return *this = *this - b; }
  lean& operator*=(const lean& b) { return *this = *this * b; }
  lean& operator/=(const lean& b) { return *this = *this / b; }

  [[gnu::noinline]] friend lean operator+(const lean& a, const lean& b) { return {a.number + b.number}; }
  [[gnu::noinline]] friend lean operator-(const lean& a, const lean& b) { return {a.number - b.number}; }
  [[gnu::noinline]] friend lean operator*(const lean& a, const lean& b) { return {a.number * b.number}; }
  [[gnu::noinline]] friend lean operator/(const lean& a, const lean& b) { return {a.number / b.number}; }
  [[gnu::noinline]] friend lean operator-(const lean& a) { return {-a.number}; }
  friend lean operator+(const lean& a) { return a; }
  friend bool operator==(const lean& a, const lean& b) { return a.number == b.number; }
  friend bool operator<(const lean& a, const lean& b) { return a.number < b.number; }
  friend bool operator>(const lean& a, const lean& b) { return a.number > b.number; }
  friend bool operator<=(const lean& a, const lean& b) { return a.number <= b.number; }
  friend bool operator>=(const lean& a, const lean& b) { return a.number >= b.number; }
};

template <class D>
[[gnu::noinline]] void sincos(const lean<D>& x, lean<D>& sine, lean<D>& cosine) {
  sincos(x.number, sine.number, cosine.number);
}
#define KTE_LEAN(function)                               \
  template <class D>                                     \
  [[gnu::noinline]] lean<D> function(const lean<D>& x) { \
    return {function(x.number)};                         \
  }
KTE_LEAN(sqrt)
KTE_LEAN(abs)
KTE_LEAN(sin)
KTE_LEAN(cos)
KTE_LEAN(tan)
KTE_LEAN(asin)
KTE_LEAN(acos)
KTE_LEAN(atan)
KTE_LEAN(exp)
KTE_LEAN(log)
KTE_LEAN(tanh)
#undef KTE_LEAN
#define KTE_LEAN(function)                                                                                            \
  template <class D>                                                                                                  \
  [[gnu::noinline]] lean<D> function(const lean<D>& x, const lean<D>& y) {                                            \
    return {function(x.number, y.number)};                                                                            \
  }                                                                                                                   \
  template <class D, class A>                                                                                         \
  requires std::is_arithmetic_v<A> lean<D> function(const lean<D>& x, const A& y) { return function(x, lean<D>(y)); } \
  template <class D, class A>                                                                                         \
  requires std::is_arithmetic_v<A> lean<D> function(const A& x, const lean<D>& y) { return function(lean<D>(x), y); }
KTE_LEAN(atan2)
KTE_LEAN(hypot)
KTE_LEAN(pow)
KTE_LEAN((min))
KTE_LEAN((max))
#undef KTE_LEAN
template <class D>
bool isfinite(const lean<D>& x) {
  return isfinite(x.number);
}
template <class D>
bool isnan(const lean<D>& x) {
  return isnan(x.number);
}

}  // namespace kte

template <class D>
struct std::numeric_limits<kte::lean<D>> : std::numeric_limits<D> {};
