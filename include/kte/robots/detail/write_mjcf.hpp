#pragma once

#include <kte/robots/detail/write_mjcf_geoms.hpp>
#include <kte/robots/detail/write_mjcf_joints.hpp>
#include <kte/robots/detail/xml_limits.hpp>

#include <algorithm>
#include <cstdio>
#include <unordered_map>

namespace kte::detail {

class mjcf_writer {
 public:
  mjcf_writer(const robot_description& d, const robot_writing& o, std::vector<robot_note> before = {})
      : d_(split_joints(d)),
        left_out_(o, "MJCF", std::move(before)),
        plan_(d_),
        geoms_(d_, o, left_out_),
        joints_(d_, o, left_out_, plan_, out_) {
    for (const auto& l : d_.links) links_.insert(l.name);
  }

  std::string write() {
    left_out_.compensations(d_);
    out_.open("mujoco"), out_.attribute("model", std::string_view(d_.name));
    out_.open("compiler"), out_.attribute("angle", std::string_view("radian"));
    out_.attribute("inertiafromgeom", std::string_view("false")), out_.close();
    if (d_.gravity) out_.leaf("option", "gravity", *d_.gravity);
    geoms_.write_assets(out_);
    out_.open("worldbody");
    const auto& root = d_.links[plan_.root()];
    bodies_.insert(root.name);
    if (root.name == "world") {
      if (plan_.weight(plan_.root()))
        left_out_.list(root.line, "link 'world': its mass does not move, and is left out");
      geoms_.write(out_, plan_.root(), true);
      bodies_below(plan_.root());
    } else {
      out_.open("body"), out_.attribute("name", std::string_view(root.name));
      inertial({plan_.root(), {}, {}, {}});
      geoms_.write(out_, plan_.root(), true);
      bodies_below(plan_.root());
      out_.close();
    }
    for (std::size_t i = 0; i < d_.joints.size(); ++i)
      if (d_.joints[i].is == kind::floating) body(i);
    out_.close(), constraints(), actuators(), out_.close();
    for (const auto& n : left_out_.notes()) out_.comment("not as in the robot: " + n.text);
    left_out_.hand_over();
    return out_.take();
  }

 private:
  using kind = robot_joint::kind;

  static std::string title(const robot_link& l) { return "link '" + l.name + "'"; }

  void bodies_below(std::size_t link) {
    for (const auto j : plan_.below(link))
      if (d_.joints[j].is != kind::floating) body(j);
  }
  void body(std::size_t first) {
    const auto b = plan_.body(first);
    const auto& l = d_.links[b.link];
    if (out_.depth() + 2 > std::size_t{deepest_element})  // its own element, and those in it
      left_out_.refuse(title(l), "its body is more than " + std::to_string(deepest_element) + " elements deep");
    auto name = l.name;
    if (name == "world") {
      name = fresh_name(links_, name);
      left_out_.list(l.line, "link 'world': it is called \"" + name + "\": MuJoCo's world is at rest");
    }
    bodies_.insert(name);
    out_.open("body"), out_.attribute("name", std::string_view(name));
    write_mjcf_place(out_, b.place);
    int moving = 0;
    for (std::size_t i = 0; i < b.joints.size(); ++i) {
      const auto& j = d_.joints[b.joints[i]];
      if (j.is == kind::fixed && j.name != j.child + "_fixed")
        left_out_.list(j.line, mjcf_title(j) + ": fixed joints have no names in MJCF");
      if (j.is != kind::fixed) joints_.write(j, b.behind[i]), ++moving;
      if (i + 1 < b.joints.size() && !comes_back(j.child, l.name, moving))
        left_out_.list(j.line, "link '" + j.child + "': frames between joints of one body, here of '" + l.name +
                                   "', have no names in MJCF");
    }
    inertial(b);
    geoms_.write(out_, b.link, plan_.rest(l.name).has_value());
    bodies_below(b.link);
    out_.close();
  }

