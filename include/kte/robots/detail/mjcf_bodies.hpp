#pragma once

#include <kte/robots/detail/mjcf_geom.hpp>

namespace kte::detail {

/// Links and joints of a file in MJCF. The world is a link; a body without joints is fixed to what it is in.
class mjcf_bodies {
 public:
  mjcf_bodies(robot_description& d, const xml_item& root, const robot_options& o)
      : d_(d), root_(root), settings_(root, d, o) {}

  void read() {
    d_.name = root_.text_or("model", "");
    root_.only({"compiler", "default", "worldbody", "actuator", "option", "asset"}, {"model"});
    for (const auto& o : root_.children("option"))
      if (o.has("gravity")) d_.gravity = o.vector("gravity");
    d_.links.emplace_back().name = "world";
    for (const auto& w : root_.children("worldbody")) {
      d_.links[0].line = w.line();
      for (const auto& g : w.children("geom")) geom(g, "", 0, false);
      for (const auto& b : w.children("body")) body(b, "world", "");
      refuse_builders(w);
      w.only({"geom", "body"}, {});
    }
    for (const auto& a : root_.children("actuator"))
      for (const auto& x : a.children()) actuator(x);
  }

 private:
  using kind = robot_joint::kind;

  /// What makes further bodies: a robot without them would be another one.
  static void refuse_builders(const xml_item& x) {
    for (const auto* name : {"frame", "include", "replicate", "attach", "composite", "flexcomp"})
      if (const auto found = x.children(name); !found.empty()) found[0].fail("is not read: write the bodies out");
  }

  void body(const xml_item& x, const std::string& parent, std::string around) {
    x.only({"inertial", "joint", "freejoint", "geom", "body"},
           {"name", "pos", "quat", "axisangle", "euler", "xyaxes", "zaxis", "childclass"});
    refuse_builders(x);
    around = x.text_or("childclass", around.c_str());
    if (!around.empty() && !settings_.has_class(around)) x.fail("there is no default class '" + excerpt(around) + "'");
    const std::size_t index = d_.links.size();
    auto& l = d_.links.emplace_back();
    l.name = x.has("name") ? x.text("name") : "body" + std::to_string(index), l.line = x.line();
    const auto own = l.name;
    const auto inertial = x.child("inertial");
    const bool from_geoms = !inertial || settings_.always_from_geoms();
    if (!from_geoms) l.inertial = body_of(*inertial);
    for (const auto& g : x.children("geom")) geom(g, around, index, from_geoms);
    joints(x, parent, own, around);
    for (const auto& b : x.children("body")) body(b, own, around);
  }

  rigid_body<> body_of(const xml_item& x) {
    x.only({}, {"pos", "quat", "axisangle", "euler", "xyaxes", "zaxis", "mass", "diaginertia", "fullinertia"});
    rigid_body<> b{x.not_negative("mass"), {}, {}};
    if (x.has("fullinertia")) {
      const auto f = x.list("fullinertia");
      if (f.size() != 6) x.fail("fullinertia must have six numbers, got " + std::to_string(f.size()));
      b.inertia = {f[0], f[3], f[4], f[1], f[5], f[2]};  // from xx yy zz xy xz yz
    } else {
      const auto i = x.vector("diaginertia");
      b.inertia = {i.x, 0, 0, i.y, 0, i.z};
    }
    return moved_body(settings_.place(x), b);
  }

  void geom(const xml_item& written, const std::string& around, std::size_t link, bool counts) {
    const auto x = settings_.resolved(written, around);
    x.only({}, {"name", "class", "type", "pos", "quat", "axisangle", "euler", "xyaxes", "zaxis", "size", "fromto",
                "mass", "density", "mesh", "rgba", "material", "contype", "conaffinity"});
    const auto g = read_geom(x, settings_);
    auto& l = d_.links[link];
    if (counts && g.body) l.inertial = l.inertial ? together(*l.inertial, *g.body) : *g.body;
    if (counts && g.shape.is == robot_shape::form::mesh)
      x.fail("the mass of a mesh is not read: its body needs an <inertial>");
    l.visuals.push_back(g.shape);
    if (g.collides) l.collisions.push_back(g.shape);
  }

