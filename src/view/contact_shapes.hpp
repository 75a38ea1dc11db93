#pragma once

#include <kte/view/detail/chain_parts.hpp>
#include <kte/view/scene.hpp>

namespace kte::view {

/// A contact of a chain, and the frames of its surface and of its body.
struct drawn_contact {
  const detail::element_parts* element;
  int surface, body;
};

/// Draws each surface once, and what touches it: spheres, points (spheres of radius 0) and discs. Robots with shapes
/// have surfaces only, and not those planes that their file draws.
void add_contact_shapes(scene& s, const std::vector<drawn_contact>& contacts);

}  // namespace kte::view
