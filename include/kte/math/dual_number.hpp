#pragma once

#include <kte/math/constant.hpp>
#include <kte/math/dual_simd.hpp>

namespace kte {

template <class T, int N>
struct dual;

/// Whether T is a dual number.
template <class T>
inline constexpr bool is_dual = false;
template <class T, int N>
inline constexpr bool is_dual<dual<T, N>> = true;

namespace detail {
template <class A, class T>
inline constexpr bool is_constant_of = std::is_arithmetic_v<A> || std::is_same_v<A, T>;
template <class A, class T, int N>
inline constexpr bool is_constant_of<A, dual<T, N>> = std::is_same_v<A, dual<T, N>> || is_constant_of<A, T>;

/// A constant as a factor of numbers of type T.
template <class T, class A>
KTE_INLINE constexpr decltype(auto) factor(const A& a) {
  if constexpr (std::is_arithmetic_v<T>) {
    return static_cast<T>(a);
  } else {
    return (a);
  }
}
}  // namespace detail

/// Constants in arithmetic with dual numbers over T: arithmetic types and T; for nested dual numbers also the constants
/// of the inner ones.
template <class A, class T>
concept constant_of = detail::is_constant_of<A, T>;

/// A number with its derivatives by N variables, which are propagated exactly: no differences, no step size.
///
///   f = (f, df/dx_1 ... df/dx_N),   (f o g)' = f'(g) g'            (1)
///
/// Use it as the scalar of a chain: start from `seeded<N>(x_i, i)`, read `derivative`, or `jacobian_of` a vector. T is
/// double, float, long double, a multiprecision number, or a dual number for second derivatives. Numbers convert to
/// constants, whose derivatives are zero. Comparisons compare values only, so a program takes the same branches with
/// and without derivatives. `dual x;` is not initialized, like `double x;`; `dual x{}` is zero.
///
/// The value is computed by the same operations as without derivatives. An operation adds to the error of a derivative
/// at most 3 eps (division 4 eps), relative to the sum of the sizes of the terms in its formula.
template <class T, int N>
struct dual {
  using scalar = T;
  static constexpr int variables = N;

  T value;
  derivatives<T, N> derivative;

  dual() = default;
  KTE_INLINE constexpr dual(const T& x) : value(x), derivative{} {}  // NOLINT(google-explicit-constructor)
  template <constant_of<T> A>
  KTE_INLINE constexpr dual(const A& x)
      : value(static_cast<T>(x)), derivative{} {}  // NOLINT(google-explicit-constructor)
  KTE_INLINE constexpr dual(const T& x, const derivatives<T, N>& dx) : value(x), derivative(dx) {}

  constexpr dual& operator+=(const auto& x) { return *this = *this + x; }
  constexpr dual& operator-=(const auto& x) { return *this = *this - x; }
  constexpr dual& operator*=(const auto& x) { return *this = *this * x; }
  constexpr dual& operator/=(const auto& x) { return *this = *this / x; }

