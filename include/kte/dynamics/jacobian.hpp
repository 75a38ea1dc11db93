#ifndef KTE_JACOBIAN_HPP
#define KTE_JACOBIAN_HPP

#include <kte/dynamics/runtime/refused_calls.hpp>
#include <kte/dynamics/unrolled/jacobian.hpp>

#include <type_traits>

namespace kte {

/// Tag: rates of a frame at its origin, in its own axes.
inline constexpr struct in_own_axes_t {
} in_own_axes;
/// Tag: rates of a frame at its origin, in axes of the world (the axes of the bases).
inline constexpr struct in_world_axes_t {
} in_world_axes;

namespace detail {
template <class T>
concept axes_at_origin = std::is_same_v<T, in_own_axes_t> || std::is_same_v<T, in_world_axes_t>;
}  // namespace detail

/// The Jacobian J of a frame, 6 x dofs, with its velocity (rows 0 to 2, m/s) and angular velocity (rows 3 to 5, rad/s),
/// in its own axes, equal to J v. Let s be an axis of a joint, and R, p the pose of the frame in the end of the joint.
/// The column of s is (Siciliano et al., Robotics, 2009, section 3.1.3, in axes of the frame)
///
///   ( R^T (s_v + s_w x p), R^T s_w )          (1)
///
/// If others follow a coordinate, or several joints share it, its column is the sum of their columns. Columns of joints
/// that do not move the frame are zero. Only the elements between base and frame are evaluated. For planar frames,
/// out-of-plane rows are zero.
///
///   jacobian(c, q, hand)             of a static chain, a value
///   jacobian(c, s, q, "hand")        of a runtime chain, a value; (c, s, "hand") at the positions of the state s
///   jacobian(c, s, q, "hand", j)     into memory of the caller, below
///
/// With `in_world_axes` after the frame it is in axes of the base ("local world aligned"); of a runtime chain in axes
/// of the world. With the pose R_E, p_E of the end of the joint and the origin p of the frame,
///
///   ( R_E s_v + R_E s_w x (p - p_E), R_E s_w )          (2)
///
/// Names and errors are those of dynamics/frame_motion.hpp.
template <class Gravity, class... E, indexable Q, key_type Frame, detail::axes_at_origin Axes = in_own_axes_t>
[[nodiscard]] auto jacobian(const static_chain<Gravity, E...>& c, const Q& q, const Frame&, Axes = {}) {
  return detail::jacobian_of<std::is_same_v<Axes, in_world_axes_t>, Frame>(c, q);
}

}  // namespace kte

#endif

// ---- runtime chains (kte/runtime_chain.hpp)

#if defined(KTE_RUNTIME_CHAINS) && !defined(KTE_JACOBIAN_OF_RUNTIME_CHAINS)
#define KTE_JACOBIAN_OF_RUNTIME_CHAINS

#include <kte/dynamics/runtime/jacobian.hpp>

namespace kte {

/// Writes the Jacobian of a frame to memory of the caller: a matrix, which is resized, or 6 rows of a larger matrix, or
/// a map. Allocates no memory, unless coordinates follow others.
///
///   Eigen::MatrixXd contacts(12, arm.dofs());
///   kte::jacobian(arm, s, q, left_foot, kte::in_world_axes, contacts.topRows<6>());
///   kte::jacobian(arm, s, q, right_foot, kte::in_world_axes, contacts.bottomRows<6>());
///
/// Throws `bad_argument` if the size does not fit.
template <class S, detail::matrix_like J>
void jacobian(const runtime_chain& c, basic_runtime_state<S>& s, const name_or_handle& frame, J&& j) {
  detail::put_jacobian_at_state(c, s, frame, false, j);
}
template <class S, detail::axes_at_origin Axes, detail::matrix_like J>
void jacobian(const runtime_chain& c, basic_runtime_state<S>& s, const name_or_handle& frame, Axes, J&& j) {
  detail::put_jacobian_at_state(c, s, frame, std::is_same_v<Axes, in_world_axes_t>, j);
}
template <class S, indexable Q, detail::matrix_like J>
requires(!names_something<Q>) void jacobian(const runtime_chain& c, basic_runtime_state<S>& s, const Q& q,
                                            const name_or_handle& frame, J&& j) {
  detail::put_jacobian_at(c, s, q, frame, false, j);
}
template <class S, indexable Q, detail::axes_at_origin Axes, detail::matrix_like J>
requires(!names_something<Q>) void jacobian(const runtime_chain& c, basic_runtime_state<S>& s, const Q& q,
                                            const name_or_handle& frame, Axes, J&& j) {
  detail::put_jacobian_at(c, s, q, frame, std::is_same_v<Axes, in_world_axes_t>, j);
}
/// The Jacobian of a frame as a value.
template <class S, detail::axes_at_origin Axes = in_own_axes_t>
basic_runtime_jacobian<S> jacobian(const runtime_chain& c, basic_runtime_state<S>& s, const name_or_handle& frame,
                                   Axes = {}) {
  basic_runtime_jacobian<S> j;
  detail::put_jacobian_at_state(c, s, frame, std::is_same_v<Axes, in_world_axes_t>, j);
  return j;
}
template <class S, indexable Q, detail::axes_at_origin Axes = in_own_axes_t>
requires(!names_something<Q>) basic_runtime_jacobian<S> jacobian(const runtime_chain& c, basic_runtime_state<S>& s,
                                                                 const Q& q, const name_or_handle& frame, Axes = {}) {
  basic_runtime_jacobian<S> j;
  detail::put_jacobian_at(c, s, q, frame, std::is_same_v<Axes, in_world_axes_t>, j);
  return j;
}

}  // namespace kte

#endif
