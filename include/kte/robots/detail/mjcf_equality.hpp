#pragma once

#include <kte/robots/detail/free_names.hpp>
#include <kte/robots/detail/mjcf_tree.hpp>
#include <kte/robots/detail/polynomial.hpp>

#include <numeric>

namespace kte::detail {

/// The <equality> of a file in MJCF: <connect> and <weld> as closures, <joint> as a coordinate that follows another, or
/// as a closure where it cannot. They hold exactly, whatever solref and solimp say.
class mjcf_equality {
 public:
  explicit mjcf_equality(robot_description& d) : d_(d) {}

  /// Poses of links in the world where the file puts them.
  std::vector<robot_pose> stands{};

  /// Reads a <connect> or <weld>, after all bodies; a <joint> when all actuators are known (`finish`). Whether it is
  /// one of these.
  bool read(const xml_item& x, const mjcf_scope& in) {
    if (x.name() != "connect" && x.name() != "weld" && x.name() != "joint") return false;
    std::string ignored;
    for (const auto* of : {"solref", "solimp", "torquescale"})
      if (x.has(of)) ignored += std::string(ignored.empty() ? "" : ", ") + of;
    if (!ignored.empty()) x.warn("its " + ignored + " not read: the constraint is exact here, not soft");
    if (x.name() == "joint")
      joints_.push_back({x, in});
    else
      close(x, in);
    return true;
  }
  void finish() {
    for (std::size_t i = 0; i < d_.joints.size() && !joints_.empty(); ++i) numbers_.emplace(d_.joints[i].name, i);
    for (const auto& a : d_.actuators) driven_.insert(a.joint);
    leaders_.resize(d_.joints.size());
    std::iota(leaders_.begin(), leaders_.end(), std::size_t{0});
    for (const auto& j : joints_) couple(j.x, j.in);
  }

 private:
  using kind = robot_closure::kind;

  robot_closure begun(const xml_item& x, const mjcf_scope& in, const std::string& usual) {
    robot_closure c;
    c.line = x.line(), c.file = x.file();
    c.name = x.has("name") ? in.named(x.text("name")) : names_.fresh(usual);
    names_.take(c.name);
    return c;
  }
  std::size_t link(const xml_item& x, const mjcf_scope& in, const char* of) {
    const auto name = x.has(of) ? in.named(x.text(of)) : "world";
    if (name == in.named("world")) return 0;
    if (links_.empty())
      for (std::size_t i = 0; i < d_.links.size(); ++i) links_.emplace(d_.links[i].name, i);
    const auto known = links_.find(name);
    if (known == links_.end()) x.fail(std::string(of) + " '" + excerpt(x.text(of)) + "' is not a body");
    return known->second;
  }
  const robot_frame& site(const xml_item& x, const mjcf_scope& in, const char* of) {
    if (sites_.empty())
      for (const auto& f : d_.frames) sites_.emplace(f.name, &f);
    const auto known = sites_.find(in.named(x.text(of)));
    if (known == sites_.end()) x.fail(std::string(of) + " '" + excerpt(x.text(of)) + "' is not a site");
    return *known->second;
  }
  void close(const xml_item& x, const mjcf_scope& in) {
    const bool weld = x.name() == "weld";
    x.only({}, {"name", "class", "active", "body1", "body2", "anchor", weld ? "relpose" : "anchor", "site1", "site2",
                "solref", "solimp", weld ? "torquescale" : "anchor"});
    auto c = begun(x, in, weld ? "weld" : "connect");
    c.is = weld ? kind::frames : kind::points;
    if (x.has("site1") || x.has("site2")) {
      const auto &a = site(x, in, "site1"), &b = site(x, in, "site2");
      c.link1 = a.link, c.link2 = b.link, c.origin1 = a.origin, c.origin2 = b.origin;
      d_.closures.push_back(std::move(c));
      return;
    }
    if (!x.has("body1")) x.fail("has no body1");
    const auto a = link(x, in, "body1"), b = link(x, in, "body2");
    if (a == b) x.fail("body1 and body2 are the same body '" + excerpt(d_.links[a].name) + "'");
    c.link1 = d_.links[a].name, c.link2 = d_.links[b].name;
    const auto b_in_a = inverse_of(stands[a]) * stands[b];
    if (weld) {
      c.origin1 = relative_pose(x).value_or(b_in_a);
    } else {
      const bool global = in.model->settings.in_world();
      c.origin1.position =
          global ? (inverse_of(stands[a]) * robot_pose{x.vector("anchor")}).position : x.vector("anchor");
      c.origin2.position = (inverse_of(b_in_a) * c.origin1).position;
    }
    d_.closures.push_back(std::move(c));
  }
  /// The pose of body2 in body1; without one, or with a quaternion of length 0, that of the file.
  static std::optional<robot_pose> relative_pose(const xml_item& x) {
    if (!x.has("relpose")) return {};
    auto p = x.list("relpose");
    if (p.size() > 7) x.fail("relpose must have seven numbers, got " + std::to_string(p.size()));
    while (p.size() < 7) p.push_back(p.size() == 1 ? 1 : 0);  // as of the format's default
    const std::vector<double> q(p.begin() + 3, p.end());
    if (q == std::vector<double>(4)) return {};
    return robot_pose{{p[0], p[1], p[2]}, rotation_of_quaternion(x, q)};
  }

