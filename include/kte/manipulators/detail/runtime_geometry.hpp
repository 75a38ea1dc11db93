#pragma once

#include <kte/dynamics/forward_kinematics.hpp>
#include <kte/dynamics/frame_motion.hpp>
#include <kte/dynamics/jacobian.hpp>
#include <kte/manipulators/detail/arm_geometry.hpp>
#include <kte/runtime_chain.hpp>

#include <string>

namespace kte::detail {

/// The joints between the base and a frame of a runtime chain whose state has coordinates zero. Their order and
/// coordinates are those of the body nodes, the axes come from the Jacobian at zero. A revolute joint has the column
/// (v, w); with the origin of the frame at p, v = w x (p - o) for any o on its axis. The o closest to p is
///
///   o = p + w x v          (1)
arm_geometry geometry_of(const runtime_chain& c, runtime_state& s, const std::string& frame);

}  // namespace kte::detail

#ifdef KTE_FUNCTION
namespace kte::detail {

KTE_FUNCTION arm_geometry geometry_of(const runtime_chain& c, runtime_state& s, const std::string& frame) {
  arm_geometry arm;
  const auto x = find_frame(c, frame);
  const auto& body_tree = s.tree().body_tree;
  const auto& place = body_tree.frame(x.what, x.index);
  if (s.tree().moves_unknown || place.slot < 0) {
    arm.refused = "has an element that is neither joint nor link between base and tool";
    return arm;
  }
  std::vector<int> columns;
  for (int slot = place.slot; slot >= body_tree.bases;) {
    const auto& r = body_tree.nodes[static_cast<std::size_t>(slot - body_tree.bases)];
    const bool is_free = r.is_free && (r.what == kind::pose_2D || r.what == kind::pose_3D);
    if (is_free && slot == place.slot && r.parent < body_tree.bases)
      arm.moves = r.what == kind::pose_2D ? arm_geometry::freely::in_plane : arm_geometry::freely::in_space;
    else if (r.moves == tree::joint::varying)
      arm.refused = "has a joint with axes that depend on its coordinates";
    else if (r.axes != 1)
      arm.refused = "has a joint of several degrees of freedom";
    else if (!r.is_free)
      arm.refused = "has a joint whose coordinate is given, or follows others";
    else if (r.moves == tree::joint::screw)
      arm.refused = "has a screw joint";
    columns.insert(columns.begin(), body_tree.row[static_cast<std::size_t>(r.first)]);
    slot = r.parent;
  }
  if (arm.refused != nullptr) return arm;
  arm.tool = forward_kinematics(c, s, frame);
  if (arm.moves != arm_geometry::freely::not_at_all) {
    const auto on_body = place.at;
    arm.placement = compose(arm.tool, inverse(on_body)), arm.tool = on_body;
    for (const auto& f : c.wiring().free)
      if (f.v == columns[0]) arm.in_q[0] = f.q, arm.in_v[0] = f.v;
    return arm;
  }
  const auto j = jacobian(c, s, frame, in_world_axes);
  for (const int k : columns) {
    const vec3<> v{j(0, k), j(1, k), j(2, k)}, w{j(3, k), j(4, k), j(5, k)};
    const bool slides = dot(w, w) == 0;
    int q = 0;
    for (const auto& f : c.wiring().free)
      if (f.v == k) q = f.q;
    arm.add(slides ? v : w, slides ? arm.tool.position : vec3<>(arm.tool.position + cross(w, v)), slides, q, k);
  }
  for (std::size_t i = 0; i < columns.size(); ++i)
    for (std::size_t k = 0; k < i; ++k)
      if (columns[i] == columns[k]) arm.refused = "has joints that share a coordinate";
  return arm;
}

}  // namespace kte::detail
#endif
