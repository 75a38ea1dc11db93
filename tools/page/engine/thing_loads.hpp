#pragma once

#include <kte/frames/coordinates.hpp>
#include <kte/frames/frame_2D.hpp>
#include <kte/frames/frame_3D.hpp>

namespace kte::page {

using load = wrench<vec3<>, vec3<>>;

inline vec3<> three(const vec2<>& v) { return {v.x, v.y, 0}; }
inline vec3<> three(const vec3<>& v) { return v; }
inline vec3<> three(double about_z) { return {0, 0, about_z}; }
inline void put_three(vec2<>& to, const vec3<>& v) { to = {v.x, v.y}; }
inline void put_three(vec3<>& to, const vec3<>& v) { to = v; }
inline void put_three(double& to, const vec3<>& about_z) { to = about_z.z; }

/// The load on a frame or a coordinate as a state holds it, in its own axes; of a coordinate of one number in force.x.
template <class X>
load load_on(const X& x) {
  load w{};
  if constexpr (requires { x.f; }) w.force.x = x.f;
  if constexpr (requires { x.force; }) w.force = three(x.force);
  if constexpr (requires { x.torque; }) w.torque = three(x.torque);
  return w;
}
template <class X>
void put_load(X& x, const load& w) {
  if constexpr (requires { x.f; }) x.f = w.force.x;
  if constexpr (requires { x.force; }) put_three(x.force, w.force);
  if constexpr (requires { x.torque; }) put_three(x.torque, w.torque);
}
/// A load on a frame, in axes of the world.
template <class X>
load in_world(const X& frame, const load& w) {
  const auto r = spatial(frame).rotation;
  return {as<double>(r * w.force), as<double>(r * w.torque)};
}

}  // namespace kte::page
