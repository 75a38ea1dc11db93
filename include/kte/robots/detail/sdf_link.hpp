#pragma once

#include <kte/robots/detail/sdf_frames.hpp>
#include <kte/robots/detail/sdf_leftovers.hpp>
#include <kte/robots/detail/sdf_shape.hpp>
#include <kte/robots/detail/sdf_surface.hpp>

namespace kte::detail {

/// Reads the links of a model in SDF.
class sdf_links {
 public:
  sdf_links(const robot_options& o, const sdf_frames& f, sdf_leftovers& l) : options_(o), frames_(f), leftovers_(l) {}

  /// Reads the link of this full name. A static link needs no body.
  robot_link read(const xml_item& x, const sdf_scope& scope, const std::string& name, bool stands, bool windy) {
    look_for_interruption();
    x.only({"inertial", "visual", "collision", "pose", "gravity", "velocity_decay", "kinematic", "enable_wind",
            "plugin", "drake:deformable_properties"},
           {"name"});
    robot_link l;
    l.name = name, l.line = x.line(), l.file = x.file();
    for (const auto& s : x.children("visual")) l.visuals.push_back(shape(s, scope, name));
    for (const auto& s : x.children("collision")) l.collisions.push_back(shape(s, scope, name));
    const auto collisions = x.children("collision").list();
    for (std::size_t i = 0; i < collisions.size(); ++i)
      if (const auto s = first_child(collisions[i], "surface"); s && !s->children().empty())
        options_.contacts.requested() ? read_sdf_surface(*s, l.collisions[i].touch, leftovers_.contacts)
                                      : leftovers_.surface(*s);
    if (stands) return l;
    l.inertial = body(x, scope, l);
    if (!child_flag(x, "gravity", true)) l.gravity_compensation = 1;
    motion(x, windy);
    return l;
  }

 private:
  robot_pose in_link(const xml_item& x, const sdf_scope& scope, const std::string& link) const {
    const auto pose = sdf_pose(x, options_);
    const auto to = relative_to(x);
    return to.empty() ? pose : frames_.relative(x, link, frames_.find(x, scope, to)) * pose;
  }

  rigid_body<> body(const xml_item& x, const sdf_scope& scope, const robot_link& l) const {
    const auto i = first_child(x, "inertial");
    if (!i) {
      x.warn("has no <inertial>: it has 1 kg and 1 kg m^2, the defaults of SDF");
      return {1, {}, {1, 0, 0, 1, 0, 1}};
    }
    i->only({"mass", "inertia", "pose", "density", "auto_inertia_params"}, {"auto"});
    for (const auto& a : i->children("fluid_added_mass")) a.moves_differently("not read");
    if (flag(*i, i->text_or("auto", "false"))) return solids(x, *i, l);
    rigid_body<> b{child_number(*i, "mass", 1), {}, {1, 0, 0, 1, 0, 1}};
    if (!(b.mass >= 0)) i->fail("mass must not be negative, got " + number(b.mass));
    if (const auto m = first_child(*i, "inertia")) {
      m->only({"ixx", "ixy", "ixz", "iyy", "iyz", "izz"}, {});
      b.inertia = {child_number(*m, "ixx", 1), child_number(*m, "ixy", 0), child_number(*m, "ixz", 0),
                   child_number(*m, "iyy", 1), child_number(*m, "iyz", 0), child_number(*m, "izz", 1)};
    } else {
      i->warn("has no <inertia>: it has 1 kg m^2, the default of SDF");
    }
    return moved_body(in_link(*i, scope, l.name), b);
  }
  /// The rigid body of the collision shapes by their densities, scaled to the mass if one is given.
  rigid_body<> solids(const xml_item& x, const xml_item& inertial, const robot_link& l) const {
    const auto shapes = x.children("collision").list();
    if (shapes.empty()) inertial.fail("its inertia is that of its collisions, but the link has none");
    const double usual = density(inertial, 1000);
    rigid_body<> b{};
    for (std::size_t i = 0; i < shapes.size(); ++i)
      b = together(b, sdf_solid(shapes[i], l.collisions[i], density(shapes[i], usual)));
    const double mass = child_number(inertial, "mass", b.mass);
    if (!(mass > 0 && b.mass > 0))
      inertial.fail("its mass must be positive, got " + number(b.mass > 0 ? mass : b.mass));
    const double k = mass / b.mass;
    const auto& j = b.inertia;
    return {mass, b.com, {k * j.xx, k * j.xy, k * j.xz, k * j.yy, k * j.yz, k * j.zz}};
  }
  static double density(const xml_item& x, double other) {
    const double d = child_number(x, "density", other);
    if (!(d > 0)) x.fail("density must be positive, got " + number(d));
    return d;
  }

  static void motion(const xml_item& x, bool windy) {
    if (const auto k = first_child(x, "kinematic"); k && child_flag(x, "kinematic", false))
      k->moves_differently("not read: it is moved by an unsupported element");
    if (const auto v = first_child(x, "velocity_decay");
        v && (child_number(*v, "linear", 0) != 0 || child_number(*v, "angular", 0) != 0))
      v->moves_differently("not read");
    if (const auto w = first_child(x, "enable_wind"); w && child_flag(x, "enable_wind", false)) {
      if (windy)
        w->moves_differently("the wind is not modelled");
      else
        w->not_read("not read");
    }
    for (const auto& p : x.children("drake:deformable_properties")) p.moves_differently("not read: it is a rigid body");
  }

  robot_shape shape(const xml_item& x, const sdf_scope& scope, const std::string& link) const {
    auto s = sdf_shape(x, options_.contacts.requested());
    s.origin = in_link(x, scope, link);
    if (s.is == robot_shape::form::plane) s.origin = s.origin * robot_pose{{}, turn_of_z_to(plane_normal(x))};
    return s;
  }

  const robot_options& options_;
  const sdf_frames& frames_;
  sdf_leftovers& leftovers_;
};

}  // namespace kte::detail
