#ifndef KTE_BIAS_FORCES_HPP
#define KTE_BIAS_FORCES_HPP

#include <kte/dynamics/inverse_dynamics.hpp>
#include <kte/dynamics/unrolled/arguments.hpp>
#include <kte/dynamics/unrolled/given_bases.hpp>

/// The terms of inverse dynamics, tau = M a + C v + g - Q, computed separately (Luh, Walker, Paul 1980; Featherstone
/// 2008, section 5.3). Each result has dofs numbers, in N and Nm. Arguments and errors are those of `inverse_dynamics`.
/// Every chain satisfies
///
///   static_forces(q)         = g(q) - Q(q, 0)                                        (1)
///   nonlinear_effects(q, v)  = gravity_forces(q) + coriolis_forces(q, v) - Q(q, v)   (2)
///   inverse_dynamics(q, v, a) = M(q) a + nonlinear_effects(q, v)                     (3)
///
/// with the forces Q of elements other than bodies: springs, dampers, motors. Runtime chains: `f(c, s, q)` or `f(c, s,
/// q, v)`, or `f(c, s)` at the positions and rates of the state s. `gravity_forces` and `coriolis_forces` throw
/// `bad_argument` for distributed masses, whose bodies are unknown.
namespace kte {

/// The generalized forces that hold the chain at rest: inverse dynamics for v = a = 0, with gravity and the forces of
/// elements. (1)
template <class Gravity, class... E, indexable Q>
[[nodiscard]] auto static_forces(const static_chain<Gravity, E...>& c, const Q& q) {
  using namespace detail;
  using chain_type = static_chain<Gravity, E...>;
  static_assert(sizeof(check_closures_of<chain_type>) > 0);
  const auto x = checked_arguments<chain_type>(q);
  return generalized_forces<value_of<Q>>(c, given{x.at, x.v, same<zero_t>{}, base_under_gravity(c)}, minus_one);
}

/// The generalized forces g(q) that hold the bodies against gravity alone: the gradient of their potential energy,
///
///   v . g = d/dt (-sum m gravity . c)          (4)
template <class Gravity, class... E, indexable Q>
[[nodiscard]] auto gravity_forces(const static_chain<Gravity, E...>& c, const Q& q) {
  using namespace detail;
  using chain_type = static_chain<Gravity, E...>;
  const auto x = checked_arguments<chain_type>(q);
  const with_loads<chain_type, bodies_alone> bodies{c};
  return generalized_forces<value_of<Q>>(bodies, given{x.at, x.v, same<zero_t>{}, base_under_gravity(bodies)},
                                         minus_one);
}

/// The bias forces of the equations of motion: inverse dynamics for a = 0. (2)
template <class Gravity, class... E, indexable Q, indexable V>
[[nodiscard]] auto nonlinear_effects(const static_chain<Gravity, E...>& c, const Q& q, const V& v) {
  using namespace detail;
  using chain_type = static_chain<Gravity, E...>;
  static_assert(sizeof(check_closures_of<chain_type>) > 0);
  const auto x = checked_arguments<chain_type>(q, v);
  return generalized_forces<value_of<Q>>(c, given{x.at, x.v, same<zero_t>{}, base_under_gravity(c)}, minus_one);
}

/// C(q, v) v: Coriolis and centrifugal forces of the bodies, without gravity and without forces of other elements. It
/// is quadratic in v, and
///
///   v . (C v) = v . (dM/dt v) / 2          (5)
template <class Gravity, class... E, indexable Q, indexable V>
[[nodiscard]] auto coriolis_forces(const static_chain<Gravity, E...>& c, const Q& q, const V& v) {
  using namespace detail;
  using chain_type = static_chain<Gravity, E...>;
  const auto x = checked_arguments<chain_type>(q, v);
  const with_loads<chain_type, bodies_alone> bodies{c};
  return generalized_forces<value_of<Q>>(
      bodies, given{x.at, x.v, same<zero_t>{}, rest_base_of<chain_type>(base_with_acceleration)}, minus_one);
}

}  // namespace kte

#endif

// ---- of runtime chains (kte/runtime_chain.hpp)

#if defined(KTE_RUNTIME_CHAINS) && !defined(KTE_BIAS_FORCES_OF_RUNTIME_CHAINS)
#define KTE_BIAS_FORCES_OF_RUNTIME_CHAINS

#include <kte/dynamics/inverse_dynamics.hpp>
#include <kte/dynamics/runtime/bodies.hpp>
#include <kte/tree/weights.hpp>

