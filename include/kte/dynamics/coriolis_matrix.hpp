#pragma once

#include <kte/dynamics/looped/follower_rates.hpp>
#include <kte/dynamics/looped/static_chains.hpp>
#include <kte/dynamics/runtime/bodies.hpp>
#include <kte/dynamics/unrolled/coriolis.hpp>
#include <kte/runtime_chain.hpp>
#include <kte/tree/fill_matrix.hpp>

/// The Coriolis matrix and the time derivative of the mass matrix, for static and runtime chains.
namespace kte {

namespace detail {
/// Projects C from all coordinates to the degrees of freedom, by the ratios E of dependent coordinates: E^T (C E + M
/// dE/dt).
template <class Elements, class State, class Matrix>
void pull_back_coriolis(const Elements& c, State& s, Matrix& coriolis) {
  using S = typename State::scalar;
  const auto& t = s.tree();
  const auto& of_axes = s.work.of_coriolis;
  const int n = t.plan.coordinates;
  coriolis.setZero(n, n);
  Matrix mass = coriolis;
  tree::for_each_coriolis_term<true>(t.body_tree, of_axes, [&](int j, int k, const S& c_jk, const S& m_jk) {
    const int row = t.body_tree.row[static_cast<std::size_t>(j)], column = t.body_tree.row[static_cast<std::size_t>(k)];
    coriolis(row, column) += c_jk, mass(row, column) += m_jk;
  });
  for (int i = 0; i < n; ++i) mass(i, i) += S(t.own_mass[static_cast<std::size_t>(i)]);
  pull_back_followers_with_rates(c, s, [&](int to, int from, const S& ratio, const S& rate) {
    coriolis.col(to) += ratio * coriolis.col(from) + rate * mass.col(from);
    mass.col(to) += ratio * mass.col(from);
    coriolis.row(to) += ratio * coriolis.row(from);
    mass.row(to) += ratio * mass.row(from);
  });
  coriolis.conservativeResize(s.dofs(), s.dofs());
}
/// Computes C in the working memory of a state whose coordinates and bases are set and checked.
template <class Elements, class State>
void coriolis_of_coordinates(const Elements& c, State& s) {
  using S = typename State::scalar;
  const auto& t = s.tree();
  auto& w = s.work;
  place_bodies(c, s);
  take_rates(s), place_in_world(s);
  for_each_base(s, [&w](const auto& m, std::size_t slot) {
    const mat3<vec3<S>>& r = w.world[slot].rotation;
    w.bodies[slot].velocity = r * as<S>(m.velocity), w.bodies[slot].ang_velocity = r * as<S>(m.ang_velocity);
  });
  if (t.followers.empty()) {
    tree::coriolis_of_tree<false>(t.body_tree, w, w.of_coriolis);
    tree::fill_coriolis(t.body_tree, s.dofs(), w.of_coriolis, w.coriolis);
  } else {
    tree::coriolis_of_tree<true>(t.body_tree, w, w.of_coriolis);
    pull_back_coriolis(c, s, w.coriolis);
  }
}
inline constexpr same_base base_with_velocity_and_axes{motion{skip{}, no_rotation{}, zero3{}, zero3{}, skip{}, skip{}}};
template <class Matrix>
Matrix with_transpose(const Matrix& m) {
  const Matrix sum = m + m.transpose();
  check_result(sum.data(), static_cast<std::size_t>(sum.size()), too_large{"a matrix"});
  return sum;
}
}  // namespace detail

/// The Coriolis matrix C(q, v), dofs x dofs: C v = `coriolis_forces`. It consists of Christoffel symbols, so that
///
///   dM/dt - 2 C  is skew-symmetric,   dM/dt = C + C^T          (1)
///
/// as passivity-based and adaptive controllers require (recursions/coriolis.hpp). Bases are at rest. For elements with
/// both a mass and forces, only the mass is included. Units: kg m^2/s, kg m/s, kg/s. Cost: O(n d); no heap allocation
/// for small trees of joints.
template <class Gravity, class... E, indexable Q, indexable V>
[[nodiscard]] auto coriolis_matrix(const static_chain<Gravity, E...>& c, const Q& q, const V& v) {
  using namespace detail;
  using chain_type = static_chain<Gravity, E...>;
  using S = value_of<Q>;
  static_assert(sizeof(check_loads_of<chain_type>) > 0 && sizeof(check_bodies_of<chain_type>) > 0 &&
                sizeof(check_closures_of<chain_type>) > 0);
  const auto x = checked_arguments<chain_type>(q, v);
  const joint_matrix<S, chain_type::dofs> m = [&]() -> joint_matrix<S, chain_type::dofs> {
    if constexpr (is_unrolled<chain_type, S> && is_tree_of_joints<chain_type>) {
      const given g{x.at, x.v, same<skip>{}, base_with_velocity_and_axes};
      return unrolled_coriolis<S, chain_type, std::remove_const_t<decltype(g)>>(c, g).result();
    } else {
      return by_tree<S>(c, given{x.at, x.v, same<zero_t>{}, base_at_rest}, [](const auto& elements, auto& s) {
        coriolis_of_coordinates(elements, s);
        return s.work.coriolis;
      });
    }
  }();
  check_result(m.data(), static_cast<std::size_t>(m.size()), x.diagnosis("a matrix"));
  return m;
}
/// The time derivative of M at the velocities v, by (1): dofs x dofs, in the units of C.
template <class Gravity, class... E, indexable Q, indexable V>
[[nodiscard]] auto mass_matrix_rate(const static_chain<Gravity, E...>& c, const Q& q, const V& v) {
  return detail::with_transpose(coriolis_matrix(c, q, v));
}

/// The Coriolis matrix at the positions and rates of a state, with its moving bases and prescribed coordinates. (1)
/// holds, but C v omits the forces due to the motion of bases and prescribed coordinates. The result is in the state,
/// until the next call with it.
template <class S>
const runtime_matrix<S>& coriolis_matrix(const runtime_chain& c, basic_runtime_state<S>& s) {
  detail::check_regular_tree(c, s), detail::refuse_distributed_masses(c, s), detail::check_state_velocities(s);
  detail::coriolis_of_coordinates(detail::runtime_elements{c}, s);
  const runtime_matrix<S>& m = s.work.coriolis;
  detail::check_result(m.data(), static_cast<std::size_t>(m.size()), [&s] { detail::diagnose("a matrix", s); });
  return m;
}
template <class S, indexable Q, indexable V>
const runtime_matrix<S>& coriolis_matrix(const runtime_chain& c, basic_runtime_state<S>& s, const Q& q, const V& v) {
  detail::check_regular_tree(c, s), detail::refuse_distributed_masses(c, s);
  return detail::take(c, s, q, v).call([&]() -> const auto& { return coriolis_matrix(c, s); });
}
template <class S>
runtime_matrix<S> mass_matrix_rate(const runtime_chain& c, basic_runtime_state<S>& s) {
  return detail::with_transpose(coriolis_matrix(c, s));
}
template <class S, indexable Q, indexable V>
runtime_matrix<S> mass_matrix_rate(const runtime_chain& c, basic_runtime_state<S>& s, const Q& q, const V& v) {
  return detail::with_transpose(coriolis_matrix(c, s, q, v));
}

}  // namespace kte
