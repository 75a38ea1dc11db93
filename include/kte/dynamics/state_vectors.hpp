#ifndef KTE_STATE_VECTORS_HPP
#define KTE_STATE_VECTORS_HPP

#include <kte/dynamics/arguments/state_numbers.hpp>

/// The numbers of a state as vectors, in the order of the chain's layout (static_chain/layout.hpp), and back. For
/// static chains, sizes are known at compile time. Throws `bad_argument` for a vector of wrong size.
namespace kte {

/// The positions q of a state: numbers, angles, quaternions.
template <class S, class W>
[[nodiscard]] KTE_INLINE auto positions(const chain_state<S, W>& s) {
  return detail::read_numbers<detail::vector_of::q, W::nq>(s);
}
/// The velocities v of a state.
template <class S, class W>
[[nodiscard]] KTE_INLINE auto velocities(const chain_state<S, W>& s) {
  return detail::read_numbers<detail::vector_of::v, W::dofs>(s);
}
/// The accelerations a of a state.
template <class S, class W>
[[nodiscard]] KTE_INLINE auto accelerations(const chain_state<S, W>& s) {
  return detail::read_numbers<detail::vector_of::a, W::dofs>(s);
}
/// The generalized forces on the degrees of freedom, after doForce.
template <class S, class W>
[[nodiscard]] KTE_INLINE auto forces(const chain_state<S, W>& s) {
  return detail::read_numbers<detail::vector_of::f, W::dofs>(s);
}

/// Sets the positions q of a state. Frames are updated by the next doMotion.
template <class S, class W, indexable X>
constexpr void set_positions(chain_state<S, W>& s, const X& q) {
  detail::check_configuration<W>(q);
  detail::write_numbers<detail::vector_of::q>(s, q);
}
/// Sets the velocities v of a state.
template <class S, class W, indexable X>
constexpr void set_velocities(chain_state<S, W>& s, const X& v) {
  check_size<W::dofs>(v, "v");
  detail::write_numbers<detail::vector_of::v>(s, v);
}
/// Sets the accelerations a of a state.
template <class S, class W, indexable X>
constexpr void set_accelerations(chain_state<S, W>& s, const X& a) {
  check_size<W::dofs>(a, "a");
  detail::write_numbers<detail::vector_of::a>(s, a);
}

}  // namespace kte

#endif

// ---- runtime chains (kte/runtime_chain.hpp)

#if defined(KTE_RUNTIME_CHAINS) && !defined(KTE_STATE_VECTORS_OF_RUNTIME_CHAINS)
#define KTE_STATE_VECTORS_OF_RUNTIME_CHAINS

#include <kte/dynamics/runtime/vectors.hpp>

namespace kte {

template <class S>
[[nodiscard]] runtime_vector<S> positions(const basic_runtime_state<S>& s) {
  return detail::read_numbers<detail::vector_of::q>(s);
}
template <class S>
[[nodiscard]] runtime_vector<S> velocities(const basic_runtime_state<S>& s) {
  return detail::read_numbers<detail::vector_of::v>(s);
}
template <class S>
[[nodiscard]] runtime_vector<S> accelerations(const basic_runtime_state<S>& s) {
  return detail::read_numbers<detail::vector_of::a>(s);
}
template <class S>
[[nodiscard]] runtime_vector<S> forces(const basic_runtime_state<S>& s) {
  return detail::read_numbers<detail::vector_of::f>(s);
}

template <class S, indexable X>
void set_positions(basic_runtime_state<S>& s, const X& q) {
  detail::write_numbers<detail::vector_of::q>(s, q, "q");
}
template <class S, indexable X>
void set_velocities(basic_runtime_state<S>& s, const X& v) {
  detail::write_numbers<detail::vector_of::v>(s, v, "v");
}
template <class S, indexable X>
void set_accelerations(basic_runtime_state<S>& s, const X& a) {
  detail::write_numbers<detail::vector_of::a>(s, a, "a");
}

#ifdef KTE_EXTERN
KTE_EXTERN template runtime_vector<double> positions(const runtime_state&);
KTE_EXTERN template runtime_vector<double> velocities(const runtime_state&);
KTE_EXTERN template runtime_vector<double> accelerations(const runtime_state&);
KTE_EXTERN template runtime_vector<double> forces(const runtime_state&);
KTE_EXTERN template void set_positions(runtime_state&, const Eigen::VectorXd&);
KTE_EXTERN template void set_velocities(runtime_state&, const Eigen::VectorXd&);
KTE_EXTERN template void set_accelerations(runtime_state&, const Eigen::VectorXd&);
#endif

}  // namespace kte

#endif