  /// Whether the reader of this library gives a frame this name when it reads a body with this number of joints.
  static bool comes_back(std::string_view frame, const std::string& body, int joints) {
    if (frame.ends_with(".joint")) frame.remove_suffix(6);
    return frame == body || frame == body + "." + std::to_string(joints);
  }

  void inertial(const mjcf_body& b) {
    const auto& l = d_.links[b.link];
    auto& own = plan_.weight(b.link);
    const bool too_light = !b.joints.empty() && d_.joints[b.joints[0]].is != kind::fixed && !plan_.may_move(b.link);
    if (too_light) {
      std::vector<std::size_t> from;
      own = plan_.gathered(b.link, from);
      for (const auto i : from)
        if (i != b.link)
          left_out_.list(d_.links[i].line,
                         title(d_.links[i]) + ": its mass is written into link '" + l.name + "', which it is fixed to");
    }
    if (!own && !too_light) {
      if (geoms_.has_mesh(b.link)) write(mjcf_weight(rigid_body<>{0, {}, {}}));  // so that the mesh has no mass
      return;
    }
    mjcf_weight w(own.value_or(rigid_body<>{0, {}, {}}));
    if (!(w.mass >= 0)) left_out_.refuse(title(l), "its mass is " + number(w.mass));
    if (w.fault() > 0) {
      char why[80];
      std::snprintf(why, sizeof why, "the moments are not physically realizable: one is wrong by %.3g kg m^2",
                    w.fault());
      if (plan_.rest(l.name))
        left_out_.list(l.line, title(l) + ": " + why + ": it is at rest, and gets the nearest realizable moments");
      else
        left_out_.change(l.line, title(l), why, "it gets the nearest realizable moments");
      w.mend();
    }
    if (too_light && !w.moves()) raise(b, w);
    write(w);
  }
  /// Raises the mass and moments of a body to the least that MuJoCo accepts. This counts as a change of the motion
  /// unless they are small beside the masses or rotor inertias that its joints move.
  void raise(const mjcf_body& b, mjcf_weight& w) {
    const auto& l = d_.links[b.link];
    const auto [mass, moments] = plan_.carried(b.link);
    bool same = w.mass >= 1e-6 || (mass >= 1e-6 && moments >= 1e-6);
    bool rotors = true;
    for (const auto i : b.joints) rotors &= d_.joints[i].is == kind::fixed || d_.joints[i].dynamics.armature >= 1e-6;
    same |= rotors;
    const std::string why =
        "it moves with a mass of " + number(w.mass) + " kg, and moments down to " + number(w.least()) + " kg m^2";
    if (same)
      left_out_.list(l.line, title(l) + ": " + why + ", which are raised to 1e-15 each, the least that MuJoCo accepts");
    else
      left_out_.change(l.line, title(l), why, "they are raised to 1e-15 each");
    w.raise_to_least();
  }
  void write(const mjcf_weight& w) {
    out_.open("inertial"), out_.attribute("pos", w.com), out_.attribute("mass", w.mass);
    if (w.axes != unit_quaternion<>{1, 0, 0, 0})
      out_.attribute("quat", std::vector<double>{w.axes.w, w.axes.x, w.axes.y, w.axes.z});
    out_.attribute("diaginertia", std::vector<double>(w.moments.begin(), w.moments.end())), out_.close();
  }

