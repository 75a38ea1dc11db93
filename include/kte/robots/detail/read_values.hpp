#pragma once

#include <kte/robots/detail/angles.hpp>
#include <kte/robots/detail/xml_item.hpp>
#include <kte/robots/options.hpp>

#include <algorithm>
#include <cstdio>
#include <unordered_set>

/// Reads values that several formats write alike.
namespace kte::detail {

inline std::string short_number(double x) {
  char text[40];
  std::snprintf(text, sizeof text, "%.3g", x);
  return text;
}

/// Throws `bad_argument` for numbers of the options that readers cannot use.
inline void check_options(const robot_options& o) {
  if (const double x = o.quarter_turn_tolerance; !(x >= 0 && x <= 0.1))
    raise<bad_argument>("kte: robot_options::quarter_turn_tolerance must be between 0 and 0.1 rad, got " + number(x));
  if (const double x = o.friction_smoothing; !(x > 0 && std::isfinite(x)))
    raise<bad_argument>("kte: robot_options::friction_smoothing must be finite and positive, got " + number(x));
}

/// The value of an attribute, which must be one of `words`; the first of them if the attribute is missing.
inline std::string keyword(const xml_item& x, const char* attribute, std::initializer_list<std::string_view> words) {
  auto word = x.text_or(attribute, std::string(*words.begin()).c_str());
  std::string all;
  for (const auto w : words) {
    if (w == word) return word;
    all.append(all.empty() ? "" : ", ").append(w);
  }
  x.fail(std::string(attribute) + " '" + excerpt(word) + "' is none of " + all);
}

/// The first child of a name; further ones give a warning.
inline std::optional<xml_item> first_child(const xml_item& x, const char* of) {
  const auto all = x.children(of);
  if (const auto again = all.second()) again->warn("occurs twice; the first is used");
  return all.first();
}

/// Warns of sizes of a shape that are negative.
inline void check_sizes(const xml_item& x, const robot_shape& s) {
  for (const double size : {s.size.x, s.size.y, s.size.z})
    if (size < 0) return x.warn("one of its sizes is negative: " + number(size));
}
/// The colour of an attribute or an element: three or four numbers; otherwise none, with a warning.
inline std::vector<double> colour_from(const xml_item& x, std::vector<double> rgba) {
  if (rgba.size() == 3 || rgba.size() == 4) return rgba;
  x.warn("its colour has " + std::to_string(rgba.size()) + " numbers, not four: it is not used");
  return {};
}

/// Frees joints that follow a joint that is not in the file, with a warning.
inline void free_followers(robot_description& d) {
  if (std::none_of(d.joints.begin(), d.joints.end(), [](const auto& j) { return j.mimic.has_value(); })) return;
  std::unordered_set<std::string_view> names;
  for (const auto& j : d.joints) names.insert(j.name);
  for (auto& j : d.joints) {
    if (!j.mimic || names.contains(j.mimic->joint)) continue;
    d.warnings.push_back({j.line,
                          "joint '" + excerpt(j.name) + "': it follows joint '" + excerpt(j.mimic->joint) +
                              "', which is not in the file: it moves freely",
                          j.file, true});
    j.mimic.reset();
  }
}
/// The unit vector along n.
inline vec3<> unit_direction(const xml_item& x, const vec3<>& n) {
  if (std::abs(dot(n, n) - 1) <= 4e-16) return {n.x + 0.0, n.y + 0.0, n.z + 0.0};  // written by this library: unchanged
  const double size = (std::max)({std::abs(n.x), std::abs(n.y), std::abs(n.z)});
  if (size == 0) x.fail("the axis has length 0");
  const vec3<> m{n.x / size, n.y / size, n.z / size};  // so that no square overflows
  const double root = std::sqrt(dot(m, m));
  return {m.x / root + 0.0, m.y / root + 0.0, m.z / root + 0.0};
}
/// The unit vector along n, with a warning if the length of n is not 1 to four digits, as rounded numbers have it.
inline vec3<> unit_axis(const xml_item& x, const vec3<>& n) {
  const double whole = std::hypot(n.x, n.y, n.z);
  if (std::abs(whole - 1) > 1e-3 && whole > 0)
    x.warn("the axis has length " + short_number(whole) + "; it is taken as 1");
  return unit_direction(x, n);
}

/// The rotation of a quaternion w, x, y, z of any length but 0. Quarter turns with rounded digits of sqrt(1/2) become
/// exact.
inline mat3<vec3<>> rotation_of_quaternion(const xml_item& x, const std::vector<double>& q) {
  if (q.size() != 4) x.fail("a quaternion must have four numbers, got " + std::to_string(q.size()));
  const double size = (std::max)({std::abs(q[0]), std::abs(q[1]), std::abs(q[2]), std::abs(q[3])});
  if (size == 0) x.fail("a quaternion of length 0 is not a rotation");
  auto m = matrix_of_any_length(unit_quaternion<>{q[0] / size, q[1] / size, q[2] / size, q[3] / size});
  for (auto* row : {&m.x, &m.y, &m.z})
    for (auto* entry : {&row->x, &row->y, &row->z})
      if (std::abs(*entry - std::round(*entry)) < 1e-15) *entry = std::round(*entry);
  return without_minus_zero(m);
}

inline void check_range(const xml_item& x, double lower, double upper, const char* low, const char* up) {
  if (!(lower <= upper)) x.fail(std::string(low) + " " + number(lower) + " is above " + up + " " + number(upper));
}

/// Warns about an angle that is more than a turn, and may be in degrees.
inline void note_many_turns(const xml_item& x, double angle) {
  if (std::abs(angle) > 6.3) x.warn("the angle " + number(angle) + " rad is more than a turn: is it in degrees?");
}
/// Warns about an angle that is nearly a quarter turn, but outside of the tolerance: one with few digits, not one that
/// is off by rounding errors.
inline void note_near_quarter(const xml_item& x, double angle, const robot_options& o) {
  const auto [count, off] = nearest_quarter(angle);
  if (off > 1e-10 && off < 1e-4 && count != 0 && off > o.quarter_turn_tolerance)
    x.warn("the angle " + number(angle) + " is " + short_number(count) + " quarter turns but for " + short_number(off) +
           " rad, and used unchanged: a larger robot_options::quarter_turn_tolerance makes it exact");
}

}  // namespace kte::detail
