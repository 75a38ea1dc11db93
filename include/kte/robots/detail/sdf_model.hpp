#pragma once

#include <kte/robots/detail/sdf_frames.hpp>

namespace kte::detail {

/// Links and joints of a model in SDF.
class sdf_model {
 public:
  sdf_model(robot_description& d, const robot_options& o, xml_parser parse) : d_(d), options_(o), parse_(parse) {}

  void read(const xml_item& root) {
    root.only({"model", "world"}, {"version"});
    auto models = root.children("model");
    for (const auto& w : root.children("world")) {
      if (w.child("gravity")) d_.gravity = child_vector(w, "gravity");
      w.only({"model", "gravity"}, {"name"});
      for (const auto& m : w.children("model")) models.push_back(m);
    }
    if (models.empty()) root.fail("has no <model>");
    if (models.size() > 1) models[1].fail("is a second model: files with one are read");
    model(models[0]);
  }

 private:
  using kind = robot_joint::kind;

  void model(const xml_item& m) {
    d_.name = m.text_or("name", "");
    m.only({"link", "joint", "frame", "pose", "static"}, {"name", "canonical_link"});
    for (const auto* name : {"model", "include"})
      if (const auto found = m.children(name); !found.empty()) found[0].fail("is not read: models within models");
    frames_.add(m, "world", "__model__", inverse_of(sdf_pose(m, options_)));
    for (const auto& x : m.children("link")) add_frame(x, "__model__");
    for (const auto& x : m.children("frame")) add_frame(x, x.text_or("attached_to", "__model__"));
    for (const auto& x : m.children("joint")) add_frame(x, child_text(x, "child"));
    bool in_world = false;
    for (const auto& x : m.children("joint")) in_world |= child_text(x, "parent") == "world";
    if (in_world) d_.links.emplace_back().name = "world";
    for (const auto& x : m.children("link")) link(x);
    for (const auto& x : m.children("joint")) joint(x);
  }
  void add_frame(const xml_item& x, const std::string& usual) {
    const auto pose = x.child("pose");
    const auto to = pose ? pose->text_or("relative_to", "") : std::string();
    frames_.add(x, x.text("name"), to.empty() ? usual : to, sdf_pose(x, options_));
  }

  void link(const xml_item& x) {
    x.only({"inertial", "visual", "collision", "pose"}, {"name"});
    robot_link l;
    l.name = x.text("name"), l.line = x.line();
    if (const auto i = x.child("inertial"))
      l.inertial = inertial(*i);
    else
      l.inertial = usual_body(x);
    for (const auto& s : x.children("visual")) l.visuals.push_back(shape(s));
    for (const auto& s : x.children("collision")) l.collisions.push_back(shape(s));
    d_.links.push_back(std::move(l));
  }
  static rigid_body<> usual_body(const xml_item& x) {
    x.warn("has no <inertial>: it has 1 kg and 1 kg m^2, as SDF says then");
    return {1, {}, {1, 0, 0, 1, 0, 1}};
  }
  rigid_body<> inertial(const xml_item& x) {
    x.only({"mass", "inertia", "pose"}, {});
    rigid_body<> b{child_number(x, "mass", 1), {}, {1, 0, 0, 1, 0, 1}};
    if (!(b.mass >= 0)) x.fail("mass must not be negative, got " + number(b.mass));
    if (const auto i = x.child("inertia")) {
      i->only({"ixx", "ixy", "ixz", "iyy", "iyz", "izz"}, {});
      b.inertia = {child_number(*i, "ixx", 1), child_number(*i, "ixy", 0), child_number(*i, "ixz", 0),
                   child_number(*i, "iyy", 1), child_number(*i, "iyz", 0), child_number(*i, "izz", 1)};
    }
    return moved_body(sdf_pose(x, options_), b);
  }
  robot_shape shape(const xml_item& x) {
    using form = robot_shape::form;
    x.only({"pose", "geometry", "material"}, {"name"});
    robot_shape s;
    s.name = x.text_or("name", ""), s.line = x.line(), s.origin = sdf_pose(x, options_);
    const auto geometry = x.needed_child("geometry");
    geometry.only({"box", "cylinder", "sphere", "capsule", "ellipsoid", "plane", "mesh"}, {});
    for (const auto& g : geometry.children()) {
      if (g.name() == "box") s.is = form::box, s.size = child_vector(g, "size");
      if (g.name() == "ellipsoid") s.is = form::ellipsoid, s.size = child_vector(g, "radii");
      if (g.name() == "sphere") s.is = form::sphere, s.size = {child_number(g, "radius", 1), 0, 0};
      if (g.name() == "plane") s.is = form::plane;
      if (g.name() == "cylinder" || g.name() == "capsule") {
        s.is = g.name() == "capsule" ? form::capsule : form::cylinder;
        s.size = {child_number(g, "radius", 1), child_number(g, "length", 1), 0};
      }
      if (g.name() == "mesh") {
        s.is = form::mesh, s.mesh = child_text(g, "uri");
        if (g.child("scale")) s.scale = child_vector(g, "scale");
      }
    }
    if (const auto m = x.child("material"))
      if (const auto c = m->child("diffuse")) s.rgba = c->list_of(c->content(), "diffuse");
    return s;
  }

