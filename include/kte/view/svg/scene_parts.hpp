#pragma once

#include <kte/errors.hpp>
#include <kte/view/scene.hpp>

#include <algorithm>

namespace kte::detail::svg {

/// Throws `bad_argument` for frames without a pose, and for parts on frames that do not exist.
inline void check_parts(const scene& s) {
  const int count = static_cast<int>(s.frames.size());
  for (int i = 0; i < count; ++i) {
    const auto& f = s.frames[static_cast<std::size_t>(i)];
    if (f.track >= s.tracks || f.parent >= i)
      raise<bad_argument>("kte: the frame '" + f.name + "' of a scene has a track or a parent that is not there");
  }
  const auto check = [count](int frame) {
    if (frame < 0 || frame >= count) raise<bad_argument>("kte: a part of a scene is on a frame that does not exist");
  };
  for (const auto& l : s.links) check(l.from), check(l.to);
  for (const auto& j : s.joints) check(j.before), check(j.after);
  for (const auto& b : s.bodies) check(b.frame);
  for (const auto& f : s.forces) std::for_each(f.frames.begin(), f.frames.end(), check);
}

}  // namespace kte::detail::svg
