#pragma once

#include <kte/robots/detail/mjcf_tree.hpp>
#include <kte/robots/detail/physical.hpp>
#include <kte/robots/detail/solid.hpp>

namespace kte::detail {

/// A geom of MJCF: its shape, its sizes, and whether it collides.
struct mjcf_geom {
  robot_shape shape;
  bool collides = true;
  vec3<> half{};  ///< sizes as MJCF defines them
};

/// The bit mask of an attribute, by default 1.
inline std::uint32_t contact_bits(const xml_item& x, const char* attribute) {
  return static_cast<std::uint32_t>(x.whole_or<std::int64_t>(attribute, 1, -2147483648.0, 4294967295.0));
}

/// Reads the form and pose of a geom. With `fromto` it extends from one point to another.
inline mjcf_geom read_geom(const xml_item& x, const mjcf_scope& in) {
  using form = robot_shape::form;
  mjcf_geom g;
  auto& s = g.shape;
  s.name = x.has("name") ? in.named(x.text("name")) : "", s.line = x.line(), s.material = x.text_or("material", "");
  if (x.has("rgba")) s.rgba = x.list("rgba");
  if (s.rgba.size() > 4) x.fail("rgba must have at most 4 numbers, got " + std::to_string(s.rgba.size()));
  g.collides = contact_bits(x, "contype") != 0 || contact_bits(x, "conaffinity") != 0;
  static const std::map<std::string, form, std::less<>> types{
      {"plane", form::plane},     {"hfield", form::none},         {"sphere", form::sphere},
      {"capsule", form::capsule}, {"ellipsoid", form::ellipsoid}, {"cylinder", form::cylinder},
      {"box", form::box},         {"mesh", form::mesh},           {"sdf", form::mesh}};
  const auto type = types.find(x.text_or("type", "sphere"));
  if (type == types.end()) x.fail("type '" + excerpt(x.text("type")) + "' is not a type of geom");
  s.is = type->second, s.mesh = x.text_or("mesh", "");
  if (x.has("mesh") && s.is != form::mesh) return g;  // fitted to the mesh
  s.origin = in.model->settings.place(x);
  auto size = x.has("size") ? x.completed_list("size", 3) : std::vector<double>{};
  if (size.size() > 3) x.fail("its size must have at most 3 numbers, got " + std::to_string(size.size()));
  const bool round = s.is == form::capsule || s.is == form::cylinder;
  if (x.has("fromto")) {
    if (!round && s.is != form::box && s.is != form::ellipsoid)
      x.fail("fromto is only for capsules, cylinders, ellipsoids and boxes");
    const auto f = x.list("fromto");
    if (f.size() != 6) x.fail("fromto must have six numbers, got " + std::to_string(f.size()));
    const vec3<> from{f[0], f[1], f[2]}, to{f[3], f[4], f[5]}, along = from - to;
    s.origin = {0.5 * (from + to), shortest_turn_of_z_to(unit_direction(x, along))};
    if (size.empty()) x.fail("has no size");
    const double half = 0.5 * std::sqrt(dot(along, along)), r = size[0];
    size = round ? std::vector<double>{r, half} : std::vector<double>{r, r, half};
  }
  const std::size_t needed = s.is == form::sphere                           ? 1
                             : round                                        ? 2
                             : s.is == form::box || s.is == form::ellipsoid ? 3
                                                                            : 0;
  if (size.size() < needed)
    x.fail("its size must have " + std::to_string(needed) + (needed == 1 ? " number" : " numbers"));
  size.resize(3);
  for (std::size_t i = 0; i < needed; ++i)
    if (!(size[i] >= 0)) x.fail("its size must not be negative, got " + number(size[i]));
  g.half = {size[0], size[1], size[2]};
  s.size = s.is == form::box ? 2.0 * g.half : round ? vec3<>{g.half.x, 2 * g.half.y, 0} : g.half;
  return g;
}

/// The rigid body of a geom in the axes of the link, from its mass or its density, of a shell in kg/m^2; none for
/// planes and height fields.
inline std::optional<rigid_body<>> body_of_geom(const xml_item& x, const mjcf_geom& g) {
  using form = robot_shape::form;
  if (g.shape.is == form::plane || g.shape.is == form::none) return {};
  const bool hollow = keyword(x, "shellinertia", {"false", "true"}) == "true";
  const auto [amount, moments] = hollow ? shell(g.shape.is, g.half) : solid(g.shape.is, g.half);
  const double mass = x.has("mass") ? x.not_negative("mass") : amount * x.not_negative_or("density", 1000);
  if (!std::isfinite(mass)) x.fail("its mass is not finite");
  if (!(mass > 0)) return {};
  return moved_body(g.shape.origin, {mass, {}, {mass * moments.x, 0, 0, mass * moments.y, 0, mass * moments.z}});
}

}  // namespace kte::detail
