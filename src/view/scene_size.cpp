#include "scene_size.hpp"

#include <algorithm>
#include <cmath>

#include "frame_places.hpp"

namespace kte::view {

double size_of(const scene& s) {
  const auto all = frame_places(s, s.recordings.front(), 0);
  vec3<> low{scene::none, scene::none, scene::none}, high{-scene::none, -scene::none, -scene::none};
  const auto reach = [&](const vec3<>& p) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
  };
  for (const auto& f : all) reach(f.position);
  for (const auto& b : s.bodies) {
    const auto& f = all[static_cast<std::size_t>(b.frame)];
    reach(f.position + f.rotation * vec3<>{b.centre[0], b.centre[1], b.centre[2]});
  }
  if (!all.empty()) {
    const vec3<> d = high - low;
    if (const double diagonal = std::hypot(d.x, d.y, d.z); diagonal > 0 && std::isfinite(diagonal)) return diagonal;
  }
  double largest = 0;
  for (const auto& x : s.shapes) {
    if (x.type == "plane") continue;
    for (const double length : x.size) largest = std::max(largest, length);
    if (x.mesh < 0) continue;
    for (const float p : s.meshes[static_cast<std::size_t>(x.mesh)].positions)
      largest = std::max(largest, static_cast<double>(std::abs(p)));
  }
  if (largest == 0)  // files have inertias that no shape of theirs has
    for (const auto& b : s.bodies) largest = std::max({largest, b.ellipsoid[0], b.ellipsoid[1], b.ellipsoid[2]});
  return largest > 0 && std::isfinite(largest) ? 2 * largest : 1;
}

}  // namespace kte::view
