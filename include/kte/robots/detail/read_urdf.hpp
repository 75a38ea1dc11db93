#pragma once

#include <kte/detail/compiled.hpp>
#include <kte/robots/description.hpp>
#include <kte/robots/detail/xml_node.hpp>
#include <kte/robots/options.hpp>

#ifdef KTE_FUNCTION
#  include <kte/robots/detail/read_values.hpp>
#endif

namespace kte::detail {

/// A robot from the root of a URDF; `name` is what messages call the file.
robot_description read_urdf(const xml_node& root, const std::string& name, const robot_options& options);

#ifdef KTE_FUNCTION
class urdf_reader {
 public:
  urdf_reader(robot_description& d, const robot_options& o) : d_(d), options_(o) {}

  void read(const xml_item& root) {
    if (root.name() != "robot") root.fail("a URDF begins with <robot>");
    d_.name = root.text_or("name", "");
    root.only({"link", "joint", "material"}, {"name", "version"});
    for (const auto& x : root.children("link")) link(x);
    for (const auto& x : root.children("joint")) joint(x);
  }

 private:
  robot_pose origin(const xml_item& owner) {
    const auto x = owner.child("origin");
    if (!x) return {};
    x->only({}, {"xyz", "rpy"});
    const vec3<> rpy = x->vector_or("rpy", {});
    for (const double angle : {rpy.x, rpy.y, rpy.z}) note_near_quarter(*x, angle, options_);
    return {x->vector_or("xyz", {}), rotation_of_rpy(rpy, options_.quarter_turn_tolerance)};
  }

  void link(const xml_item& x) {
    robot_link l;
    l.name = x.text("name"), l.line = x.line();
    x.only({"inertial", "visual", "collision"}, {"name", "type"});
    if (const auto i = x.child("inertial")) l.inertial = inertial(*i);
    for (const auto& s : x.children("visual")) l.visuals.push_back(shape(s));
    for (const auto& s : x.children("collision")) l.collisions.push_back(shape(s));
    d_.links.push_back(std::move(l));
  }
  rigid_body<> inertial(const xml_item& x) {
    x.only({"origin", "mass", "inertia"}, {});
    const auto mass = x.needed_child("mass"), inertia = x.needed_child("inertia");
    mass.only({}, {"value"});
    inertia.only({}, {"ixx", "ixy", "ixz", "iyy", "iyz", "izz"});
    const sym3<> about_com{inertia.number("ixx"), inertia.number("ixy"), inertia.number("ixz"),
                           inertia.number("iyy"), inertia.number("iyz"), inertia.number("izz")};
    return moved_body(origin(x), {mass.not_negative("value"), {}, about_com});
  }
  robot_shape shape(const xml_item& x) {
    x.only({"origin", "geometry", "material"}, {"name"});
    robot_shape s;
    s.name = x.text_or("name", ""), s.line = x.line(), s.origin = origin(x);
    const auto geometry = x.needed_child("geometry");
    geometry.only({"box", "cylinder", "sphere", "capsule", "mesh"}, {});
    for (const auto& g : geometry.children()) {
      if (g.name() == "box") s.is = robot_shape::form::box, s.size = g.vector("size");
      if (g.name() == "sphere") s.is = robot_shape::form::sphere, s.size = {g.number("radius"), 0, 0};
      if (g.name() == "cylinder" || g.name() == "capsule") {
        s.is = g.name() == "capsule" ? robot_shape::form::capsule : robot_shape::form::cylinder;
        s.size = {g.number("radius"), g.number("length"), 0};
      }
      if (g.name() == "mesh")
        s.is = robot_shape::form::mesh, s.mesh = g.text("filename"), s.scale = g.vector_or("scale", {1, 1, 1});
    }
    if (const auto m = x.child("material")) {
      s.material = m->text_or("name", "");
      if (const auto c = m->child("color")) s.rgba = c->list("rgba");
    }
    return s;
  }