  KTE_INLINE friend constexpr bool operator==(const dual& a, const dual& b) { return a.value == b.value; }
  KTE_INLINE friend constexpr bool operator<(const dual& a, const dual& b) { return a.value < b.value; }
  KTE_INLINE friend constexpr bool operator>(const dual& a, const dual& b) { return a.value > b.value; }
  KTE_INLINE friend constexpr bool operator<=(const dual& a, const dual& b) { return a.value <= b.value; }
  KTE_INLINE friend constexpr bool operator>=(const dual& a, const dual& b) { return a.value >= b.value; }
};

namespace detail {
/// A function of one argument by (1): its value, its slope there, the argument.
template <class T, int N>
KTE_INLINE constexpr dual<T, N> chained(const T& value, const T& slope, const dual<T, N>& x) {
  return {value, x.derivative.map([&](const auto& dx) KTE_INLINE_LAMBDA { return slope * dx; }, x.derivative)};
}
/// The derivatives of a result: r' = s a' + t b'.
template <class T, int N>
KTE_INLINE constexpr dual<T, N> chained(const T& value, const T& s, const dual<T, N>& a, const T& t,
                                        const dual<T, N>& b) {
  return {value, a.derivative.map([&](const auto& da, const auto& db) KTE_INLINE_LAMBDA { return s * da + t * db; },
                                  a.derivative, b.derivative)};
}
template <class T, int N>
KTE_INLINE constexpr dual<T, N> negated_to(const T& value, const dual<T, N>& x) {
  return {value, x.derivative.map([](const auto& dx) KTE_INLINE_LAMBDA { return -dx; }, x.derivative)};
}
}  // namespace detail

template <class T, int N>
KTE_INLINE constexpr dual<T, N> operator+(const dual<T, N>& a) {
  return a;
}
template <class T, int N>
KTE_INLINE constexpr dual<T, N> operator-(const dual<T, N>& a) {
  return detail::negated_to(T(-a.value), a);
}

// ---- two dual numbers
template <class T, int N>
KTE_INLINE constexpr dual<T, N> operator+(const dual<T, N>& a, const dual<T, N>& b) {
  return {T(a.value + b.value), a.derivative.map([](const auto& x, const auto& y) KTE_INLINE_LAMBDA { return x + y; },
                                                 a.derivative, b.derivative)};
}
template <class T, int N>
KTE_INLINE constexpr dual<T, N> operator-(const dual<T, N>& a, const dual<T, N>& b) {
  return {T(a.value - b.value), a.derivative.map([](const auto& x, const auto& y) KTE_INLINE_LAMBDA { return x - y; },
                                                 a.derivative, b.derivative)};
}
/// (a b)' = b a' + a b'
template <class T, int N>
KTE_INLINE constexpr dual<T, N> operator*(const dual<T, N>& a, const dual<T, N>& b) {
  return detail::chained(T(a.value * b.value), b.value, a, a.value, b);
}
/// r = a/b,  r' = (a' - r b') / b. One division for all, by the reciprocal.
template <class T, int N>
KTE_INLINE constexpr dual<T, N> operator/(const dual<T, N>& a, const dual<T, N>& b) {
  const T r(a.value / b.value), inverse(T(1) / b.value);
  return {r, a.derivative.map([&](const auto& x, const auto& y) KTE_INLINE_LAMBDA { return (x - r * y) * inverse; },
                              a.derivative, b.derivative)};
}

// ---- with constants, whose zero derivatives are left out
template <class T, int N, constant_of<T> A>
KTE_INLINE constexpr dual<T, N> operator+(const A& a, const dual<T, N>& b) {
  return {T(detail::factor<T>(a) + b.value), b.derivative};
}
template <class T, int N, constant_of<T> A>
KTE_INLINE constexpr dual<T, N> operator+(const dual<T, N>& a, const A& b) {
  return {T(a.value + detail::factor<T>(b)), a.derivative};
}
template <class T, int N, constant_of<T> A>
KTE_INLINE constexpr dual<T, N> operator-(const A& a, const dual<T, N>& b) {
  return detail::negated_to(T(detail::factor<T>(a) - b.value), b);
}
template <class T, int N, constant_of<T> A>
KTE_INLINE constexpr dual<T, N> operator-(const dual<T, N>& a, const A& b) {
  return {T(a.value - detail::factor<T>(b)), a.derivative};
}
template <class T, int N, constant_of<T> A>
KTE_INLINE constexpr dual<T, N> operator*(const A& a, const dual<T, N>& b) {
  const auto& s = detail::factor<T>(a);
  return {T(s * b.value), b.derivative.map([&](const auto& x) KTE_INLINE_LAMBDA { return s * x; }, b.derivative)};
}
template <class T, int N, constant_of<T> A>
KTE_INLINE constexpr dual<T, N> operator*(const dual<T, N>& a, const A& b) {
  return b * a;
}
template <class T, int N, constant_of<T> A>
KTE_INLINE constexpr dual<T, N> operator/(const dual<T, N>& a, const A& b) {
  const auto& s = detail::factor<T>(b);
  return {T(a.value / s), a.derivative.map([&](const auto& x) KTE_INLINE_LAMBDA { return x / s; }, a.derivative)};
}
template <class T, int N, constant_of<T> A>
KTE_INLINE constexpr dual<T, N> operator/(const A& a, const dual<T, N>& b) {
  const T r(detail::factor<T>(a) / b.value);
  return detail::chained(r, T(-r / b.value), b);
}

}  // namespace kte
