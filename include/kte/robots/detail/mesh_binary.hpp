#pragma once

#include <kte/io/bytes.hpp>
#include <kte/robots/detail/triangle_mesh.hpp>

#include <bit>
#include <cmath>

/// Reads meshes from binary files, least significant byte first.
namespace kte::detail {

inline vec3<> take_vertex(byte_reader& in) {
  const byte_reader start = in;
  const auto take = [&] { return double{std::bit_cast<float>(in.number<std::uint32_t>("a vertex"))}; };
  const double x = take(), y = take(), z = take();
  if (!std::isfinite(x) || !std::isfinite(y) || !std::isfinite(z)) start.bad("the vertex is not finite");
  return {x, y, z};
}

/// Binary STL: a title of 80 bytes, the number n of facets, and 50 bytes for each facet.
inline triangle_mesh read_binary_stl(byte_reader in) {
  triangle_mesh mesh;
  const std::uint64_t size = in.size();
  in.take(80, "the title");
  const std::uint64_t n = in.number<std::uint32_t>("the number of facets");
  if (size != 84 + 50 * n)
    in.bad("the file has " + std::to_string(size) + " bytes, but " + std::to_string(n) + " facets of binary STL need " +
           std::to_string(84 + 50 * n));
  if (n == 0) in.bad("the mesh has no facets");
  mesh.vertices.reserve(3 * n), mesh.faces.reserve(n);
  for (std::uint32_t i = 0; i < n; ++i) {
    in.take(12, "a normal");
    for (int k = 0; k < 3; ++k) mesh.vertices.push_back(take_vertex(in));
    in.take(2, "an attribute");
    mesh.faces.push_back({3 * i, 3 * i + 1, 3 * i + 2});
  }
  return mesh;
}

/// MSH: its size is 16 + 12 (nvertex + nnormal + nface) + 8 ntexcoord bytes.
inline triangle_mesh read_msh(byte_reader in) {
  triangle_mesh mesh;
  const std::uint64_t size = in.size();
  std::array<std::uint64_t, 4> n{};
  const byte_reader header = in;
  for (auto& count : n) {
    count = in.number<std::uint32_t>("the header");
    if (count > 0x7FFFFFFF) header.bad("a number in the header is negative");
  }
  const auto [vertices, normals, texcoords, faces] = n;
  const std::uint64_t needed = 16 + 12 * (vertices + normals + faces) + 8 * texcoords;
  if (size != needed)
    header.bad("the file has " + std::to_string(size) + " bytes, but its header needs " + std::to_string(needed));
  if (vertices == 0) header.bad("the mesh has no vertices");
  mesh.vertices.reserve(vertices), mesh.faces.reserve(faces);
  for (std::uint64_t i = 0; i < vertices; ++i) mesh.vertices.push_back(take_vertex(in));
  in.take(12 * normals + 8 * texcoords, "the normals");
  for (std::uint64_t i = 0; i < faces; ++i) {
    auto& face = mesh.faces.emplace_back();
    for (auto& index : face) {
      const byte_reader start = in;
      index = in.number<std::uint32_t>("a face");
      if (index >= vertices)
        start.bad("index " + std::to_string(static_cast<std::int32_t>(index)) + " of face " + std::to_string(i) +
                  " is out of range: the mesh has " + std::to_string(vertices) + " vertices");
    }
  }
  return mesh;
}

}  // namespace kte::detail
