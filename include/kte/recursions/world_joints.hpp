#pragma once

#include <kte/contract/joint_axis.hpp>
#include <kte/engine/body.hpp>
#include <kte/math/rigid_body.hpp>

#include <concepts>

/// The joints of a mechanism as numbers in axes of the world, for recursions over pairs of joints or bodies: they would
/// be too much code for each pair, and in these axes no number is a typed constant.
namespace kte::engine {

using kte::detail::joint_axis;

/// Joints, parents first; the body of joint i is fixed to its end.
///   count(), parent(i)     their number; the parent of joint i, or -1
///   first(i), axes(i)      its axes, by number
///   axis(k)                the motion at the unit rate of axis k, at the end of its joint
///   step(i)                from the end of its parent, or its base, to its end, m
template <class T>
concept world_joints = requires(const T& t) {
  { t.count() } -> std::convertible_to<int>;
  { t.parent(0) } -> std::convertible_to<int>;
  t.first(0), t.axes(0), t.axis(0).angular, t.step(0);
};

/// put(k, v, u): the columns of the Jacobian of a frame, in its own axes, for joint i and all joints before it.
/// `rotation`: of the frame in the world; `way`: from the end of joint i to it, in axes of the world. For loops over
/// body nodes, which need no placements in the world otherwise, tree/jacobian.hpp is up to 15 % of a regressor faster.
template <class S, world_joints T, class Put>
KTE_INLINE void frame_columns(const T& t, int i, const mat3<vec3<S>>& rotation, vec3<S> way, const Put& put) {
  const mat3<vec3<S>> in = transpose(rotation);
  for (; i >= 0; i = t.parent(i)) {
    for (int k = t.first(i); k < t.first(i) + t.axes(i); ++k) {
      const joint_axis<S>& s = t.axis(k);
      const vec3<S> v = in * (s.linear + cross(s.angular, way)), u = in * s.angular;
      put(k, v, u);
    }
    way = t.step(i) + way;
  }
}

}  // namespace kte::engine
