#pragma once

#include <kte/robots/detail/no_limit.hpp>
#include <kte/robots/detail/split_joints.hpp>
#include <kte/robots/detail/unwritten.hpp>
#include <kte/robots/detail/write_mjcf_plan.hpp>
#include <kte/robots/detail/xml_writer.hpp>

namespace kte::detail {

inline std::string mjcf_title(const robot_joint& j) { return "joint '" + j.name + "'"; }

/// Writes the joints of bodies of MJCF.
class mjcf_joints {
 public:
  mjcf_joints(const robot_description& d, const robot_writing& o, unwritten& left_out, const mjcf_plan& plan,
              xml_writer& out)
      : o_(o), left_out_(left_out), plan_(plan), out_(out) {
    for (const auto& j : d.joints) names_.insert(j.name);
  }

  /// `behind`: the pose of the body in the frame that the joint moves.
  void write(const robot_joint& j, const robot_pose& behind) {
    if (j.is == kind::floating) return free_joint(j);
    if (j.is == kind::planar) return planar_joint(j, behind);
    if (j.is == kind::screw) left_out_.refuse(mjcf_title(j), "it is a screw");
    open_joint(j.name, j.is == kind::revolute ? "hinge" : j.is == kind::prismatic ? "slide" : "ball", behind);
    if (j.is != kind::spherical) out_.attribute("axis", transpose(behind.rotation) * j.axis);
    limits(j), dynamics(j);
    out_.close();
  }

 private:
  using kind = robot_joint::kind;

  void open_joint(const std::string& name, std::string_view type, const robot_pose& behind) {
    out_.open("joint"), out_.attribute("name", std::string_view(name)), out_.attribute("type", type);
    if (const auto p = inverse_of(behind).position; type != "slide" && p != vec3<>{}) out_.attribute("pos", p);
  }
  void free_joint(const robot_joint& j) {
    const auto& placement = plan_.rest(j.parent);
    if (!placement) left_out_.refuse(mjcf_title(j), "it floats in a link that moves, '" + j.parent + "'");
    if (!is_nothing(*placement * j.origin))
      left_out_.refuse(mjcf_title(j), "its placement is not the frame of the world");
    if (j.parent != "world")
      left_out_.list(j.line, mjcf_title(j) + ": it floats in the world, in which link '" + j.parent + "' rests");
    out_.open("joint"), out_.attribute("name", std::string_view(j.name));
    out_.attribute("type", std::string_view("free")), dynamics(j), out_.close();
  }
  void planar_joint(const robot_joint& j, const robot_pose& behind) {
    const auto plane = transpose(transpose(behind.rotation) * turn_of_z_to(j.axis));
    const auto x = fresh_name(names_, j.name + "_x"), y = fresh_name(names_, j.name + "_y"),
               angle = fresh_name(names_, j.name + "_angle");
    left_out_.list(j.line, mjcf_title(j) + ": it is planar, and written as slides '" + x + "', '" + y +
                               "' and a hinge '" + angle + "'");
    auto own = j.dynamics;
    own.rest = 0;
    if (own != robot_joint_dynamics{})
      left_out_.list(j.line,
                     mjcf_title(j) + ": damping, friction, springs and rotors are only those of one coordinate");
    open_joint(x, "slide", behind), out_.attribute("axis", plane.x), out_.close();
    open_joint(y, "slide", behind), out_.attribute("axis", plane.y), out_.close();
    open_joint(angle, "hinge", behind), out_.attribute("axis", plane.z), out_.close();
  }

  void limits(const robot_joint& j) {
    const auto no = [&](const std::string& what) { left_out_.list(j.line, mjcf_title(j) + ": " + what); };
    if (j.lower != -robot_joint::none || j.upper != robot_joint::none) {
      if (!(j.lower <= j.upper))
        left_out_.refuse(mjcf_title(j),
                         "its limits " + number(j.lower) + " and " + number(j.upper) + " are not a range");
      const double lower = limit_in_file(j.lower);
      double upper = limit_in_file(j.upper);
      if (lower == upper) {
        upper = std::nextafter(upper, robot_joint::none);
        no("MuJoCo does not accept an empty range: its upper limit is the next number above " + number(lower));
      }
      out_.attribute("limited", std::string_view("true")), out_.attribute("range", std::vector<double>{lower, upper});
    }
    if (j.soft_lower > j.lower || j.soft_upper < j.upper) no("its soft limits are left out");
    if (j.rate != robot_joint::none) no("the limit of its rate, " + number(j.rate) + ", is left out");
    if (j.effort == robot_joint::none) return;
    if (o_.effort_limits && j.effort > 0)
      out_.attribute("actuatorfrcrange", std::vector<double>{0.0 - j.effort, j.effort});
    else
      no("the limit of its effort, " + number(j.effort) + ", is left out");
  }
  void dynamics(const robot_joint& j) {
    const auto unless_zero = [&](const char* key, double x) {
      if (x != 0) out_.attribute(key, x);
    };
    const auto polynomial = [&](const char* key, double linear, const robot_joint_dynamics::powers& more) {
      if (more == robot_joint_dynamics::powers{}) return unless_zero(key, linear);
      out_.attribute(key, std::vector<double>{linear, more.quadratic, more.cubic});
    };
    const auto& x = j.dynamics;
    polynomial("damping", x.damping, x.damping_powers), unless_zero("frictionloss", x.friction);
    polynomial("stiffness", x.stiffness, x.stiffness_powers), unless_zero("springref", x.rest);
    unless_zero("armature", x.armature);
    if (x.time_constant == 0) return;
    if (x.damping_ratio == robot_joint::none)
      left_out_.change(j.line, mjcf_title(j), "its springdamper has no spring", "it has no springdamper");
    else
      out_.attribute("springdamper", std::vector<double>{x.time_constant, x.damping_ratio});
  }

  const robot_writing& o_;
  unwritten& left_out_;
  const mjcf_plan& plan_;
  xml_writer& out_;
  std::set<std::string, std::less<>> names_;
};

}  // namespace kte::detail
