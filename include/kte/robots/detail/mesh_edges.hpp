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

}  // namespace kte::detail

#ifdef KTE_FUNCTION
#  include <kte/errors.hpp>

#  include <algorithm>
#  include <cmath>
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

KTE_FUNCTION std::string open_edge(const triangle_mesh& mesh) {
  check_mesh(mesh);
  using place = std::array<double, 3>;
  const auto at = [&](std::uint32_t i) {
    const auto& v = mesh.vertices[i];
    return place{v.x + 0.0, v.y + 0.0, v.z + 0.0};
  };
  struct side {
    place low, high;
    int direction;
  };
  std::vector<side> sides;
  sides.reserve(3 * mesh.faces.size());
  for (const auto& f : mesh.faces)
    for (std::size_t k = 0; k < 3; ++k) {
      const auto a = at(f[k]), b = at(f[(k + 1) % 3]);
      if (a != b) sides.push_back(a < b ? side{a, b, 1} : side{b, a, -1});
    }
  const auto ends = [](const side& s) { return std::tie(s.low, s.high); };
  std::sort(sides.begin(), sides.end(), [&](const side& s, const side& t) { return ends(s) < ends(t); });
  for (std::size_t i = 0; i < sides.size();) {
    const auto& s = sides[i];
    int count = 0;
    for (; i < sides.size() && ends(sides[i]) == ends(s); ++i) count += sides[i].direction;
    const auto text = [](const place& p) { return number(p[0]) + " " + number(p[1]) + " " + number(p[2]); };
    if (count != 0) return "the edge from " + text(s.low) + " to " + text(s.high) + " has no face on one of its sides";
  }
  return {};
}

}  // namespace kte::detail
#endif
