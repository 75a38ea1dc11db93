#pragma once

#include <kte/contract/transmission.hpp>
#include <kte/dynamics/detail/given.hpp>
#include <kte/dynamics/detail/static_loops.hpp>
#include <kte/dynamics/state_vectors.hpp>

namespace kte {

namespace detail {
/// The numbers of the load on a coordinate of kind K, to places V, V + 1, ... of f.
template <kind K, int V, class L, class Sign, class X>
KTE_INLINE void spread_load(const L& load, Sign sign, X& f) {
  using S = typename X::Scalar;
  const auto each_number = [&]<int... N>(std::integer_sequence<int, N...>) KTE_INLINE_LAMBDA {
    const int done[]{(f[V + N] = as<S>(sign * number_of<K, N>(load)), 0)..., 0};
    (void)done;
  };
  each_number(std::make_integer_sequence<int, nv_of(K)>{});
}
/// The forces of virtual power on all degrees of freedom (`sign` one), or what must be applied for the motion to
/// happen (minus one).
template <class S, class Pass, class Sign>
KTE_INLINE auto forces_of(const Pass& pass, Sign sign) {
  using wiring = typename Pass::chain_type::wiring;
  joint_vector<S, wiring::dofs> f;
  const auto read = [&]<std::size_t... I>(std::index_sequence<I...>) KTE_INLINE_LAMBDA {
    const int done[]{(spread_load<wiring::template free<I>.what, wiring::template free<I>.v>(
                          pass.template load<wiring::template free<I>.what, wiring::template free<I>.slot>(), sign, f),
                      0)...,
                     0};
    (void)done;
  };
  read(std::make_index_sequence<wiring::freedoms>{});
  return f;
}
template <class S, class Chain, class Given, class Sign>
KTE_INLINE auto coordinate_forces(const Chain& c, const Given& g, Sign sign) {
  const auto f = [&]() KTE_INLINE_LAMBDA {
    if constexpr (has_unrolled_passes<Chain, S>) {
      using pass = local_pass<Chain, Given>;
      static_assert(sizeof(typename pass::need) > 0);
      return forces_of<S>(pass(c, g), sign);
    } else {
      return forces_by_records<S>(c, g, sign);
    }
  }();
  check_forces<typename Chain::wiring>(f, g);
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
/// order of the chain's layout (static_chain/layout.hpp); anything with operator[]. Returns tau in Nm and N. No heap,
/// no state.
template <class Gravity, class... E, indexable Q, indexable V, indexable A>
auto inverse_dynamics(const static_chain<Gravity, E...>& c, const Q& q, const V& v, const A& a) {
  using chain_type = static_chain<Gravity, E...>;
  using S = value_of<Q>;
  detail::check_configuration<chain_type>(q), check_size<chain_type::dofs>(v, "v"),
      check_size<chain_type::dofs>(a, "a");
  const detail::configuration<S, typename chain_type::wiring, Q> at(q);
  return detail::coordinate_forces<S>(
      c, detail::given{at, detail::each<S, V>{v}, detail::each<S, A>{a}, detail::base_under_gravity(c)}, minus_one);
}

/// The same at the positions, rates and accelerations of a state, with its moving bases and its inputs.
template <class Gravity, class... E, class S>
auto inverse_dynamics(const static_chain<Gravity, E...>& c, const chain_state<S, detail::wiring<E...>>& s) {
  using state = chain_state<S, detail::wiring<E...>>;
  const auto q = positions(s);
  const auto v = velocities(s), a = accelerations(s);
  using vector = std::remove_const_t<decltype(v)>;
  const detail::configuration<S, detail::wiring<E...>, std::remove_const_t<decltype(q)>> at(q);
  return detail::coordinate_forces<S>(
      c, detail::given{at, detail::each<S, vector>{v}, detail::each<S, vector>{a}, detail::base_of_state<state>{s}},
      minus_one);
}

}  // namespace kte
