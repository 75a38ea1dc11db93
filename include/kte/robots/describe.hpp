#pragma once

#include <kte/detail/compiled.hpp>
#include <kte/robots/robot.hpp>

namespace kte {

/// The reverse of `to_robot`: what a chain is as links and joints. Throws `bad_argument`, with the element, for what is
/// neither: springs between frames, screws, rotors, motors, what is in the plane, a coordinate of two joints.
robot_description describe(const kte_map_chain& chain, const std::string& name = "robot");
/// The same with limits and shapes.
robot_description describe(const robot& r);

}  // namespace kte

#ifdef KTE_FUNCTION
#  include <kte/robots/detail/chain_reader.hpp>

namespace kte {
KTE_FUNCTION robot_description describe(const kte_map_chain& chain, const std::string& name) {
  return detail::chain_reader(chain, name).read();
}
KTE_FUNCTION robot_description describe(const robot& r) {
  auto d = describe(r.chain, r.name);
  for (auto& j : d.joints)
    for (const auto& e : layout(r.chain)) {
      if (e.name != j.name || e.nv != 1) continue;
      const auto i = static_cast<std::size_t>(e.v);
      j.lower = r.limits.lower[i], j.upper = r.limits.upper[i];
      j.rate = r.limits.rate[i], j.effort = r.limits.effort[i];
      j.soft_lower = r.soft_limits.lower[i], j.soft_upper = r.soft_limits.upper[i];
      j.continuous = j.continuous && j.lower == -robot_joint::none && j.upper == robot_joint::none;
    }
  for (const auto& s : r.shapes)
    for (auto& l : d.links)
      if (l.name == s.frame) (s.collision ? l.collisions : l.visuals).push_back(s);
  d.actuators = r.actuators;
  return d;
}
}  // namespace kte
#endif
