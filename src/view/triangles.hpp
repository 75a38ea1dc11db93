#pragma once

#include <kte/robots/detail/triangle_mesh.hpp>
#include <kte/view/scene.hpp>

namespace kte::view {

/// A mesh in floats, whose equal vertices are one, without triangles that have a vertex twice.
scene::mesh merged(const detail::triangle_mesh& mesh);

/// What a mesh takes in a page, bytes of base64.
constexpr std::size_t text_bytes(std::size_t vertices, std::size_t triangles) { return 16 * (vertices + triangles); }
inline std::size_t text_bytes(const scene::mesh& m) { return text_bytes(m.positions.size() / 3, m.indices.size() / 3); }

/// The mesh of fewer triangles, by clusters of vertices, in no more bytes of a page; without triangles if there is
/// none.
scene::mesh simplified(const scene::mesh& m, std::size_t bytes);

}  // namespace kte::view
