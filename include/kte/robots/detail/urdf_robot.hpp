#pragma once

#include <kte/robots/detail/urdf_joint.hpp>
#include <kte/robots/detail/urdf_loop.hpp>

namespace kte::detail {

/// Reads a URDF: links, joints, and the supported extensions.
class urdf_robot {
 public:
  urdf_robot(robot_description& d, const robot_options& o)
      : d_(d), links_(d, o), joints_(d, links_), contacts_(o.contacts.requested()) {}

  void read(const xml_item& root) {
    if (root.name() != "robot") root.fail("a URDF begins with <robot>");
    d_.name = root.text_or("name", "");
    root.only({"link", "joint", "kte:loop", "material", "frame", "drake:frame", "drake:joint", "transmission", "gazebo",
               "loop_joint", "force_element", "drake:loop_joint", "drake:force_element", "drake:linear_spring_damper",
               "drake:linear_bushing_rpy", "drake:ball_constraint", "drake:link"},
              {"name", "version"});
    for (const auto& x : root.children("material")) links_.material(x);
    const auto count = [&](std::string_view of) {
      const auto& all = root.node().children;
      return static_cast<std::size_t>(
          std::count_if(all.begin(), all.end(), [&](const auto& c) { return c.name == of; }));
    };
    d_.links.reserve(count("link")), d_.joints.reserve(count("joint"));
    for (const auto& x : root.children("link")) links_.read(x);
    links_.colour();
    for (const auto* of : {"joint", "drake:joint"})
      for (const auto& x : root.children(of)) joints_.read(x);
    for (const auto& x : root.children("kte:loop")) d_.closures.push_back(read_urdf_loop(x, links_));
    free_followers(d_);
    add_world();
    read_frames(root);
    for (const auto& x : root.children("transmission")) transmission(x);
    for (const auto& x : root.children("gazebo")) gazebo(x);
    links_.rub(frictions_);
    for (const auto* of :
         {"loop_joint", "force_element", "drake:loop_joint", "drake:force_element", "drake:linear_spring_damper",
          "drake:linear_bushing_rpy", "drake:ball_constraint", "drake:link"})
      for (const auto& x : root.children(of)) x.moves_differently("not read");
    contacts_ ? links_.warn_of_contacts() : contacts(root);
  }

