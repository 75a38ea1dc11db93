#pragma once

#include <kte/dynamics/detail/given.hpp>
#include <kte/dynamics/joint_vector.hpp>

namespace kte {

namespace detail {
/// The forces of virtual power on all degrees of freedom (`sign` one), or what must be applied for the motion to
/// happen (minus one).
template <class S, class Chain, class Given, class Sign>
KTE_INLINE auto coordinate_forces(const Chain& c, const Given& g, Sign sign) {
  const local_pass<Chain, Given> pass(c, g);
  joint_vector<S, Chain::dofs> f;
  const auto read = [&]<int... I>(std::integer_sequence<int, I...>) KTE_INLINE_LAMBDA {
    const int done[]{(f[I] = as<S>(sign * pass.template load<kind::gen, I>()), 0)..., 0};
    (void)done;
  };
  read(std::make_integer_sequence<int, Chain::dofs>{});
  check_finite(f, std::size_t{Chain::dofs}, "kte: a force is no finite number: an argument is none, or is too large");
  return f;
}
}  // namespace detail

/// Inverse dynamics by the recursive Newton-Euler algorithm (RNEA; Luh, Walker, Paul 1980; Featherstone, Rigid Body
/// Dynamics Algorithms, 2008, section 5.3), with classical accelerations in body axes:
///
///   tau = M(q) a + C(q, v) v + g(q) - Q(q, v)          (1)
///
/// where Q are the forces of the chain's own springs, dampers and the like, gravity is the chain's `gravity()`, bases
/// rest and inputs are zero. q, v, a: positions (rad, m), velocities, accelerations of the degrees of freedom in the
/// order of first appearance in the chain; anything with operator[]. Returns tau in Nm and N. No heap, no state.
template <class Gravity, class... E, indexable Q, indexable V, indexable A>
auto inverse_dynamics(const static_chain<Gravity, E...>& c, const Q& q, const V& v, const A& a) {
  using chain_type = static_chain<Gravity, E...>;
  using S = value_of<Q>;
  check_size<chain_type::dofs>(q, "q"), check_size<chain_type::dofs>(v, "v"), check_size<chain_type::dofs>(a, "a");
  const detail::positions<S, typename chain_type::wiring, detail::each<S, Q>> at({q});
  return detail::coordinate_forces<S>(
      c, detail::given{at, detail::each<S, V>{v}, detail::each<S, A>{a}, detail::base_under_gravity(c)}, minus_one);
}

/// The same at the positions, rates and accelerations of a state, with its moving bases and its inputs.
template <class Gravity, class... E, class S>
auto inverse_dynamics(const static_chain<Gravity, E...>& c, const chain_state<S, detail::wiring<E...>>& s) {
  using namespace detail;
  using state = chain_state<S, detail::wiring<E...>>;
  const positions<S, wiring<E...>, of_state<state, &gen_coord<S>::q>> at({s});
  return coordinate_forces<S>(c,
                              given{at, of_state<state, &gen_coord<S>::q_dot>{s},
                                    of_state<state, &gen_coord<S>::q_ddot>{s}, base_of_state<state>{s}},
                              minus_one);
}

}  // namespace kte
