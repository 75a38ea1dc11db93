#ifndef KTE_MASS_MATRIX_HPP
#define KTE_MASS_MATRIX_HPP

#include <kte/dynamics/state_vectors.hpp>
#include <kte/dynamics/unrolled/flattened.hpp>
#include <kte/dynamics/unrolled/mass_matrix.hpp>

namespace kte {

/// The mass matrix by the composite-rigid-body algorithm (CRBA; Walker and Orin 1982; Featherstone 2008, section 6.2):
///
///   M_ij = s_i . (I^c_j s_j)   for i upstream of j,  0 for joints on different branches                 (1)
///
/// with the axis s of a joint and the composite inertia I^c of its subtree. dofs x dofs, symmetric, both triangles
/// filled; kg m^2, kg m, kg.
///
///   mass_matrix(c, q)       of a static chain, a value
///   mass_matrix(c, s, q)    of a runtime chain, in the state s; the first call allocates memory
///   mass_matrix(c, s)       of both, at the positions of a state
///
/// Arguments and errors are those of `inverse_dynamics`. Throws `bad_argument` also for chains that trees of body nodes
/// do not describe (docs/algorithms.md, "What is refused").
template <class Gravity, class... E, indexable Q>
[[nodiscard]] auto mass_matrix(const static_chain<Gravity, E...>& c, const Q& q) {
  using chain_type = static_chain<Gravity, E...>;
  using S = value_of<Q>;
  detail::check_configuration<chain_type>(q);
  const detail::configuration<S, typename chain_type::wiring, Q> at(q);
  return detail::in_one_function<S, detail::is_unrolled<chain_type, S>>(
      [&]() KTE_INLINE_LAMBDA { return detail::mass_matrix_at<S>(c, at, detail::base_under_gravity(c)); });
}

template <class Gravity, class... E, class S>
[[nodiscard]] auto mass_matrix(const static_chain<Gravity, E...>& c, const chain_state<S, detail::wiring<E...>>& s) {
  using namespace detail;
  const auto q = positions(s);
  const configuration<S, wiring<E...>, std::remove_const_t<decltype(q)>> at(q);
  return mass_matrix_at<S>(c, at, base_of_state<chain_state<S, wiring<E...>>>{s});
}

}  // namespace kte

#endif

// ---- runtime chains (kte/runtime_chain.hpp)

#if defined(KTE_RUNTIME_CHAINS) && !defined(KTE_MASS_MATRIX_OF_RUNTIME_CHAINS)
#define KTE_MASS_MATRIX_OF_RUNTIME_CHAINS

#include <kte/dynamics/runtime/elements.hpp>
#include <kte/dynamics/runtime/refused_calls.hpp>

namespace kte {

namespace detail {
template <class S>
void check_masses(const basic_runtime_state<S>& s, const runtime_matrix<S>& m) {
  if (!tree::all_finite_in_row(m.data(), static_cast<std::size_t>(m.size()))) [[unlikely]]
    diagnose_mass(s, first_non_finite(m), false);
}
#ifdef KTE_EXTERN
KTE_EXTERN template void check_masses(const runtime_state&, const runtime_matrix<double>&);
#endif
}  // namespace detail

template <class S>
const runtime_matrix<S>& mass_matrix(const runtime_chain& c, basic_runtime_state<S>& s) {
  detail::check_regular_tree(c, s);
  detail::check_positions(s);
  detail::mass_of_coordinates(detail::runtime_elements{c}, s);
  detail::check_masses(s, s.work.mass);
  return s.work.mass;
}
template <class S, indexable Q>
const runtime_matrix<S>& mass_matrix(const runtime_chain& c, basic_runtime_state<S>& s, const Q& q) {
  detail::check_regular_tree(c, s);
  return detail::take<detail::keeping::if_needed>(c, s, q).call([&]() -> const auto& {
    detail::mass_of_coordinates(detail::runtime_elements{c}, s);
    detail::check_masses(s, s.work.mass);
    return s.work.mass;
  });
}

#ifdef KTE_EXTERN
KTE_EXTERN template const runtime_matrix<double>& mass_matrix(const runtime_chain&, runtime_state&);
#endif

}  // namespace kte

#endif
