#pragma once

#include <kte/dynamics/detail/moved_in_world.hpp>
#include <kte/dynamics/jacobian.hpp>
#include <kte/dynamics/runtime.hpp>

/// Frames of runtime chains: poses, velocities, accelerations, Jacobians, under the names they have on static chains
/// (dynamics/frame_motion.hpp, dynamics/jacobian.hpp). Bases are as the state has them. Nothing is allocated but the
/// Jacobian that is returned.
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
      s, [](const auto& c, const auto& f) { visit_v(c, f); }, "kte: a velocity is no finite number");
}

/// Columns of all coordinates over the degrees of freedom: those of followers count for what they follow, those of
/// coordinates that are given are left out.
template <class S>
Eigen::Matrix<S, 6, Eigen::Dynamic> folded(const kte_map_chain& c, basic_runtime_state<S>& s,
                                           Eigen::Matrix<S, 6, Eigen::Dynamic> a) {
  if (a.cols() == s.dofs()) return a;
  hand_on(runtime_elements{c}, s, [&a](int to, int from, const S& ratio) { a.col(to) += ratio * a.col(from); });
  return a.leftCols(s.dofs());
}
}  // namespace detail

namespace detail {
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
  detail::take(c, s, q);
  c.doMotion(s);
  detail::check_poses(s);
  return s;
}

