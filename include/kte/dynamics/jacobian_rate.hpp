#pragma once

#include <kte/dynamics/detail/follower_rates.hpp>
#include <kte/dynamics/detail/runtime_bodies.hpp>
#include <kte/tree/jacobian_rate.hpp>

/// How Jacobians of frames change, and what a frame is accelerated by rates alone; on static and runtime chains. With
/// J of `jacobian`, in any of three kinds of axes,
///
///   d/dt (J v) = J a + J_dot v          (1)
namespace kte {

/// Tag: rates of a frame at its origin, in its own axes.
inline constexpr struct in_own_axes_t {
} in_own_axes;
/// Tag: rates of that point of the frame's body which stands at the origin of the world, in axes of the world (spatial
/// velocity): with the origin of the frame at p,
///
///   v_0 = p' + p x w,   w          (2)
inline constexpr struct at_world_origin_t {
} at_world_origin;

/// One of the three kinds of axes.
template <class T>
concept axes_of_rates =
    std::is_same_v<T, in_own_axes_t> || std::is_same_v<T, in_world_axes_t> || std::is_same_v<T, at_world_origin_t>;

namespace detail {
/// A Jacobian and its rate, at first in own axes.
template <class Matrix>
struct jacobian_with_rate {
  Matrix value, rate;
};
/// Where the frame is and how it moves, in axes of the world.
template <class S>
struct frame_in_world {
  mat3<vec3<S>> rotation;
  vec3<S> position, velocity, ang_velocity;
};
template <class Matrix, class F>
void change_columns(Matrix& j, const F& f) {
  using S = typename Matrix::Scalar;
  for (Eigen::Index k = 0; k < j.cols(); ++k) {
    vec3<S> u{j(0, k), j(1, k), j(2, k)}, w{j(3, k), j(4, k), j(5, k)};
    f(k, u, w);
    j.col(k) << u.x, u.y, u.z, w.x, w.y, w.z;
  }
}
/// (2), of columns in axes of the world.
template <class Matrix, class S>
void move_to_world_origin(Matrix& j, const vec3<S>& p) {
  change_columns(j, [&p](Eigen::Index, vec3<S>& u, const vec3<S>& w) { u = u + cross(p, w); });
}
/// From own axes, R^T J, to others, with  d/dt (R J) = R (J_dot + w x J)  and  d/dt (p x w) = p' x w + p x w'.
template <class Axes, class Matrix, class S>
void change_axes(jacobian_with_rate<Matrix>& j, const frame_in_world<S>& x) {
  if constexpr (!std::is_same_v<Axes, in_own_axes_t>) {
    const auto to_world = [&x](Eigen::Index, vec3<S>& u, vec3<S>& w) { u = x.rotation * u, w = x.rotation * w; };
    change_columns(j.value, to_world), change_columns(j.rate, to_world);
    change_columns(j.rate, [&](Eigen::Index k, vec3<S>& u, vec3<S>& w) {
      u = u + cross(x.ang_velocity, vec3<S>{j.value(0, k), j.value(1, k), j.value(2, k)});
      w = w + cross(x.ang_velocity, vec3<S>{j.value(3, k), j.value(4, k), j.value(5, k)});
    });
  }
  if constexpr (std::is_same_v<Axes, at_world_origin_t>) {
    move_to_world_origin(j.value, x.position), move_to_world_origin(j.rate, x.position);
    change_columns(j.rate, [&](Eigen::Index k, vec3<S>& u, const vec3<S>&) {
      u = u + cross(x.velocity, vec3<S>{j.value(3, k), j.value(4, k), j.value(5, k)});
    });
  }
}
/// What changes in (1) at a motion without accelerations of coordinates.
template <class S, class Axes, class M, class Blame = too_large>
linear_angular<S> bias_of(const M& m, Axes, const Blame& why = {"an acceleration"}) {
  if constexpr (std::is_same_v<Axes, in_own_axes_t>) {
    return checked<S>(m.acceleration - cross(m.ang_velocity, m.velocity), m.ang_acceleration, why);
  } else {
    const auto x = in_parent_axes(m);
    if constexpr (std::is_same_v<Axes, in_world_axes_t>)
      return checked<S>(x.acceleration, x.ang_acceleration, why);
    else
      return checked<S>(x.acceleration + cross(x.velocity, x.ang_velocity) + cross(x.position, x.ang_acceleration),
                        x.ang_acceleration, why);
  }
}
}  // namespace detail

// ---- of static chains, with bases at rest

/// The Jacobian at the origin of the world: (2).
template <class Gravity, class... E, indexable Q, key_type Frame>
auto jacobian(const static_chain<Gravity, E...>& c, const Q& q, const Frame& frame, at_world_origin_t) {
  using S = value_of<Q>;
  auto j = jacobian(c, q, frame, in_world_axes);
  const auto p = forward_kinematics(c, q, frame).position;
  if constexpr (Frame::what == kind::frame_2D)
    detail::move_to_world_origin(j, vec3<S>{p.x, p.y, S(0)});
  else
    detail::move_to_world_origin(j, p);
  return j;
}
template <class Gravity, class... E, indexable Q, key_type Frame>
auto jacobian(const static_chain<Gravity, E...>& c, const Q& q, const Frame& frame, in_own_axes_t) {
  return jacobian(c, q, frame);
}

/// The time derivative J_dot of `jacobian(c, q, frame, axes)` where the chain moves by v: by dual numbers, exact to
/// rounding.
template <class Gravity, class... E, indexable Q, indexable V, key_type Frame, axes_of_rates Axes = in_own_axes_t>
auto jacobian_rate(const static_chain<Gravity, E...>& c, const Q& q, const V& v, const Frame& frame, Axes axes = {}) {
  using namespace detail;
  using chain_type = static_chain<Gravity, E...>;
  using S = value_of<Q>;
  check_configuration<chain_type>(q), check_velocities<chain_type>(v);
  const auto moving = jacobian(c, moving_along(c, q, v), frame, axes);
  six_by_dofs<S, chain_type::dofs> rate;
  for (Eigen::Index i = 0; i < rate.size(); ++i) rate.data()[i] = moving.data()[i].derivative[0];
  check_result(rate.data(), static_cast<std::size_t>(rate.size()), [&]() {
    blame<typename chain_type::wiring>("a rate", each<S, Q>{q}, each<S, V>{v}, same<zero_t>{}, "a");
  });
  return rate;
}

/// J_dot v: what the rates in (1) change by where no coordinate is accelerated, in m/s^2 and rad/s^2. O(d).
template <class Gravity, class... E, indexable Q, indexable V, key_type Frame, axes_of_rates Axes = in_own_axes_t>
auto bias_acceleration(const static_chain<Gravity, E...>& c, const Q& q, const V& v, const Frame&, Axes axes = {}) {
  using namespace detail;
  using chain_type = static_chain<Gravity, E...>;
  using S = value_of<Q>;
  check_configuration<chain_type>(q), check_velocities<chain_type>(v);
  const configuration<S, typename chain_type::wiring, Q> at(q);
  at.check();
  return bias_of<S>(motion_at<Frame>(c, given{at, each<S, V>{v}, same<zero_t>{}, base_at_rest}), axes, [&]() {
    blame<typename chain_type::wiring>("an acceleration", at.q, each<S, V>{v}, same<zero_t>{}, "a");
  });
}

// ---- of runtime chains, with bases as the state has them

namespace detail {
/// At positions and rates that are good.
template <class Axes, class S>
jacobian_with_rate<basic_runtime_jacobian<S>> jacobian_with_rate_of(const kte_map_chain& c, basic_runtime_state<S>& s,
                                                                    const runtime_frame& x) {
  using six_rows = basic_runtime_jacobian<S>;
  const auto& t = s.tree();
  const auto& place = t.forest.frame(x.what, x.index);
  place_ancestors(runtime_elements{c}, s, place.slot);
  take_rates(s);
  jacobian_with_rate<six_rows> j{six_rows::Zero(6, t.plan.coordinates), six_rows::Zero(6, t.plan.coordinates)};
  const auto add = [&t](six_rows& to, int k, const vec3<S>& u, const vec3<S>& w) {
    auto column = to.col(t.forest.row[static_cast<std::size_t>(k)]);
    column[0] += u.x, column[1] += u.y, column[2] += u.z, column[3] += w.x, column[4] += w.y, column[5] += w.z;
  };
  tree::dense_pose<S> seen;
  tree::world_axis<S> moves;
  const int base =
      tree::jacobian_rate_columns(t.forest, s.work, place, seen, moves,
                                  [&](int k, const vec3<S>& u, const vec3<S>& w, const vec3<S>& u_dot,
                                      const vec3<S>& w_dot) { add(j.value, k, u, w), add(j.rate, k, u_dot, w_dot); });
  hand_on_with_rates(runtime_elements{c}, s, [&j](int to, int from, const S& ratio, const S& rate) {
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
  check_result(j.rate.data(), static_cast<std::size_t>(j.rate.size()), [&s] { blame("a rate", s); });
  return j;
}
template <class Axes, class S>
linear_angular<S> bias_acceleration_of(const kte_map_chain& c, basic_runtime_state<S>& s, const runtime_frame& x) {
  static_assert(goes_through_passes<S>);
  const rates_aside aside(s, false);
  move(c.wiring(), s, x);
  const vec3<> all = c.gravity(), g = x.what == kind::frame_2D ? vec3<>{all.x, all.y, 0.0} : all;
  return with_motion(s, x, [&g](const auto& m) {
    return bias_of<S>(motion{m.position, m.rotation, m.velocity, m.ang_velocity,
                             m.acceleration + transpose(matrix(m.rotation)) * g, m.ang_acceleration},
                      Axes{});
  });
}
template <class S>
basic_runtime_jacobian<S> at_origin(basic_runtime_jacobian<S> j, const vec3<S>& position) {
  move_to_world_origin(j, position);
  return j;
}
}  // namespace detail

template <class S>
basic_runtime_jacobian<S> jacobian(const kte_map_chain& c, basic_runtime_state<S>& s, const name_or_handle& frame,
                                   at_world_origin_t) {
  auto j = jacobian(c, s, frame, in_world_axes);
  return detail::at_origin(std::move(j), forward_kinematics(c, s, frame).position);
}
template <class S, indexable Q>
requires(!names_something<Q>) basic_runtime_jacobian<S> jacobian(const kte_map_chain& c, basic_runtime_state<S>& s,
                                                                 const Q& q, const name_or_handle& frame,
                                                                 at_world_origin_t axes) {
  detail::check_regular(c, s), (void)detail::find_frame(c, frame);
  detail::take(c, s, q);
  return jacobian(c, s, frame, axes);
}

/// As on static chains, by columns that change as the frame moves (tree/jacobian_rate.hpp).
template <class S, axes_of_rates Axes = in_own_axes_t>
basic_runtime_jacobian<S> jacobian_rate(const kte_map_chain& c, basic_runtime_state<S>& s, const name_or_handle& frame,
                                        Axes = {}) {
  detail::check_regular(c, s);
  const auto x = detail::find_frame(c, frame);
  detail::check_state_velocities(s);
  return detail::jacobian_with_rate_of<Axes>(c, s, x).rate;
}
template <class S, indexable Q, indexable V, axes_of_rates Axes = in_own_axes_t>
basic_runtime_jacobian<S> jacobian_rate(const kte_map_chain& c, basic_runtime_state<S>& s, const Q& q, const V& v,
                                        const name_or_handle& frame, Axes = {}) {
  detail::check_regular(c, s);
  const auto x = detail::find_frame(c, frame);
  detail::take(c, s, q, v);
  return detail::jacobian_with_rate_of<Axes>(c, s, x).rate;
}

/// As on static chains; where bases of the state are accelerated, but for gravity, with that.
template <class S, axes_of_rates Axes = in_own_axes_t>
linear_angular<S> bias_acceleration(const kte_map_chain& c, basic_runtime_state<S>& s, const name_or_handle& frame,
                                    Axes = {}) {
  c.check(s);
  const auto x = detail::find_frame(c, frame);
  detail::check_state_velocities(s);
  return detail::bias_acceleration_of<Axes>(c, s, x);
}
template <class S, indexable Q, indexable V, axes_of_rates Axes = in_own_axes_t>
linear_angular<S> bias_acceleration(const kte_map_chain& c, basic_runtime_state<S>& s, const Q& q, const V& v,
                                    const name_or_handle& frame, Axes = {}) {
  const auto x = detail::find_frame(c, frame);
  detail::take(c, s, q, v);
  return detail::bias_acceleration_of<Axes>(c, s, x);
}

}  // namespace kte