  void joint(const xml_item& x) {
    robot_joint j;
    j.name = x.text("name"), j.line = x.line();
    x.only({"parent", "child", "origin", "axis", "limit", "dynamics", "mimic", "safety_controller"}, {"name", "type"});
    j.parent = x.needed_child("parent").text("link");
    j.child = x.needed_child("child").text("link");
    j.origin = origin(x);
    type(x, j);
    if (const auto a = x.child("axis")) {
      if (j.is != robot_joint::kind::fixed && j.is != robot_joint::kind::floating)
        j.axis = unit_axis(*a, a->vector("xyz"));
    }
    limits(x, j);
    if (const auto y = x.child("dynamics")) {
      y->only({}, {"damping", "friction"});
      j.dynamics.damping = y->not_negative_or("damping", 0);
      j.dynamics.friction = y->not_negative_or("friction", 0);
    }
    if (const auto m = x.child("mimic")) {
      m->only({}, {"joint", "multiplier", "offset"});
      if (j.is != robot_joint::kind::revolute && j.is != robot_joint::kind::prismatic)
        m->fail("only revolute, continuous and prismatic joints can follow another");
      j.mimic = {m->text("joint"), m->number_or("multiplier", 1), m->number_or("offset", 0)};
    }
    d_.joints.push_back(std::move(j));
  }
  static void type(const xml_item& x, robot_joint& j) {
    using kind = robot_joint::kind;
    const auto t = x.text("type");
    j.continuous = t == "continuous";
    if (t == "revolute" || t == "continuous")
      j.is = kind::revolute;
    else if (t == "prismatic")
      j.is = kind::prismatic;
    else if (t == "floating")
      j.is = kind::floating;
    else if (t == "planar")
      j.is = kind::planar;
    else if (t != "fixed")
      x.fail("type '" + excerpt(t) + "' is none of revolute, continuous, prismatic, fixed, floating, planar");
  }

  static void limits(const xml_item& x, robot_joint& j) {
    const bool one_number = j.is == robot_joint::kind::revolute || j.is == robot_joint::kind::prismatic;
    const auto l = x.child("limit");
    if (!l && one_number && !j.continuous) x.fail("has no <limit>, which joints of type " + x.text("type") + " need");
    if (l && one_number) {
      l->only({}, {"lower", "upper", "effort", "velocity"});
      j.effort = l->limit("effort"), j.rate = l->limit("velocity");
      if (!j.continuous) {
        j.lower = l->has("lower") ? l->limit("lower") : 0, j.upper = l->has("upper") ? l->limit("upper") : 0;
      } else if (l->has("lower") || l->has("upper")) {
        l->not_read("lower and upper mean nothing to a continuous joint");
      }
      check_range(*l, j.lower, j.upper, "lower", "upper");
      if (!(j.rate >= 0)) l->fail("velocity must not be negative, got " + number(j.rate));
      if (!(j.effort >= 0)) l->fail("effort must not be negative, got " + number(j.effort));
    }
    j.soft_lower = j.lower, j.soft_upper = j.upper;
    if (const auto s = x.child("safety_controller")) {
      s->only({}, {"soft_lower_limit", "soft_upper_limit"});
      if (!one_number || j.continuous) return;
      // files that have only gains mean no range: the format's default of 0 would hold the joint
      if (s->has("soft_lower_limit")) j.soft_lower = s->limit("soft_lower_limit");
      if (s->has("soft_upper_limit")) j.soft_upper = s->limit("soft_upper_limit");
      check_range(*s, j.soft_lower, j.soft_upper, "soft_lower_limit", "soft_upper_limit");
    }
  }

  robot_description& d_;
  const robot_options& options_;
};

KTE_FUNCTION robot_description read_urdf(const xml_node& root, const std::string& name, const robot_options& options) {
  robot_description d;
  d.source = name;
  urdf_reader(d, options).read({root, d});
  return d;
}
#endif

}  // namespace kte::detail
