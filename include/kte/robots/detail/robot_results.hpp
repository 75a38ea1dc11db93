#pragma once

#include <kte/dynamics/configuration_space.hpp>
#include <kte/robots/detail/no_limit.hpp>
#include <kte/robots/detail/robot_tree.hpp>
#include <kte/robots/robot.hpp>
#include <kte/runtime_chain.hpp>
#include <kte/runtime_chain/layout.hpp>

#include <algorithm>

/// The data of a robot beyond its chain.
namespace kte::detail {

inline void list_joints(robot& r, const robot_description& d) {
  for (const auto& j : d.joints)
    if (j.is != robot_joint::kind::fixed) r.joints.push_back(j.name);
}
inline void list_shapes(robot& r, const robot_description& d) {
  for (const auto& l : d.links) {
    for (const auto& v : l.visuals) r.shapes.push_back({v, l.name, false, l.file});
    for (const auto& c : l.collisions) r.shapes.push_back({c, l.name, true, l.file});
  }
}
/// What a joint may do (robot_joint).
struct joint_range {
  double lower, upper, soft_lower, soft_upper, rate, effort;
};
/// Takes the ranges and rates of followers back to the joints that they follow: q = k q_leader + c is in [a, b] where
/// q_leader is in [(a - c)/k, (b - c)/k], for negative k with the ends exchanged.
inline std::vector<joint_range> with_ranges_of_followers(const robot_description& d, const robot_tree& tree) {
  constexpr auto nowhere = ~std::size_t{0};
  struct line {
    std::size_t leader = nowhere;
    double k = 1, c = 0;
  };
  std::vector<line> lines(d.joints.size());
  std::vector<joint_range> all;
  all.reserve(d.joints.size());
  for (const auto& j : d.joints) all.push_back({j.lower, j.upper, j.soft_lower, j.soft_upper, j.rate, j.effort});
  for (std::size_t i = 0; i < d.joints.size(); ++i) {
    std::vector<std::size_t> way;  // of followers whose leader is not known yet
    for (std::size_t at = i; lines[at].leader == nowhere;)
      if (const auto& m = d.joints[at].mimic)
        way.push_back(at), at = tree.joint(m->joint);
      else
        lines[at].leader = at;
    for (; !way.empty(); way.pop_back()) {
      const auto& m = *d.joints[way.back()].mimic;
      const auto& before = lines[tree.joint(m.joint)];
      lines[way.back()] = {before.leader, m.ratio * before.k, m.ratio * before.c + m.offset};
    }
    const auto& j = d.joints[i];
    const auto [leader, k, c] = lines[i];
    if (leader == i || k == 0) continue;
    auto& to = all[leader];
    const auto narrow = [k = k, c = c](double a, double b, double& lower, double& upper) {
      a = (limit_from_file(a) - c) / k, b = (limit_from_file(b) - c) / k;
      lower = (std::max)(lower, (std::min)(a, b)), upper = (std::min)(upper, (std::max)(a, b));
    };
    narrow(j.lower, j.upper, to.lower, to.upper);
    narrow(j.soft_lower, j.soft_upper, to.soft_lower, to.soft_upper);
    to.rate = (std::min)(to.rate, limit_from_file(j.rate) / std::abs(k));
  }
  return all;
}
inline void read_limits(robot& r, const robot_description& d, const robot_tree& tree) {
  auto& hard = r.limits;
  hard = unlimited(r.chain);
  auto soft = hard;
  const auto joints = with_ranges_of_followers(d, tree);
  for (const auto& e : layout(r.chain)) {
    if (e.what != kind::gen) continue;
    const auto& j = joints[tree.joint(e.name)];
    const auto i = static_cast<std::size_t>(e.v);
    hard.lower[i] = limit_from_file(j.lower), hard.upper[i] = limit_from_file(j.upper);
    hard.rate[i] = limit_from_file(j.rate), hard.effort[i] = limit_from_file(j.effort);
    soft.lower[i] = (std::max)(hard.lower[i], limit_from_file(j.soft_lower));
    soft.upper[i] = (std::min)(hard.upper[i], limit_from_file(j.soft_upper));
  }
  r.soft_limits = hard;
  r.soft_limits.lower = soft.lower, r.soft_limits.upper = soft.upper;
}
inline void read_configurations(robot& r, const robot_description& d) {
  if (d.configurations.empty()) return;
  std::unordered_map<std::string, layout_entry<std::string>> places;
  for (const auto& e : layout(r.chain)) places.emplace(e.name, e);
  for (const auto& c : d.configurations) {
    auto& made = r.configurations.emplace_back();
    const auto q = neutral_configuration(r.chain);
    made.name = c.name, made.q.assign(q.data(), q.data() + q.size());
    for (const auto& [joint, numbers] : c.joints) {
      const auto e = places.find(joint);
      if (e == places.end()) continue;  // a follower, or fixed
      if (static_cast<int>(numbers.size()) != e->second.nq)
        raise<bad_file>("kte: " + place_text(d.source, c.line) + "configuration '" + c.name + "': joint '" + joint +
                        "' has " + std::to_string(e->second.nq) + " numbers, got " + std::to_string(numbers.size()));
      std::copy(numbers.begin(), numbers.end(), made.q.begin() + e->second.q);
    }
  }
}
/// Orders the warnings, differences in motion first, or throws for these if `strict`.
inline void judge(robot& r, const robot_description& d, bool strict) {
  auto& all = r.warnings;
  const auto differs = [](const robot_note& n) { return n.changes_motion; };
  const auto end = std::stable_partition(all.begin(), all.end(), differs);
  if (!strict || end == all.begin()) return;
  std::string why;
  for (auto n = all.begin(); n != end; ++n)
    why += "\n  " + place_text(n->file.empty() ? d.source : n->file, n->line) + n->text;
  raise<bad_file>("kte: the robot '" + d.name + "' would move differently from that of its file:" + why);
}

}  // namespace kte::detail
