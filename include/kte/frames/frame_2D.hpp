#pragma once

#include <kte/frames/motion.hpp>

namespace kte {

/// A frame in the plane, in the state of a chain. SI units.
///   position, rotation              in the axes of the world
///   velocity, ang_velocity          and all below: in the axes of the frame; angular quantities are about z
///   acceleration, ang_acceleration  classical, not spatial
///   force, torque                   on the mechanism at the origin of the frame
template <class S = double>
struct frame_2D {
  vec2<S> position{};
  rotation_2D<S> rotation{S(1), S(0)};
  vec2<S> velocity{};
  S ang_velocity{};
  vec2<S> acceleration{};
  S ang_acceleration{};
  vec2<S> force{};
  S torque{};
};

namespace detail {
template <class S>
KTE_INLINE constexpr auto in_plane(const vec2<S>& v) {
  return vec3{v.x, v.y, zero};
}
template <class S>
KTE_INLINE constexpr auto about_z(const S& w) {
  return vec3{zero, zero, w};
}
template <class S, class X, class Y, class Z>
KTE_INLINE constexpr vec2<S> planar_part(const vec3<X, Y, Z>& v) {
  static_assert(std::is_same_v<Z, zero_t>, "kte: an element moves or pushes a 2D frame out of its plane");
  return {as<S>(v.x), as<S>(v.y)};
}
template <class S, class X, class Y, class Z>
KTE_INLINE constexpr S normal_part(const vec3<X, Y, Z>& v) {
  static_assert(std::is_same_v<X, zero_t> && std::is_same_v<Y, zero_t>,
                "kte: an element turns a 2D frame out of its plane");
  return as<S>(v.z);
}
}  // namespace detail

/// The frame as a motion in space. Components out of the plane are typed zeros, so that kernels are written once for
/// both dimensions.
template <class S>
[[nodiscard]] KTE_INLINE constexpr auto spatial(const frame_2D<S>& x) {
  using namespace detail;
  return motion{in_plane(x.position),     x.rotation,
                in_plane(x.velocity),     about_z(x.ang_velocity),
                in_plane(x.acceleration), about_z(x.ang_acceleration)};
}
/// The load of the frame as a wrench in space.
template <class S>
[[nodiscard]] KTE_INLINE constexpr auto load_of(const frame_2D<S>& x) {
  return wrench{detail::in_plane(x.force), detail::about_z(x.torque)};
}
/// Sets position, rotation, rates and accelerations.
template <class S, class... M>
KTE_INLINE constexpr void set_motion(frame_2D<S>& x, const motion<M...>& m) {
  using namespace detail;
  x.position = planar_part<S>(m.position);
  x.rotation = as<S>(m.rotation * rotation_2D{one, zero});
  x.velocity = planar_part<S>(m.velocity);
  x.ang_velocity = normal_part<S>(m.ang_velocity);
  x.acceleration = planar_part<S>(m.acceleration);
  x.ang_acceleration = normal_part<S>(m.ang_acceleration);
}
/// Adds a wrench in the axes of the frame.
template <class S, class F, class T>
KTE_INLINE constexpr void add_load(frame_2D<S>& x, const wrench<F, T>& w) {
  x.force = as<S>(x.force + detail::planar_part<S>(w.force));
  x.torque = as<S>(x.torque + detail::normal_part<S>(w.torque));
}
/// Sets force and torque to zero.
template <class S>
KTE_INLINE constexpr void clear_load(frame_2D<S>& x) {
  x.force = {};
  x.torque = S{};
}

}  // namespace kte
