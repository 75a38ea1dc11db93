#pragma once

#include <kte/kernels/newton_solver.hpp>
#include <kte/math/derivatives_of.hpp>

/// Values and derivatives of functions y(q) that equations define (kernels/newton_solver.hpp).
namespace kte::detail {

template <class One, class T>
constexpr One lane_of(const T& x, std::size_t lane) {
  if constexpr (is_dual<T>) {
    One y{};
    y.value = lane_of<decltype(y.value)>(x.value, lane);
    for (std::size_t i = 0; i < T::variables; ++i) y.derivative[i] = lane_of<decltype(y.value)>(x.derivative[i], lane);
    return y;
  } else {
    return x[lane];
  }
}
template <class T, class One>
constexpr void set_lane(T& x, std::size_t lane, const One& y) {
  if constexpr (is_dual<T>) {
    set_lane(x.value, lane, y.value);
    for (std::size_t i = 0; i < T::variables; ++i) set_lane(x.derivative[i], lane, y.derivative[i]);
  } else {
    x.set(lane, y);
  }
}
/// of(q, start) of each lane of packs.
template <class One, class T, std::size_t N, class S, std::size_t M, class F>
constexpr numbers<T, M> lane_by_lane(const numbers<T, N>& q, const numbers<S, M>& start, const F& of) {
  numbers<T, M> y{};
  for (std::size_t lane = 0; lane < S::lanes; ++lane) {
    numbers<One, N> at;
    numbers<typename S::value_type, M> from;
    for (std::size_t i = 0; i < N; ++i) at[i] = lane_of<One>(q[i], lane);
    for (std::size_t k = 0; k < M; ++k) from[k] = start[k][lane];
    const auto found = of(at, from);
    for (std::size_t k = 0; k < M; ++k) set_lane(y[k], lane, found[k]);
  }
  return y;
}
/// Relative errors of dF/dy: above the first, a type with more digits solves (1); above the second, nothing does.
inline constexpr double error_for_more_digits = 1e-12, largest_error = 1.5e-8;

/// y of (1) and its derivatives, to all orders of T: with J = dF/dy of plain numbers each step of
///
///   y <- y - J^-1 F(q, y)          (3)
///
/// makes the derivatives of one order more exact. fail(why, q) throws.
template <class T, std::size_t N, std::size_t M, class Law>
constexpr numbers<T, M> with_derivatives(const Law& law, const numbers<T, N>& q,
                                         const implicit_solution<typename derivatives_of<T>::plain, M>& x) {
  numbers<T, M> y;
  for (std::size_t k = 0; k < M; ++k) y[k] = T(x.y[k]);
  for (int step = 0; step < derivatives_of<T>::order; ++step) {
    const auto f = rows_of<T>(law, q, y);
    for (std::size_t k = 0; k < M; ++k)
      for (std::size_t r = 0; r < M; ++r) y[k] -= T(x.inverse[k][r]) * f[r];
  }
  return y;
}
template <class T, std::size_t N, std::size_t M, class Law, class S, class Fail>
constexpr numbers<T, M> implicit_value(const Law& law, const numbers<T, N>& q, const numbers<S, M>& start,
                                       bool starts_near, const Fail& fail) {
  using of = derivatives_of<T>;
  if constexpr (requires { S::lanes; }) {
    using one = typename of::template with<typename S::value_type>;
    return lane_by_lane<one>(q, start, [&](const auto& at, const auto& from) {
      return implicit_value<one>(law, at, from, starts_near, fail);
    });
  } else {
    numbers<S, N> plain;
    for (std::size_t i = 0; i < N; ++i) plain[i] = of::value(q[i]);
    implicit_solution<S, M> x;
    const newton_solver<Law, S, N, M> newton(law, plain);
    const auto require = [&](no_solution_of why) {
      if (why != no_solution_of::none) [[unlikely]]
        fail(why, plain);
    };
    require(newton.solve(start, starts_near, x));
    if constexpr (of::order > 0) {
      const rate_certainty rates = newton.rates(x);
      if (!(rates.error <= error_for_more_digits)) [[unlikely]] {
        if constexpr (std::is_same_v<S, double> || std::is_same_v<S, float>) {
          using more = std::conditional_t<std::is_same_v<S, float>, double, long double>;
          using number = typename of::template with<more>;
          numbers<number, N> p;
          numbers<more, M> from;
          for (std::size_t i = 0; i < N; ++i) p[i] = of::template to<more>(q[i]);
          for (std::size_t k = 0; k < M; ++k) from[k] = x.y[k];
          const auto exact = implicit_value<number>(law, p, from, false, fail);
          numbers<T, M> y;
          for (std::size_t k = 0; k < M; ++k) y[k] = of::from(exact[k]);
          return y;
        } else if (!(rates.error < largest_error)) {
          require(rates.bounded ? no_solution_of::ambiguous : no_solution_of::undetermined);
        }
      }
    }
    return with_derivatives<T>(law, q, x);
  }
}

}  // namespace kte::detail
