#pragma once

#include <kte/view/svg/mechanism/options.hpp>
#include <kte/view/svg/mechanism/scene_motion.hpp>
#include <kte/view/svg/mechanism/scene_view.hpp>
#include <kte/view/svg/mechanism/styles.hpp>

#include <set>

/// Fixed parts of a picture of a mechanism: the ground, the scale.
namespace kte::detail::svg {

/// Frames on the ground: frames at rest from which a joint or force starts, and that no link holds.
inline std::set<int> grounded_frames(const scene_motion& motion) {
  const scene& s = motion.of();
  std::set<int> all, held;
  const auto add = [&](int f) {
    if (motion.rests(f)) all.insert(f);
  };
  for (const auto& l : s.links) {
    add(l.from);
    if (motion.rests(l.to)) held.insert(l.to);
  }
  for (const auto& j : s.joints)
    if (j.kind != "free") add(j.before);
  for (const auto& f : s.forces)
    if (f.frames.size() >= 2)
      for (const int i : f.frames) add(i);
  for (const int f : held) all.erase(f);
  return all;
}

/// A line with hatching below, in mm; a triangle connects it to the joint.
inline std::vector<drawn_shape> ground_symbol(picture_point at, double radius) {
  const double half = 2.4 * radius, y = at.y + 1.9 * radius;
  std::vector<drawn_shape> all{{styles::ground, "ground", {{at.x - 1.1 * radius, y}, at, {at.x + 1.1 * radius, y}}},
                               {styles::ground, "ground", {{at.x - half, y}, {at.x + half, y}}}};
  for (int i = 0; i < 6; ++i) {
    const double x = at.x - half + (i + 0.6) * half / 3;
    all.push_back({styles::hatch, "ground", {{x, y}, {x - 0.7 * radius, y + 0.8 * radius}}});
  }
  return all;
}

/// A length with one digit, 1, 2 or 5, close to a number of m, as text with a unit.
struct round_length {
  double metres;
  std::string text;
};
inline round_length round_length_of(double metres) {
  const int power = static_cast<int>(std::floor(std::log10(metres)));
  const double digit = metres / std::pow(10, power);
  const int whole = digit >= 5 ? 5 : digit >= 2 ? 2 : 1;
  const auto text = [&](int to_unit, const char* unit) {
    const int zeros = power + to_unit;
    return std::to_string(whole) + std::string(static_cast<std::size_t>(zeros), '0') + " " + unit;
  };
  const double rounded = whole * std::pow(10, power);
  if (power >= 0 && power < 3) return {rounded, text(0, "m")};
  if (power >= 3 && power < 7) return {rounded, text(-3, "km")};
  if (power < 0 && power >= -1) return {rounded, "0." + std::to_string(whole) + " m"};
  if (power < -1 && power >= -3) return {rounded, text(3, "mm")};
  return {rounded, std::to_string(whole) + "e" + std::to_string(power) + " m"};
}

}  // namespace kte::detail::svg
