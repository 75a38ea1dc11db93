#pragma once

#include <kte/detail/compiled.hpp>
#include <kte/robots/robot.hpp>

namespace kte {

/// The inverse of `to_robot`: the links and joints of a chain. Throws `bad_argument`, naming the element, for elements
/// that are neither: springs between frames, rotors, motors, elements in the plane, a coordinate of two joints.
/// Properties without a field in the description, such as the smoothing of friction, are listed in its `not_read`.
[[nodiscard]] robot_description describe(const runtime_chain& chain, const std::string& name = "robot");
/// The links and joints of a robot, with limits and shapes. Throws `bad_parameter` for limits that do not fit the chain
/// (`check_limits`). Limits of acceleration and jerk, and those of coordinates of several numbers, are listed in
/// `not_read`.
[[nodiscard]] robot_description describe(const robot& r);

}  // namespace kte

#ifdef KTE_FUNCTION
#  include <kte/robots/detail/chain_reader.hpp>
#  include <kte/robots/detail/shape_names.hpp>

#  include <string_view>
#  include <unordered_map>

namespace kte {
KTE_FUNCTION robot_description describe(const runtime_chain& chain, const std::string& name) {
  return detail::chain_reader(chain, name).read();
}
KTE_FUNCTION robot_description describe(const robot& r) {
  auto d = describe(r.chain, r.name);
  check_limits(r.chain, r.limits), check_limits(r.chain, r.soft_limits);
  const auto& hard = r.limits;
  std::unordered_map<std::string_view, robot_joint*> joints;
  for (auto& j : d.joints) joints.emplace(j.name, &j);
  for (const auto& e : layout(r.chain)) {
    const auto no_place = [&](const std::string& what) {
      d.not_read.push_back({0, "coordinate '" + e.name + "': a description has no " + what});
    };
    const auto limited = [&](const std::vector<double>& list, int i) {
      return std::isfinite(list[static_cast<std::size_t>(i)]);
    };
    bool of_several = false, rates = false;
    for (int i = e.v; i < e.v + e.nv; ++i) {
      rates |= limited(hard.acceleration, i) || limited(hard.jerk, i);
      if (e.nv == 1) continue;
      for (const auto* list : {&hard.lower, &hard.upper, &hard.rate, &hard.effort}) of_several |= limited(*list, i);
    }
    if (rates) no_place("limits of acceleration and jerk");
    if (of_several) no_place("limits of coordinates of several numbers");
    const auto known = joints.find(e.name);
    if (known == joints.end() || e.nv != 1) continue;
    auto& j = *known->second;
    const auto i = static_cast<std::size_t>(e.v);
    j.lower = hard.lower[i], j.upper = hard.upper[i];
    j.rate = hard.rate[i], j.effort = hard.effort[i];
    j.soft_lower = r.soft_limits.lower[i], j.soft_upper = r.soft_limits.upper[i];
    j.continuous = j.continuous && j.lower == -robot_joint::none && j.upper == robot_joint::none;
  }
  detail::shape_names names;
  for (const auto& s : r.shapes) names.add(s.frame, s, s.collision);
  std::unordered_map<std::string_view, robot_link*> links;
  for (auto& l : d.links) links.emplace(l.name, &l);
  for (const auto& s : r.shapes) {
    if (const auto known = links.find(s.frame); known != links.end())
      (s.collision ? known->second->collisions : known->second->visuals).push_back(s);
    else
      d.not_read.push_back({s.line, names.of(s) + " is in frame '" + s.frame + "', which is not a link"});
  }
  d.actuators = r.actuators;
  return d;
}
}  // namespace kte
#endif
