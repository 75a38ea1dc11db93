#pragma once

#include <kte/robots/detail/no_limit.hpp>
#include <kte/robots/detail/robot_tree.hpp>
#include <kte/robots/detail/split_joints.hpp>
#include <kte/robots/detail/urdf_loop.hpp>
#include <kte/robots/detail/write_urdf_shapes.hpp>

#include <unordered_set>

namespace kte::detail {

class urdf_writer {
 public:
  urdf_writer(const robot_description& d, const robot_writing& o, std::vector<robot_note> before = {})
      : d_(split_joints(d)), left_out_(o, "URDF", std::move(before)), shapes_(out_, o, left_out_) {}

  std::string write() {
    const robot_tree good(d_, {});
    left_out_.compensations(d_);
    out_.open("robot"), out_.attribute("name", std::string_view(d_.name));
    for (const auto& l : d_.links) link(l);
    for (const auto& j : d_.joints) joint(j);
    for (const auto& c : d_.closures) closure(c);
    if (d_.gravity && *d_.gravity != vec3<>{0, 0, -9.81})
      left_out_.list(0, "gravity " + numbers_to_text(std::vector<double>{d_.gravity->x, d_.gravity->y, d_.gravity->z}) +
                            " is left out");
    for (const auto& a : d_.actuators) actuator(a);
    out_.close();
    for (const auto& n : left_out_.notes()) out_.comment("not as in the robot: " + n.text);
    left_out_.hand_over();
    return out_.take();
  }

 private:
  using kind = robot_joint::kind;

  /// Writes an actuator as a transmission; its command must be the force of its joint.
  void actuator(const robot_actuator& a) {
    if (numbered_.empty())
      for (const auto& j : d_.joints)
        if (has_one_coordinate(j)) numbered_.insert(j.name);
    if (!a.not_modelled.empty() || a.law != motor_law{.gain = 1 / a.gear} || !numbered_.contains(a.joint))
      return left_out_.list(a.line, "actuator '" + a.name + "' is left out");
    out_.open("transmission"), out_.attribute("name", std::string_view(a.joint + "_transmission"));
    out_.text("type", "transmission_interface/SimpleTransmission");
    out_.leaf("joint", "name", std::string_view(a.joint));
    out_.open("actuator"), out_.attribute("name", std::string_view(a.name));
    out_.text("mechanicalReduction", numbers_to_text(std::vector<double>{a.gear}));
    out_.close(), out_.close();
  }

  void link(const robot_link& l) {
    out_.open("link"), out_.attribute("name", std::string_view(l.name));
    if (const auto& b = l.inertial) {
      out_.open("inertial");
      write_urdf_origin(out_, {b->com, robot_pose{}.rotation});
      out_.leaf("mass", "value", b->mass);
      out_.open("inertia");
      const auto& i = b->inertia;
      out_.attribute("ixx", i.xx), out_.attribute("ixy", i.xy), out_.attribute("ixz", i.xz);
      out_.attribute("iyy", i.yy), out_.attribute("iyz", i.yz), out_.attribute("izz", i.zz);
      out_.close(), out_.close();
    }
    shapes_.write(l);
    out_.close();
  }

