#pragma once

#include <kte/dynamics/axes_of_rates.hpp>
#include <kte/dynamics/configuration_space.hpp>
#include <kte/dynamics/forward_kinematics.hpp>
#include <kte/dynamics/frame_motion.hpp>
#include <kte/dynamics/jacobian.hpp>
#include <kte/dynamics/looped/follower_rates.hpp>
#include <kte/dynamics/runtime/bodies.hpp>
#include <kte/dynamics/runtime/motion_in_world.hpp>
#include <kte/runtime_chain.hpp>
#include <kte/tree/jacobian_rate.hpp>

/// Time derivatives of Jacobians and bias accelerations of frames, for static and runtime chains. With J of `jacobian`
/// in one of three kinds of axes,
///
///   d/dt (J v) = J a + J_dot v          (1)
namespace kte {

// ---- static chains, with bases at rest

/// The Jacobian at the origin of the world: (1) of dynamics/axes_of_rates.hpp.
template <class Gravity, class... E, indexable Q, key_type Frame>
[[nodiscard]] auto jacobian(const static_chain<Gravity, E...>& c, const Q& q, const Frame& frame, at_world_origin_t) {
  using S = value_of<Q>;
  auto j = jacobian(c, q, frame, in_world_axes);
  const auto p = forward_kinematics(c, q, frame).position;
  if constexpr (Frame::what == kind::frame_2D)
    detail::move_to_world_origin(j, vec3<S>{p.x, p.y, S(0)});
  else
    detail::move_to_world_origin(j, p);
  return j;
}

/// The time derivative J_dot of `jacobian(c, q, frame, axes)` at the velocities v, by dual numbers, exact to rounding.
template <class Gravity, class... E, indexable Q, indexable V, key_type Frame, axes_of_rates Axes = in_own_axes_t>
[[nodiscard]] auto jacobian_rate(const static_chain<Gravity, E...>& c, const Q& q, const V& v, const Frame& frame,
                                 Axes axes = {}) {
  using namespace detail;
  using chain_type = static_chain<Gravity, E...>;
  using S = value_of<Q>;
  check_configuration<chain_type>(q), check_velocities<chain_type>(v);
  const auto moving = jacobian(c, moving_along(c, q, v), frame, axes);
  six_by_dofs<S, chain_type::dofs> rate;
  for (Eigen::Index i = 0; i < rate.size(); ++i) rate.data()[i] = moving.data()[i].derivative[0];
  check_result(rate.data(), static_cast<std::size_t>(rate.size()), [&]() {
    diagnose<typename chain_type::wiring>("a rate", each<S, Q>{q}, each<S, V>{v}, same<zero_t>{}, "a");
  });
  return rate;
}

/// J_dot v: the acceleration of a frame without accelerations of coordinates, m/s^2 and rad/s^2. O(d).
template <class Gravity, class... E, indexable Q, indexable V, key_type Frame, axes_of_rates Axes = in_own_axes_t>
[[nodiscard]] auto bias_acceleration(const static_chain<Gravity, E...>& c, const Q& q, const V& v, const Frame&,
                                     Axes axes = {}) {
  using namespace detail;
  using chain_type = static_chain<Gravity, E...>;
  using S = value_of<Q>;
  const auto x = checked_arguments<chain_type>(q, v);
  return bias_of<S>(motion_at<Frame>(c, given{x.at, x.v, same<zero_t>{}, base_at_rest}), axes,
                    x.diagnosis("an acceleration"));
}

// ---- runtime chains, with the bases of the state

namespace detail {
/// The Jacobian and its rate, for positions and rates that have been checked.
template <class Axes, class S>
jacobian_with_rate<basic_runtime_jacobian<S>> jacobian_with_rate_of(const runtime_chain& c, basic_runtime_state<S>& s,
                                                                    const runtime_frame& x) {
  using six_rows = basic_runtime_jacobian<S>;
  const auto& t = s.tree();
  const auto& place = t.body_tree.frame(x.what, x.index);
  refuse_following(c, s, x);
  place_ancestors(runtime_elements{c}, s, place.slot);
  take_rates(s);
  jacobian_with_rate<six_rows> j{six_rows::Zero(6, t.plan.coordinates), six_rows::Zero(6, t.plan.coordinates)};
  const auto add = [&t](six_rows& to, int k, const vec3<S>& u, const vec3<S>& w) {
    auto column = to.col(t.body_tree.row[static_cast<std::size_t>(k)]);
    column[0] += u.x, column[1] += u.y, column[2] += u.z, column[3] += w.x, column[4] += w.y, column[5] += w.z;
  };
  tree::dense_pose<S> seen;
  tree::world_axis<S> moves;
  const int base =
      tree::jacobian_rate_columns(t.body_tree, s.work, place, seen, moves,
                                  [&](int k, const vec3<S>& u, const vec3<S>& w, const vec3<S>& u_dot,
                                      const vec3<S>& w_dot) { add(j.value, k, u, w), add(j.rate, k, u_dot, w_dot); });
  pull_back_followers_with_rates(runtime_elements{c}, s, [&j](int to, int from, const S& ratio, const S& rate) {
    j.rate.col(to) += ratio * j.rate.col(from) + rate * j.value.col(from);
    j.value.col(to) += ratio * j.value.col(from);
  });
  j.value.conservativeResize(6, s.dofs()), j.rate.conservativeResize(6, s.dofs());
  for_each_base(s, [&](const auto& b, std::size_t slot) {
    if (static_cast<int>(slot) != base) return;
    const auto m = compose(
        motion{as<S>(b.position), as<S>(matrix(b.rotation)), as<S>(b.velocity), as<S>(b.ang_velocity), skip{}, skip{}},
        motion{seen.position, seen.rotation, moves.linear, moves.angular, skip{}, skip{}});
    const mat3<vec3<S>>& r = m.rotation;
    change_axes<Axes>(j, frame_in_world<S>{r, m.position, r * m.velocity, r * m.ang_velocity});
  });
  check_result(j.rate.data(), static_cast<std::size_t>(j.rate.size()), [&s] { diagnose("a rate", s); });
  return j;
}
template <class Axes, class S>
linear_angular<S> bias_acceleration_of(const runtime_chain& c, basic_runtime_state<S>& s, const runtime_frame& x) {
  const rates_aside aside(s, false);
  return with_motion_in_world(c, s, x, [&s](const auto& m) {
    return bias_of<S>(m, Axes{}, diagnose_state{"an acceleration", s});
  });
}
}  // namespace detail

template <class S>
basic_runtime_jacobian<S> jacobian(const runtime_chain& c, basic_runtime_state<S>& s, const name_or_handle& frame,
                                   at_world_origin_t) {
  auto j = jacobian(c, s, frame, in_world_axes);
  detail::move_to_world_origin(j, forward_kinematics(c, s, frame).position);
  return j;
}
template <class S, indexable Q>
requires(!names_something<Q>) basic_runtime_jacobian<S> jacobian(const runtime_chain& c, basic_runtime_state<S>& s,
                                                                 const Q& q, const name_or_handle& frame,
                                                                 at_world_origin_t axes) {
  detail::check_motion(c, s), (void)detail::find_frame(c, frame);
  return detail::take(c, s, q).call([&] { return jacobian(c, s, frame, axes); });
}

/// The time derivative J_dot of `jacobian(c, q, frame, axes)` at the velocities v, by the derivatives of columns
/// (tree/jacobian_rate.hpp). Throws `bad_argument` for a frame that follows others.
template <class S, axes_of_rates Axes = in_own_axes_t>
basic_runtime_jacobian<S> jacobian_rate(const runtime_chain& c, basic_runtime_state<S>& s, const name_or_handle& frame,
                                        Axes = {}) {
  detail::check_motion(c, s);
  const auto x = detail::find_frame(c, frame);
  detail::check_state_velocities(s);
  return detail::jacobian_with_rate_of<Axes>(c, s, x).rate;
}
template <class S, indexable Q, indexable V, axes_of_rates Axes = in_own_axes_t>
basic_runtime_jacobian<S> jacobian_rate(const runtime_chain& c, basic_runtime_state<S>& s, const Q& q, const V& v,
                                        const name_or_handle& frame, Axes = {}) {
  detail::check_motion(c, s);
  const auto x = detail::find_frame(c, frame);
  return detail::take(c, s, q, v).call([&] { return detail::jacobian_with_rate_of<Axes>(c, s, x).rate; });
}

/// J_dot v, m/s^2 and rad/s^2, plus the acceleration of the bases of the state, without gravity.
template <class S, axes_of_rates Axes = in_own_axes_t>
linear_angular<S> bias_acceleration(const runtime_chain& c, basic_runtime_state<S>& s, const name_or_handle& frame,
                                    Axes = {}) {
  c.check(s);
  const auto x = detail::find_frame(c, frame);
  detail::check_state_velocities(s);
  return detail::bias_acceleration_of<Axes>(c, s, x);
}
template <class S, indexable Q, indexable V, axes_of_rates Axes = in_own_axes_t>
linear_angular<S> bias_acceleration(const runtime_chain& c, basic_runtime_state<S>& s, const Q& q, const V& v,
                                    const name_or_handle& frame, Axes = {}) {
  const auto x = detail::find_frame(c, frame);
  return detail::take(c, s, q, v).call([&] { return detail::bias_acceleration_of<Axes>(c, s, x); });
}

}  // namespace kte
