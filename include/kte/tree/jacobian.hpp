#pragma once

#include <kte/recursions/jacobian.hpp>
#include <kte/tree/bodies.hpp>
#include <kte/tree/direction.hpp>
#include <kte/tree/placement.hpp>

namespace kte::tree {

/// The pose of a frame in its base, or in the body of slot `top` if that carries it. Returns the slot. Reads only the
/// body nodes on the path.
template <class P, class S>
int pose_in_base(const body_tree<P>& f, const memory<P, S>& m, const frame_place<P>& frame, dense_pose<S>& x,
                 int top = -1) {
  mat3<vec3<S>> rotation = as<S>(frame.at.rotation);
  vec3<S> p = as<S>(frame.at.position);
  int slot = frame.slot;
  while (slot >= f.bases && slot != top) {
    const auto i = static_cast<std::size_t>(slot - f.bases);
    const placed at{f.nodes[i], m.joint_transforms[i]};
    rotation = at.units_out(rotation), p = at.at.position + at.out(p);
    slot = f.nodes[i].parent;
  }
  x = {rotation, p};
  return slot;
}

/// put(k, velocity, angular velocity) for each axis k of a joint: (1) of recursions/jacobian.hpp. `units`: the unit
/// vectors of its body, as rows; p: from its origin to that of the frame; both in axes of the columns.
template <class P, class S, class Put>
KTE_INLINE void columns_of_joint(const body_node<P>& r, const joint_transform<S>& at, const mat3<direction<S>>& units,
                                 const direction<S>& p, const Put& put) {
  const auto put_axis = [&](int k, const mat3<direction<S>>& axes, const auto& s) KTE_INLINE_LAMBDA {
    const auto column = engine::jacobian_column(rotation_of_units<direction<S>>{axes}, p, s);
    put(k, direction_of<S>(column.linear), direction_of<S>(column.angular));
  };
  if (r.moves == joint::revolute) [[likely]]
    return put_axis(r.first, units, about_z::axis<0>(r));
  switch (r.moves) {
    case joint::revolute:
      break;
    case joint::prismatic:
      put_axis(r.first, units, along_z::axis<0>(r));
      break;
    case joint::screw:
      put_axis(r.first, units, along_and_about_z::axis<0>(r));
      break;
    case joint::several: {  // unit axes by number, each as z
      const std::array<direction<S>, 3> unit{units.x, units.y, units.z};
      for (int k = 0; k < r.axes; ++k) {
        const std::size_t n = r.axis[static_cast<std::size_t>(k)];
        if (n < 3)
          put_axis(r.first + k, {unit[0], unit[1], unit[n]}, along_z::axis<0>(r));
        else
          put_axis(r.first + k, {unit[0], unit[1], unit[n - 3]}, about_z::axis<0>(r));
      }
      break;
    }
    case joint::varying:
      for (int k = 0; k < r.axes; ++k)
        put_axis(r.first + k, units, engine::motion_vector{at.axis(k).linear, at.axis(k).angular});
      break;
  }
}
/// Visits the joints from a frame to its base or `top`: visit(body node, its joint transform, units, p), as in
/// `columns_of_joint`, in axes of the frame. Returns the slot, as `pose_in_base`.
template <class P, class S, class N, class Visit>
KTE_INLINE int each_joint_inward(const body_tree<P>& f, const memory<P, S>& m, const frame_place<N>& frame,
                                 dense_pose<S>& x, const Visit& visit, int top = -1) {
  mat3<direction<S>> units = directions_of<S>(as<S>(frame.at.rotation));
  direction<S> p = combined(units, as<S>(frame.at.position));
  int slot = frame.slot;
  while (slot >= f.bases && slot != top) {
    const auto i = static_cast<std::size_t>(slot - f.bases);
    const body_node<P>& r = f.nodes[i];
    const placed at{r, m.joint_transforms[i]};
    visit(r, m.joint_transforms[i], units, p);
    units = at.units_out(units), p = p + combined(units, at.at.position);
    slot = r.parent;
  }
  x.rotation = components<S>(units), x.position = x.rotation * components<S>(p);
  return slot;
}
/// The columns of the Jacobian of a frame in its own axes, from the frame to its base or `top`: put(k, v, w). Returns
/// the slot, as `pose_in_base`.
template <class P, class S, class N, class Put>
int jacobian_columns(const body_tree<P>& f, const memory<P, S>& m, const frame_place<N>& frame, dense_pose<S>& x,
                     const Put& put, int top = -1) {
  return each_joint_inward(
      f, m, frame, x,
      [&put](const body_node<P>& r, const joint_transform<S>& at, const mat3<direction<S>>& units,
             const direction<S>& p) KTE_INLINE_LAMBDA { columns_of_joint(r, at, units, p, put); },
      top);
}
/// The columns of the Jacobian of a frame in world axes, for all joints from the frame to its base. Bodies are placed
/// outward, columns are computed inward. `base`: the axes of the base.
template <class P, class S, class Put>
void jacobian_columns_in_world(const body_tree<P>& f, memory<P, S>& m, const frame_place<P>& frame,
                               std::span<const int> way, const mat3<vec3<S>>& base, const Put& put) {
  // Local copies: the compiler cannot exclude that `put` writes to the vectors.
  const body_node<P>* const nodes = f.nodes.data();
  const joint_transform<S>* const joint_transforms = m.joint_transforms.data();
  seen_body<S>* const seen = m.seen.data();
  mat3<direction<S>> units = directions_of<S>(transpose(base));
  for (std::size_t n = way.size(); n-- > 0;) {
    const int i = way[n];
    const placed at{nodes[i], joint_transforms[i]};
    seen_body<S>& x = seen[n];
    x.step = combined(units, at.at.position);
    units = at.units_in(units);
    x.units = units;
  }
  direction<S> p = combined(units, as<S>(frame.at.position));
  for (std::size_t n = 0; n < way.size(); ++n) {
    const seen_body<S>& x = seen[n];
    columns_of_joint(nodes[way[n]], joint_transforms[way[n]], x.units, p, put);
    p = p + x.step;
  }
}

}  // namespace kte::tree
