#pragma once

#include <kte/view/scene.hpp>

namespace kte::view {

/// A typical length: the diagonal of the box about all frames and centres of mass in the first row, or else the largest
/// size of a body or shape, or 1 m.
double size_of(const scene& s);

}  // namespace kte::view
