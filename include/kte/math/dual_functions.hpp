#pragma once

#include <kte/math/dual_number.hpp>
#include <kte/math/select.hpp>
#include <kte/math/sincos.hpp>

#include <cmath>

/// Functions of dual numbers: f(x)' = f'(x) x'. The value is that of the same function of T. Where f' is infinite or
/// undefined (sqrt at 0, hypot and atan2 at the origin, asin at 1), so are the derivatives, those of constants too.
namespace kte {

/// sqrt' = 1/(2 sqrt)
template <class T, int N>
[[nodiscard]] KTE_INLINE constexpr dual<T, N> sqrt(const dual<T, N>& x) {
  using std::sqrt;
  const T s(sqrt(x.value));
  return detail::chained(s, T(T(1) / (s + s)), x);
}
/// |x|' = -x' below zero, else x'.
template <class T, int N>
[[nodiscard]] KTE_INLINE constexpr dual<T, N> abs(const dual<T, N>& x) {
  using std::abs;
  return detail::chained(T(abs(x.value)), select(x.value < 0, T(-1), T(1)), x);
}
/// |x|, see `abs`.
template <class T, int N>
[[nodiscard]] KTE_INLINE constexpr dual<T, N> fabs(const dual<T, N>& x) {
  return abs(x);
}

/// Sine and cosine of an angle, rad; each is the derivative of the other, up to its sign.
template <class T, int N>
KTE_INLINE constexpr void sincos(const dual<T, N>& angle, dual<T, N>& sine, dual<T, N>& cosine) {
  const dual<T, N> x = angle;
  T s, c;
  sincos(x.value, s, c);
  sine = detail::chained(s, c, x);
  cosine = detail::chained(c, T(-s), x);
}
/// sin' = cos
template <class T, int N>
[[nodiscard]] KTE_INLINE constexpr dual<T, N> sin(const dual<T, N>& x) {
  T s, c;
  sincos(x.value, s, c);
  return detail::chained(s, c, x);
}
/// cos' = -sin
template <class T, int N>
[[nodiscard]] KTE_INLINE constexpr dual<T, N> cos(const dual<T, N>& x) {
  T s, c;
  sincos(x.value, s, c);
  return detail::chained(c, T(-s), x);
}
/// tan' = 1 + tan^2
template <class T, int N>
[[nodiscard]] KTE_INLINE constexpr dual<T, N> tan(const dual<T, N>& x) {
  using std::tan;
  const T t(tan(x.value));
  return detail::chained(t, T(1 + t * t), x);
}

namespace detail {
/// 1 / sqrt(1 - x^2), without cancellation next to 1.
template <class T>
KTE_INLINE constexpr T slope_of_asin(const T& x) {
  using std::sqrt;
  return T(T(1) / sqrt(T((1 - x) * (1 + x))));
}
}  // namespace detail

/// asin' = 1/sqrt(1 - x^2)
template <class T, int N>
[[nodiscard]] KTE_INLINE constexpr dual<T, N> asin(const dual<T, N>& x) {
  using std::asin;
  return detail::chained(T(asin(x.value)), detail::slope_of_asin(x.value), x);
}
/// acos' = -1/sqrt(1 - x^2)
template <class T, int N>
[[nodiscard]] KTE_INLINE constexpr dual<T, N> acos(const dual<T, N>& x) {
  using std::acos;
  return detail::chained(T(acos(x.value)), T(-detail::slope_of_asin(x.value)), x);
}
/// atan' = 1/(1 + x^2)
template <class T, int N>
[[nodiscard]] KTE_INLINE constexpr dual<T, N> atan(const dual<T, N>& x) {
  using std::atan;
  return detail::chained(T(atan(x.value)), T(T(1) / (1 + x.value * x.value)), x);
}
/// exp' = exp
template <class T, int N>
[[nodiscard]] KTE_INLINE constexpr dual<T, N> exp(const dual<T, N>& x) {
  using std::exp;
  const T e(exp(x.value));
  return detail::chained(e, e, x);
}
/// tanh' = 1 - tanh^2, to the last digit of 1
template <class T, int N>
[[nodiscard]] KTE_INLINE constexpr dual<T, N> tanh(const dual<T, N>& x) {
  using std::tanh;
  const T t(tanh(x.value));
  return detail::chained(t, T((1 - t) * (1 + t)), x);
}
/// log' = 1/x
template <class T, int N>
[[nodiscard]] KTE_INLINE constexpr dual<T, N> log(const dual<T, N>& x) {
  using std::log;
  return detail::chained(T(log(x.value)), T(T(1) / x.value), x);
}

// ---- functions of two arguments; one may be a constant

/// atan2(y, x)' = (x y' - y x') / (x^2 + y^2). The squares must neither overflow nor underflow.
template <class T, int N>
[[nodiscard]] KTE_INLINE constexpr dual<T, N> atan2(const dual<T, N>& y, const dual<T, N>& x) {
  using std::atan2;
  const T r(T(1) / (x.value * x.value + y.value * y.value));
  return detail::chained(T(atan2(y.value, x.value)), T(x.value * r), y, T(-y.value * r), x);
}
/// hypot(x, y)' = (x x' + y y') / hypot(x, y)
template <class T, int N>
[[nodiscard]] KTE_INLINE constexpr dual<T, N> hypot(const dual<T, N>& x, const dual<T, N>& y) {
  using std::hypot, std::sqrt;
  if constexpr (requires { T(hypot(x.value, y.value)); }) {
    const T h(hypot(x.value, y.value));
    return detail::chained(h, T(x.value / h), x, T(y.value / h), y);
  } else {
    const T h(sqrt(T(x.value * x.value + y.value * y.value)));  // multiprecision numbers may have no hypot
    return detail::chained(h, T(x.value / h), x, T(y.value / h), y);
  }
}
/// (x^p)' = p x^(p-1) x';  zero for p = 0, at x = 0 too.
template <class T, int N, constant_of<T> A>
[[nodiscard]] KTE_INLINE constexpr dual<T, N> pow(const dual<T, N>& x, const A& exponent) {
  using std::pow;
  const auto& p = detail::factor<T>(exponent);  // in nested dual numbers still a constant: x may be negative
  return detail::chained(T(pow(x.value, p)), p == 0 ? T(0) : T(p * pow(x.value, p - 1)), x);
}
/// (x^y)' = y x^(y-1) x' + x^y log(x) y'; the second term is zero at x = 0 and NaN for x < 0.
template <class T, int N>
[[nodiscard]] KTE_INLINE constexpr dual<T, N> pow(const dual<T, N>& x, const dual<T, N>& y) {
  using std::log, std::pow;
  const T v(pow(x.value, y.value));
  return detail::chained(v, y.value == 0 ? T(0) : T(y.value * pow(x.value, T(y.value - 1))), x,
                         x.value == 0 ? T(0) : T(v * log(x.value)), y);
}
template <class T, int N, constant_of<T> A>
[[nodiscard]] KTE_INLINE constexpr dual<T, N> pow(const A& base, const dual<T, N>& y) {
  using std::log, std::pow;
  const T x(base);
  T v;
  if constexpr (is_dual<T>) {
    v = pow(base, y.value);
  } else {
    v = pow(x, y.value);
  }
  return detail::chained(v, x == 0 ? T(0) : T(v * log(x)), y);
}
template <class T, int N, constant_of<T> A>
[[nodiscard]] KTE_INLINE constexpr dual<T, N> atan2(const A& y, const dual<T, N>& x) {
  return atan2(dual<T, N>(y), x);
}
template <class T, int N, constant_of<T> A>
[[nodiscard]] KTE_INLINE constexpr dual<T, N> atan2(const dual<T, N>& y, const A& x) {
  return atan2(y, dual<T, N>(x));
}
template <class T, int N, constant_of<T> A>
[[nodiscard]] KTE_INLINE constexpr dual<T, N> hypot(const A& x, const dual<T, N>& y) {
  return hypot(dual<T, N>(x), y);
}
template <class T, int N, constant_of<T> A>
[[nodiscard]] KTE_INLINE constexpr dual<T, N> hypot(const dual<T, N>& x, const A& y) {
  return hypot(x, dual<T, N>(y));
}

/// The smaller of two, or the larger, with its derivatives; the first if both are equal, as std::min and std::max.
template <class T, int N>
KTE_INLINE constexpr dual<T, N>(min)(const dual<T, N>& a, const dual<T, N>& b) {
  return b < a ? b : a;
}
template <class T, int N, constant_of<T> A>
KTE_INLINE constexpr dual<T, N>(min)(const A& a, const dual<T, N>& b) {
  return (min)(dual<T, N>(a), b);
}
template <class T, int N, constant_of<T> A>
KTE_INLINE constexpr dual<T, N>(min)(const dual<T, N>& a, const A& b) {
  return (min)(a, dual<T, N>(b));
}
template <class T, int N>
KTE_INLINE constexpr dual<T, N>(max)(const dual<T, N>& a, const dual<T, N>& b) {
  return a < b ? b : a;
}
template <class T, int N, constant_of<T> A>
KTE_INLINE constexpr dual<T, N>(max)(const A& a, const dual<T, N>& b) {
  return (max)(dual<T, N>(a), b);
}
template <class T, int N, constant_of<T> A>
KTE_INLINE constexpr dual<T, N>(max)(const dual<T, N>& a, const A& b) {
  return (max)(a, dual<T, N>(b));
}

// ---- of the value alone, like comparisons
/// Whether the value is finite; derivatives are not looked at.
template <class T, int N>
[[nodiscard]] KTE_INLINE constexpr bool isfinite(const dual<T, N>& x) {
  using std::isfinite;
  return isfinite(x.value);
}
/// Whether the value is NaN.
template <class T, int N>
[[nodiscard]] KTE_INLINE constexpr bool isnan(const dual<T, N>& x) {
  using std::isnan;
  return isnan(x.value);
}
/// Whether the value is infinite.
template <class T, int N>
[[nodiscard]] KTE_INLINE constexpr bool isinf(const dual<T, N>& x) {
  using std::isinf;
  return isinf(x.value);
}

}  // namespace kte