namespace kte {

// The velocities and accelerations of the state are set aside and restored.

template <class S>
const runtime_vector<S>& static_forces(const runtime_chain& c, basic_runtime_state<S>& s) {
  c.check(s), detail::refuse_constraint_forces(c), detail::check_positions(s);
  const detail::rates_aside aside(s, true);
  return detail::forces_at_state(c, s);
}
namespace detail {
/// Whether gravity acts on a chain as on the bodies of a tree of degrees of freedom.
template <class S>
bool weighs_as_tree(const basic_runtime_state<S>& s) {
  const auto& t = s.tree();
  return t.plan.tree && t.plan.coordinates == s.dofs() && t.plan.jointless_dofs.empty() && t.weights.empty();
}
/// Whether a base turns.
template <class S>
bool bases_turn(const basic_runtime_state<S>& s) {
  for (int b = 0; b < s.tree().body_tree.bases; ++b) {
    const auto& x = s.work.bodies[static_cast<std::size_t>(b)];
    if (!all(dot(x.ang_velocity, x.ang_velocity) + dot(x.ang_acceleration, x.ang_acceleration) == S(0))) return true;
  }
  return false;
}
/// As `gravity_forces`, for positions that have been checked.
template <class S>
const runtime_vector<S>& gravity_forces_of(const runtime_chain& c, basic_runtime_state<S>& s) {
  if (weighs_as_tree(s)) [[likely]] {
    take_bases(s);
    if (!bases_turn(s)) [[likely]] {
      place_bodies(runtime_elements{c}, s);
      tree::transmit_weights(s.tree().body_tree, s.work);
      take_forces_of_axes(s);
      check_result(s, [&s] {
        const rates_aside aside(s, true);
        diagnose("a force", s);
      });
      return s.work.forces;
    }
  }
  const rates_aside aside(s, true);
  forces_on_coordinates(runtime_elements{c}, s, acting::bodies);
  return applied_forces(s);
}
}  // namespace detail
template <class S>
const runtime_vector<S>& gravity_forces(const runtime_chain& c, basic_runtime_state<S>& s) {
  detail::check_regular_tree(c, s), detail::refuse_distributed_masses(c, s), detail::check_positions(s);
  return detail::gravity_forces_of(c, s);
}
namespace detail {
/// As `nonlinear_effects`, for positions and velocities that have been checked.
template <class S>
const runtime_vector<S>& nonlinear_effects_of(const runtime_chain& c, basic_runtime_state<S>& s) {
  if (!s.tree().only_bodies) {
    const rates_aside aside(s, false);
    return forces_at_state(c, s);
  }
  bias_forces_of_bodies(runtime_elements{c}, s);
  take_generalized_forces(s);
  check_result(s.work.forces, static_cast<std::size_t>(s.dofs()), [&s] {
    const rates_aside aside(s, false);
    diagnose("a force", s);
  });
  return s.work.forces;
}
}  // namespace detail
template <class S>
const runtime_vector<S>& nonlinear_effects(const runtime_chain& c, basic_runtime_state<S>& s) {
  c.check(s), detail::refuse_constraint_forces(c), detail::check_state_velocities(s);
  return detail::nonlinear_effects_of(c, s);
}
template <class S>
const runtime_vector<S>& coriolis_forces(const runtime_chain& c, basic_runtime_state<S>& s) {
  detail::check_regular_tree(c, s), detail::refuse_distributed_masses(c, s), detail::check_state_velocities(s);
  const detail::rates_aside aside(s, false);
  detail::forces_on_coordinates(detail::runtime_elements{c}, s, detail::acting::bodies, false);
  return detail::applied_forces(s);
}
template <class S, indexable Q>
const runtime_vector<S>& static_forces(const runtime_chain& c, basic_runtime_state<S>& s, const Q& q) {
  detail::refuse_constraint_forces(c);
  return detail::take<detail::keeping::if_needed>(c, s, q).call([&]() -> const auto& {
    const detail::rates_aside aside(s, true);
    return detail::forces_at_state(c, s);
  });
}
template <class S, indexable Q>
const runtime_vector<S>& gravity_forces(const runtime_chain& c, basic_runtime_state<S>& s, const Q& q) {
  detail::check_regular_tree(c, s), detail::refuse_distributed_masses(c, s);
  return detail::take<detail::keeping::if_needed>(c, s, q).call([&]() -> const auto& {
    return detail::gravity_forces_of(c, s);
  });
}
template <class S, indexable Q, indexable V>
const runtime_vector<S>& nonlinear_effects(const runtime_chain& c, basic_runtime_state<S>& s, const Q& q, const V& v) {
  detail::refuse_constraint_forces(c);
  return detail::take<detail::keeping::if_needed>(c, s, q, v).call([&]() -> const auto& {
    return detail::nonlinear_effects_of(c, s);
  });
}
template <class S, indexable Q, indexable V>
const runtime_vector<S>& coriolis_forces(const runtime_chain& c, basic_runtime_state<S>& s, const Q& q, const V& v) {
  return detail::take<detail::keeping::if_needed>(c, s, q, v).call([&]() -> const auto& {
    return coriolis_forces(c, s);
  });
}

#ifdef KTE_EXTERN
KTE_EXTERN template const runtime_vector<double>& static_forces(const runtime_chain&, runtime_state&);
KTE_EXTERN template const runtime_vector<double>& nonlinear_effects(const runtime_chain&, runtime_state&);
namespace detail {
KTE_EXTERN template const runtime_vector<double>& gravity_forces_of(const runtime_chain&, runtime_state&);
KTE_EXTERN template const runtime_vector<double>& nonlinear_effects_of(const runtime_chain&, runtime_state&);
}  // namespace detail
KTE_EXTERN template const runtime_vector<double>& coriolis_forces(const runtime_chain&, runtime_state&);
#endif

}  // namespace kte

#endif