 private:
  /// Adds the link "world" if joints refer to it and the file does not define it.
  void add_world() {
    const auto is_world = [](const auto& l) { return l.name == "world"; };
    if (std::any_of(d_.links.begin(), d_.links.end(), is_world)) return;
    for (const auto& j : d_.joints)
      if (j.parent == "world") {
        d_.links.emplace_back().name = "world";
        d_.warnings.push_back(
            {j.line, "joint '" + j.name + "': its parent 'world' is not a link of the file: it is the ground"});
        return;
      }
  }
  /// Reads the frames of Drake (<drake:frame>).
  void read_frames(const xml_item& root) {
    std::unordered_set<std::string> links, frames;
    if (!root.children("frame").empty() || !root.children("drake:frame").empty())
      for (const auto& l : d_.links) links.insert(l.name);
    for (const auto* of : {"frame", "drake:frame"})
      for (const auto& x : root.children(of)) {
        x.only({}, {"name", "link", "xyz", "rpy"});
        const auto name = x.text("name"), link = x.text("link");
        if (!links.contains(link))
          x.not_read("not read: there is no link '" + excerpt(link) + "'");
        else if (links.contains(name) || !frames.insert(name).second)
          x.not_read("not read: another frame or a link has its name");
        else
          d_.frames.push_back({name, x.line(), link, links_.pose(x)});
      }
  }
  /// Reads a transmission: an actuator for each of its joints, and the rotor inertia of Drake, which acts on the joint
  /// times the square of the gear ratio.
  void transmission(const xml_item& x) {
    const auto joints = x.children("joint").list(), actuators = x.children("actuator").list();
    double inertia = 0;
    for (const auto& a : actuators)
      if (const auto rotor = a.child("drake:rotor_inertia")) {
        const double ratio = reduction(a);
        inertia += rotor->not_negative("value") * ratio * ratio;
      }
    if (joints.empty()) return inertia == 0 ? x.not_read("not read") : x.fail("has no <joint>");
    if (joints.size() > 1)
      x.warn("couples " + std::to_string(joints.size()) + " joints: each has its own motor instead");
    if (numbered_.empty())
      for (std::size_t i = 0; i < d_.joints.size(); ++i)
        if (has_one_coordinate(d_.joints[i])) numbered_.emplace(d_.joints[i].name, i);
    for (std::size_t i = 0; i < joints.size(); ++i) {
      const auto name = joints[i].text("name");
      const auto j = numbered_.find(name);
      if (j == numbered_.end()) {
        const auto why = "there is no joint '" + excerpt(name) + "' of one coordinate for it";
        inertia == 0 ? x.warn(why) : x.moves_differently(why);
        continue;
      }
      if (inertia > 0 && joints.size() == 1) d_.joints[j->second].dynamics.armature = inertia;
      const bool has_own = i < actuators.size();
      const double ratio = reduction(has_own && has_reduction(actuators[i]) ? actuators[i] : x);
      d_.actuators.push_back(
          {has_own ? actuators[i].text_or("name", "") : "", x.line(), name, ratio, {.gain = 1 / ratio}});
      hardware(x, joints[i]);
      if (has_own) hardware(x, actuators[i]);
    }
  }
  static bool has_reduction(const xml_item& x) { return x.child("mechanicalReduction") || x.child("drake:gear_ratio"); }
  /// The reduction; 1 if it is missing or cannot be read.
  static double reduction(const xml_item& x) {
    double ratio = 1;
    if (const auto drake = x.child("drake:gear_ratio"))
      ratio = drake->number("value");
    else if (const auto own = x.child("mechanicalReduction"))
      try {
        ratio = own->one(own->list_of(own->content(), "mechanicalReduction"), "mechanicalReduction");
      } catch (const bad_file&) {
        own->not_read("'" + excerpt(own->content()) + "' is not one number: the reduction is taken as 1");
      }
    if (ratio == 0) x.fail("a gear ratio must not be 0");
    return ratio;
  }
  /// Notes that commands of position or velocity need gains, which URDF does not have.
  static void hardware(const xml_item& x, const xml_item& of) {
    for (const auto& h : of.children("hardwareInterface"))
      if (h.content().find("Position") != std::string::npos || h.content().find("Velocity") != std::string::npos)
        x.not_read("its " + excerpt(h.content()) +
                   " has no gains in URDF: commands are forces, or positions by those of kte::motor_options");
  }
  void gazebo(const xml_item& x) {
    x.not_read(contacts_ ? "not read, except for mu1" : "not read");
    for (const auto& c : x.children()) {
      if (contacts_ && (c.name() == "mu1" || c.name() == "mu2")) friction(x, c);
      const bool flag = !c.content().empty() && c.content() != "0" && c.content() != "false";
      if (c.name() == "joint" || (flag && c.name() == "turnGravityOff") || (!flag && c.name() == "gravity"))
        c.moves_differently("not read");
    }
  }
  /// Reads the friction that Gazebo has for a link.
  void friction(const xml_item& x, const xml_item& mu) {
    const double value = mu.one(mu.list_of(mu.content(), "friction"), "friction");
    const auto first = first_child(x, "mu1");
    if (mu.name() == "mu1")
      frictions_[x.text_or("reference", "")] = value;
    else if (first && first->list_of(first->content(), "friction") != std::vector{value})
      mu.moves_differently("friction that depends on the direction is not modelled: mu1 is used");
  }
  /// Notes contact properties with one warning for all.
  static void contacts(const xml_item& root) {
    std::size_t count = 0;
    std::optional<xml_item> first;
    for (const auto& l : root.children("link"))
      for (const auto& c : l.children("contact")) {
        if (!first) first = c;
        ++count;
      }
    if (first)
      first->moves_differently("contacts are not modelled: it is not read" +
                               (count > 1 ? ", as others of " + std::to_string(count) + " links" : std::string()));
  }

  robot_description& d_;
  urdf_links links_;
  urdf_joints joints_;
  bool contacts_;                                          ///< whether contacts are requested
  std::unordered_map<std::string, std::size_t> numbered_;  ///< joints of one coordinate, where there are transmissions
  std::unordered_map<std::string, double> frictions_;      ///< of Gazebo, by link
};

}  // namespace kte::detail
