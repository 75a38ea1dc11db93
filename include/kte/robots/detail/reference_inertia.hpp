#pragma once

#include <kte/robots/detail/robot_tree.hpp>

namespace kte::detail {

/// What moves at coordinate q: of a joint that has one, the pose of its end in its seat.
inline robot_pose joint_motion_at(const robot_joint& j, double q) {
  if (j.is == robot_joint::kind::prismatic) return {q * j.axis, robot_pose{}.rotation};
  if (j.is != robot_joint::kind::revolute || q == 0) return {};
  return {{}, as<double>(rotation_about(j.axis, std::cos(q), std::sin(q)))};
}

/// The inertia that a joint of one coordinate feels where the robot stands as the file writes it, kg m^2 or kg: of the
/// bodies b that it moves, with masses m, centres of mass c and inertias I about them, and its axis n through p
///
///   turning  J = sum n . I n + m |n x (c - p)|^2,   sliding  J = sum m          (1)
///
/// and of its rotor. It is the joint's entry on the diagonal of the mass matrix.
inline double reference_inertia(const robot_description& d, const robot_tree& tree, std::size_t which) {
  const auto& joint = d.joints[which];
  std::vector<robot_pose> at(d.links.size());  // in the seat of the joint
  std::vector<char> moved(d.links.size(), 0);
  double sum = joint.dynamics.armature;
  for (const auto& s : tree.steps()) {
    const auto& j = d.joints[s.joint];
    const auto to = tree.link(j.child), from = tree.link(j.parent);
    if (s.joint != which && !moved[from]) continue;
    moved[to] = 1;
    const auto seat = s.joint == which ? robot_pose{} : at[from] * j.origin;
    at[to] = seat * joint_motion_at(j, j.reference) * j.child_pose;
    if (!d.links[to].inertial) continue;
    const auto b = moved_body(at[to], *d.links[to].inertial);
    const auto across = cross(joint.axis, b.com);
    sum += joint.is == robot_joint::kind::prismatic
               ? b.mass
               : dot(joint.axis, b.inertia * joint.axis) + b.mass * dot(across, across);
  }
  return sum;  // (1)
}

}  // namespace kte::detail