namespace detail {
template <class S>
linear_angular<S> velocity_of(const kte_map_chain& c, basic_runtime_state<S>& s, const runtime_frame& x) {
  static_assert(goes_through_passes<S>);
  move(c.wiring(), s, x);
  return with_motion(s, x, [](const auto& m) { return checked<double>(m.velocity, m.ang_velocity); });
}
template <class S>
linear_angular<S> acceleration_of(const kte_map_chain& c, basic_runtime_state<S>& s, const runtime_frame& x) {
  return with_motion_in_world(c, s, x,
                              [](const auto& m) { return checked<double>(m.acceleration, m.ang_acceleration); });
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
  detail::take(c, s, q, v);
  return detail::velocity_of(c, s, x);
}

/// The acceleration of a frame, classical, in its own axes, without gravity, which the bases have in the state and
/// which is taken away here (dynamics/detail/moved_in_world.hpp).
template <class S>
linear_angular<S> frame_acceleration(const kte_map_chain& c, basic_runtime_state<S>& s, const name_or_handle& frame) {
  c.check(s);
  const auto x = detail::find_frame(c, frame);
  detail::check_state_velocities(s);
  detail::check_state(
      s, [](const auto& y, const auto& f) { visit_a(y, f); }, "kte: an acceleration is no finite number");
  return detail::acceleration_of(c, s, x);
}
template <class S, indexable Q, indexable V, indexable A>
linear_angular<S> frame_acceleration(const kte_map_chain& c, basic_runtime_state<S>& s, const Q& q, const V& v,
                                     const A& a, const name_or_handle& frame) {
  const auto x = detail::find_frame(c, frame);
  detail::take(c, s, q, v, a);
  return detail::acceleration_of(c, s, x);
}

/// The Jacobian of a frame, as on static chains.
template <class S>
using basic_runtime_jacobian = Eigen::Matrix<S, 6, Eigen::Dynamic>;
using runtime_jacobian = basic_runtime_jacobian<double>;

namespace detail {
/// Of a frame that follows others: its velocities at unit rates.
template <class S>
basic_runtime_jacobian<S> jacobian_by_rates(const kte_map_chain& c, basic_runtime_state<S>& s, const runtime_frame& x,
                                            bool world) {
  static_assert(goes_through_passes<S>);
  basic_runtime_jacobian<S> j(6, s.dofs());
  const runtime_vector<S> v = velocities(s);
  runtime_vector<S> rates = runtime_vector<S>::Zero(s.dofs());
  const auto velocity = [&]() -> linear_angular<S> {
    write_numbers<vector_of::v>(s, rates, "v");
    move(c.wiring(), s, x);
    return with_motion(s, x, [world](const auto& m) -> linear_angular<S> {
      if (!world) return {as<S>(m.velocity), as<S>(m.ang_velocity)};
      return {as<S>(matrix(m.rotation) * m.velocity), as<S>(matrix(m.rotation) * m.ang_velocity)};
    });
  };
  const auto at_rest = velocity();  // not zero, if bases move
  for (int k = 0; k < s.dofs(); ++k) {
    rates[k] = S(1);
    const auto [linear, angular] = velocity();
    const vec3<S> u = linear - at_rest.linear, w = angular - at_rest.angular;
    j.col(k) << u.x, u.y, u.z, w.x, w.y, w.z;
    rates[k] = S(0);
  }
  write_numbers<vector_of::v>(s, v, "v");
  return j;
}
/// At positions that are good, into a matrix of the caller's, of which all numbers are written.
template <class S>
void put_jacobian(const kte_map_chain& c, basic_runtime_state<S>& s, const runtime_frame& x, bool world,
                  basic_runtime_jacobian<S>& j) {
  const auto& t = s.tree();
  const auto& place = t.forest.frame(x.what, x.index);
  if constexpr (std::is_same_v<S, double>)
    if (place.slot < 0) [[unlikely]] {
      j = jacobian_by_rates(c, s, x, world);
      return;
    }
  if (j.cols() != t.plan.coordinates) j.resize(6, t.plan.coordinates);  // which divides, whatever the size is
  j.setZero();
  const auto add = [begin = j.data(), row = t.forest.row.data()](int k, const auto& v, const auto& w)
                       KTE_INLINE_LAMBDA { tree::add_column<S>(begin + 6 * row[k], v, w); };
  const auto way = place_ancestors(runtime_elements{c}, s, place.slot);
  if (world) {
    const int base = way.empty() ? place.slot : t.forest.records[static_cast<std::size_t>(way.back())].parent;
    tree::jacobian_columns_in_world(t.forest, s.work, place, way, axes_of_base(s, base), add);
  } else {
    tree::dense_pose<S> seen;
    (void)tree::jacobian_columns(t.forest, s.work, place, seen, add);
  }
  if (j.cols() != s.dofs()) j = folded(c, s, std::move(j));
}
template <class S>
basic_runtime_jacobian<S> jacobian_of(const kte_map_chain& c, basic_runtime_state<S>& s, const runtime_frame& x,
                                      bool world) {
  basic_runtime_jacobian<S> j;
  put_jacobian(c, s, x, world, j);
  return j;
}
template <class S>
void put_jacobian_at_state(const kte_map_chain& c, basic_runtime_state<S>& s, const name_or_handle& frame, bool world,
                           basic_runtime_jacobian<S>& j) {
  check_motion(c, s);
  const auto x = find_frame(c, frame);
  check_positions(s);
  put_jacobian(c, s, x, world, j);
}
template <class S, class Q>
void put_jacobian_at(const kte_map_chain& c, basic_runtime_state<S>& s, const Q& q, const name_or_handle& frame,
                     bool world, basic_runtime_jacobian<S>& j) {
  check_motion(c, s);
  const auto x = find_frame(c, frame);
  take(c, s, q);
  put_jacobian(c, s, x, world, j);
}
}  // namespace detail

/// Into a matrix of the caller's, which gets the size it needs: a control loop that keeps it allocates nothing (but
/// where coordinates follow others).
template <class S>
void jacobian(const kte_map_chain& c, basic_runtime_state<S>& s, const name_or_handle& frame,
              basic_runtime_jacobian<S>& j) {
  detail::put_jacobian_at_state(c, s, frame, false, j);
}
template <class S>
void jacobian(const kte_map_chain& c, basic_runtime_state<S>& s, const name_or_handle& frame, in_world_axes_t,
              basic_runtime_jacobian<S>& j) {
  detail::put_jacobian_at_state(c, s, frame, true, j);
}
template <class S, indexable Q>
requires(!names_something<Q>) void jacobian(const kte_map_chain& c, basic_runtime_state<S>& s, const Q& q,
                                            const name_or_handle& frame, basic_runtime_jacobian<S>& j) {
  detail::put_jacobian_at(c, s, q, frame, false, j);
}
template <class S, indexable Q>
requires(!names_something<Q>) void jacobian(const kte_map_chain& c, basic_runtime_state<S>& s, const Q& q,
                                            const name_or_handle& frame, in_world_axes_t,
                                            basic_runtime_jacobian<S>& j) {
  detail::put_jacobian_at(c, s, q, frame, true, j);
}
/// The same as a value.
template <class S>
basic_runtime_jacobian<S> jacobian(const kte_map_chain& c, basic_runtime_state<S>& s, const name_or_handle& frame) {
  basic_runtime_jacobian<S> j;
  jacobian(c, s, frame, j);
  return j;
}
template <class S>
basic_runtime_jacobian<S> jacobian(const kte_map_chain& c, basic_runtime_state<S>& s, const name_or_handle& frame,
                                   in_world_axes_t axes) {
  basic_runtime_jacobian<S> j;
  jacobian(c, s, frame, axes, j);
  return j;
}
template <class S, indexable Q>
requires(!names_something<Q>) basic_runtime_jacobian<S> jacobian(const kte_map_chain& c, basic_runtime_state<S>& s,
                                                                 const Q& q, const name_or_handle& frame) {
  basic_runtime_jacobian<S> j;
  jacobian(c, s, q, frame, j);
  return j;
}
template <class S, indexable Q>
requires(!names_something<Q>) basic_runtime_jacobian<S> jacobian(const kte_map_chain& c, basic_runtime_state<S>& s,
                                                                 const Q& q, const name_or_handle& frame,
                                                                 in_world_axes_t axes) {
  basic_runtime_jacobian<S> j;
  jacobian(c, s, q, frame, axes, j);
  return j;
}

#ifdef KTE_EXTERN
KTE_EXTERN template const runtime_state& forward_kinematics(const kte_map_chain&, runtime_state&);
namespace detail {
KTE_EXTERN template void check_state_velocities(const runtime_state&);
KTE_EXTERN template linear_angular<double> velocity_of(const kte_map_chain&, runtime_state&, const runtime_frame&);
KTE_EXTERN template linear_angular<double> acceleration_of(const kte_map_chain&, runtime_state&, const runtime_frame&);
KTE_EXTERN template void put_jacobian(const kte_map_chain&, runtime_state&, const runtime_frame&, bool,
                                      runtime_jacobian&);
}  // namespace detail
#endif

}  // namespace kte
