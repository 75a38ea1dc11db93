#pragma once

#include <kte/math/vec.hpp>

#include <charconv>
#include <cmath>
#include <string>

/// Numbers for people: few digits.
namespace kte_tool {

inline std::string short_number(double x) {
  if (std::isinf(x)) return x < 0 ? "-inf" : "inf";
  char text[40];
  return {text, std::to_chars(text, text + sizeof text, x == 0 ? 0.0 : x, std::chars_format::general, 5).ptr};
}
inline std::string short_vector(const kte::vec3<>& x) {
  return "(" + short_number(x.x) + ", " + short_number(x.y) + ", " + short_number(x.z) + ")";
}
/// "0.5 m large".
inline std::string size_text(double size) { return size > 0 ? short_number(size) + " m large" : "of unknown size"; }
/// "1 joint", "2 joints".
inline std::string counted(std::size_t n, const std::string& what) {
  return std::to_string(n) + " " + what + (n == 1 ? "" : "s");
}

inline std::string degrees_text(int dofs) {
  return std::to_string(dofs) + (dofs == 1 ? " degree of freedom" : " degrees of freedom");
}
inline std::string bodies_text(std::size_t n) { return n == 1 ? "1 body" : std::to_string(n) + " bodies"; }

}  // namespace kte_tool