  void joint(const xml_item& x) {
    x.only({"parent", "child", "pose", "axis", "axis2"}, {"name", "type"});
    robot_joint j;
    j.name = x.text("name"), j.line = x.line();
    j.parent = child_text(x, "parent"), j.child = child_text(x, "child");
    const auto type = x.text("type");
    j.continuous = type == "continuous";
    const bool universal = type == "universal";
    if (type == "revolute" || type == "continuous" || universal)
      j.is = kind::revolute;
    else if (type == "prismatic")
      j.is = kind::prismatic;
    else if (type == "ball")
      j.is = kind::spherical;
    else if (type != "fixed")
      x.fail("type '" + excerpt(type) + "' is none of revolute, continuous, prismatic, fixed, ball, universal");
    j.origin = frames_.relative(x, j.parent, j.name);
    const auto child_pose = frames_.relative(x, j.name, j.child);
    const auto child = j.child;
    if (j.is == kind::revolute || j.is == kind::prismatic) axis(x.needed_child("axis"), j.name, j);
    if (!universal) {
      j.child_pose = child_pose;
      return d_.joints.push_back(std::move(j));
    }
    auto second = j;
    j.child = second.parent = child + ".cross", second.origin = {};
    d_.links.emplace_back().name = j.child, d_.links.back().line = j.line;
    second.name = j.name + "_2", second.child_pose = child_pose;
    axis(x.needed_child("axis2"), j.name, second);
    d_.joints.push_back(std::move(j)), d_.joints.push_back(std::move(second));
  }
  /// `frame` is that of the joint: universal joints are two.
  void axis(const xml_item& x, const std::string& frame, robot_joint& j) {
    x.only({"xyz", "limit", "dynamics"}, {});
    if (uses_parent_frame(x)) x.fail("use_parent_model_frame is not read: newer files have expressed_in");
    const auto n = x.needed_child("xyz");
    j.axis = unit_axis(n, n.three(n.list_of(n.content(), "xyz"), "xyz"));
    if (const auto in = n.text_or("expressed_in", ""); !in.empty())
      j.axis = frames_.relative(x, frame, in).rotation * j.axis;
    j.lower = -robot_joint::none, j.upper = j.rate = j.effort = robot_joint::none;
    if (const auto l = x.child("limit")) {
      l->only({"lower", "upper", "effort", "velocity"}, {});
      const auto bound = [](double b) { return std::abs(b) >= 1e16 ? std::copysign(robot_joint::none, b) : b; };
      const auto most = [](double b) { return b < 0 ? robot_joint::none : b; };  // -1 is none
      if (!j.continuous)
        j.lower = bound(child_limit(*l, "lower", -1e16)), j.upper = bound(child_limit(*l, "upper", 1e16));
      j.effort = most(child_limit(*l, "effort", -1)), j.rate = most(child_limit(*l, "velocity", -1));
      check_range(*l, j.lower, j.upper, "lower", "upper");
    }
    j.soft_lower = j.lower, j.soft_upper = j.upper;
    j.dynamics = {};
    if (const auto y = x.child("dynamics")) {
      y->only({"damping", "friction", "spring_reference", "spring_stiffness"}, {});
      j.dynamics = {child_number(*y, "damping", 0), child_number(*y, "friction", 0),
                    child_number(*y, "spring_stiffness", 0), child_number(*y, "spring_reference", 0), 0};
      if (j.dynamics.damping < 0 || j.dynamics.friction < 0 || j.dynamics.stiffness < 0)
        y->fail("damping, friction and stiffness must not be negative");
    }
  }
  static bool uses_parent_frame(const xml_item& x) {
    const auto f = x.child("use_parent_model_frame");
    return f && f->content() != "0" && f->content() != "false";
  }

  robot_description& d_;
  const robot_options& options_;
  xml_parser parse_;
  sdf_frames frames_;
};

}  // namespace kte::detail
