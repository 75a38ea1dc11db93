#pragma once

#include <kte/robots/detail/robot_tree.hpp>
#include <kte/robots/detail/xml_writer.hpp>

namespace kte::detail {

class mjcf_writer {
 public:
  explicit mjcf_writer(const robot_description& d) : d_(d), tree_(d, {}), below_(d.links.size()) {
    for (const auto& s : tree_.steps()) below_[tree_.link(d.joints[s.joint].parent)].push_back(s.joint);
  }

  std::string write() {
    for (const auto& l : d_.links)
      if (l.name == "world" && (l.inertial || &l != &d_.links[tree_.root()]))
        raise<bad_argument>(
            "kte: link 'world': it has a mass, or a joint carries it, which MJCF cannot say of the world");
    out_.open("mujoco"), out_.attribute("model", std::string_view(d_.name));
    out_.open("compiler"), out_.attribute("angle", std::string_view("radian"));
    out_.attribute("autolimits", std::string_view("true")), out_.close();
    if (d_.gravity) out_.leaf("option", "gravity", *d_.gravity);
    out_.open("worldbody");
    const auto& root = d_.links[tree_.root()];
    if (root.name == "world") {
      for (const auto j : below_[tree_.root()]) body(d_.joints[j], true);
    } else {
      robot_joint ground;
      ground.child = root.name;
      body(ground, true);
    }
    out_.close(), actuators(), out_.close();
    return out_.take();
  }

 private:
  using kind = robot_joint::kind;

  [[noreturn]] static void refuse(const robot_joint& j, const std::string& why) {
    raise<bad_argument>("kte: joint '" + j.name + "': " + why + ", which MJCF cannot say");
  }
  void place(const robot_pose& p) {
    if (p.position != vec3<>{}) out_.attribute("pos", p.position);
    if (p.rotation == robot_pose{}.rotation) return;
    const auto q = to_quaternion(p.rotation);
    out_.attribute("quat", std::vector<double>{q.w, q.x, q.y, q.z});
  }
  /// What a joint carries. One whose child stands elsewhere than its axis needs a body in between.
  void body(const robot_joint& j, bool in_world) {
    const bool two = j.is != kind::fixed && !is_nothing(j.child_pose);
    const auto& l = d_.links[tree_.link(j.child)];
    out_.open("body");
    if (!two) out_.attribute("name", std::string_view(l.name));
    place(j.is == kind::fixed ? j.origin * j.child_pose : j.origin);
    if (j.is != kind::fixed) joint(j, in_world);
    if (two) {
      out_.open("body"), out_.attribute("name", std::string_view(l.name));
      place(j.child_pose);
    }
    inertial(l);
    for (const auto k : below_[tree_.link(j.child)]) body(d_.joints[k], false);
    out_.close();
    if (two) out_.close();
  }
  void inertial(const robot_link& l) {
    if (!l.inertial) return;
    const auto& b = *l.inertial;
    out_.open("inertial"), out_.attribute("pos", b.com), out_.attribute("mass", b.mass);
    const auto& i = b.inertia;
    out_.attribute("fullinertia", std::vector<double>{i.xx, i.yy, i.zz, i.xy, i.xz, i.yz}), out_.close();
  }
  void joint(const robot_joint& j, bool in_world) {
    if (j.is == kind::planar) refuse(j, "it is planar");
    if (j.mimic) refuse(j, "it follows another");
    if (j.is == kind::floating) {
      if (!in_world || d_.links[tree_.root()].name != "world") refuse(j, "it floats in another link than the world");
      if (!is_nothing(j.origin)) refuse(j, "its seat stands elsewhere than the world");
      return out_.leaf("freejoint", "name", std::string_view(j.name));
    }
    out_.open("joint"), out_.attribute("name", std::string_view(j.name));
    static constexpr std::string_view types[]{"", "hinge", "slide", "ball", "", ""};
    out_.attribute("type", types[static_cast<std::size_t>(j.is)]);
    if (j.is != kind::spherical) out_.attribute("axis", j.axis);
    if (j.lower != -robot_joint::none || j.upper != robot_joint::none) {
      if (!std::isfinite(j.lower) || !std::isfinite(j.upper)) refuse(j, "it has a limit to one side alone");
      out_.attribute("range", std::vector<double>{j.lower, j.upper});
    }
    if (j.rate != robot_joint::none) refuse(j, "its rate has a limit");
    if (j.effort != robot_joint::none)
      out_.attribute("actuatorfrcrange", std::vector<double>{0.0 - j.effort, j.effort});
    const auto unless_zero = [&](const char* key, double x) {
      if (x != 0) out_.attribute(key, x);
    };
    unless_zero("damping", j.dynamics.damping), unless_zero("frictionloss", j.dynamics.friction);
    unless_zero("stiffness", j.dynamics.stiffness), unless_zero("springref", j.dynamics.rest);
    unless_zero("armature", j.dynamics.armature);
    out_.close();
  }
  void actuators() {
    if (d_.actuators.empty()) return;
    out_.open("actuator");
    for (const auto& a : d_.actuators) {
      out_.open("motor");
      if (!a.name.empty()) out_.attribute("name", std::string_view(a.name));
      out_.attribute("joint", std::string_view(a.joint)), out_.attribute("gear", a.gear), out_.close();
    }
    out_.close();
  }

  const robot_description& d_;
  robot_tree tree_;
  std::vector<std::vector<std::size_t>> below_;
  xml_writer out_;
};

}  // namespace kte::detail
