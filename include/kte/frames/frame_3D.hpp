#pragma once

#include <kte/frames/motion.hpp>

namespace kte {

/// A frame in space, in the state of a chain. SI units.
///   position, rotation              in the axes of the world, the parent of the chain's base
///   velocity, ang_velocity          and all below: in the axes of the frame
///   acceleration, ang_acceleration  classical, not spatial
///   force, torque                   on the mechanism at the origin of the frame
template <class S = double>
struct frame_3D {
  vec3<S> position{};
  mat3<vec3<S>> rotation{{S(1), S(0), S(0)}, {S(0), S(1), S(0)}, {S(0), S(0), S(1)}};
  vec3<S> velocity{};
  vec3<S> ang_velocity{};
  vec3<S> acceleration{};
  vec3<S> ang_acceleration{};
  vec3<S> force{};
  vec3<S> torque{};
};

/// The frame as a motion in space.
template <class S>
KTE_INLINE constexpr const frame_3D<S>& spatial(const frame_3D<S>& x) {
  return x;
}
/// The load of the frame as a wrench.
template <class S>
[[nodiscard]] KTE_INLINE constexpr auto load_of(const frame_3D<S>& x) {
  return wrench{x.force, x.torque};
}
/// Sets position, rotation, rates and accelerations.
template <class S, class... M>
KTE_INLINE constexpr void set_motion(frame_3D<S>& x, const motion<M...>& m) {
  x.position = as<S>(m.position);
  x.rotation = as<S>(matrix(m.rotation));
  x.velocity = as<S>(m.velocity);
  x.ang_velocity = as<S>(m.ang_velocity);
  x.acceleration = as<S>(m.acceleration);
  x.ang_acceleration = as<S>(m.ang_acceleration);
}
/// Adds a wrench in the axes of the frame.
template <class S, class F, class T>
KTE_INLINE constexpr void add_load(frame_3D<S>& x, const wrench<F, T>& w) {
  x.force = as<S>(x.force + w.force);
  x.torque = as<S>(x.torque + w.torque);
}
/// Sets force and torque to zero.
template <class S>
KTE_INLINE constexpr void clear_load(frame_3D<S>& x) {
  x.force = {};
  x.torque = {};
}

}  // namespace kte
