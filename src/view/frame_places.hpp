#pragma once

#include <kte/math/quaternion.hpp>
#include <kte/view/scene.hpp>

namespace kte::view {

/// A place in another one: position, m, and rotation.
struct placed {
  vec3<> position{};
  unit_quaternion<> rotation{};
  friend placed operator*(const placed& a, const placed& b) {
    return {a.position + a.rotation * b.position, a.rotation * b.rotation};
  }
};
placed place_of(const scene::pose& p);
/// The pose of a track in a row of a recording.
placed place_of(const scene& s, const scene::recording& r, std::size_t row, int track);

/// Where all frames are in a row of a recording, in the world.
std::vector<placed> frame_places(const scene& s, const scene::recording& r, std::size_t row);

}  // namespace kte::view