  /// Joints of one body act one after another: links in between, without mass.
  void joints(const xml_item& x, const std::string& parent, const std::string& own, const std::string& around) {
    std::vector<xml_item> all;
    for (const auto& c : x.children())
      if (c.name() == "freejoint" || c.name() == "joint") all.push_back(settings_.resolved(c, around));
    robot_pose place = settings_.place(x);
    std::string from = parent;
    if (all.empty()) {
      robot_joint j;
      j.name = own + "_fixed", j.line = x.line(), j.parent = from, j.child = own, j.origin = place;
      d_.joints.push_back(std::move(j));
    }
    for (std::size_t i = 0; i < all.size(); ++i) {
      const bool last = i + 1 == all.size();
      auto j = joint(all[i], own, i);
      j.parent = from, j.child = last ? own : own + "." + std::to_string(i + 1);
      if (j.is == kind::floating) {
        if (all.size() > 1 || parent != "world")
          all[i].fail("a free joint must be the only one of a body in the world");
        if (!is_nothing(place)) all[i].not_read("the pose of its body is where it starts, which is no part of a chain");
      } else {
        j.origin = place * j.origin;
      }
      if (!last) d_.links.emplace_back().name = j.child, d_.links.back().line = j.line;
      from = j.child, place = {};
      d_.joints.push_back(std::move(j));
    }
  }
  robot_joint joint(const xml_item& x, const std::string& own, std::size_t i) const {
    robot_joint j;
    j.line = x.line();
    j.name = x.has("name") ? x.text("name") : own + "_joint" + (i == 0 ? "" : std::to_string(i + 1));
    const auto type = x.name() == "freejoint" ? std::string("free") : x.text_or("type", "hinge");
    if (type == "free")
      j.is = kind::floating;
    else if (type == "hinge")
      j.is = kind::revolute;
    else if (type == "slide")
      j.is = kind::prismatic;
    else if (type == "ball")
      j.is = kind::spherical;
    else
      x.fail("type '" + excerpt(type) + "' is none of hinge, slide, ball, free");
    if (j.is == kind::floating) return x.only({}, {"name", "class", "type"}), j;
    x.only({}, {"name", "class", "type", "pos", "axis", "range", "limited", "damping", "frictionloss", "stiffness",
                "springref", "armature", "ref", "actuatorfrcrange", "actuatorfrclimited"});
    const bool turns = j.is == kind::revolute;
    const auto unit = [&](double a) { return j.is == kind::prismatic ? a : settings_.angle(a); };
    j.origin.position = x.vector_or("pos", {});
    j.child_pose.position = vec3<>{} - j.origin.position;
    j.dynamics = {x.not_negative_or("damping", 0), x.not_negative_or("frictionloss", 0),
                  x.not_negative_or("stiffness", 0), unit(x.number_or("springref", 0)),
                  x.not_negative_or("armature", 0)};
    if (j.is == kind::spherical) {
      if (x.has("range")) x.not_read("the range of a ball is not read");
      return j;
    }
    j.axis = unit_direction(x, x.vector_or("axis", {0, 0, 1}));
    const double ref = unit(x.number_or("ref", 0));  // the coordinate where the body stands as written
    if (ref != 0 && turns) {
      const auto [c, s] = turn_by(-ref, settings_.options().quarter_turn_tolerance);
      const robot_pose back{{}, without_minus_zero(as<double>(rotation_about(j.axis, c, s)))};
      j.child_pose = back * j.child_pose;
    } else if (ref != 0) {
      j.child_pose.position = j.child_pose.position - ref * j.axis;
    }
    const auto range = limits(x, "range", "limited");
    if (range) j.lower = unit(range->first), j.upper = unit(range->second);
    j.continuous = turns && !range;
    if (const auto force = limits(x, "actuatorfrcrange", "actuatorfrclimited"))
      j.effort = (std::max)(std::abs(force->first), std::abs(force->second));
    j.soft_lower = j.lower, j.soft_upper = j.upper;
    return j;
  }
  std::optional<std::pair<double, double>> limits(const xml_item& x, const char* range, const char* limited) const {
    const auto on = x.text_or(limited, "auto");
    if (on != "true" && !(on == "auto" && settings_.limits_by_range() && x.has(range))) return {};
    const auto r = x.list(range);
    if (r.size() != 2) x.fail(std::string(range) + " must have two numbers, got " + std::to_string(r.size()));
    check_range(x, r[0], r[1], "the lower end", "the upper");
    return std::pair{r[0], r[1]};
  }

  void actuator(const xml_item& written) {
    const auto x = settings_.resolved(written, "");
    if (!x.has("joint")) return x.not_read("acts on no joint, and is not read");
    const auto gear = x.has("gear") ? x.list("gear") : std::vector<double>{1};
    d_.actuators.push_back({x.text_or("name", ""), x.line(), x.text("joint"), gear.empty() ? 1 : gear[0]});
    x.only({}, {"name", "class", "joint", "gear"});
  }

  robot_description& d_;
  xml_item root_;
  mjcf_settings settings_;
};

}  // namespace kte::detail
