#include "scene_size.hpp"

#include <kte/math/quaternion.hpp>

#include <algorithm>
#include <cmath>

namespace kte::view {

namespace {
struct placed {
  vec3<> position;
  unit_quaternion<> rotation;
};
placed place_of(const scene::pose& p) { return {{p[0], p[1], p[2]}, {p[3], p[4], p[5], p[6]}}; }
}  // namespace

double size_of(const scene& s) {
  std::vector<placed> all;
  const auto& r = s.recordings.front();
  vec3<> low{scene::none, scene::none, scene::none}, high{-scene::none, -scene::none, -scene::none};
  const auto reach = [&](const vec3<>& p) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
  };
  for (const auto& f : s.frames) {
    if (f.track >= 0) {
      const auto k = static_cast<std::size_t>(f.track);
      const float* const p = r.positions.data() + 3 * k;
      const std::int16_t* const q = r.rotations.data() + 4 * k;
      all.push_back({{p[0], p[1], p[2]}, {q[0] / 32767.0, q[1] / 32767.0, q[2] / 32767.0, q[3] / 32767.0}});
    } else {
      const auto in = place_of(f.place);
      if (f.parent < 0) {
        all.push_back(in);
      } else {
        const placed parent = all[static_cast<std::size_t>(f.parent)];
        all.push_back({parent.position + parent.rotation * in.position, parent.rotation * in.rotation});
      }
    }
    reach(all.back().position);
  }
  for (const auto& b : s.bodies) {
    const auto& f = all[static_cast<std::size_t>(b.frame)];
    reach(f.position + f.rotation * vec3<>{b.centre[0], b.centre[1], b.centre[2]});
  }
  if (!all.empty()) {
    const vec3<> d = high - low;
    if (const double diagonal = std::hypot(d.x, d.y, d.z); diagonal > 0 && std::isfinite(diagonal)) return diagonal;
  }
  double largest = 0;
  for (const auto& b : s.bodies) largest = std::max({largest, b.ellipsoid[0], b.ellipsoid[1], b.ellipsoid[2]});
  for (const auto& x : s.shapes)
    for (const double length : x.size) largest = std::max(largest, length);
  return largest > 0 && std::isfinite(largest) ? 2 * largest : 1;
}

}  // namespace kte::view
