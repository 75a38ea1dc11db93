#pragma once

#include <kte/dynamics/detail/moved_in_world.hpp>
#include <kte/dynamics/runtime_jacobian.hpp>

/// Frames of runtime chains: poses, velocities, accelerations, under the names they have on static chains
/// (dynamics/frame_motion.hpp), and Jacobians. Bases are as the state has them. Nothing is allocated.
namespace kte {

namespace detail {
template <class S, class X>
void check_state(const basic_runtime_state<S>& s, const X& visit, const char* what) {
  bool finite = true;
  for_each_listed_freedom(
      s, [&](const auto& c, const freedom&) { visit(c, [&](const S& x) { finite &= all(x - x == S(0)); }); });
  if (!finite) throw bad_argument(what);
}
template <class S>
void check_state_velocities(const basic_runtime_state<S>& s) {
  check_positions(s);
  check_state(
      s, [](const auto& c, const auto& f) { visit_v(c, f); }, "kte: a velocity is not finite");
}

template <class S>
void check_poses(const basic_runtime_state<S>& s) {
  const auto check = [&s]<kind K>() {
    for (int i = 0; i < s.made_for()->count(K); ++i) checked_pose(s, spatial(s.template get<K>(i)), K, i);
  };
  check.template operator()<kind::frame_2D>(), check.template operator()<kind::frame_3D>();
}
}  // namespace detail

/// All frames at the state's positions: in the state, which is returned.
///
///   kte::forward_kinematics(arm, s, q).frame_3D("elbow").position
template <class S>
const basic_runtime_state<S>& forward_kinematics(const kte_map_chain& c, basic_runtime_state<S>& s) {
  static_assert(detail::goes_through_passes<S>);
  c.check(s);
  detail::check_positions(s);
  c.doMotion(s);
  detail::check_poses(s);
  return s;
}
/// The same at q, which is put into the state.
template <class S, indexable Q>
requires(!names_something<Q>) const basic_runtime_state<S>& forward_kinematics(const kte_map_chain& c,
                                                                               basic_runtime_state<S>& s, const Q& q) {
  static_assert(detail::goes_through_passes<S>);
  return detail::take(c, s, q).call([&]() -> const auto& {
    c.doMotion(s);
    detail::check_poses(s);
    return s;
  });
}

namespace detail {
template <class S>
linear_angular<S> velocity_of(const kte_map_chain& c, basic_runtime_state<S>& s, const runtime_frame& x) {
  static_assert(goes_through_passes<S>);
  move(c.wiring(), s, x);
  return with_motion(s, x, [&s](const auto& m) {
    return checked<double>(m.velocity, m.ang_velocity, blame_state{"a velocity", s});
  });
}
template <class S>
linear_angular<S> acceleration_of(const kte_map_chain& c, basic_runtime_state<S>& s, const runtime_frame& x) {
  return with_motion_in_world(c, s, x, [&s](const auto& m) {
    return checked<double>(m.acceleration, m.ang_acceleration, blame_state{"an acceleration", s});
  });
}
}  // namespace detail

/// The velocity and angular velocity of a frame in its own axes, as the state has bases and rates. Only the elements
/// between the bases and the frame are evaluated.
template <class S>
linear_angular<S> frame_velocity(const kte_map_chain& c, basic_runtime_state<S>& s, const name_or_handle& frame) {
  c.check(s);
  const auto x = detail::find_frame(c, frame);
  detail::check_state_velocities(s);
  return detail::velocity_of(c, s, x);
}
template <class S, indexable Q, indexable V>
linear_angular<S> frame_velocity(const kte_map_chain& c, basic_runtime_state<S>& s, const Q& q, const V& v,
                                 const name_or_handle& frame) {
  const auto x = detail::find_frame(c, frame);
  return detail::take(c, s, q, v).call([&] { return detail::velocity_of(c, s, x); });
}

/// The acceleration of a frame, classical, in its own axes, without gravity, which the bases have in the state and
/// which is taken away here (dynamics/detail/moved_in_world.hpp).
template <class S>
linear_angular<S> frame_acceleration(const kte_map_chain& c, basic_runtime_state<S>& s, const name_or_handle& frame) {
  c.check(s);
  const auto x = detail::find_frame(c, frame);
  detail::check_state_velocities(s);
  detail::check_state(
      s, [](const auto& y, const auto& f) { visit_a(y, f); }, "kte: an acceleration is not finite");
  return detail::acceleration_of(c, s, x);
}
template <class S, indexable Q, indexable V, indexable A>
linear_angular<S> frame_acceleration(const kte_map_chain& c, basic_runtime_state<S>& s, const Q& q, const V& v,
                                     const A& a, const name_or_handle& frame) {
  const auto x = detail::find_frame(c, frame);
  return detail::take(c, s, q, v, a).call([&] { return detail::acceleration_of(c, s, x); });
}

#ifdef KTE_EXTERN
KTE_EXTERN template const runtime_state& forward_kinematics(const kte_map_chain&, runtime_state&);
namespace detail {
KTE_EXTERN template void check_state_velocities(const runtime_state&);
KTE_EXTERN template linear_angular<double> velocity_of(const kte_map_chain&, runtime_state&, const runtime_frame&);
KTE_EXTERN template linear_angular<double> acceleration_of(const kte_map_chain&, runtime_state&, const runtime_frame&);
}  // namespace detail
#endif

}  // namespace kte
