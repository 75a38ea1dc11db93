#pragma once

#include <kte/math/matrix.hpp>

#include <array>
#include <cstdint>
#include <utility>
#include <vector>

namespace kte::detail {

/// A surface of triangles, m. Vertices may repeat. A mesh without faces is a set of points and stands for its convex
/// hull. The vertices of a face run counterclockwise when seen from outside.
struct triangle_mesh {
  std::vector<vec3<>> vertices;
  std::vector<std::array<std::uint32_t, 3>> faces;
};

/// The mesh as MuJoCo 2.2.2 places it as an asset: its reference frame, at `position` with `rotation`, becomes the
/// frame of the mesh, and the coordinates are then scaled,
///
///   v -> scale * (R^T (v - p)),   component by component                     (1)
///
/// A mirrored mesh gets its faces reversed.
inline triangle_mesh placed_mesh(triangle_mesh mesh, const vec3<>& position, const mat3<vec3<>>& rotation,
                                 const vec3<>& scale) {
  const auto back = transpose(rotation);
  for (auto& v : mesh.vertices) {
    const vec3<> p = back * (v - position);
    v = {scale.x * p.x, scale.y * p.y, scale.z * p.z};  // (1)
  }
  if ((scale.x < 0) != ((scale.y < 0) != (scale.z < 0)))
    for (auto& f : mesh.faces) std::swap(f[1], f[2]);
  return mesh;
}

}  // namespace kte::detail