  robot_joint& joint(const xml_item& x, const mjcf_scope& in, const char* of) {
    const auto name = in.named(x.text(of));
    const auto known = numbers_.find(name);
    if (known == numbers_.end() || !has_one_coordinate(d_.joints[known->second]))
      x.fail(std::string(of) + " '" + excerpt(name) + "' is not a hinge or slide");
    return d_.joints[known->second];
  }
  std::size_t number_of(const robot_joint& j) const { return static_cast<std::size_t>(&j - d_.joints.data()); }
  /// Whether q_j can be k q_other + c: it follows none, no actuator drives it, and the other one does not follow it.
  bool can_follow(const robot_joint& j, const robot_joint& other) {
    auto leader = number_of(other);  // that follows none
    while (leaders_[leader] != leader) leader = leaders_[leader] = leaders_[leaders_[leader]];
    return !j.mimic && !driven_.contains(j.name) && leader != number_of(j);
  }
  void follow(robot_joint& j, const robot_joint& other, double ratio, double offset) {
    j.mimic = {other.name, ratio, offset}, leaders_[number_of(j)] = number_of(other);
  }
  /// q_1 - r_1 = c_0 + c_1 (q_2 - r_2) + ... + c_4 (q_2 - r_2)^4, with r the coordinates where the file puts the
  /// bodies.
  void couple(const xml_item& x, const mjcf_scope& in) {
    x.only({}, {"name", "class", "active", "joint1", "joint2", "polycoef", "solref", "solimp"});
    if (!x.has("joint1")) x.fail("has no joint1");
    auto& a = joint(x, in, "joint1");
    std::array<double, 5> p{0, 1, 0, 0, 0};
    if (x.has("polycoef")) {
      const auto all = x.list("polycoef");
      if (all.size() > p.size()) x.fail("polycoef has at most five numbers, got " + std::to_string(all.size()));
      std::copy(all.begin(), all.end(), p.begin());
    }
    if (!x.has("joint2")) return hold(x, a, a.reference + p[0]);
    auto& b = joint(x, in, "joint2");
    if (&a == &b) x.fail("joint1 and joint2 are the same joint '" + excerpt(a.name) + "'");
    p = of_linear(p, 1, -b.reference);
    p[0] += a.reference;
    const bool linear = p[2] == 0 && p[3] == 0 && p[4] == 0;
    if (linear && can_follow(a, b)) {
      follow(a, b, p[1], p[0]);
    } else if (linear && p[1] != 0 && can_follow(b, a)) {
      follow(b, a, 1 / p[1], -p[0] / p[1]);
    } else {
      auto c = begun(x, in, "joints");
      c.is = kind::joints, c.link1 = a.name, c.link2 = b.name, c.polynomial = p;
      d_.closures.push_back(std::move(c));
    }
  }
  /// A joint that stays at a coordinate is fixed there.
  void hold(const xml_item& x, robot_joint& j, double q) {
    x.not_read("joint '" + excerpt(j.name) + "' stays at " + number(q) + ": it is fixed");
    robot_pose at;
    if (j.is == robot_joint::kind::prismatic)
      at.position = q * j.axis;
    else
      at.rotation = without_minus_zero(as<double>(rotation_about(j.axis, std::cos(q), std::sin(q))));
    if (q != 0) j.child_pose = at * j.child_pose;
    j.is = robot_joint::kind::fixed, j.dynamics = {};
  }

  robot_description& d_;
  struct waiting {
    xml_item x;
    mjcf_scope in;
  };
  std::vector<waiting> joints_;
  free_names names_;                                              ///< of closures
  std::unordered_map<std::string, std::size_t> links_, numbers_;  ///< numbers of links and joints, by name
  std::unordered_map<std::string, const robot_frame*> sites_;
  std::unordered_set<std::string> driven_;  ///< joints with actuators
  std::vector<std::size_t> leaders_;        ///< by joint: one that it follows, directly or through others, or itself
};

}  // namespace kte::detail
