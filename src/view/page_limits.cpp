#include "page_limits.hpp"

#include <algorithm>
#include <numeric>

#include "triangles.hpp"

namespace kte::view {

namespace {
std::string megabytes(std::size_t bytes) {
  if (bytes < std::size_t{1} << 20) return std::to_string(bytes) + " bytes";
  const auto tenths = bytes / 104858;
  return std::to_string(tenths / 10) + "." + std::to_string(tenths % 10) + " MiB";
}

/// The size to which the largest are cut so that the sum is within a limit.
std::size_t cut_of(std::vector<std::size_t> sizes, std::size_t limit) {
  std::sort(sizes.begin(), sizes.end());
  std::size_t left = limit;
  for (std::size_t i = 0; i < sizes.size(); ++i) {
    const std::size_t share = left / (sizes.size() - i);
    if (sizes[i] > share) return share;
    left -= sizes[i];
  }
  return limit;
}

void fit_meshes(scene& s, std::size_t limit) {
  std::vector<std::size_t> sizes;
  for (const auto& m : s.meshes) sizes.push_back(text_bytes(m));
  const std::size_t cut = cut_of(sizes, limit);
  for (auto& m : s.meshes) {
    if (text_bytes(m) <= cut) continue;
    const std::size_t before = m.indices.size() / 3;
    m = simplified(m, cut);
    const std::size_t now = m.indices.size() / 3;
    s.notes.push_back("mesh '" + m.name + "' is " +
                      (now > 0 ? "drawn with " + std::to_string(now) + " of its " : "not drawn: it has ") +
                      std::to_string(before) + " triangles, and all meshes of a page have " + megabytes(limit) +
                      ", unless its options say otherwise");
  }
  std::erase_if(s.shapes, [&s](const scene::shape& x) {
    return x.mesh >= 0 && s.meshes[static_cast<std::size_t>(x.mesh)].indices.empty();
  });
}

/// The size of a row of a recording.
std::size_t bytes_of_row(const scene& s, const scene::recording& r) {
  const auto tracks = static_cast<std::size_t>(s.tracks);
  const std::size_t numbers = (r.q.size() + r.v.size() + r.signals.size()) / r.t.size() + r.columns.size();
  return (8 + 20 * tracks + 4 * numbers) * 4 / 3;
}
/// Keeps `width` numbers of each row.
template <class Number>
void keep(std::vector<Number>& all, const std::vector<std::size_t>& rows, std::size_t width) {
  std::vector<Number> kept;
  if (all.empty()) return;
  kept.reserve(rows.size() * width);
  for (const auto i : rows)
    for (std::size_t k = 0; k < width; ++k) kept.push_back(all[i * width + k]);
  all = std::move(kept);
}
void fit_recordings(scene& s, std::size_t limit) {
  std::vector<std::size_t> sizes;
  for (const auto& r : s.recordings) sizes.push_back(bytes_of_row(s, r) * r.t.size());
  const std::size_t cut = cut_of(sizes, limit);
  for (std::size_t i = 0; i < sizes.size(); ++i) {
    if (sizes[i] <= cut) continue;
    auto& r = s.recordings[i];
    const std::size_t n = r.t.size(), most = std::max(cut / bytes_of_row(s, r), std::size_t{2});
    const std::size_t step = (n + most - 1) / most;
    std::vector<std::size_t> rows;
    for (std::size_t k = 0; k < n; k += step) rows.push_back(k);
    if (rows.back() != n - 1) rows.push_back(n - 1);
    const auto tracks = static_cast<std::size_t>(s.tracks);
    keep(r.t, rows, 1), keep(r.positions, rows, 3 * tracks), keep(r.rotations, rows, 4 * tracks);
    keep(r.q, rows, s.q.size()), keep(r.v, rows, s.v.size()), keep(r.signals, rows, r.signals.size() / n);
    for (auto& c : r.columns) keep(c.data, rows, 1);
    s.notes.push_back("of the " + std::to_string(n) + " rows of the recording" +
                      (r.name.empty() ? "" : " '" + r.name + "'") + " one in " + std::to_string(step) +
                      " is in the page: all recordings of a page have " + megabytes(limit) +
                      ", unless its options say otherwise");
  }
}
}  // namespace

scene within_limits(const scene& s, const page_options& options) {
  scene out = s;
  fit_meshes(out, options.mesh_bytes);
  fit_recordings(out, options.recording_bytes);
  return out;
}

}  // namespace kte::view
