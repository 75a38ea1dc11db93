#pragma once

#include <kte/recursions/world_joints.hpp>
#include <kte/tree/memory.hpp>

/// Transforms components between the axes of a body and of its parent.
namespace kte::tree {

// Separate functions: joints of several axes are rare, and their code would be inlined into all others.
template <class S, class L>
[[gnu::noinline]] vec3<L> rotated(const mat3<vec3<S>>& r, const vec3<L>& u) {
  return {r.x.x * u.x + r.x.y * u.y + r.x.z * u.z, r.y.x * u.x + r.y.y * u.y + r.y.z * u.z,
          r.z.x * u.x + r.z.y * u.y + r.z.z * u.z};
}
template <class S>
[[gnu::noinline]] vec3<S> rotated_back(const mat3<vec3<S>>& r, const vec3<S>& u) {
  return transpose(r) * u;
}
/// A body node with its joint transform.
template <class P, class S>
struct placed {
  const body_node<P>& r;
  const joint_transform<S>& at;

  /// Transforms to the axes of the parent: vectors of numbers, or of lanes.
  template <class L>
  KTE_INLINE vec3<L> out(vec3<L> u) const {
    if (r.has_matrix()) [[unlikely]]
      u = rotated(at.rotation(), u);
    return out_placement(u);
  }
  /// Transforms to the axes of the body.
  KTE_INLINE vec3<S> in(const vec3<S>& u) const {
    const vec3<S> x = in_placement(u);
    if (r.has_matrix()) [[unlikely]]
      return rotated_back(at.rotation(), x);
    return x;
  }
  /// R A: from the unit vectors of the body, as rows, to those of the parent; and the inverse.
  template <class Row>
  KTE_INLINE mat3<Row> units_out(mat3<Row> a) const {
    if (r.has_matrix()) [[unlikely]]
      a = turned(a, at.rotation());
    a = rows_out_x(r.tilt, rows_out_z(at.angle, a));
    return r.turned ? rows_out_z(r.before, a) : a;
  }
  template <class Row>
  KTE_INLINE mat3<Row> units_in(mat3<Row> a) const {
    if (r.turned) a = rows_out_z(r.before.back(), a);
    a = rows_out_z(at.angle.back(), rows_out_x(r.tilt.back(), a));
    if (r.has_matrix()) [[unlikely]]
      a = turned(a, transpose(at.rotation()));
    return a;
  }
  KTE_INLINE const vec3<S>& position() const { return at.position; }
  KTE_INLINE dense_wrench<S> out(const dense_wrench<S>& w) const {
    const vec3<S> f = out(w.force);
    return {f, out(w.torque) + cross(at.position, f)};
  }

  /// Transforms by the placement and a rotation about z only.
  KTE_INLINE vec3<S> in_placement(vec3<S> u) const {
    if (r.turned) u = in_z(r.before, u);
    return in_z(at.angle, in_x(r.tilt, u));
  }
  template <class X>
  KTE_INLINE X out_placement(const X& x) const {
    const X y = out_x(r.tilt, out_z(at.angle, x));
    return r.turned ? out_z(r.before, y) : y;
  }

