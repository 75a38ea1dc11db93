#pragma once

#include <kte/robots/detail/angles.hpp>
#include <kte/robots/detail/xml_item.hpp>
#include <kte/robots/options.hpp>

#include <algorithm>
#include <cstdio>

/// What several formats have alike.
namespace kte::detail {

inline std::string short_number(double x) {
  char text[40];
  std::snprintf(text, sizeof text, "%.3g", x);
  return text;
}

/// Of length 1, whatever its length in the file, of which a warning tells if it is not meant as 1.
inline vec3<> unit_axis(const xml_item& x, const vec3<>& n) {
  if (std::abs(dot(n, n) - 1) <= 4e-16) return {n.x + 0.0, n.y + 0.0, n.z + 0.0};  // written here, it stays as it is
  const double size = std::max({std::abs(n.x), std::abs(n.y), std::abs(n.z)});
  if (size == 0) x.fail("the axis has length 0");
  const vec3<> m{n.x / size, n.y / size, n.z / size};  // no square of it overflows
  const double root = std::sqrt(dot(m, m)), whole = root * size;
  if (std::abs(whole - 1) > 1e-6) x.warn("the axis has length " + short_number(whole) + "; it is taken as 1");
  return {m.x / root + 0.0, m.y / root + 0.0, m.z / root + 0.0};
}

inline void check_range(const xml_item& x, double lower, double upper, const char* low, const char* up) {
  if (!(lower <= upper)) x.fail(std::string(low) + " " + number(lower) + " is above " + up + " " + number(upper));
}

/// Says of angles that are nearly quarter turns, but not near enough to be taken for such.
inline void note_near_quarter(const xml_item& x, double angle, const robot_options& o) {
  const auto [count, off] = nearest_quarter(angle);
  if (off > 1e-14 && off < (count == 0 ? 1e-6 : 1e-4) && off > o.quarter_turn_tolerance)
    x.warn("the angle " + number(angle) + " is " + short_number(count) + " quarter turns but for " + short_number(off) +
           " rad, and taken as it is: a larger robot_options::quarter_turn_tolerance makes it exact");
}

}  // namespace kte::detail