  /// Followers and closures: MuJoCo's are soft.
  void constraints() {
    using closure_kind = robot_closure::kind;
    bool any = false;
    const auto begin = [&](const char* of) {
      if (!any) out_.open("equality");
      any = true;
      out_.open(of);
    };
    const auto couple = [&](const std::string& name, const std::string& joint1, const std::string& joint2,
                            const std::vector<double>& p) {
      begin("joint");
      if (!name.empty()) out_.attribute("name", std::string_view(name));
      out_.attribute("joint1", std::string_view(joint1)), out_.attribute("joint2", std::string_view(joint2));
      out_.attribute("polycoef", p), out_.close();
    };
    for (const auto& j : d_.joints) {
      if (!j.mimic) continue;
      left_out_.change(j.line, mjcf_title(j), "it follows joint '" + j.mimic->joint + "'",
                       "it has its own coordinate, and an equality constraint, which is soft");
      couple("", j.name, j.mimic->joint, {j.mimic->offset, j.mimic->ratio, 0, 0, 0});
    }
    for (const auto& c : d_.closures) {
      const auto title = "closure '" + c.name + "'";
      const bool weld = c.is == closure_kind::frames;
      if (!weld && c.is != closure_kind::joints) {  // <connect> has a point of one body alone, and closes at q = 0
        left_out_.change(c.line, title, "it closes a loop", "it is left out");
        continue;
      }
      left_out_.change(c.line, title, "it holds exactly", "an equality constraint, which is soft");
      if (!weld) {
        couple(c.name, c.link1, c.link2, {c.polynomial.begin(), c.polynomial.end()});
        continue;
      }
      for (const auto* link : {&c.link1, &c.link2})
        if (!bodies_.contains(*link)) left_out_.refuse(title, "'" + *link + "' is a frame between joints of one body");
      const auto at = c.origin1 * inverse_of(c.origin2);
      const auto q = to_quaternion(at.rotation);
      begin("weld"), out_.attribute("name", std::string_view(c.name));
      out_.attribute("body1", std::string_view(c.link1)), out_.attribute("body2", std::string_view(c.link2));
      out_.attribute("relpose", std::vector<double>{at.position.x, at.position.y, at.position.z, q.w, q.x, q.y, q.z});
      out_.close();
    }
    if (any) out_.close();
  }
  void actuators() {
    std::set<std::string, std::less<>> names;
    std::unordered_map<std::string_view, kind> joints;
    if (!d_.actuators.empty())
      for (const auto& j : d_.joints) joints.emplace(j.name, j.is);
    bool any = false;
    for (const auto& a : d_.actuators) {
      const auto on = joints.find(a.joint);
      const auto title = "actuator '" + a.name + "'";
      if (on == joints.end() || on->second == kind::fixed || on->second == kind::planar) {
        left_out_.list(a.line, title + ": left out: '" + a.joint + "' is not a joint of MJCF");
        continue;
      }
      if (!a.not_modelled.empty()) {
        left_out_.list(a.line, title + ": left out: " + a.not_modelled + " is not modelled");
        continue;
      }
      if (!any) out_.open("actuator");
      any = true;
      out_.open(a.law == motor_law{} ? "motor" : "general");
      if (!a.name.empty() && !names.insert(a.name).second)
        left_out_.list(a.line, title + ": its name occurs twice, and is omitted");
      else if (!a.name.empty())
        out_.attribute("name", std::string_view(a.name));
      out_.attribute("joint", std::string_view(a.joint)), out_.attribute("gear", a.gear);
      motor(a.law);
      out_.close();
    }
    if (any) out_.close();
  }
  /// Writes the attributes in which a law differs from that of <motor>.
  void motor(const motor_law& law) {
    if (law.gain != 1) out_.attribute("gainprm", law.gain);
    if (law.offset != 0 || law.stiffness != 0 || law.damping != 0) {
      out_.attribute("biastype", std::string_view("affine"));
      out_.attribute("biasprm", std::vector<double>{law.offset, 0.0 - law.stiffness, 0.0 - law.damping});
    }
    const auto range = [&](const char* limited, const char* of, double lower, double upper) {
      if (lower == -motor_law::none && upper == motor_law::none) return;
      out_.attribute(limited, std::string_view("true"));
      out_.attribute(of, std::vector<double>{limit_in_file(lower), limit_in_file(upper)});
    };
    range("ctrllimited", "ctrlrange", law.lower_command, law.upper_command);
    range("forcelimited", "forcerange", law.lower, law.upper);
  }

  const robot_description d_;
  unwritten left_out_;
  mjcf_plan plan_;
  mjcf_geoms geoms_;
  std::set<std::string, std::less<>> links_, bodies_;  ///< names of links; of those that are bodies of the file
  xml_writer out_;
  mjcf_joints joints_;
};

}  // namespace kte::detail
