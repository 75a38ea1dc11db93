#pragma once

#include <kte/tree/placement.hpp>

namespace kte::tree {

/// The pose of a frame in its base, or in the body of slot `top` where it stands on that; the slot is returned. Only
/// the records on the way are read.
template <class P, class S>
int pose_in_base(const forest<P>& f, const memory<P, S>& m, const frame_place<P>& frame, dense_pose<S>& x,
                 int top = -1) {
  mat3<vec3<S>> rotation = as<S>(frame.at.rotation);
  vec3<S> p = as<S>(frame.at.position);
  int slot = frame.slot;
  while (slot >= f.bases && slot != top) {
    const auto i = static_cast<std::size_t>(slot - f.bases);
    const placed at{f.records[i], m.spots[i]};
    rotation = at.columns_out(rotation), p = at.at.position + at.out(p);
    slot = f.records[i].parent;
  }
  x = {rotation, p};
  return slot;
}

/// The columns of the Jacobian of a frame in its own axes, from the frame to its base or `top`: with the frame at R, p
/// in a body whose joint has the axis s (Siciliano et al., Robotics, 2009, section 3.1.3),
///
///   put(k, R^T (s_v + s_w x p), R^T s_w)          (1)
///
/// Returns as `pose_in_base`.
template <class P, class S, class N, class Put>
int jacobian_columns(const forest<P>& f, const memory<P, S>& m, const frame_place<N>& frame, dense_pose<S>& x,
                     const Put& put, int top = -1) {
  mat3<vec3<S>> rotation = as<S>(frame.at.rotation);
  vec3<S> p = as<S>(frame.at.position);
  int slot = frame.slot;
  while (slot >= f.bases && slot != top) {
    const auto i = static_cast<std::size_t>(slot - f.bases);
    const record<P>& r = f.records[i];
    const placed at{r, m.spots[i]};
    const auto &x_row = rotation.x, &y_row = rotation.y, &z_row = rotation.z;  // unit vectors of the body
    const vec3<S> turn = p.x * y_row - p.y * x_row;
    switch (r.moves) {
      case joint::revolute:
        put(r.first, turn, z_row);
        break;
      case joint::prismatic:
        put(r.first, z_row, vec3<S>{});
        break;
      case joint::screw:
        put(r.first, vec3<S>(r.slides * z_row + r.turns * turn), vec3<S>(r.turns * z_row));
        break;
      case joint::several: {
        const std::array<vec3<S>, 3> unit{x_row, y_row, z_row},
            turns{vec3<S>(p.y * z_row - p.z * y_row), vec3<S>(p.z * x_row - p.x * z_row), turn};
        for (int k = 0; k < r.axes; ++k) {
          const std::size_t n = r.axis[static_cast<std::size_t>(k)];
          if (n < 3)
            put(r.first + k, unit[n], vec3<S>{});
          else
            put(r.first + k, turns[n - 3], unit[n - 3]);
        }
      }
    }
    rotation = at.columns_out(rotation), p = at.at.position + at.out(p);
    slot = r.parent;
  }
  x = {rotation, p};
  return slot;
}

/// The last body that two slots stand on, which may be one of them; -1 where they have different bases.
template <class P>
int common_slot(const forest<P>& f, int a, int b) {
  while (a != b) {  // parents come first
    int& later = a > b ? a : b;
    if (later < f.bases) return -1;
    later = f.records[static_cast<std::size_t>(later - f.bases)].parent;
  }
  return a;
}

}  // namespace kte::tree
