#pragma once

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

/// (1) for an axis given in the axes of the body.
template <class S, class Put>
void column_of_axis(int k, const world_axis<S>& s, const mat3<direction<S>>& units, const direction<S>& p,
                    const Put& put) {
  const direction<S> angular = combined(units, s.angular);
  put(k, direction<S>(combined(units, s.linear) + crossed<S>(angular, p)), angular);
}
/// put(k, velocity of a point, angular velocity) at the unit rate of each axis of a joint: with the point at p from the
/// origin of the body, and the axis s along or about a unit vector of the body,
///
///   put(k, s_v + s_w x p, s_w)          (1)
template <class P, class S, class Put>
KTE_INLINE void columns_of_joint(const body_node<P>& r, const joint_transform<S>& at, const mat3<direction<S>>& units,
                                 const direction<S>& p, const Put& put) {
  if (r.moves == joint::varying) [[unlikely]] {
    for (int k = 0; k < r.axes; ++k) column_of_axis<S>(r.first + k, at.axis(k), units, p, put);
    return;
  }
  const direction<S>& z = units.z;
  switch (r.moves) {
    case joint::revolute:
      put(r.first, crossed<S>(z, p), z);
      break;
    case joint::prismatic:
      put(r.first, z, direction<S>{});
      break;
    case joint::screw:
      put(r.first, direction<S>(r.slides * z + r.turns * crossed<S>(z, p)), direction<S>(r.turns * z));
      break;
    case joint::several: {
      const std::array<direction<S>, 3> all{units.x, units.y, z};
      for (int k = 0; k < r.axes; ++k) {
        const std::size_t n = r.axis[static_cast<std::size_t>(k)];
        if (n < 3)
          put(r.first + k, all[n], direction<S>{});
        else
          put(r.first + k, crossed<S>(all[n - 3], p), all[n - 3]);
      }
      break;
    }
    case joint::varying:
      break;
  }
}
/// Visits the joints from a frame to its base or `top`: visit(body node, its joint transform, the unit vectors of its
/// body, the vector from its origin to that of the frame), in the axes of the frame. Returns the slot, as
/// `pose_in_base`.
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
/// The columns of the Jacobian of a frame in its own axes, from the frame to its base or `top` (Siciliano et al.,
/// Robotics, 2009, section 3.1.3): put(k, v, w) as in (1). Returns the slot, as `pose_in_base`.
template <class P, class S, class N, class Put>
int jacobian_columns(const body_tree<P>& f, const memory<P, S>& m, const frame_place<N>& frame, dense_pose<S>& x,
                     const Put& put, int top = -1) {
  return each_joint_inward(
      f, m, frame, x,
      [&put](const body_node<P>& r, const joint_transform<S>& at, const mat3<direction<S>>& units,
             const direction<S>& p) KTE_INLINE_LAMBDA { columns_of_joint<P, S>(r, at, units, p, put); },
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
    columns_of_joint<P, S>(nodes[way[n]], joint_transforms[way[n]], x.units, p, put);
    p = p + x.step;
  }
}

/// The last body that carries both slots, which may be one of them; -1 if they have different bases.
template <class P>
int common_slot(const body_tree<P>& f, int a, int b) {
  while (a != b) {  // parents come first
    int& later = a > b ? a : b;
    if (later < f.bases) return -1;
    later = f.nodes[static_cast<std::size_t>(later - f.bases)].parent;
  }
  return a;
}

}  // namespace kte::tree
