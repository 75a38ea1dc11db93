#pragma once

#include <kte/contact/shape_points.hpp>
#include <kte/robots/detail/angles.hpp>

#include <cmath>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

namespace kte::detail {

/// A part of a shape that touches surfaces: a sphere of a radius r >= 0 about a point, or the rim of a disc normal to
/// an axis; in axes of the link, m.
struct touching_part {
  std::string name;  ///< such as "/corner 3"; empty for a single part
  vec3<> at{};
  double radius = 0;
  std::optional<vec3<>> axis{};  ///< of a rim
};
/// The parts of a sphere, capsule, box or cylinder. The rims of a cylinder are circles, or that many points.
inline std::vector<touching_part> touching_parts(const robot_shape& s, int rim_points) {
  using form = robot_shape::form;
  const auto at = [&s](const vec3<>& p) { return as<double>(s.origin.position + s.origin.rotation * p); };
  std::vector<touching_part> all;
  const auto add = [&](const std::string& name, const vec3<>& p, double radius) {
    all.push_back({name, at(p), radius});
  };
  const auto numbered = [](const char* what, std::size_t k) {
    return std::string("/") + what + " " + std::to_string(k + 1);
  };
  const auto ends = ends_of({0, 0, s.size.y / 2});
  if (s.is == form::sphere) add("", {}, s.size.x);
  if (s.is == form::capsule)
    for (std::size_t k = 0; k < 2; ++k) add(numbered("end", k), ends[k], s.size.x);
  if (s.is == form::box) {
    const auto corners = corners_3D(0.5 * s.size);
    for (std::size_t k = 0; k < 8; ++k) add(numbered("corner", k), corners[k], 0);
  }
  if (s.is != form::cylinder) return all;
  for (std::size_t k = 0; k < 2; ++k) {
    if (rim_points == 0) {
      add(numbered("rim", k), ends[k], s.size.x);
      all.back().axis = as<double>(s.origin.rotation * vec3<>{0, 0, 1});
    }
    for (int i = 0; i < rim_points; ++i) {
      const double angle = 2 * std::numbers::pi * i / rim_points;
      add(numbered("rim", k) + " point " + std::to_string(i + 1),
          ends[k] + vec3<>{s.size.x * std::cos(angle), s.size.x * std::sin(angle), 0}, 0);
    }
  }
  return all;
}

}  // namespace kte::detail
