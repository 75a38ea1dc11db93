#pragma once

#include <kte/dynamics/centre_of_mass.hpp>
#include <kte/dynamics/centroidal.hpp>
#include <kte/dynamics/runtime/bodies.hpp>
#include <kte/dynamics/state_vectors.hpp>
#include <kte/runtime_chain.hpp>

/// Rates of the centre of mass and of the momentum, for static and runtime chains: bases at rest, without gravity, in
/// axes of the base.
namespace kte {

namespace detail {
template <class S, class Chain, class At, class V, class A>
KTE_INLINE auto momentum_rate_at_base(const Chain& c, const At& at, const V& v, const A& a) {
  const auto w = loads_on_bases<bodies_alone>(c, given{at, v, a, base_at_rest});
  return wrench{-w.force, -w.torque};
}
}  // namespace detail

/// The Jacobian of the centre of mass, 3 x dofs: `centre_of_mass_velocity` = J v. It is the linear rows of
/// `centroidal_momentum_matrix` over the mass. Throws `bad_argument` for a mass of zero.
template <class Gravity, class... E, indexable Q>
[[nodiscard]] auto centre_of_mass_jacobian(const static_chain<Gravity, E...>& c, const Q& q) {
  using namespace detail;
  using chain_type = static_chain<Gravity, E...>;
  using S = value_of<Q>;
  static_assert(sizeof(check_bodies_of<chain_type>) > 0 && sizeof(check_closures_of<chain_type>) > 0);
  const auto x = checked_arguments<chain_type>(q);
  const given g{x.at, same<skip>{}, same<skip>{}, base_with_pose};
  using pass = momentum_columns<S, chain_type, std::remove_const_t<decltype(g)>, 3>;
  typename pass::matrix_type j;
  const auto all = pass(c, g, {}, j).fill();
  (void)divided_by_mass<S>(all.mass, all.moment);
  j *= S(1) / as<S>(all.mass);
  check_result(j.data(), static_cast<std::size_t>(j.size()), too_large{"a Jacobian"});
  return j;
}

/// The time derivative of `centroidal_momentum`, N and Nm. With the sum f of the rates of momentum of all bodies, the
/// sum n of their moments about the origin, and the centre of mass c,
///
///   p' = f,   k_G' = n - c x f          (1)
///
/// It equals the sum of external loads: gravity and the forces of bases.
template <class Gravity, class... E, indexable Q, indexable V, indexable A>
[[nodiscard]] auto centroidal_momentum_rate(const static_chain<Gravity, E...>& c, const Q& q, const V& v, const A& a) {
  using namespace detail;
  using chain_type = static_chain<Gravity, E...>;
  using S = value_of<Q>;
  static_assert(sizeof(check_bodies_of<chain_type>) > 0 && sizeof(check_closures_of<chain_type>) > 0);
  const auto x = checked_arguments<chain_type>(q, v, a);
  const auto why = x.diagnosis("a force");
  const auto w = weight_of<S>(c, x.at);
  const auto h = momentum_rate_at_base<S>(c, x.at, x.v, x.a);
  return checked<S>(h.force, h.torque - cross(divided_by_mass<S>(w.mass, w.moment, why), h.force), why);  // (1)
}
/// The acceleration of the centre of mass, m/s^2: p' over the mass.
template <class Gravity, class... E, indexable Q, indexable V, indexable A>
[[nodiscard]] auto centre_of_mass_acceleration(const static_chain<Gravity, E...>& c, const Q& q, const V& v,
                                               const A& a) {
  using S = value_of<Q>;
  const S mass = centre_of_mass(c, q).mass;
  const vec3<S> f = centroidal_momentum_rate(c, q, v, a).linear;
  return vec3<S>{f.x / mass, f.y / mass, f.z / mass};
}

namespace detail {
/// The sum of the body wrenches due to the motion of coordinates, and of bases that elements move, about a point of the
/// world. Call `carry` first. Bases accelerate by -gravity.
template <class S>
tree::dense_wrench<S> momentum_rate_of_coordinates(basic_runtime_state<S>& s, const vec3<>& gravity,
                                                   const vec3<S>& about) {
  const auto& f = s.tree().body_tree;
  auto& w = s.work;
  const auto bases = static_cast<std::size_t>(f.bases);
  take_rates(s), rest_given_coordinates(s);
  for (std::size_t b = 0; b < bases; ++b) w.bodies[b] = {};
  for_each_moved_base(s, [&](const auto& x, std::size_t slot) {
    auto& b = w.bodies[slot];
    b.ang_velocity = as<S>(x.ang_velocity), b.ang_acceleration = as<S>(x.ang_acceleration);
    b.acceleration = as<S>(x.acceleration) + transpose(w.world[slot].rotation) * as<S>(gravity);
  });
  tree::move_bodies<false>(f, w);
  tree::dense_wrench<S> sum{};
  const auto add = [&](const auto& weight, std::size_t slot) {
    const auto& x = w.bodies[slot];
    const auto& at = w.world[slot];
    const vec3<S> h = as<S>(weight.moment), &u = x.ang_velocity;
    const sym3<S> inertia = as<S>(weight.inertia);
    const vec3<S> force =
        at.rotation * (S(weight.mass) * x.acceleration + cross(x.ang_acceleration, h) + cross(u, cross(u, h)));
    const vec3<S> torque =
        at.rotation * (inertia * x.ang_acceleration + cross(u, inertia * u) + cross(h, x.acceleration));
    sum = {sum.force + force, sum.torque + torque + cross(at.position - about, force)};
  };
  for (std::size_t b = 0; b < bases; ++b) add(f.base_weight[b], b);
  for (std::size_t i = 0; i < f.nodes.size(); ++i) add(f.nodes[i].weight, bases + i);
  return sum;
}
}  // namespace detail

// ---- runtime chains. Prescribed coordinates and bases are at rest, as for `centroidal_momentum`, except for bases
// that elements move by signals.

namespace detail {
/// As `centre_of_mass_jacobian`, for positions that have been checked.
template <class S>
runtime_matrix<S> centre_of_mass_jacobian_of(const runtime_chain& c, basic_runtime_state<S>& s) {
  if (s.tree().plan.coordinates > s.dofs()) {  // for dependent coordinates
    const auto map = centroidal_momentum_matrix_of(c, s);
    return map.topRows(3) / tree::weight_in_world(s.tree().body_tree, s.work).mass;
  }
  refuse_distributed_masses(c, s);
  carry_bodies<S, engine::world_placement<mat3<vec3<S>>, skip, skip>, composite<S, vec3<S>, skip>>(c, s);
  const auto w = tree::weight_in_world(s.tree().body_tree, s.work);
  const diagnose_state why{"a Jacobian", s};
  (void)divided_by_mass<S>(w.mass, w.moment, why);
  runtime_matrix<S> j = runtime_matrix<S>::Zero(3, s.dofs());
  for_each_momentum(s, vec3<S>{},
                    [to = j.data(), mass = w.mass](int row, const tree::dense_wrench<S>& h) KTE_INLINE_LAMBDA {
                      S* const column = to + 3 * row;
                      column[0] += h.force.x / mass, column[1] += h.force.y / mass, column[2] += h.force.z / mass;
                    });
  check_result(j.data(), static_cast<std::size_t>(j.size()), why);
  return j;
}
}  // namespace detail
template <class S>
runtime_matrix<S> centre_of_mass_jacobian(const runtime_chain& c, basic_runtime_state<S>& s) {
  detail::check_regular(c, s), detail::check_positions(s);
  return detail::centre_of_mass_jacobian_of(c, s);
}
template <class S>
linear_angular<S> centroidal_momentum_rate(const runtime_chain& c, basic_runtime_state<S>& s) {
  detail::check_regular(c, s), detail::check_state_velocities(s);
  detail::carry(c, s);
  const auto w = tree::weight_in_world(s.tree().body_tree, s.work);
  const detail::diagnose_state why{"a rate of momentum", s};
  const auto h =
      detail::momentum_rate_of_coordinates(s, c.gravity(), detail::divided_by_mass<S>(w.mass, w.moment, why));
  return detail::checked<S>(h.force, h.torque, why);
}
template <class S>
vec3<S> centre_of_mass_acceleration(const runtime_chain& c, basic_runtime_state<S>& s) {
  const S mass = centre_of_mass(c, s).mass;
  const vec3<S> f = centroidal_momentum_rate(c, s).linear;
  return {f.x / mass, f.y / mass, f.z / mass};
}
// The Jacobian of the centre of mass at q, which is stored in the state.
template <class S, indexable Q>
runtime_matrix<S> centre_of_mass_jacobian(const runtime_chain& c, basic_runtime_state<S>& s, const Q& q) {
  detail::check_regular(c, s);
  return detail::take(c, s, q).call([&] { return detail::centre_of_mass_jacobian_of(c, s); });
}
template <class S, indexable Q, indexable V, indexable A>
linear_angular<S> centroidal_momentum_rate(const runtime_chain& c, basic_runtime_state<S>& s, const Q& q, const V& v,
                                           const A& a) {
  detail::check_regular(c, s);
  return detail::take(c, s, q, v, a).call([&] { return centroidal_momentum_rate(c, s); });
}
template <class S, indexable Q, indexable V, indexable A>
vec3<S> centre_of_mass_acceleration(const runtime_chain& c, basic_runtime_state<S>& s, const Q& q, const V& v,
                                    const A& a) {
  detail::check_regular(c, s);
  return detail::take(c, s, q, v, a).call([&] { return centre_of_mass_acceleration(c, s); });
}

}  // namespace kte
