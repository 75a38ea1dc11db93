#pragma once

#include <kte/robots/detail/contact_leftovers.hpp>
#include <kte/robots/detail/read_values.hpp>

#include <map>
#include <unordered_map>

namespace kte::detail {

/// Reads the links of a URDF.
class urdf_links {
 public:
  urdf_links(robot_description& d, const robot_options& o) : d_(d), options_(o) {}

  robot_pose origin(const xml_item& owner) const {
    const auto x = owner.child("origin");
    if (!x) return {};
    x->only({}, {"xyz", "rpy"});
    return pose(*x);
  }
  /// The pose of the attributes xyz and rpy.
  robot_pose pose(const xml_item& x) const {
    const vec3<> rpy = x.vector_or("rpy", {});
    for (const double angle : {rpy.x, rpy.y, rpy.z}) note_near_quarter(x, angle, options_), note_many_turns(x, angle);
    return {x.vector_or("xyz", {}), rotation_of_rpy(rpy, options_.quarter_turn_tolerance)};
  }

  void material(const xml_item& x) {
    x.only({"color", "texture"}, {"name"});
    const auto c = x.child("color");
    if (x.child("texture")) x.child("texture")->not_read("not read");
    const auto [known, fresh] =
        colours_.emplace(x.text("name"), c ? colour_from(*c, c->list("rgba")) : std::vector<double>{});
    if (!fresh && c && known->second.empty())
      known->second = colour_from(*c, c->list("rgba"));
    else if (!fresh && c && known->second != c->list("rgba"))
      x.not_read("there is another material of this name; the first is used");
  }

  void read(const xml_item& x) {
    look_for_interruption();
    robot_link l;
    l.name = x.text("name"), l.line = x.line(), l.file = x.file();
    x.only({"inertial", "visual", "collision", "contact", "gravity", "kinematic"}, {"name", "type"});
    if (const auto i = first_child(x, "inertial")) l.inertial = inertial(*i);
    for (const auto& s : x.children("visual")) l.visuals.push_back(shape(s));
    for (const auto& s : x.children("collision")) l.collisions.push_back(shape(s));
    if (options_.contacts.requested())
      for (const auto& c : x.children("contact")) contact(c, l);
    for (const auto* name : {"gravity", "kinematic"})
      for (const auto& g : x.children(name)) g.moves_differently("not read, as URDF has no such element");
    d_.links.push_back(std::move(l));
  }
  /// Sets the frictions of the collision shapes of links, by name.
  void rub(const std::unordered_map<std::string, double>& frictions) {
    for (auto& l : d_.links)
      if (const auto f = frictions.find(l.name); f != frictions.end())
        for (auto& s : l.collisions) s.touch.friction = f->second;
  }
  void warn_of_contacts() const { leftovers_.warn(); }
  /// Collects the colours of named materials.
  void colour() {
    for (auto& l : d_.links)
      for (auto* shapes : {&l.visuals, &l.collisions})
        for (auto& s : *shapes)
          if (const auto c = colours_.find(s.material); s.rgba.empty() && c != colours_.end()) s.rgba = c->second;
  }

 private:
  /// Reads the properties of contact that Bullet has for a link.
  void contact(const xml_item& x, robot_link& l) {
    for (const auto& c : x.children())
      for (auto& s : l.collisions)
        if (c.name() == "lateral_friction")
          s.touch.friction = c.not_negative("value");
        else if (c.name() == "restitution")
          s.touch.restitution = c.not_negative("value");
        else
          leftovers_.add(x, c.name());
  }
  rigid_body<> inertial(const xml_item& x) const {
    x.only({"origin", "mass", "inertia"}, {});
    rigid_body<> b{};
    if (const auto mass = x.child("mass")) {
      mass->only({}, {"value"});
      b.mass = mass->not_negative("value");
    } else {
      x.warn("has no <mass>: it has 0 kg");
    }
    if (const auto i = first_child(x, "inertia")) {
      i->only({}, {"ixx", "ixy", "ixz", "iyy", "iyz", "izz"});
      for (const auto* product : {"ixy", "ixz", "iyz"})
        if (!i->has(product)) i->warn(std::string("has no ") + product + ": it is 0");
      b.inertia = {i->number("ixx"), i->number_or("ixy", 0), i->number_or("ixz", 0),
                   i->number("iyy"), i->number_or("iyz", 0), i->number("izz")};
    } else {
      x.warn("has no <inertia>: it is a point mass");
    }
    return moved_body(origin(x), b);
  }
  robot_shape shape(const xml_item& x) {
    x.only({"origin", "geometry", "material"}, {"name"});
    robot_shape s;
    s.name = x.text_or("name", ""), s.line = x.line(), s.origin = origin(x);
    if (const auto geometry = x.child("geometry"))
      form(*geometry, s);
    else
      x.not_read("has no <geometry>");
    const auto materials = x.children("material").list();
    for (std::size_t i = 1; i < materials.size(); ++i) materials[i].not_read("occurs twice; the first is used");
    if (materials.empty()) return s;
    const auto& m = materials[0];
    s.material = m.text_or("name", "");
    if (const auto c = m.child("color")) s.rgba = colour_from(*c, c->list("rgba"));
    if (!s.rgba.empty() && !s.material.empty()) colours_.emplace(s.material, s.rgba);
    return s;
  }
  static void form(const xml_item& x, robot_shape& s) {
    using form = robot_shape::form;
    x.only({"box", "cylinder", "sphere", "capsule", "plane", "mesh", "drake:capsule", "drake:ellipsoid"}, {});
    if (x.children().empty()) x.not_read("is empty");
    for (const auto& g : x.children()) {
      std::string_view of = g.name();
      if (of.starts_with("drake:")) of.remove_prefix(6);
      if (of == "box") s.is = form::box, s.size = g.vector("size");
      if (of == "sphere") s.is = form::sphere, s.size = {g.number("radius"), 0, 0};
      if (of == "plane") s.is = form::plane;
      if (of == "ellipsoid") s.is = form::ellipsoid, s.size = {g.number("a"), g.number("b"), g.number("c")};
      if (of == "cylinder" || of == "capsule") {
        s.is = of == "capsule" ? form::capsule : form::cylinder;
        s.size = {g.number("radius"), g.number("length"), 0};
      }
      if (of == "mesh") s.is = form::mesh, s.mesh = g.text("filename"), s.scale = scale(g);
      check_sizes(g, s);
    }
  }
  static vec3<> scale(const xml_item& mesh) {
    if (!mesh.has("scale")) return {1, 1, 1};
    auto x = mesh.list("scale");
    if (x.size() > 3) {
      mesh.warn("scale has " + std::to_string(x.size()) + " numbers; the first three are used");
      x.resize(3);
    }
    if (x.size() != 1) return mesh.three(x, "scale");
    mesh.warn("scale is one number; it is used for all three directions");
    return {x[0], x[0], x[0]};
  }

  robot_description& d_;
  const robot_options& options_;
  contact_leftovers leftovers_;
  std::map<std::string, std::vector<double>, std::less<>> colours_;  ///< by material
};

}  // namespace kte::detail
