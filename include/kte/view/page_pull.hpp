#pragma once

#include <kte/math/vec.hpp>

#include <string>

namespace kte {

/// A pull by the user of a page: a spring and a damper from a point of a frame to a target.
struct page_pull {
  std::string frame{};   ///< its name; empty: nothing is pulled
  vec3<> point{};        ///< in the frame, m
  vec3<> target{};       ///< in the world, m
  double stiffness = 0;  ///< k, N/m
  double damping = 0;    ///< c, N s/m
};

}  // namespace kte
