#pragma once

#include <kte/detail/compiled.hpp>
#include <kte/robots/detail/triangle_mesh.hpp>

#include <string>

namespace kte::detail {

/// Throws `bad_argument` unless all numbers are finite and all indices are valid.
void check_mesh(const triangle_mesh& mesh);

/// Describes an edge where the surface is open or its faces are oriented differently: more faces run along the edge in
/// one direction than in the other. Empty for closed surfaces. Vertices at the same position count as one.
std::string open_edge(const triangle_mesh& mesh);

/// Whether a surface is closed and that of a convex body, so that it is its own convex hull, found from its edges in
/// the time of sorting them: all faces see their mean corner c on their inner side, and cover the directions from c
/// once, so that the surface is simple; then it is convex if no edge is concave. Concave edges that rounding makes are
/// accepted: none is deeper than 1e-6 of the largest distance R from c, and the sum of their lengths times their
/// angles, which bounds the depth of dents, is at most 0.01 V/R^2, so that the hull has at most 1 % more volume than V.
bool is_convex(const triangle_mesh& mesh);

}  // namespace kte::detail

#ifdef KTE_FUNCTION
#  include <kte/errors.hpp>

#  include <algorithm>
#  include <cmath>
#  include <numbers>
#  include <tuple>

namespace kte::detail {

KTE_FUNCTION void check_mesh(const triangle_mesh& mesh) {
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
    const auto& v = mesh.vertices[i];
    if (!std::isfinite(v.x) || !std::isfinite(v.y) || !std::isfinite(v.z))
      raise<bad_argument>("kte: vertex " + std::to_string(i) + " of the mesh is not finite");
  }
  for (std::size_t i = 0; i < mesh.faces.size(); ++i)
    for (const auto index : mesh.faces[i])
      if (index >= mesh.vertices.size())
        raise<bad_argument>("kte: index " + std::to_string(index) + " of face " + std::to_string(i) +
                            " is out of range: the mesh has " + std::to_string(mesh.vertices.size()) + " vertices");
}

/// A side of a face: its ends in order, whether it runs from the lower one (1) or to it (-1), and its number, 3 times
/// that of the face and the place of its first corner.
struct mesh_side {
  using place = std::array<double, 3>;
  place low, high;
  int direction;
  std::size_t number;

  bool is_at(const mesh_side& s) const { return low == s.low && high == s.high; }
};
inline std::vector<mesh_side> sorted_sides(const triangle_mesh& mesh) {
  check_mesh(mesh);
  const auto at = [&](std::uint32_t i) {
    const auto& v = mesh.vertices[i];
    return mesh_side::place{v.x + 0.0, v.y + 0.0, v.z + 0.0};
  };
  std::vector<mesh_side> sides;
  sides.reserve(3 * mesh.faces.size());
  for (std::size_t i = 0; i < 3 * mesh.faces.size(); ++i) {
    const auto a = at(mesh.faces[i / 3][i % 3]), b = at(mesh.faces[i / 3][(i + 1) % 3]);
    if (a != b) sides.push_back(a < b ? mesh_side{a, b, 1, i} : mesh_side{b, a, -1, i});
  }
  const auto ends = [](const mesh_side& s) { return std::tie(s.low, s.high); };
  std::sort(sides.begin(), sides.end(), [&](const auto& s, const auto& t) { return ends(s) < ends(t); });
  return sides;
}

KTE_FUNCTION std::string open_edge(const triangle_mesh& mesh) {
  const auto sides = sorted_sides(mesh);
  for (std::size_t i = 0; i < sides.size();) {
    const auto& s = sides[i];
    int count = 0;
    for (; i < sides.size() && sides[i].is_at(s); ++i) count += sides[i].direction;
    const auto text = [](const auto& p) { return number(p[0]) + " " + number(p[1]) + " " + number(p[2]); };
    if (count != 0) return "the edge from " + text(s.low) + " to " + text(s.high) + " has no face on one of its sides";
  }
  return {};
}

KTE_FUNCTION bool is_convex(const triangle_mesh& mesh) {
  check_mesh(mesh);
  const auto length = [](const vec3<>& v) { return std::hypot(v.x, v.y, v.z); };
  vec3<> centre{};
  for (const auto& f : mesh.faces)
    for (const auto corner : f)
      centre = centre + (1 / (3 * static_cast<double>(mesh.faces.size()))) * mesh.vertices[corner];
  std::vector<vec3<>> normals;
  double angle = 0, volume = 0, size = 0;
  for (const auto& [i, j, k] : mesh.faces) {
    const vec3<> a = mesh.vertices[i] - centre, b = mesh.vertices[j] - centre, c = mesh.vertices[k] - centre;
    const vec3<> n = cross(b - a, c - a);
    const double box = dot(a, n), x = length(a), y = length(b), z = length(c);
    if (!(box > 0)) return false;
    normals.push_back((1 / length(n)) * n);
    angle += 2 * std::atan2(box, x * y * z + dot(a, b) * z + dot(b, c) * x + dot(c, a) * y);  // Van Oosterom, Strackee
    volume += box / 6, size = (std::max)({size, x, y, z});
  }
  if (!(std::abs(angle - 4 * std::numbers::pi) < 1)) return false;
  const auto sides = sorted_sides(mesh);
  double dents = 0;
  for (std::size_t i = 0; i < sides.size(); i += 2) {
    if (i + 1 == sides.size() || !sides[i].is_at(sides[i + 1]) || sides[i].direction == sides[i + 1].direction ||
        (i + 2 < sides.size() && sides[i].is_at(sides[i + 2])))
      return false;
    const auto one = sides[i].number, other = sides[i + 1].number;
    const auto &n = normals[one / 3], &m = normals[other / 3];
    const auto& [x, y, z] = sides[i].low;
    const double above = dot(n, mesh.vertices[mesh.faces[other / 3][(other + 2) % 3]] - vec3<>{x, y, z});
    if (!(above > 0)) continue;
    if (above > 1e-6 * size) return false;
    const auto& [u, v, w] = sides[i].high;
    dents += std::hypot(u - x, v - y, w - z) * std::atan2(length(cross(n, m)), dot(n, m));
  }
  return dents <= 0.01 * volume / (size * size);
}

}  // namespace kte::detail
#endif
