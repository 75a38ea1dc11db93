#pragma once

#include <kte/robots/description.hpp>

#include <numbers>

namespace kte::detail {

/// Volume V and moments of inertia per kilogram of a solid with half edges or half axes a, b, c, or with radius a and
/// half length b:
///   box        V = 8 a b c               (b^2 + c^2)/3 ...
///   ellipsoid  V = 4/3 pi a b c          (b^2 + c^2)/5 ...
///   cylinder   V = 2 pi a^2 b            a^2/4 + b^2/3 across, a^2/2 along
///   capsule    a cylinder and two half balls, whose centres are at the distance b from the centre:
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

}  // namespace kte::detail
