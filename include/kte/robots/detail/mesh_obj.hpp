#pragma once

#include <kte/robots/detail/mesh_text.hpp>

namespace kte::detail {

/// Reads Wavefront OBJ: lines "v x y z", optionally followed by a weight or a colour, and "f i j k ..." with indices
/// from 1, or from -1 backwards from the last vertex so far; i is alone or i/t, i//n, i/t/n. Other lines are skipped.
class obj_reader {
 public:
  explicit obj_reader(const mesh_text& in) : in_(in) {}

  triangle_mesh read() {
    do {
      const auto w = in_.word();
      if (w == "v") {
        vertex();
      } else if (w == "f") {
        face();
      }
    } while (in_.next_line());
    if (mesh_.vertices.empty()) in_.bad("the mesh has no vertices");
    for (std::size_t i = 0; i < mesh_.faces.size(); ++i)  // faces may precede their vertices
      for (const auto index : mesh_.faces[i]) check(index < mesh_.vertices.size(), lines_[i], index + std::int64_t{1});
    return std::move(mesh_);
  }

 private:
  /// The next word of the line, without comments.
  std::string_view word() {
    const auto w = in_.word();
    return w.starts_with('#') ? std::string_view{} : w;
  }
  void vertex() {
    std::array<double, 3> x{};
    for (double& c : x) c = in_.number(word(), "the vertex");
    int more = 0;
    for (auto w = word(); !w.empty(); w = word(), ++more) in_.number(w, "the vertex");
    if (more == 2 || more > 3) in_.bad("a vertex must have 3, 4 or 6 numbers");
    mesh_.vertices.push_back({x[0], x[1], x[2]});
  }
  void face() {
    const int line = in_.line();
    std::array<std::uint32_t, 3> fan{};
    std::size_t corners = 0;
    for (auto w = word(); !w.empty(); w = word(), ++corners) {
      const auto i = index(w);
      if (corners > 1) {
        fan[2] = i;
        mesh_.faces.push_back(fan), lines_.push_back(line);
        fan[1] = i;
      } else {
        fan[corners] = i;
      }
    }
    if (corners < 3) in_.bad("a face must have three corners, got " + std::to_string(corners));
  }
  std::uint32_t index(std::string_view w) const {
    std::int64_t i = 0;
    const char* const last = w.data() + w.size();
    const auto [end, error] = std::from_chars(w.data(), last, i);
    if (error == std::errc::invalid_argument || (end != last && *end != '/') ||
        w.find_first_not_of("0123456789-/") != w.npos)
      in_.bad("'" + excerpt(w) + "' is not an index");
    const auto n = static_cast<std::int64_t>(mesh_.vertices.size());
    const std::int64_t from_zero = i < 0 ? n + i : i - 1;
    check(error == std::errc{} && from_zero >= 0 && from_zero < 0xFFFFFFFF, in_.line(), i);
    return static_cast<std::uint32_t>(from_zero);
  }
  void check(bool ok, int line, std::int64_t i) const {
    if (!ok)
      in_.bad_at(line, "index " + std::to_string(i) + " is out of range: there are " +
                           std::to_string(mesh_.vertices.size()) + " vertices");
  }

  mesh_text in_;
  triangle_mesh mesh_;
  std::vector<int> lines_;  ///< of the faces
};

}  // namespace kte::detail
