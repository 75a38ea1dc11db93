#pragma once

#include <kte/detail/inline.hpp>

#include <type_traits>

/// Typed constants: numbers that are types, so that arithmetic on them is done by the compiler.
///
///   0*x -> 0,  1*x -> x,  -1*x -> -x,  0+x -> x            (1)
///
/// A vector, rotation or inertia may have such entries. One body of formulas then serves the general case and every
/// special one (an axis along z, a quarter turn, a point mass, a base at rest), and the special ones cost nothing.
namespace kte {

/// The integer N as a type. `constant<0>`, `constant<1>` and `constant<-1>` vanish from arithmetic by (1).
template <int N>
struct constant {};

/// The types of the constants 0 and 1.
using zero_t = constant<0>;
using one_t = constant<1>;
/// The constants 0, 1 and -1.
inline constexpr zero_t zero{};
inline constexpr one_t one{};
inline constexpr constant<-1> minus_one{};

/// A quantity that is not needed: arithmetic with `skip` gives `skip` and no machine code. An algorithm that needs no
/// positions starts from a base whose position is `skip`, and no position is computed. Entries x, y, z of a `skip` are
/// `skip`.
struct skip {
  static const skip x, y, z;
};
inline constexpr skip skip::x{}, skip::y{}, skip::z{};

namespace detail {
template <class T>
inline constexpr bool is_constant = false;
template <int N>
inline constexpr bool is_constant<constant<N>> = true;
}  // namespace detail

/// A typed constant.
template <class T>
concept typed_constant = detail::is_constant<std::remove_cvref_t<T>>;

/// Vectors, matrices and types composed of them; each has a member type `geometry`.
template <class T>
concept geometric = requires {
  typename std::remove_cvref_t<T>::geometry;
};

/// A scalar known at run time: double, float, a multiprecision number, a dual number, a SIMD pack.
template <class T>
concept variable = !typed_constant<T> && !geometric<T> && !std::is_same_v<std::remove_cvref_t<T>, skip>;

/// An entry of a vector: a typed constant or a scalar.
template <class T>
concept entry = typed_constant<T> || variable<T>;

/// The value of an entry as a scalar of type S.
template <class S, int N>
KTE_INLINE constexpr S as(constant<N>) {
  return S(N);
}
template <class S, variable T>
KTE_INLINE constexpr S as(const T& x) {
  return S(x);
}

/// The entry with numbers converted to scalars of type S; typed constants are unchanged.
template <class S, int N>
KTE_INLINE constexpr constant<N> lifted(constant<N> c) {
  return c;
}
template <class S, variable T>
KTE_INLINE constexpr S lifted(const T& x) {
  return S(x);
}

/// The value of a parameter; integers become double, so that `along_x(1)` means 1.0 m.
template <entry T>
KTE_INLINE constexpr auto real(const T& x) {
  if constexpr (std::is_integral_v<T>) {
    return static_cast<double>(x);
  } else {
    return x;
  }
}

// ---- constants with constants
template <int M, int N>
KTE_INLINE constexpr constant<M + N> operator+(constant<M>, constant<N>) {
  return {};
}
template <int M, int N>
KTE_INLINE constexpr constant<M - N> operator-(constant<M>, constant<N>) {
  return {};
}
template <int M, int N>
KTE_INLINE constexpr constant<M * N> operator*(constant<M>, constant<N>) {
  return {};
}
template <int N>
KTE_INLINE constexpr constant<-N> operator-(constant<N>) {
  return {};
}
template <int M, int N>
constexpr bool operator==(constant<M>, constant<N>) {
  return M == N;
}

// ---- constants with variables: (1)
template <int N, variable T>
KTE_INLINE constexpr auto operator*(constant<N>, const T& x) {
  if constexpr (N == 0) {
    return zero;
  } else if constexpr (N == 1) {
    return x;
  } else if constexpr (N == -1) {
    return T(-x);
  } else {
    return T(T(N) * x);
  }
}
template <int N, variable T>
KTE_INLINE constexpr auto operator*(const T& x, constant<N> n) {
  return n * x;
}
template <int N, variable T>
KTE_INLINE constexpr T operator+(constant<N>, const T& x) {
  if constexpr (N == 0) {
    return x;
  } else {
    return T(T(N) + x);
  }
}
template <int N, variable T>
KTE_INLINE constexpr T operator+(const T& x, constant<N> n) {
  return n + x;
}
template <int N, variable T>
KTE_INLINE constexpr T operator-(constant<N>, const T& x) {
  if constexpr (N == 0) {
    return T(-x);
  } else {
    return T(T(N) - x);
  }
}
template <int N, variable T>
KTE_INLINE constexpr T operator-(const T& x, constant<N>) {
  if constexpr (N == 0) {
    return x;
  } else {
    return T(x - T(N));
  }
}

// ---- skip with anything
/// Any type but `skip`.
template <class T>
concept not_skip = !std::is_same_v<T, skip>;

KTE_INLINE constexpr skip operator-(skip) { return {}; }
template <class T>
KTE_INLINE constexpr skip operator+(skip, const T&) {
  return {};
}
template <not_skip T>
KTE_INLINE constexpr skip operator+(const T&, skip) {
  return {};
}
template <class T>
KTE_INLINE constexpr skip operator-(skip, const T&) {
  return {};
}
template <not_skip T>
KTE_INLINE constexpr skip operator-(const T&, skip) {
  return {};
}
template <class T>
KTE_INLINE constexpr skip operator*(skip, const T&) {
  return {};
}
template <not_skip T>
KTE_INLINE constexpr skip operator*(const T&, skip) {
  return {};
}
template <class T>
KTE_INLINE constexpr skip operator/(skip, const T&) {
  return {};
}
template <not_skip T>
KTE_INLINE constexpr skip operator/(const T&, skip) {
  return {};
}
/// The square root of `skip` is `skip`.
[[nodiscard]] KTE_INLINE constexpr skip sqrt(skip) { return {}; }

/// Literals for typed constants: `0_c`, `1_c`, `-1_c`.
inline namespace literals {
template <char... digits>
constexpr auto operator""_c() {
  static_assert(((digits >= '0' && digits <= '9') && ...),
                "kte: a typed constant is a whole number, such as 0_c or 1_c");
  constexpr int value = [] {
    int n = 0;
    ((n = 10 * n + (digits - '0')), ...);
    return n;
  }();
  return constant<value>{};
}
}  // namespace literals

namespace detail {
/// A typed constant as a double, a number unchanged.
template <entry T>
KTE_INLINE constexpr auto as_number(const T& x) {
  if constexpr (typed_constant<T>) {
    return as<double>(x);
  } else {
    return x;
  }
}
}  // namespace detail

}  // namespace kte
