#include "triangles.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numeric>
#include <unordered_map>

namespace kte::view {

namespace {
using corner = std::array<std::uint32_t, 3>;
struct hash_of_corner {
  std::size_t operator()(const corner& c) const {
    std::uint64_t h = 0;
    for (const auto x : c) h = (h ^ x) * 0x9E3779B97F4A7C15ull, h ^= h >> 29;
    return static_cast<std::size_t>(h);
  }
};
using corner_map = std::unordered_map<corner, std::uint32_t, hash_of_corner>;

bool has_area(const corner& f) { return f[0] != f[1] && f[1] != f[2] && f[2] != f[0]; }
/// The triangle with its least index first.
corner rotated(const corner& f) {
  const auto least = static_cast<std::size_t>(std::min_element(f.begin(), f.end()) - f.begin());
  return {f[least], f[(least + 1) % 3], f[(least + 2) % 3]};
}

/// Vertices that are in one cell of a grid become their mean.
class clusters {
 public:
  explicit clusters(const scene::mesh& m) : mesh_(m) {
    for (std::size_t i = 0; i < m.positions.size(); ++i) {
      low_[i % 3] = std::min(low_[i % 3], m.positions[i]);
      high_[i % 3] = std::max(high_[i % 3], m.positions[i]);
    }
    for (std::size_t k = 0; k < 3; ++k) longest_ = std::max(longest_, double{high_[k]} - double{low_[k]});
  }

  /// The mesh reduced to `cells` cells along the longest side.
  scene::mesh reduced(std::uint32_t cells) const {
    scene::mesh out;
    out.name = mesh_.name;
    const std::size_t n = mesh_.positions.size() / 3;
    std::vector<std::uint32_t> of_vertex(n);
    std::vector<double> sums;
    std::vector<std::uint32_t> counts;
    corner_map known;
    const double scale = longest_ > 0 ? cells / longest_ : 0;
    for (std::size_t i = 0; i < n; ++i) {
      const float* const p = mesh_.positions.data() + 3 * i;
      corner cell{};
      for (std::size_t k = 0; k < 3; ++k)
        cell[k] = std::min(static_cast<std::uint32_t>((double{p[k]} - double{low_[k]}) * scale), cells - 1);
      const auto [at, fresh] = known.emplace(cell, static_cast<std::uint32_t>(counts.size()));
      if (fresh) counts.push_back(0), sums.resize(sums.size() + 3);
      of_vertex[i] = at->second;
      ++counts[at->second];
      for (std::size_t k = 0; k < 3; ++k) sums[3 * at->second + k] += p[k];
    }
    std::vector<corner> faces;
    for (std::size_t i = 0; i < mesh_.indices.size(); i += 3) {
      const corner f{of_vertex[mesh_.indices[i]], of_vertex[mesh_.indices[i + 1]], of_vertex[mesh_.indices[i + 2]]};
      if (has_area(f)) faces.push_back(rotated(f));
    }
    std::sort(faces.begin(), faces.end());
    faces.erase(std::unique(faces.begin(), faces.end()), faces.end());
    constexpr auto unused = ~std::uint32_t{0};
    std::vector<std::uint32_t> place(counts.size(), unused);
    for (const auto& f : faces)
      for (const auto c : f) {
        if (place[c] == unused) {
          place[c] = static_cast<std::uint32_t>(out.positions.size() / 3);
          for (std::size_t k = 0; k < 3; ++k) out.positions.push_back(static_cast<float>(sums[3 * c + k] / counts[c]));
        }
        out.indices.push_back(place[c]);
      }
    return out;
  }

 private:
  const scene::mesh& mesh_;
  std::array<float, 3> low_{INFINITY, INFINITY, INFINITY}, high_{-INFINITY, -INFINITY, -INFINITY};
  double longest_ = 0;
};
}  // namespace

scene::mesh merged(const detail::triangle_mesh& mesh) {
  scene::mesh out;
  std::vector<std::uint32_t> of_vertex(mesh.vertices.size());
  constexpr auto bad = ~std::uint32_t{0};
  corner_map known;
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
    const auto& v = mesh.vertices[i];
    const std::array<float, 3> p{static_cast<float>(v.x) + 0.0f, static_cast<float>(v.y) + 0.0f,
                                 static_cast<float>(v.z) + 0.0f};
    if (!std::isfinite(p[0]) || !std::isfinite(p[1]) || !std::isfinite(p[2])) {
      of_vertex[i] = bad;
      continue;
    }
    corner bits{};
    std::memcpy(bits.data(), p.data(), sizeof bits);
    const auto [at, fresh] = known.emplace(bits, static_cast<std::uint32_t>(out.positions.size() / 3));
    if (fresh) out.positions.insert(out.positions.end(), p.begin(), p.end());
    of_vertex[i] = at->second;
  }
  for (const auto& f : mesh.faces) {
    const corner c{of_vertex[f[0]], of_vertex[f[1]], of_vertex[f[2]]};
    if (has_area(c) && c[0] != bad && c[1] != bad && c[2] != bad)
      out.indices.insert(out.indices.end(), c.begin(), c.end());
  }
  return out;
}

scene::mesh simplified(const scene::mesh& m, std::size_t bytes) {
  const clusters all(m);
  scene::mesh best;
  best.name = m.name;
  std::uint32_t low = 1, high = 2048;  // of one cell nothing is left
  while (high - low > 1) {
    const auto cells = std::midpoint(low, high);
    auto tried = all.reduced(cells);
    if (text_bytes(tried) > bytes) {
      high = cells;
      continue;
    }
    low = cells, best = std::move(tried);
    if (text_bytes(best) > bytes - bytes / 8) break;
  }
  return best;
}

}  // namespace kte::view
