#pragma once

#include <kte/dynamics/configuration_space.hpp>
#include <kte/dynamics/inverse_dynamics.hpp>
#include <kte/math/dual.hpp>

namespace kte {

namespace detail {

/// Displaces a coordinate along number `direction` of its velocities, as lane `lane` of its numbers.
template <class S, int N>
void displace(freedom f, int direction, std::size_t lane, std::span<dual<S, N>> x) {
  std::array<S, 6> unit{};
  unit[static_cast<std::size_t>(direction)] = S(1);
  std::array<S, 7> own{}, rate{};
  const auto first = static_cast<std::size_t>(f.q), count = static_cast<std::size_t>(nq_of(f.what));
  for (std::size_t k = 0; k < count; ++k) own[k] = x[first + k].value;
  f.q = f.v = 0;
  rate_of_one<S>(f, own, unit, rate);
  for (std::size_t k = 0; k < count; ++k) x[first + k].derivative[lane] = rate[k];
}

/// Directions that are derived together: along degrees of freedom from `first` on, of q, v or a; or along all degrees
/// of freedom of the colours from `first` on, if each force depends on at most one of each colour.
struct directions {
  vector_of by;
  int first;
  const int* colour = nullptr;

  int lane(int row) const { return (colour != nullptr ? colour[row] : row) - first; }
};
/// Sets the derivatives of q, v and a to these directions.
template <class S, int N>
void point_along(const directions& along, std::span<const freedom> freedoms, std::span<dual<S, N>> q,
                 std::span<dual<S, N>> v, std::span<dual<S, N>> a) {
  for (auto* numbers : {&q, &v, &a})
    for (auto& x : *numbers) x = dual<S, N>(x.value);
  for (const freedom& f : freedoms)
    for (int k = 0; k < nv_of(f.what); ++k) {
      const int lane = along.lane(f.v + k);
      if (lane < 0 || lane >= N) continue;
      if (along.by == vector_of::q)
        displace(f, k, static_cast<std::size_t>(lane), q);
      else
        (along.by == vector_of::v ? v : a)[static_cast<std::size_t>(f.v + k)]
            .derivative[static_cast<std::size_t>(lane)] = S(1);
    }
}
/// Writes the derivatives of tau = evaluate(directions), a function of q, v and a in dual numbers, by q, v, and a if
/// `by_a`, to `r`, as many directions at a time as dual numbers have.
template <class S, int N, class Evaluate, class Result>
void derive_by_duals(std::span<const freedom> freedoms, std::span<dual<S, N>> q, std::span<dual<S, N>> v,
                     std::span<dual<S, N>> a, bool by_a, const Evaluate& evaluate, Result& r) {
  const int dofs = static_cast<int>(v.size());
  for (const vector_of by : {vector_of::q, vector_of::v, vector_of::a})
    for (int first = 0; first < dofs && (by != vector_of::a || by_a); first += N) {
      const directions along{by, first};
      point_along(along, freedoms, q, v, a);
      const auto& tau = evaluate(along);
      auto& to = by == vector_of::q ? r.by_q : by == vector_of::v ? r.by_v : r.by_a;
      for (int i = 0; i < dofs; ++i) {
        r.tau[i] = tau[i].value;
        for (int j = first; j < dofs && j < first + N; ++j)
          to(i, j) = tau[i].derivative[static_cast<std::size_t>(j - first)];
      }
    }
}

/// Derivatives of inverse dynamics by q and v of a static chain of any elements, and by a if friction depends on loads.
/// Otherwise by_a is the mass matrix.
template <class S, class Chain, class Base, class Q, class V, class A>
void dual_derivatives(const Chain& c, const Base& base, const Q& q, const V& v, const A& a,
                      inverse_dynamics_result<S, Chain::dofs>& r) {
  using number = dual<S, 4>;
  using wiring = typename Chain::wiring;
  using positions = std::array<number, std::size_t{Chain::nq}>;
  using rates = std::array<number, std::size_t{Chain::dofs}>;
  positions x;
  rates y, z;
  for (std::size_t i = 0; i < x.size(); ++i) x[i] = number(S(q[i]));
  for (std::size_t i = 0; i < y.size(); ++i) y[i] = number(S(v[i])), z[i] = number(S(a[i]));
  auto lent = c.kept.template borrow<static_state<number, Chain>>(c);
  static_state<number, Chain>& s = lent;
  const auto evaluate = [&](const directions&) {
    const configuration<number, wiring, positions> at(x);
    const given g{at, each<number, rates>{y}, each<number, rates>{z}, base};
    const auto tau = take_forces(c, g, s, minus_one);
    check_forces<wiring>(tau, g);
    return tau;
  };
  derive_by_duals(std::span(wiring::table.free.data(), wiring::freedoms), std::span<number>(x), std::span<number>(y),
                  std::span<number>(z), has_load_dependent_friction<Chain>, evaluate, r);
}

}  // namespace detail
}  // namespace kte
