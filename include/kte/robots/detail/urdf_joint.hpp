#pragma once

#include <kte/robots/detail/free_names.hpp>
#include <kte/robots/detail/urdf_link.hpp>

namespace kte::detail {

/// Reads the joints of a URDF.
class urdf_joints {
 public:
  urdf_joints(robot_description& d, const urdf_links& links) : d_(d), links_(links) {}

  /// Reads a <joint>, or a <drake:joint>, which has further types.
  void read(const xml_item& x) {
    look_for_interruption();
    robot_joint j;
    j.name = x.text("name"), j.line = x.line(), j.file = x.file();
    x.only({"parent", "child", "origin", "axis", "limit", "dynamics", "mimic", "safety_controller",
            "drake:screw_thread_pitch", "joint_properties", "drake:mimic"},
           {"name", "type"});
    j.parent = x.needed_child("parent").text("link");
    j.child = x.needed_child("child").text("link");
    j.origin = links_.origin(x);
    const bool universal = type(x, j);
    if (const auto a = first_child(x, "axis"); a && (has_one_coordinate(j) || j.is == kind::planar) && !universal)
      j.axis = unit_axis(*a, a->vector("xyz"));
    limits(x, j);
    dynamics(x, j);
    for (const auto& m : x.children("drake:mimic")) m.moves_differently("not read");
    if (const auto m = x.child("mimic")) mimic(*m, j, universal);
    if (universal) return cross(std::move(j));
    d_.joints.push_back(std::move(j));
  }

 private:
  using kind = robot_joint::kind;

  /// Sets the type of the joint; returns whether it is universal.
  static bool type(const xml_item& x, robot_joint& j) {
    static const std::map<std::string, kind, std::less<>> types{
        {"revolute", kind::revolute},   {"continuous", kind::revolute}, {"prismatic", kind::prismatic},
        {"fixed", kind::fixed},         {"floating", kind::floating},   {"planar", kind::planar},
        {"spherical", kind::spherical}, {"ball", kind::spherical},      {"universal", kind::revolute},
        {"screw", kind::screw}};
    const auto t = x.text("type");
    const auto known = types.find(t);
    if (known == types.end())
      x.fail(
          "type '" + excerpt(t) +
          "' is none of revolute, continuous, prismatic, fixed, floating, planar, spherical, ball, universal, screw");
    j.is = known->second, j.continuous = t == "continuous";
    if (j.is == kind::screw)  // metres per turn
      j.pitch = x.needed_child("drake:screw_thread_pitch").number("value") / (2 * std::numbers::pi);
    return t == "universal";
  }
  /// Adds a universal joint: rotations about x and then about y of the placement.
  void cross(robot_joint j) {
    auto second = j;
    if (names_.empty())
      for (const auto& l : d_.links) names_.take(l.name);
    auto& middle = d_.links.emplace_back();
    middle.name = names_.fresh(j.child + ".cross"), middle.line = j.line, middle.file = j.file;
    j.child = second.parent = middle.name;
    second.name += "_2", second.origin = {};
    j.axis = {1, 0, 0}, second.axis = {0, 1, 0};
    d_.joints.push_back(std::move(j)), d_.joints.push_back(std::move(second));
  }

  static void limits(const xml_item& x, robot_joint& j) {
    const auto l = x.child("limit");
    const bool one = has_one_coordinate(j), bounded = one && !j.continuous;
    if (!l && (j.is == kind::revolute || j.is == kind::prismatic) && bounded && x.text("type") != "universal")
      x.warn("has no <limit>, which joints of type " + x.text("type") + " need: it has no limits");
    if (l && one) {
      l->only({}, {"lower", "upper", "effort", "velocity"});
      j.effort = most(*l, "effort"), j.rate = most(*l, "velocity");
      if (bounded && (l->has("lower") || l->has("upper") || j.is != kind::screw)) {
        j.lower = l->has("lower") ? l->limit("lower") : 0, j.upper = l->has("upper") ? l->limit("upper") : 0;
      } else if (!bounded && (l->has("lower") || l->has("upper"))) {
        l->not_read("a continuous joint has no lower and upper limits");
      }
      if (j.lower > j.upper) {
        l->warn("lower " + number(j.lower) + " is above upper " + number(j.upper) + "; they are exchanged");
        std::swap(j.lower, j.upper);
      }
    }
    if (l && !one && j.is != kind::fixed) l->not_read("not read: only joints with one coordinate have limits");
    j.soft_lower = j.lower, j.soft_upper = j.upper;
    if (const auto s = x.child("safety_controller")) {
      s->only({}, {"soft_lower_limit", "soft_upper_limit"});
      if (!bounded) return;
      // a controller with gains only has no range: the default of the format, 0, would lock the joint
      if (s->has("soft_lower_limit")) j.soft_lower = s->limit("soft_lower_limit");
      if (s->has("soft_upper_limit")) j.soft_upper = s->limit("soft_upper_limit");
      check_range(*s, j.soft_lower, j.soft_upper, "soft_lower_limit", "soft_upper_limit");
    }
  }
  /// An effort or a rate: files often write -1 for "no limit".
  static double most(const xml_item& l, const char* what) {
    if (!l.has(what)) {
      l.warn(std::string("has no ") + what + ": it has no limit");
      return robot_joint::none;
    }
    const double x = l.limit(what);
    if (x >= 0) return x;
    l.warn(std::string(what) + " " + number(x) + " is negative: it has no limit");
    return robot_joint::none;
  }

  static void dynamics(const xml_item& x, robot_joint& j) {
    for (const auto& p : x.children("joint_properties"))
      p.moves_differently("not read, as URDF has no such element: its place is <dynamics>");
    const auto y = x.child("dynamics");
    if (!y) return;
    for (const auto& [attribute, value] : y->node().attributes)
      if (attribute != "damping" && attribute != "friction")
        y->moves_differently("its " + excerpt(attribute) + " is not read");
    if (j.is == kind::planar && y->has("damping") && y->list("damping").size() == 3)
      return y->moves_differently("its damping of three numbers is not read: planar joints have none");
    j.dynamics.damping = y->not_negative_or("damping", 0);
    j.dynamics.friction = y->not_negative_or("friction", 0);
  }
  static void mimic(const xml_item& m, robot_joint& j, bool universal) {
    m.only({}, {"joint", "multiplier", "offset"});
    if (j.is == kind::fixed) return m.not_read("a fixed joint cannot follow another");
    if (!has_one_coordinate(j) || universal)
      m.fail("only revolute, continuous, prismatic and screw joints can follow another");
    j.mimic = {m.text("joint"), m.number_or("multiplier", 1), m.number_or("offset", 0)};
  }

  robot_description& d_;
  const urdf_links& links_;
  free_names names_;  ///< of links, where a joint needs another one
};

}  // namespace kte::detail
