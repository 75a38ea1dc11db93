#pragma once

#include <kte/robots/detail/mesh_binary.hpp>
#include <kte/robots/detail/mesh_text.hpp>

namespace kte::detail {

/// Text begins with "solid" and has no zero byte. The title of a binary file may begin with "solid" as well, but zero
/// bytes follow, in the title or in the numbers.
inline bool is_text_stl(std::string_view bytes) {
  const auto first = bytes.find_first_not_of(" \t\r\n");
  if (first == bytes.npos || !same_word(bytes.substr(first, 5), "solid")) return false;
  if (bytes.size() >= 84 && bytes.size() == 84 + 50 * std::uint64_t{from_bytes<std::uint32_t>(bytes.substr(80, 4))})
    return false;
  return bytes.find('\0') == bytes.npos;
}

/// STL as text: one or more solids of
///   solid NAME, then facets, then endsolid NAME
///   facet normal X Y Z  outer loop  vertex X Y Z  vertex X Y Z  vertex X Y Z  endloop  endfacet
class text_stl {
 public:
  explicit text_stl(const mesh_text& in) : in_(in) {}

  triangle_mesh read() {
    for (auto w = in_.next_word(); !w.empty(); w = in_.next_word()) {
      if (!same_word(w, "solid")) in_.bad("expected solid, got '" + excerpt(w) + "'");
      in_.next_line();
      for (w = in_.next_word(); !same_word(w, "endsolid"); w = in_.next_word()) facet(w);
      in_.next_line();
    }
    if (mesh_.faces.empty()) in_.bad("the mesh has no facets");
    return std::move(mesh_);
  }

 private:
  void facet(std::string_view first) {
    check(first, "facet"), check(in_.next_word(), "normal");
    for (int k = 0; k < 3; ++k) in_.next_word();  // the normal, which may be NaN for facets without area
    check(in_.next_word(), "outer"), check(in_.next_word(), "loop");
    const auto n = static_cast<std::uint32_t>(mesh_.vertices.size());
    for (int k = 0; k < 3; ++k) {
      check(in_.next_word(), "vertex");
      const double x = number(), y = number(), z = number();
      mesh_.vertices.push_back({x, y, z});
    }
    check(in_.next_word(), "endloop"), check(in_.next_word(), "endfacet");
    mesh_.faces.push_back({n, n + 1, n + 2});
  }
  double number() { return in_.number(in_.next_word(), "the vertex"); }
  void check(std::string_view w, const char* expected) const {
    if (same_word(w, expected)) return;
    const std::string place = " in facet " + std::to_string(mesh_.faces.size());
    if (w.empty()) in_.bad("the file ends" + place + ", where " + expected + " must stand");
    in_.bad("expected " + std::string(expected) + place + ", got '" + excerpt(w) + "'");
  }

  mesh_text in_;
  triangle_mesh mesh_;
};

}  // namespace kte::detail
