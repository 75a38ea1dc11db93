#include "frame_places.hpp"

namespace kte::view {

placed place_of(const scene::pose& p) { return {{p[0], p[1], p[2]}, {p[3], p[4], p[5], p[6]}}; }

placed place_of(const scene& s, const scene::recording& r, std::size_t row, int track) {
  const std::size_t k = row * static_cast<std::size_t>(s.tracks) + static_cast<std::size_t>(track);
  const float* const p = r.positions.data() + 3 * k;
  const std::int16_t* const q = r.rotations.data() + 4 * k;
  return {{p[0], p[1], p[2]}, normalized(double{q[0] / 32767.0}, q[1] / 32767.0, q[2] / 32767.0, q[3] / 32767.0)};
}

std::vector<placed> frame_places(const scene& s, const scene::recording& r, std::size_t row) {
  std::vector<placed> all;
  all.reserve(s.frames.size());
  for (const auto& f : s.frames) {
    if (f.track >= 0)
      all.push_back(place_of(s, r, row, f.track));
    else if (f.parent < 0)
      all.push_back(place_of(f.place));
    else
      all.push_back(all[static_cast<std::size_t>(f.parent)] * place_of(f.place));
  }
  return all;
}

}  // namespace kte::view
