#pragma once

#include <kte/dynamics/configuration_space.hpp>
#include <kte/dynamics/inverse_dynamics.hpp>
#include <kte/math/dual.hpp>

namespace kte {

namespace detail {

/// A configuration that moves along velocity number `direction` of a coordinate: lane `lane` of its numbers.
template <class S, class Q, int N, std::size_t M>
void displace(freedom f, const Q& q, int direction, std::size_t lane, std::array<dual<S, N>, M>& x) {
  std::array<S, 6> unit{};
  unit[static_cast<std::size_t>(direction)] = S(1);
  f.v = 0;
  std::array<S, M> rate{};
  rate_of_one<S>(f, q, unit, rate);
  for (auto i = static_cast<std::size_t>(f.q), k = i; k < i + static_cast<std::size_t>(nq_of(f.what)); ++k)
    x[k].derivative[lane] = rate[k];
}

/// Derivatives of inverse dynamics by q and v in dual numbers, four directions at a time: for chains of any elements.
template <class S, class Chain, class Base, class Q, class V, class A>
void dual_derivatives(const Chain& c, const Base& base, const Q& q, const V& v, const A& a,
                      inverse_dynamics_result<S, Chain::dofs>& r) {
  constexpr int lanes = 4;
  using number = dual<S, lanes>;
  using wiring = typename Chain::wiring;
  constexpr std::size_t n = std::size_t{Chain::dofs}, nq = std::size_t{Chain::nq};
  const auto evaluate = [&](const auto& x, const auto& y) {
    const configuration<number, wiring, std::array<number, nq>> at(x);
    return coordinate_forces<number>(c, given{at, each<number, std::array<number, n>>{y}, each<number, A>{a}, base},
                                     minus_one);
  };
  const auto constants = [](const auto& x, auto& out) {
    for (std::size_t i = 0; i < out.size(); ++i) out[i] = number(S(x[i]));
  };
  std::array<number, nq> x;
  std::array<number, n> y;
  for (int by_v = 0; by_v < 2; ++by_v)
    for (int first = 0; first < Chain::dofs; first += lanes) {
      constants(q, x), constants(v, y);
      for (std::size_t f = 0; f < wiring::freedoms; ++f) {
        const freedom& at = wiring::table.free[f];
        for (int k = 0; k < nv_of(at.what); ++k) {
          const int lane = at.v + k - first;
          if (lane < 0 || lane >= lanes) continue;
          if (by_v)
            y[static_cast<std::size_t>(at.v + k)].derivative[static_cast<std::size_t>(lane)] = S(1);
          else
            displace(at, q, k, static_cast<std::size_t>(lane), x);
        }
      }
      const auto tau = evaluate(x, y);
      for (int i = 0; i < Chain::dofs; ++i) {
        r.tau[i] = tau[i].value;
        for (int j = first; j < Chain::dofs && j < first + lanes; ++j)
          (by_v ? r.by_v : r.by_q)(i, j) = tau[i].derivative[static_cast<std::size_t>(j - first)];
      }
    }
}

}  // namespace detail
}  // namespace kte