 private:
  template <class Row>
  KTE_INLINE static mat3<Row> turned(const mat3<Row>& a, const mat3<vec3<S>>& r) {
    return {combined(a, r.x), combined(a, r.y), combined(a, r.z)};
  }
};
template <class P, class S>
placed(const body_node<P>&, const joint_transform<S>&) -> placed<P, S>;

/// The position of a body whose joint has slid by d along the axes of its placement.
template <class P, class S>
KTE_INLINE vec3<S> slid(const body_node<P>& r, const vec3<S>& d) {
  const vec3<S> x = out_x(r.tilt, out_z(r.after, d));
  return r.position + (r.turned ? out_z(r.before, x) : x);
}
/// Places a z-joint at q; `angle` is used if the joint rotates: cosine and sine.
template <class P, class S>
KTE_INLINE void place_on_z(const body_node<P>& r, const S& q, const turn<S>& angle, joint_transform<S>& at) {
  if (r.moves != joint::prismatic) at.angle = r.after * angle;
  if (r.moves != joint::revolute) at.position = slid(r, vec3<S>{S(0), S(0), r.slides * q});
}

/// The component of (linear, angular) along unit motion `n` of the axes of a body.
template <class S>
KTE_INLINE S& component(vec3<S>& linear, vec3<S>& angular, int n) {
  S* const components[]{&linear.x, &linear.y, &linear.z, &angular.x, &angular.y, &angular.z};
  return *components[n];
}

/// dS/dt of axis k of a `varying` joint at these rates, in the axes of the body.
template <class P, class S>
world_axis<S> rate_of_axis(const body_node<P>& r, const joint_transform<S>& at, int k, const S* rate) {
  world_axis<S> sum{};
  for (int j = 0; j < r.axes; ++j) {
    const world_axis<S>& by = at.axis(r.axes + r.axes * k + j);
    sum = {sum.linear + rate[j] * by.linear, sum.angular + rate[j] * by.angular};
  }
  return sum;
}
/// The motion of a `varying` joint: a call, so that it is not in the code of other joints.
template <class P, class S, class T>
[[gnu::noinline]] void varying_along_axes(const body_node<P>& r, const joint_transform<S>& at, const T* x,
                                          vec3<T>& linear, vec3<T>& angular) {
  for (int k = 0; k < r.axes; ++k) {
    const world_axis<S>& s = at.axis(k);
    linear = linear + x[k] * s.linear, angular = angular + x[k] * s.angular;
  }
}
/// dS/dt q_dot of a `varying` joint, in axes of the body.
template <class P, class S>
[[gnu::noinline]] world_axis<S> bias_of_varying(const body_node<P>& r, const joint_transform<S>& at, const S* rate) {
  world_axis<S> sum{};
  for (int k = 0; k < r.axes; ++k) {
    const world_axis<S> s = rate_of_axis(r, at, k, rate);
    sum = {sum.linear + rate[k] * s.linear, sum.angular + rate[k] * s.angular};
  }
  return sum;
}
/// The motion for the rates of a joint, or their changes: x[0], ... belong to its axes. In the axes of the body.
template <class P, class S, class T>
KTE_INLINE void along_axes(const body_node<P>& r, const joint_transform<S>& at, const T* x, vec3<T>& linear,
                           vec3<T>& angular) {
  if (r.moves == joint::varying) [[unlikely]]
    return varying_along_axes(r, at, x, linear, angular);
  switch (r.moves) {
    case joint::revolute:
      angular.z += x[0];
      break;
    case joint::prismatic:
      linear.z += x[0];
      break;
    case joint::screw:
      linear.z += r.slides * x[0], angular.z += r.turns * x[0];
      break;
    case joint::several:
      if (r.axes == 6)  // a pose: all six, in order
        linear = linear + vec3{x[0], x[1], x[2]}, angular = angular + vec3{x[3], x[4], x[5]};
      else
        for (int k = 0; k < r.axes; ++k) component(linear, angular, r.axis[static_cast<std::size_t>(k)]) += x[k];
      break;
    case joint::varying:
      break;
  }
}
/// Calls put(k, power of a wrench on the unit rate of axis k of a joint) for its first `count` axes.
template <class P, class S, class Put>
KTE_INLINE void powers_along(const body_node<P>& r, const joint_transform<S>& at, const dense_wrench<S>& w, int count,
                             const Put& put) {
  if (r.moves == joint::varying) [[unlikely]] {
    for (int k = 0; k < count; ++k) put(k, engine::power(at.axis(k), w));
    return;
  }
  switch (r.moves) {
    case joint::revolute:
      put(0, w.torque.z);
      break;
    case joint::prismatic:
      put(0, w.force.z);
      break;
    case joint::screw:
      put(0, S(r.slides * w.force.z + r.turns * w.torque.z));
      break;
    case joint::several: {
      const std::array<S, 6> parts{w.force.x, w.force.y, w.force.z, w.torque.x, w.torque.y, w.torque.z};
      for (int k = 0; k < count; ++k) put(k, parts[r.axis[static_cast<std::size_t>(k)]]);
      break;
    }
    case joint::varying:
      break;
  }
}

}  // namespace kte::tree
