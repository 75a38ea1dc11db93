#pragma once

#include <kte/dynamics/jacobian.hpp>
#include <kte/frames/inverse.hpp>

#include <type_traits>

/// The kinds of axes in which rates of frames and their Jacobians are expressed.
namespace kte {

/// Tag: rates of the point of the frame's body at the origin of the world, in axes of the world (spatial velocity):
/// with the origin of the frame at p,
///
///   v_0 = p' + p x w,   w          (1)
inline constexpr struct at_world_origin_t {
} at_world_origin;

/// One of the three tags for axes of rates.
template <class T>
concept axes_of_rates = detail::axes_at_origin<T> || std::is_same_v<T, at_world_origin_t>;

namespace detail {
/// A Jacobian and its rate, at first in own axes.
template <class Matrix>
struct jacobian_with_rate {
  Matrix value, rate;
};
/// The pose and the motion of a frame, in axes of the world.
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
/// Applies (1) to columns in axes of the world.
template <class Matrix, class S>
void move_to_world_origin(Matrix& j, const vec3<S>& p) {
  change_columns(j, [&p](Eigen::Index, vec3<S>& u, const vec3<S>& w) { u = u + cross(p, w); });
}
/// Changes a Jacobian and its rate from own axes to other axes: R^T J, and  d/dt (R J) = R (J_dot + w x J)  and  d/dt
/// (p x w) = p' x w + p x w'.
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
/// The bias acceleration J_dot v of a frame in the given axes, from its motion.
template <class S, class Axes, class M, class Diagnose = too_large>
linear_angular<S> bias_of(const M& m, Axes, const Diagnose& why = {"an acceleration"}) {
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

}  // namespace kte
