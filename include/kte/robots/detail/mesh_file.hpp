#pragma once

#include <kte/detail/compiled.hpp>
#include <kte/robots/detail/triangle_mesh.hpp>

#include <filesystem>
#include <string_view>

namespace kte::detail {

/// Reads a mesh in the format given by the extension of its file, in upper or lower case:
///   .stl  binary or text, distinguished by size and content
///   .obj  Wavefront: vertices, and polygons, which become fans of triangles; the rest is skipped
///   .msh  MuJoCo: int32 nvertex, nnormal, ntexcoord, nface, then these numbers of float32 and int32 data
/// Throws `bad_file` with byte, line or facet: for other extensions, files of the wrong size, vertices that are not
/// finite, indices out of range, meshes without vertices, and files of more than 1 GiB.
triangle_mesh read_mesh(const std::filesystem::path& path);
/// Reads a mesh from the bytes of a file; `path` gives the extension and names the file in messages.
triangle_mesh parse_mesh(const std::filesystem::path& path, std::string_view bytes);

}  // namespace kte::detail

#ifdef KTE_FUNCTION
#  include <kte/io/file.hpp>
#  include <kte/robots/detail/mesh_obj.hpp>
#  include <kte/robots/detail/mesh_stl.hpp>

namespace kte::detail {

inline constexpr std::size_t largest_mesh_file = std::size_t{1} << 30;

KTE_FUNCTION triangle_mesh parse_mesh(const std::filesystem::path& path, std::string_view bytes) {
  byte_reader in(path, bytes);
  if (bytes.size() > largest_mesh_file)
    in.bad("the file has more than " + std::to_string(largest_mesh_file) + " bytes");
  const auto kind = lower_extension(path);
  if (kind == ".stl") return is_text_stl(bytes) ? text_stl(mesh_text(path, bytes)).read() : read_binary_stl(in);
  if (kind == ".obj") return obj_reader(mesh_text(path, bytes)).read();
  if (kind == ".msh") return read_msh(in);
  raise<bad_file>("kte: '" + path.string() + "': a mesh must be an .stl, .obj or .msh file");
}
KTE_FUNCTION triangle_mesh read_mesh(const std::filesystem::path& path) {
  return parse_mesh(path, read_file(path, largest_mesh_file));
}

}  // namespace kte::detail
#endif
