#pragma once

#include <kte/robots/detail/mjcf_tree.hpp>
#include <kte/robots/detail/physical.hpp>

namespace kte::detail {

/// A geom of MJCF: a shape, and the body that it is if there is no other.
struct mjcf_geom {
  robot_shape shape;
  bool collides = true;
  vec3<> half{};  ///< sizes as MJCF has them
};

/// Volume V and moments of inertia of one kilogram, for half sizes a, b, c or radius a and half length b:
///   box        V = 8 a b c               (b^2 + c^2)/3 ...
///   ellipsoid  V = 4/3 pi a b c          (b^2 + c^2)/5 ...
///   cylinder   V = 2 pi a^2 b            a^2/4 + b^2/3 across, a^2/2 along
///   capsule    the same and a ball, of which each half stands b away:
///              2/5 a^2 + b^2 + 3/4 a b across, 2/5 a^2 along                              (1)
inline std::pair<double, vec3<>> solid(robot_shape::form is, const vec3<>& half) {
  using form = robot_shape::form;
  const double a = half.x, b = half.y, c = half.z;
  const double ball = 4 * std::numbers::pi / 3;
  const auto of_three = [&](double k) { return vec3<>{k * (b * b + c * c), k * (c * c + a * a), k * (a * a + b * b)}; };
  if (is == form::box) return {8 * a * b * c, of_three(1.0 / 3)};
  if (is == form::ellipsoid) return {ball * a * b * c, of_three(1.0 / 5)};
  if (is == form::sphere) return {ball * a * a * a, {0.4 * a * a, 0.4 * a * a, 0.4 * a * a}};
  const double tube = 2 * std::numbers::pi * a * a * b, ends = is == form::capsule ? ball * a * a * a : 0;
  const double whole = tube + ends, t = whole > 0 ? tube / whole : 0, e = whole > 0 ? ends / whole : 0;
  const double across = t * (a * a / 4 + b * b / 3) + e * (0.4 * a * a + b * b + 0.75 * a * b);  // (1)
  return {whole, {across, across, t * (a * a / 2) + e * (0.4 * a * a)}};
}

/// The form and place of a geom. With `fromto` it reaches from one point to another.
inline mjcf_geom read_geom(const xml_item& x, const mjcf_scope& in) {
  using form = robot_shape::form;
  mjcf_geom g;
  auto& s = g.shape;
  s.name = x.has("name") ? in.named(x.text("name")) : "", s.line = x.line(), s.material = x.text_or("material", "");
  if (x.has("rgba")) s.rgba = x.list("rgba");
  g.collides = x.number_or("contype", 1) != 0 || x.number_or("conaffinity", 1) != 0;
  static const std::map<std::string, form, std::less<>> types{
      {"plane", form::plane},     {"hfield", form::none},         {"sphere", form::sphere},
      {"capsule", form::capsule}, {"ellipsoid", form::ellipsoid}, {"cylinder", form::cylinder},
      {"box", form::box},         {"mesh", form::mesh},           {"sdf", form::mesh}};
  const auto type = types.find(x.text_or("type", "sphere"));
  if (type == types.end()) x.fail("type '" + excerpt(x.text("type")) + "' is no type of geom");
  s.is = type->second, s.mesh = x.text_or("mesh", "");
  if (x.has("mesh") && s.is != form::mesh) return g;  // fitted to the mesh
  s.origin = in.model->settings.place(x);
  auto size = x.has("size") ? x.list("size") : std::vector<double>{};
  const bool round = s.is == form::capsule || s.is == form::cylinder;
  if (x.has("fromto")) {
    const auto f = x.list("fromto");
    if (f.size() != 6) x.fail("fromto must have six numbers, got " + std::to_string(f.size()));
    const vec3<> from{f[0], f[1], f[2]}, to{f[3], f[4], f[5]}, along = to - from;
    s.origin = {0.5 * (from + to), shortest_turn_of_z_to(unit_direction(x, along))};
    const double half = 0.5 * std::sqrt(dot(along, along)), r = size.empty() ? 0 : size[0];
    size = round ? std::vector<double>{r, half} : std::vector<double>{r, r, half};
  }
  const std::size_t needed = s.is == form::sphere                           ? 1
                             : round                                        ? 2
                             : s.is == form::box || s.is == form::ellipsoid ? 3
                                                                            : 0;
  if (size.size() < needed) x.fail("its size must have " + std::to_string(needed) + " numbers");
  size.resize(3);
  g.half = {size[0], size[1], size[2]};
  s.size = s.is == form::box ? 2.0 * g.half : round ? vec3<>{g.half.x, 2 * g.half.y, 0} : g.half;
  return g;
}

/// The body that a geom is, in axes of the link, from its mass or its density; of planes and fields none.
inline std::optional<rigid_body<>> body_of_geom(const xml_item& x, const mjcf_geom& g) {
  using form = robot_shape::form;
  if (g.shape.is == form::plane || g.shape.is == form::none) return {};
  if (x.text_or("shellinertia", "false") == "true") x.fail("shellinertia is not read: its body needs an <inertial>");
  const auto [volume, moments] = solid(g.shape.is, g.half);
  const double mass = x.has("mass") ? x.not_negative("mass") : volume * x.not_negative_or("density", 1000);
  if (!(mass > 0)) return {};
  return moved_body(g.shape.origin, {mass, {}, {mass * moments.x, 0, 0, mass * moments.y, 0, mass * moments.z}});
}

}  // namespace kte::detail
