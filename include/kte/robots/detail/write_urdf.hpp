#pragma once

#include <kte/robots/detail/robot_tree.hpp>
#include <kte/robots/detail/xml_writer.hpp>

namespace kte::detail {

class urdf_writer {
 public:
  explicit urdf_writer(const robot_description& d) : d_(d) {}

  std::string write() {
    const robot_tree good(d_, {});
    out_.open("robot"), out_.attribute("name", std::string_view(d_.name));
    for (const auto& l : d_.links) link(l);
    for (const auto& j : d_.joints) joint(j);
    out_.close();
    return out_.take();
  }

 private:
  using kind = robot_joint::kind;
  using form = robot_shape::form;

  [[noreturn]] void refuse(const std::string& what, const std::string& why) const {
    raise<bad_argument>("kte: " + what + ": " + why + ", which URDF cannot say");
  }
  void origin(const robot_pose& p) {
    if (is_nothing(p)) return;
    out_.open("origin"), out_.attribute("xyz", p.position);
    if (p.rotation != robot_pose{}.rotation) out_.attribute("rpy", rpy_of_rotation(p.rotation));
    out_.close();
  }
  void link(const robot_link& l) {
    out_.open("link"), out_.attribute("name", std::string_view(l.name));
    if (const auto& b = l.inertial) {
      out_.open("inertial");
      origin({b->com, robot_pose{}.rotation});
      out_.leaf("mass", "value", b->mass);
      out_.open("inertia");
      const auto& i = b->inertia;
      out_.attribute("ixx", i.xx), out_.attribute("ixy", i.xy), out_.attribute("ixz", i.xz);
      out_.attribute("iyy", i.yy), out_.attribute("iyz", i.yz), out_.attribute("izz", i.zz);
      out_.close(), out_.close();
    }
    for (const auto& s : l.visuals) shape("visual", s, l);
    for (const auto& s : l.collisions) shape("collision", s, l);
    out_.close();
  }
  void shape(const char* what, const robot_shape& s, const robot_link& l) {
    if (s.is == form::none) return;
    if (s.is == form::ellipsoid || s.is == form::plane)
      refuse("link '" + l.name + "'", "it has an ellipsoid or a plane for a shape");
    out_.open(what);
    if (!s.name.empty()) out_.attribute("name", std::string_view(s.name));
    origin(s.origin);
    out_.open("geometry");
    if (s.is == form::box) out_.leaf("box", "size", s.size);
    if (s.is == form::sphere) out_.leaf("sphere", "radius", s.size.x);
    if (s.is == form::cylinder || s.is == form::capsule) {
      out_.open(s.is == form::capsule ? "capsule" : "cylinder");
      out_.attribute("radius", s.size.x), out_.attribute("length", s.size.y), out_.close();
    }
    if (s.is == form::mesh) {
      out_.open("mesh"), out_.attribute("filename", std::string_view(s.mesh));
      if (s.scale != vec3<>{1, 1, 1}) out_.attribute("scale", s.scale);
      out_.close();
    }
    out_.close();
    if (!s.material.empty() || !s.rgba.empty()) {
      out_.open("material"), out_.attribute("name", std::string_view(s.material));
      if (!s.rgba.empty()) out_.leaf("color", "rgba", s.rgba);
      out_.close();
    }
    out_.close();
  }

  void joint(const robot_joint& j) {
    const auto no = [&](const std::string& why) { refuse("joint '" + j.name + "'", why); };
    if (j.is == kind::spherical) no("it is spherical");
    if (j.dynamics.stiffness != 0) no("it has a spring");
    if (j.dynamics.armature != 0) no("it has a rotor inertia");
    if (!is_nothing(j.child_pose)) no("its child stands elsewhere than its axis");
    out_.open("joint"), out_.attribute("name", std::string_view(j.name));
    const bool continuous = j.is == kind::revolute && j.lower == -robot_joint::none && j.upper == robot_joint::none;
    static constexpr std::string_view types[]{"fixed", "revolute", "prismatic", "", "planar", "floating"};
    out_.attribute("type", continuous ? std::string_view("continuous") : types[static_cast<std::size_t>(j.is)]);
    out_.leaf("parent", "link", std::string_view(j.parent));
    out_.leaf("child", "link", std::string_view(j.child));
    origin(j.origin);
    const bool one = j.is == kind::revolute || j.is == kind::prismatic;
    if (one || j.is == kind::planar) out_.leaf("axis", "xyz", j.axis);
    if (one) limit(j, continuous);
    if (j.dynamics.damping != 0 || j.dynamics.friction != 0) {
      out_.open("dynamics");
      out_.attribute("damping", j.dynamics.damping), out_.attribute("friction", j.dynamics.friction), out_.close();
    }
    if (j.mimic) {
      out_.open("mimic"), out_.attribute("joint", std::string_view(j.mimic->joint));
      out_.attribute("multiplier", j.mimic->ratio), out_.attribute("offset", j.mimic->offset), out_.close();
    }
    out_.close();
  }
  void limit(const robot_joint& j, bool continuous) {
    out_.open("limit");
    if (!continuous) out_.attribute("lower", j.lower), out_.attribute("upper", j.upper);
    out_.attribute("effort", j.effort), out_.attribute("velocity", j.rate), out_.close();
    if (j.soft_lower <= j.lower && j.soft_upper >= j.upper) return;
    out_.open("safety_controller"), out_.attribute("soft_lower_limit", j.soft_lower);
    out_.attribute("soft_upper_limit", j.soft_upper), out_.attribute("k_velocity", 0.0), out_.close();
  }

  const robot_description& d_;
  xml_writer out_;
};

}  // namespace kte::detail
