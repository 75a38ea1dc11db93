#pragma once

#include <kte/view/recorded_scene.hpp>

namespace kte::view {

/// A scene without recordings, and where its tracks and coordinates are in states.
struct built_scene {
  scene picture;
  std::vector<detail::thing_place> tracked, freedoms;
};
built_scene build_scene(const detail::chain_parts& chain);

/// Draws the shapes of a robot's file, where frames have the names in the list.
void add_shapes(scene& s, const detail::chain_parts& chain);

}  // namespace kte::view
