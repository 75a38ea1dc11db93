#pragma once

#include <kte/dynamics/inverse_dynamics.hpp>
#include <kte/math/dual.hpp>

namespace kte {

namespace detail {

/// A configuration that moves along velocity number `direction` of a coordinate: lane `lane` of its numbers.
template <class S, class Q, int N, std::size_t M>
void displace(const freedom& f, const Q& q, int direction, std::size_t lane, std::array<dual<S, N>, M>& x) {
  const auto i = static_cast<std::size_t>(f.q);
  if (f.what == kind::gen) {
    x[i].derivative[lane] = S(1);
    return;
  }
  const int linear = f.what == kind::rotation_3D ? 0 : f.what == kind::pose_2D ? 2 : 3;
  const std::size_t r = i + static_cast<std::size_t>(linear);  // of the rotation
  if (f.what == kind::pose_2D) {
    using std::cos;
    using std::sin;
    const S c = cos(S(q[r])), s = sin(S(q[r]));
    x[i].derivative[lane] = direction == 0 ? c : direction == 1 ? S(-s) : S(0);
    x[i + 1].derivative[lane] = direction == 0 ? s : direction == 1 ? c : S(0);
    x[r].derivative[lane] = S(direction == 2);
    return;
  }
  const unit_quaternion<S> turn{S(q[r]), S(q[r + 1]), S(q[r + 2]), S(q[r + 3])};
  const auto unit = [&](int k) { return S(direction == k); };
  if (direction < linear) {
    const auto d = matrix_of_any_length(turn) * vec3<S>{unit(0), unit(1), unit(2)};
    x[i].derivative[lane] = d.x, x[i + 1].derivative[lane] = d.y, x[i + 2].derivative[lane] = d.z;
  } else {  // q (0, e/2)
    const S half = S(1) / S(2);
    const auto d =
        turn * unit_quaternion<S>{S(0), half * unit(linear), half * unit(linear + 1), half * unit(linear + 2)};
    const S numbers[]{d.w, d.x, d.y, d.z};
    for (std::size_t k = 0; k < 4; ++k) x[r + k].derivative[lane] = numbers[k];
  }
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
