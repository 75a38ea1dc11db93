#pragma once

#include <utility>

/// Former names of the public interface (docs/glossary.md has the table). They work for one version, with a warning
/// that says the present name.
namespace kte {

// Functions

template <class... A>
requires requires(A&&... a) { subtree_inertia(std::forward<A>(a)...); }
[[deprecated("kte: carried_inertia is now subtree_inertia")]] decltype(auto) carried_inertia(A&&... a) {
  return subtree_inertia(std::forward<A>(a)...);
}
template <class... A>
requires requires(A&&... a) { centroidal_momentum_matrix(std::forward<A>(a)...); }
[[deprecated("kte: centroidal_map is now centroidal_momentum_matrix")]] decltype(auto) centroidal_map(A&&... a) {
  return centroidal_momentum_matrix(std::forward<A>(a)...);
}

template <class Arm, class Goals, class Q>
[[deprecated("kte: clik is now numerical_inverse_kinematics")]] auto clik(const Arm& arm, const Goals& goals,
                                                                          const Q& q_start) {
  return numerical_inverse_kinematics(arm, goals, q_start);
}
struct numerical_ik_options;
template <class Arm, class Goals, class Q>
[[deprecated("kte: clik is now numerical_inverse_kinematics")]] auto clik(const Arm& arm, const Goals& goals,
                                                                          const Q& q_start,
                                                                          const numerical_ik_options& options) {
  return numerical_inverse_kinematics(arm, goals, q_start, options);
}

// Types

using clik_options [[deprecated("kte: clik_options is now numerical_ik_options")]] = numerical_ik_options;
enum class numerical_ik_status;
using clik_status [[deprecated("kte: clik_status is now numerical_ik_status")]] = numerical_ik_status;
template <class S, int N>
struct numerical_ik_result;
template <class S, int N>
using clik_result [[deprecated("kte: clik_result is now numerical_ik_result")]] = numerical_ik_result<S, N>;

struct coordinate_lock;
using coordinate_holder [[deprecated("kte: coordinate_holder is now coordinate_lock")]] = coordinate_lock;

template <class D>
struct out_of_line;
template <class D>
using lean [[deprecated("kte: lean is now out_of_line")]] = out_of_line<D>;

namespace core {
template <class Joint, class Rotation, class Position>
struct placed_joint;
template <class Joint, class Rotation, class Position>
using seated [[deprecated("kte: core::seated is now core::placed_joint")]] = placed_joint<Joint, Rotation, Position>;
}  // namespace core

// Flags of element cores

namespace detail::former {
template <class Core>
[[deprecated("kte: the flag spreads_mass of an element core is now distributed_mass")]]  //
inline constexpr bool spreads_mass = Core::spreads_mass;
template <class Core>
[[deprecated("kte: the flag reads_reaction of an element core is now load_dependent_friction")]]  //
inline constexpr bool reads_reaction = Core::reads_reaction;
}  // namespace detail::former
namespace detail {
template <class Core>
inline constexpr bool former_distributed_mass = false;
template <class Core>
requires requires { Core::spreads_mass; }
inline constexpr bool former_distributed_mass<Core> = former::spreads_mass<Core>;
template <class Core>
inline constexpr bool former_load_dependent_friction = false;
template <class Core>
requires requires { Core::reads_reaction; }
inline constexpr bool former_load_dependent_friction<Core> = former::reads_reaction<Core>;
}  // namespace detail

}  // namespace kte
