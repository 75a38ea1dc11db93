#pragma once

#include <kte/tree/placement.hpp>

namespace kte::tree {

/// The pose of a frame in its base, which is returned as a slot. Only the records on the way are read.
template <class P, class S>
int pose_in_base(const forest<P>& f, const memory<P, S>& m, const frame_place<P>& frame, dense_pose<S>& x) {
  mat3<vec3<S>> rotation = as<S>(frame.at.rotation);
  vec3<S> p = as<S>(frame.at.position);
  int slot = frame.slot;
  while (slot >= f.bases) {
    const auto i = static_cast<std::size_t>(slot - f.bases);
    const placed at{f.records[i], m.spots[i]};
    rotation = at.columns_out(rotation), p = at.at.position + at.out(p);
    slot = f.records[i].parent;
  }
  x = {rotation, p};
  return slot;
}

/// The columns of the Jacobian of a frame in its own axes, from the frame to its base: with the frame at R, p in a body
/// whose joint has the axis s (Siciliano et al., Robotics, 2009, section 3.1.3),
///
///   put(k, R^T (s_v + s_w x p), R^T s_w)          (1)
///
/// Returns as `pose_in_base`.
template <class P, class S, class Put>
int jacobian_columns(const forest<P>& f, const memory<P, S>& m, const frame_place<P>& frame, dense_pose<S>& x,
                     const Put& put) {
  mat3<vec3<S>> rotation = as<S>(frame.at.rotation);
  vec3<S> p = as<S>(frame.at.position);
  int slot = frame.slot;
  while (slot >= f.bases) {
    const auto i = static_cast<std::size_t>(slot - f.bases);
    const record<P>& r = f.records[i];
    const placed at{r, m.spots[i]};
    if (r.moves == joint::revolute) {
      put(r.first, vec3<S>(p.x * rotation.y - p.y * rotation.x), rotation.z);
    } else {
      const mat3<vec3<S>> t = transpose(rotation);
      for (int k = 0; k < r.axes; ++k) {
        std::array<S, 6> one{};
        one[static_cast<std::size_t>(k)] = S(1);
        vec3<S> v{}, w{};
        along_axes(r, one.data(), v, w);
        put(r.first + k, vec3<S>(t * (v + cross(w, p))), vec3<S>(t * w));
      }
    }
    rotation = at.columns_out(rotation), p = at.at.position + at.out(p);
    slot = r.parent;
  }
  x = {rotation, p};
  return slot;
}

}  // namespace kte::tree
