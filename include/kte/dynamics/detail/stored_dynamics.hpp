#pragma once

#include <kte/dynamics/detail/stored_chain.hpp>

/// The algorithms on static chains too large to unroll. `Given`: dynamics/detail/given.hpp.
namespace kte::detail {

/// The forces of virtual power on all degrees of freedom, times `sign`.
template <class State, class Sign, class X>
void take_forces(const State& s, Sign sign, X& f) {
  read_listed_numbers<vector_of::f>(s, f);
  for (auto& x : f) x = as<typename State::scalar>(sign * x);
}
template <class S, class Chain, class Given, class Sign>
auto stored_forces(const Chain& c, const Given& g, Sign sign) {
  stored_state<S, Chain, pass_memory> s(g);
  forces_on_coordinates(static_elements<Chain>{c}, s);
  joint_vector<S, Chain::dofs> f;
  take_forces(s, sign, f);
  return f;
}

template <class S, class Chain, class Given>
joint_matrix<S, Chain::dofs> stored_mass_matrix(const Chain& c, const Given& g) {
  stored_state<S, Chain, mass_memory> s(g);
  mass_of_coordinates(static_elements<Chain>{c}, s);
  return s.work.mass;
}

/// Accelerations under forces `tau`, into the state. A degree of freedom of which an acceleration is given (in `Given`
/// it is no typed zero) keeps that.
template <class S, class Chain, class Given, class State>
const auto& accelerate_stored(const Chain& c, const Given& g, State& s, const joint_vector<S, Chain::dofs>& tau) {
  s.work.prescribed = []<int... I>(std::integer_sequence<int, I...>) {
    return std::array<char, sizeof...(I)>{
        !std::is_same_v<decltype(std::declval<const Given&>().a.template at<I>()), zero_t>...};
  }
  (std::make_integer_sequence<int, Chain::dofs>{});
  accelerate_articulated(static_elements<Chain>{c}, s, [&tau](int i) -> const S& { return tau[i]; });
  check_accelerations<typename Chain::wiring>(s.work.forces, g, tau);
  return s.work.forces;
}
template <class S, class Chain, class Given>
joint_vector<S, Chain::dofs> stored_accelerations(const Chain& c, const Given& g,
                                                  const joint_vector<S, Chain::dofs>& tau) {
  stored_state<S, Chain, pass_memory, articulated_memory> s(g);
  return accelerate_stored<S>(c, g, s, tau);
}
/// The same, and the inverse of the mass matrix.
template <class S, class Chain, class Given>
void stored_accelerations_and_inverse(const Chain& c, const Given& g, const joint_vector<S, Chain::dofs>& tau,
                                      joint_vector<S, Chain::dofs>& a, joint_matrix<S, Chain::dofs>& inverse) {
  stored_state<S, Chain, pass_memory, articulated_memory, inverse_memory> s(g);
  a = accelerate_stored<S>(c, g, s, tau);
  invert_columns(static_elements<Chain>{c}, s, inverse);
}

template <class S, class Chain, class Given>
joint_matrix<S, Chain::dofs> stored_inverse_mass(const Chain& c, const Given& g) {
  stored_state<S, Chain, pass_memory, articulated_memory, inverse_memory> s(g);
  joint_matrix<S, Chain::dofs> inverse;
  invert_articulated(static_elements<Chain>{c}, s, inverse);
  return inverse;
}

template <class S, class Chain, class Given, class Result>
void stored_derivatives(const Chain& c, const Given& g, Result& r) {
  stored_state<S, Chain, pass_memory, variation_memory> s(g);
  const static_elements<Chain> e{c};
  forces_on_coordinates(e, s);
  derive_forces(e, s, r);
  take_forces(s, minus_one, r.tau);
}

}  // namespace kte::detail
