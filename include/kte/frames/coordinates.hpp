#pragma once

#include <kte/frames/frame_2D.hpp>
#include <kte/math/quaternion.hpp>
#include <kte/math/sincos.hpp>

/// Coordinates of several degrees of freedom in the state of a chain. Rates are those of the components in axes of the
/// moving frame, with v' = a: the velocity of a pose is R^T p', and its acceleration is d(R^T p')/dt. This differs from
/// the acceleration of a frame, R^T p'', by w x v.
namespace kte {

/// A rotation in space as a coordinate.
///   rotation          maps axes of the moving frame to those of the parent; any length but 0; `integrate` sets it to 1
///   ang_velocity      rad/s, ang_acceleration rad/s^2, torque Nm (generalized force): in axes of the moving frame
///   matrix            of `rotation`, set by doMotion
template <class S = double>
struct rotation_coord_3D {
  unit_quaternion<S> rotation{S(1), S(0), S(0), S(0)};
  vec3<S> ang_velocity{};
  vec3<S> ang_acceleration{};
  vec3<S> torque{};
  mat3<vec3<S>> matrix{{S(1), S(0), S(0)}, {S(0), S(1), S(0)}, {S(0), S(0), S(1)}};
};

/// A pose in the plane as a coordinate. Rates and loads are in the axes of the moving frame.
///   position, angle                 in the axes of the parent, m; rad
///   velocity, ang_velocity          m/s, rad/s
///   acceleration, ang_acceleration  m/s^2, rad/s^2
///   force, torque                   generalized forces, N, Nm
///   cos, sin                        of the angle, set by doMotion
template <class S = double>
struct pose_coord_2D {
  vec2<S> position{};
  S angle{};
  vec2<S> velocity{};
  S ang_velocity{};
  vec2<S> acceleration{};
  S ang_acceleration{};
  vec2<S> force{};
  S torque{};
  S cos = S(1);
  S sin{};
};

/// A pose in space as a coordinate. Rates and loads are in the axes of the moving frame.
///   position, rotation              in the axes of the parent, m; a quaternion of any length but 0
///   velocity, ang_velocity          m/s, rad/s
///   acceleration, ang_acceleration  m/s^2, rad/s^2
///   force, torque                   generalized forces, N, Nm
///   matrix                          of `rotation`, set by doMotion
template <class S = double>
struct pose_coord_3D {
  vec3<S> position{};
  unit_quaternion<S> rotation{S(1), S(0), S(0), S(0)};
  vec3<S> velocity{};
  vec3<S> ang_velocity{};
  vec3<S> acceleration{};
  vec3<S> ang_acceleration{};
  vec3<S> force{};
  vec3<S> torque{};
  mat3<vec3<S>> matrix{{S(1), S(0), S(0)}, {S(0), S(1), S(0)}, {S(0), S(0), S(1)}};
};

// ---- conversion to motions; the accelerations are those described above
/// The coordinate as a `motion` in space.
template <class S>
[[nodiscard]] KTE_INLINE constexpr auto spatial(const rotation_coord_3D<S>& c) {
  return motion{zero3{}, c.matrix, zero3{}, c.ang_velocity, zero3{}, c.ang_acceleration};
}
template <class S>
[[nodiscard]] KTE_INLINE constexpr auto spatial(const pose_coord_2D<S>& c) {
  using namespace detail;
  return motion{in_plane(c.position),    rotation_2D{c.cos, c.sin}, in_plane(c.velocity),
                about_z(c.ang_velocity), in_plane(c.acceleration),  about_z(c.ang_acceleration)};
}
template <class S>
[[nodiscard]] KTE_INLINE constexpr auto spatial(const pose_coord_3D<S>& c) {
  return motion{c.position, c.matrix, c.velocity, c.ang_velocity, c.acceleration, c.ang_acceleration};
}

// ---- updates by doMotion
/// Computes cosine and sine, or the rotation matrix, from the coordinate.
template <class S>
KTE_INLINE constexpr void update_angle(pose_coord_2D<S>& c) {
  sincos(c.angle, c.sin, c.cos);
}
template <class S>
KTE_INLINE constexpr void update_angle(rotation_coord_3D<S>& c) {
  c.matrix = matrix_of_any_length(c.rotation);
}
template <class S>
KTE_INLINE constexpr void update_angle(pose_coord_3D<S>& c) {
  c.matrix = matrix_of_any_length(c.rotation);
}

// ---- loads
/// Adds a wrench in the axes of the moving frame to the generalized forces of the coordinate.
template <class S, class F, class T>
KTE_INLINE constexpr void add_load(rotation_coord_3D<S>& c, const wrench<F, T>& w) {
  c.torque = as<S>(c.torque + w.torque);
}
template <class S, class F, class T>
KTE_INLINE constexpr void add_load(pose_coord_2D<S>& c, const wrench<F, T>& w) {
  c.force = as<S>(c.force + detail::planar_part<S>(w.force));
  c.torque = as<S>(c.torque + detail::normal_part<S>(w.torque));
}
template <class S, class F, class T>
KTE_INLINE constexpr void add_load(pose_coord_3D<S>& c, const wrench<F, T>& w) {
  c.force = as<S>(c.force + w.force);
  c.torque = as<S>(c.torque + w.torque);
}
/// Sets the generalized forces of the coordinate to zero.
template <class S>
KTE_INLINE constexpr void clear_load(rotation_coord_3D<S>& c) {
  c.torque = {};
}
template <class S>
KTE_INLINE constexpr void clear_load(pose_coord_2D<S>& c) {
  c.force = {}, c.torque = S{};
}
template <class S>
KTE_INLINE constexpr void clear_load(pose_coord_3D<S>& c) {
  c.force = {}, c.torque = {};
}

}  // namespace kte
