#pragma once

#include <kte/dynamics/configuration_space.hpp>
#include <kte/manipulators/detail/in_limits.hpp>
#include <kte/manipulators/detail/tool_pose.hpp>

namespace kte::detail {

/// Sets the pose of a free body such that its tool is at x: the coordinate is placement^-1 x tool^-1, projected into
/// the plane for planar bodies. Returns the remaining error.
template <class S, class Q>
pose_gap<S> place_free_body(const arm_geometry& arm, const plain_pose_of<S>& x, Q& q) {
  const auto scaled = [](const auto& y) { return plain_pose_of<S>{as<S>(y.rotation), as<S>(y.position)}; };
  const plain_pose_of<S> placement = scaled(arm.placement), tool = scaled(arm.tool);
  plain_pose_of<S> body = compose(inverse(placement), compose(x, inverse(tool)));
  auto& [R, p] = body;
  const int i = arm.in_q[0];
  if (arm.moves == arm_geometry::freely::in_plane) {
    const auto t = direction(S(R.x.x + R.y.y), S(R.y.x - R.x.y));
    q[i] = p.x, q[i + 1] = p.y, q[i + 2] = t.value();
    R = as<S>(rotation_about(vec3<S>{S(0), S(0), S(1)}, t.cos, t.sin)), p.z = S(0);
  } else {
    const auto turn = to_quaternion(R);
    put_vector(q, i, p), put_quaternion(q, i + 3, turn);
    R = as<S>(matrix(turn));
  }
  return gap_between(plain_pose_of<S>(compose(placement, compose(body, tool))), x);
}

/// Whether the position is within limits, and in the plane also the angle, after adding whole turns.
template <class Limits, class Start, class Q>
bool free_body_within(const arm_geometry& arm, const Limits& limits, const Start& start, Q& q) {
  const bool flat = arm.moves == arm_geometry::freely::in_plane;
  bool inside = true;
  for (int k = 0; k < 3; ++k) {
    const auto v = static_cast<std::size_t>(arm.in_v[0] + k);
    const Eigen::Index i = arm.in_q[0] + k;
    inside &= bring_within(limits.lower[v], limits.upper[v], !(flat && k == 2), start[i], q[i]);
  }
  return inside;
}

}  // namespace kte::detail