  void joint(const robot_joint& j) {
    const auto title = "joint '" + j.name + "'";
    if (j.is == kind::spherical) left_out_.refuse(title, "it is spherical");
    if (j.is == kind::screw) left_out_.refuse(title, "it is a screw");
    const auto& x = j.dynamics;
    const robot_joint_dynamics::powers none{};
    if (x.stiffness != 0 || x.stiffness_powers != none)
      left_out_.change(j.line, title, "it has a spring", "that is left out");
    if (x.damping_powers != none)
      left_out_.change(j.line, title, "its damping is not linear", "its linear part alone is written");
    if (x.time_constant != 0) left_out_.change(j.line, title, "it has a springdamper", "that is left out");
    if (x.armature != 0) left_out_.change(j.line, title, "it has a rotor inertia", "that is left out");
    out_.open("joint"), out_.attribute("name", std::string_view(j.name));
    const bool continuous =
        j.is == kind::revolute && no_range(j.lower, j.upper) && no_range(j.soft_lower, j.soft_upper);
    static constexpr std::string_view types[]{"fixed", "revolute", "prismatic", "", "planar", "floating"};
    out_.attribute("type", continuous ? std::string_view("continuous") : types[static_cast<std::size_t>(j.is)]);
    out_.leaf("parent", "link", std::string_view(j.parent));
    out_.leaf("child", "link", std::string_view(j.child));
    write_urdf_origin(out_, j.origin);
    const bool one = j.is == kind::revolute || j.is == kind::prismatic;
    if (one || j.is == kind::planar) out_.leaf("axis", "xyz", j.axis);
    if (one) limit(j, continuous);
    if (x.damping != 0 || x.friction != 0) {
      out_.open("dynamics");
      out_.attribute("damping", x.damping), out_.attribute("friction", x.friction), out_.close();
    }
    if (j.mimic) {
      out_.open("mimic"), out_.attribute("joint", std::string_view(j.mimic->joint));
      out_.attribute("multiplier", j.mimic->ratio), out_.attribute("offset", j.mimic->offset), out_.close();
    }
    out_.close();
  }
  /// An extension that other readers do not know.
  void closure(const robot_closure& c) {
    using closure_kind = robot_closure::kind;
    left_out_.list(c.line, "closure '" + c.name + "': it is a <kte:loop>, which other readers of URDF leave out");
    const auto* const type = std::find_if(std::begin(urdf_loop_types), std::end(urdf_loop_types),
                                          [&](const auto& t) { return t.is == c.is; });
    out_.open("kte:loop"), out_.attribute("name", std::string_view(c.name)), out_.attribute("type", type->name);
    if (c.is == closure_kind::joints) {
      out_.attribute("polynomial", std::vector<double>(c.polynomial.begin(), c.polynomial.end()));
      out_.leaf("joint1", "joint", std::string_view(c.link1)), out_.leaf("joint2", "joint", std::string_view(c.link2));
      return out_.close();
    }
    if (c.is == closure_kind::distance) out_.attribute("length", c.length);
    const auto end = [&](const char* of, const std::string& link, const robot_pose& at) {
      out_.open(of), out_.attribute("link", std::string_view(link)), write_urdf_pose(out_, at), out_.close();
    };
    end("link1", c.link1, c.origin1), end("link2", c.link2, c.origin2);
    if (c.is != closure_kind::points && c.is != closure_kind::frames && c.is != closure_kind::distance)
      out_.leaf("axis", "xyz", c.axis);
    if (c.is == closure_kind::universal) out_.leaf("axis2", "xyz", c.axis2);
    out_.close();
  }
  static bool no_range(double lower, double upper) { return lower == -robot_joint::none && upper == robot_joint::none; }
  void limit(const robot_joint& j, bool continuous) {
    const auto number_of = [&](const char* key, double x) { out_.attribute(key, limit_in_file(x)); };
    if (continuous && j.effort == robot_joint::none && j.rate == robot_joint::none) return;
    out_.open("limit");
    if (!continuous) number_of("lower", j.lower), number_of("upper", j.upper);
    number_of("effort", j.effort), number_of("velocity", j.rate), out_.close();
    if (j.soft_lower <= j.lower && j.soft_upper >= j.upper) return;
    out_.open("safety_controller"), number_of("soft_lower_limit", j.soft_lower);
    number_of("soft_upper_limit", j.soft_upper), out_.attribute("k_velocity", 0.0), out_.close();
  }

  const robot_description d_;
  std::unordered_set<std::string_view> numbered_;  ///< joints of one coordinate, where an actuator needs them
  unwritten left_out_;
  xml_writer out_;
  urdf_shapes shapes_;
};

}  // namespace kte::detail
