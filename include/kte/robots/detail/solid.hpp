#pragma once

#include <kte/robots/description.hpp>

#include <cmath>
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

/// Area A and moments of inertia per kilogram of a shell with the same mass per area everywhere:
///   box        A = 8 (a b + b c + c a)   <y^2> + <z^2>, <x^2> = a^2 (1 + 2 s_x)/3, s_x = b c/(a b + b c + c a) the
///              share of the faces normal to x                               (2)
///   sphere     A = 4 pi a^2              2/3 a^2
///   cylinder   A = 4 pi a b + 2 pi a^2   side: a^2/2 + b^2/3 across, a^2 along; caps: a^2/4 + b^2, a^2/2
///   capsule    A = 4 pi a b + 4 pi a^2   side, and two half spheres: 2/3 a^2 + b^2 + a b across, 2/3 a^2 along
///   ellipsoid  A = 4 pi (((a b)^p + (b c)^p + (c a)^p)/3)^(1/p), p = 1.6075 (Thomsen, within 1.1 %), and, as in
///              MuJoCo, the moments of the thin layer up to the half axes a + e, b + e, c + e:
///              (b^2 + c^2)/5 + 2 a b c (b + c)/(5 (a b + b c + c a)) ...     (3)
inline std::pair<double, vec3<>> shell(robot_shape::form is, const vec3<>& half) {
  using form = robot_shape::form;
  const double a = half.x, b = half.y, c = half.z, pi = std::numbers::pi;
  const double sum = a * b + b * c + c * a;
  const auto ratio = [](double x, double y) { return y > 0 ? x / y : 0; };
  if (is == form::sphere) return {4 * pi * a * a, {2 * a * a / 3, 2 * a * a / 3, 2 * a * a / 3}};
  if (is == form::box) {
    const vec3<> share{ratio(b * c, sum), ratio(c * a, sum), ratio(a * b, sum)};
    const vec3<> square{a * a * (1 + 2 * share.x) / 3, b * b * (1 + 2 * share.y) / 3, c * c * (1 + 2 * share.z) / 3};
    return {8 * sum, {square.y + square.z, square.z + square.x, square.x + square.y}};  // (2)
  }
  if (is == form::ellipsoid) {
    const double p = 1.6075, mean = (std::pow(a * b, p) + std::pow(b * c, p) + std::pow(c * a, p)) / 3;
    const double k = ratio(2 * a * b * c, 5 * sum);
    const auto moment = [&](double x, double y) { return (x * x + y * y) / 5 + k * (x + y); };
    return {4 * pi * std::pow(mean, 1 / p), {moment(b, c), moment(c, a), moment(a, b)}};  // (3)
  }
  const bool capsule = is == form::capsule;
  const double side = 4 * pi * a * b, ends = (capsule ? 4 : 2) * pi * a * a, whole = side + ends;
  const double s = ratio(side, whole), e = ratio(ends, whole);
  const double across = s * (a * a / 2 + b * b / 3) + e * (capsule ? 2 * a * a / 3 + b * b + a * b : a * a / 4 + b * b);
  return {whole, {across, across, s * a * a + e * (capsule ? 2 * a * a / 3 : a * a / 2)}};
}

}  // namespace kte::detail
