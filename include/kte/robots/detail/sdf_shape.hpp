#pragma once

#include <kte/robots/detail/physical.hpp>
#include <kte/robots/detail/sdf_values.hpp>
#include <kte/robots/detail/solid.hpp>

namespace kte::detail {

/// Warns of the <heightmap> of a collision, where contacts are requested.
inline void warn_of_height_map(const xml_item& x) {
  x.moves_differently("not read: the ground does not have this surface, but a plane");
}

/// Reads the shape of a <visual> or a <collision>, without its pose. `touches`: whether contacts of collisions are
/// read.
inline robot_shape sdf_shape(const xml_item& x, bool touches) {
  using form = robot_shape::form;
  x.only({"pose", "geometry", "material", "surface", "density"}, {"name"});
  robot_shape s;
  s.name = x.text_or("name", ""), s.line = x.line();
  if (const auto m = first_child(x, "material"))
    if (const auto c = filled_child(*m, "diffuse")) s.rgba = colour_from(*c, c->list_of(c->content(), "diffuse"));
  const auto geometry = first_child(x, "geometry");
  if (!geometry || geometry->children().empty()) {
    x.not_read(geometry ? "its <geometry> is empty" : "has no <geometry>");
    return s;
  }
  geometry->only({"box", "cylinder", "sphere", "capsule", "ellipsoid", "plane", "mesh", "empty", "heightmap",
                  "drake:capsule", "drake:ellipsoid"},
                 {});
  for (const auto& g : geometry->children()) {
    std::string_view of = g.name();
    if (of.starts_with("drake:")) of.remove_prefix(6);
    if (of == "box") s.is = form::box, s.size = child_vector(g, "size", {1, 1, 1});
    if (of == "sphere") s.is = form::sphere, s.size = {child_number(g, "radius", 1), 0, 0};
    if (of == "plane") s.is = form::plane;
    if (g.name() == "ellipsoid") s.is = form::ellipsoid, s.size = child_vector(g, "radii", {1, 1, 1});
    if (g.name() == "drake:ellipsoid")
      s.is = form::ellipsoid, s.size = {child_number(g, "a", 1), child_number(g, "b", 1), child_number(g, "c", 1)};
    if (of == "cylinder" || of == "capsule") {
      s.is = of == "capsule" ? form::capsule : form::cylinder;
      s.size = {child_number(g, "radius", of == "capsule" ? 0.5 : 1), child_number(g, "length", 1), 0};
    }
    if (of == "heightmap") {
      if (touches && x.name() == "collision")
        warn_of_height_map(g);
      else
        g.not_read("not read");
    }
    if (of == "mesh") {
      g.only({"uri", "scale"}, {});
      s.is = form::mesh, s.mesh = child_text(g, "uri"), s.scale = child_vector(g, "scale", {1, 1, 1});
    }
    check_sizes(g, s);
  }
  return s;
}

/// The rigid body of a collision shape with a density, in the axes of the link. Throws `bad_file` for shapes without
/// volume.
inline rigid_body<> sdf_solid(const xml_item& x, const robot_shape& s, double density) {
  using form = robot_shape::form;
  if (s.is == form::none || s.is == form::plane || s.is == form::mesh)
    x.fail(std::string(s.is == form::mesh    ? "meshes are"
                       : s.is == form::plane ? "planes are"
                                             : "its shape is") +
           " not read as bodies: the link needs its own <inertial> with mass and inertia");
  for (const double size : {s.size.x, s.is == form::sphere ? 1 : s.size.y})
    if (!(size > 0)) x.fail("its sizes must be positive to give a mass, got " + number(size));
  const bool round = s.is == form::cylinder || s.is == form::capsule;
  const vec3<> half = s.is == form::box ? 0.5 * s.size : round ? vec3<>{s.size.x, 0.5 * s.size.y, 0} : s.size;
  const auto [volume, moments] = solid(s.is, half);
  const double mass = density * volume;
  if (!(mass > 0)) x.fail("its sizes must be positive to give a mass");
  return moved_body(s.origin, {mass, {}, {mass * moments.x, 0, 0, mass * moments.y, 0, mass * moments.z}});
}

}  // namespace kte::detail
