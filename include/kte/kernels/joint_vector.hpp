#pragma once

#include <kte/detail/inline.hpp>
#include <kte/errors.hpp>
#include <kte/math/select.hpp>

#include <Eigen/Core>

#include <concepts>

namespace kte {

/// A vector with one number per degree of freedom.
template <class S, int N>
using joint_vector = Eigen::Matrix<S, N, 1>;
/// A square matrix over the degrees of freedom.
template <class S, int N>
using joint_matrix = Eigen::Matrix<S, N, N>;

/// Generalized forces tau and their derivatives: by_q(i, j) is the derivative of tau_i along v_j (for numbers the
/// partial derivative; for rotations and poses along axes of the moving frame), by_v and by_a are those by velocity and
/// acceleration j. by_a is the mass matrix, minus the derivatives of load-dependent friction.
template <class S, int N>
struct inverse_dynamics_result {
  joint_vector<S, N> tau;
  joint_matrix<S, N> by_q, by_v, by_a;
};
/// Accelerations a and their derivatives by_q, by_v and by_tau, as in `inverse_dynamics_result`; by_tau is the inverse
/// of by_a.
template <class S, int N>
struct forward_dynamics_result {
  joint_vector<S, N> a;
  joint_matrix<S, N> by_q, by_v, by_tau;
};

/// An argument q, v, a or tau of algorithms: an Eigen vector, std::array, std::span, a pointer.
template <class T>
concept indexable = requires(const T& x, std::size_t i) {
  x[i];
};

/// The type of the numbers of such an argument.
template <indexable T>
using value_of = std::remove_cvref_t<decltype(std::declval<const T&>()[std::size_t{}])>;

namespace detail {
[[noreturn, gnu::cold, gnu::noinline]] inline void raise_size(std::size_t has, std::size_t n, const char* name,
                                                              const char* what) {
  raise<bad_argument>(std::string("kte: ") + name + " has " + std::to_string(has) + " numbers, the chain has " +
                      std::to_string(n) + " " + what);
}
}  // namespace detail

/// Rejects arguments of the wrong size, if the size is known. `what`: the unit of n in the message.
template <indexable T>
constexpr void check_size(std::size_t n, const T& x, const char* name, const char* what = "degrees of freedom") {
  if constexpr (requires { x.size(); }) {
    if (static_cast<std::size_t>(x.size()) != n) [[unlikely]]
      detail::raise_size(static_cast<std::size_t>(x.size()), n, name, what);
  } else if constexpr (std::is_array_v<T>) {
    if (std::extent_v<T> != n) [[unlikely]]
      detail::raise_size(std::extent_v<T>, n, name, what);
  }
}
namespace detail {
/// The number of elements of a type, if its type determines it; otherwise -1.
template <class T>
inline constexpr std::ptrdiff_t count_of = -1;
template <class T>
requires requires { std::tuple_size<T>::value; }
inline constexpr std::ptrdiff_t count_of<T> = std::ptrdiff_t{std::tuple_size<T>::value};
template <class T>
requires requires { T::SizeAtCompileTime; }
inline constexpr std::ptrdiff_t count_of<T> = T::SizeAtCompileTime;
template <class T, std::size_t N>
inline constexpr std::ptrdiff_t count_of<T[N]> = std::ptrdiff_t{N};
/// Whether it may hold N elements.
template <class T, int N>
inline constexpr bool holds = count_of<T> < 0 || count_of<T> == N;
}  // namespace detail

template <int N, indexable T>
constexpr void check_size(const T& x, const char* name, const char* what = "degrees of freedom") {
  static_assert(detail::holds<T, N>,
                "kte: the size of an argument (v, a, tau) differs from the number of degrees of freedom of the chain");
  check_size(std::size_t{N}, x, name, what);
}

namespace detail {
/// Checks that q has the size of a configuration.
template <indexable Q>
constexpr void check_configuration(int nq, int dofs, const Q& q) {
  check_size(static_cast<std::size_t>(nq), q, "q", nq == dofs ? "degrees of freedom" : "numbers of a configuration");
}
template <class Chain, indexable Q>
constexpr void check_configuration(const Q& q) {
  static_assert(holds<Q, Chain::nq>, "kte: the size of q differs from that of a configuration of the chain");
  check_configuration(Chain::nq, Chain::dofs, q);
}

/// term(0) + ... + term(n - 1), in four independent sums; many terms in sixteen. (Eigen's sum causes warnings of g++ 12
/// for AVX-512.)
template <class S, class Term>
KTE_INLINE constexpr S sum_by_four(std::size_t n, const Term& term) {
  std::size_t i = 0;
  S a(0), b(0), c(0), d(0);  // not an array, which compilers would keep on the stack
  if (n < 8) {
    for (; i < n; ++i) a += term(i);
    return a;
  }
  if (n >= 64) {
    S more[16]{};
    for (const std::size_t whole = n - n % 16; i < whole; i += 16)
      for (std::size_t k = 0; k < 16; ++k) more[k] += term(i + k);
    for (const S& x : more) a += x;
  }
  for (const std::size_t whole = n - n % 4; i < whole; i += 4)
    a += term(i), b += term(i + 1), c += term(i + 2), d += term(i + 3);
  for (; i < n; ++i) a += term(i);
  return (a + b) + (c + d);
}
template <class X>
KTE_INLINE constexpr auto zero_or_nan(const X& x, std::size_t n) {
  using S = std::remove_cvref_t<decltype(x[0])>;
  return sum_by_four<S>(n, [&x](std::size_t i) KTE_INLINE_LAMBDA { return S(x[i] * S(0)); });
}
template <class X>
KTE_INLINE constexpr bool all_finite(const X& x, std::size_t n) {
  const auto sum = zero_or_nan(x, n);
  return all(sum == decltype(sum)(0));
}
/// Throws `bad_argument` unless x[0] ... x[n-1] are finite: no algorithm returns NaN silently.
template <class X>
KTE_INLINE constexpr void check_finite(const X& x, std::size_t n, const char* what) {
  if (!all_finite(x, n)) [[unlikely]]
    raise<bad_argument>(what);
}
}  // namespace detail

}  // namespace kte
