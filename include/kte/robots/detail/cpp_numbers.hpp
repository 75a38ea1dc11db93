#pragma once

#include <kte/contract/record.hpp>
#include <kte/math/axis.hpp>

#include <array>
#include <charconv>
#include <cmath>
#include <limits>
#include <optional>
#include <span>

/// Numbers of records as C++: the shortest digits that give the same doubles; vectors and rotations of exact zeros and
/// ones become typed constants. Names are fully qualified, so that no other name hides them.
namespace kte::detail {

/// "0.36", "2.0", "-::std::numeric_limits<double>::infinity()"
inline std::string cpp_number(double x) {
  if (std::isinf(x)) return std::string(x < 0 ? "-" : "") + "::std::numeric_limits<double>::infinity()";
  char digits[40];
  std::string s(digits, std::to_chars(digits, digits + sizeof digits, x).ptr);
  if (s.find_first_of(".en") == std::string::npos) s += ".0";
  return s;
}
/// An entry of a vector or matrix.
inline std::string cpp_entry(double x) {
  return x == 0 ? "::kte::zero" : x == 1 ? "::kte::one" : x == -1 ? "::kte::minus_one" : cpp_number(x);
}
/// "{a, b, c}" of numbers or entries.
template <class Text>
std::string cpp_list(std::span<const double> values, const Text& text) {
  std::string s = "{";
  for (const double x : values) s.append(s.size() > 1 ? ", " : "").append(text(x));
  return s + "}";
}

/// axis::x, axis::minus_y, ...
inline std::optional<std::string> cpp_axis(std::span<const double> v) {
  static constexpr std::array names{"x", "y", "z"};
  for (std::size_t i = 0; i < 3; ++i)
    if (std::abs(v[i]) == 1 && v[(i + 1) % 3] == 0 && v[(i + 2) % 3] == 0)
      return std::string("::kte::axis::") + (v[i] < 0 ? "minus_" : "") + names[i];
  return {};
}
inline std::string cpp_vector(std::span<const double> v) {
  if (v[0] == 0 && v[1] == 0 && v[2] == 0) return "::kte::zero3{}";
  if (const auto name = cpp_axis(v)) return *name;
  for (std::size_t i = 0; i < 3; ++i)
    if (v[(i + 1) % 3] == 0 && v[(i + 2) % 3] == 0)
      return std::string("::kte::along_") + "xyz"[i] + "(" + cpp_number(v[i]) + ")";
  return "::kte::vec3" + cpp_list(v, cpp_entry);
}
/// The entries xx xy xz yy yz zz; zeros are typed, but never ones: inertias are measured.
inline std::string cpp_symmetric(std::span<const double> v) {
  const auto entry = [](double x) { return x == 0 ? std::string("::kte::zero") : cpp_number(x); };
  if (v[1] == 0 && v[2] == 0 && v[4] == 0)
    return "::kte::diagonal(" + entry(v[0]) + ", " + entry(v[3]) + ", " + entry(v[5]) + ")";
  return "::kte::sym3" + cpp_list(v, entry);
}
inline std::string cpp_matrix(std::span<const double> v) {
  std::string s = "::kte::mat3{";
  for (std::size_t row = 0; row < 3; ++row) {
    const auto r = v.subspan(3 * row, 3);
    s.append(row == 0 ? "" : ", ").append(cpp_axis(r).value_or("::kte::vec3" + cpp_list(r, cpp_entry)));
  }
  return s + "}";
}

/// A typed rotation, by its name or as a product of two, if it is one.
inline std::optional<std::string> cpp_turn(std::span<const double> v) {
  struct named {
    const char* name;
    mat3<vec3<>> turn;
  };
  static const std::array all{named{"::kte::quarter_turn_x", as<double>(quarter_turn_x)},
                              named{"::kte::quarter_turn_y", as<double>(quarter_turn_y)},
                              named{"::kte::quarter_turn_z", as<double>(quarter_turn_z)},
                              named{"::kte::half_turn_x", as<double>(half_turn_x)},
                              named{"::kte::half_turn_y", as<double>(half_turn_y)},
                              named{"::kte::half_turn_z", as<double>(half_turn_z)},
                              named{"::kte::minus_quarter_turn_x", as<double>(minus_quarter_turn_x)},
                              named{"::kte::minus_quarter_turn_y", as<double>(minus_quarter_turn_y)},
                              named{"::kte::minus_quarter_turn_z", as<double>(minus_quarter_turn_z)}};
  const mat3<vec3<>> m{{v[0], v[1], v[2]}, {v[3], v[4], v[5]}, {v[6], v[7], v[8]}};
  if (m == as<double>(matrix(no_rotation{}))) return "::kte::no_rotation{}";
  for (const auto& a : all)
    if (m == a.turn) return a.name;
  for (const auto& a : all)
    for (const auto& b : all)
      if (m == a.turn * b.turn) return std::string(a.name) + " * " + b.name;
  return {};
}
inline std::string cpp_rotation(std::span<const double> v) { return cpp_turn(v).value_or(cpp_matrix(v)); }
/// A rotation in the plane.
inline std::string cpp_plane_rotation(std::span<const double> v) {
  const double c = v[0], s = v[3];
  if (c == 1 && s == 0) return "::kte::no_rotation{}";
  if (c == -1 && s == 0) return "::kte::half_turn";
  if (c == 0 && std::abs(s) == 1) return s > 0 ? "::kte::quarter_turn" : "::kte::minus_quarter_turn";
  return "::kte::rotation_2D{" + cpp_number(c) + ", " + cpp_number(s) + "}";
}

/// A body from the parameters mass, com and inertia.
inline std::string cpp_body(double mass, std::span<const double> com, std::span<const double> inertia, bool in_plane) {
  const bool at_origin = com[0] == 0 && com[1] == 0 && com[2] == 0;
  const std::string at = at_origin ? "" : ", " + cpp_vector(com);
  bool is_point = true;
  for (const double x : inertia) is_point &= x == 0;
  if (is_point) return "::kte::point_mass(" + cpp_number(mass) + at + ")";
  if (in_plane) return "::kte::planar_body(" + cpp_number(mass) + ", " + cpp_number(inertia[5]) + at + ")";
  return "::kte::rigid_body{" + cpp_number(mass) + ", " + cpp_vector(com) + ", " + cpp_symmetric(inertia) + "}";
}

}  // namespace kte::detail
