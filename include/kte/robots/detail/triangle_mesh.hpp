#pragma once

#include <kte/math/vec.hpp>

#include <array>
#include <cstdint>
#include <vector>

namespace kte::detail {

/// A surface of triangles, m. Vertices may repeat. Without faces it is a set of points, which stands for its convex
/// hull. The vertices of a face run counterclockwise as seen from outside.
struct triangle_mesh {
  std::vector<vec3<>> vertices;
  std::vector<std::array<std::uint32_t, 3>> faces;
};

}  // namespace kte::detail
