#pragma once

#include <kte/view/scene.hpp>

namespace kte::view {

/// Throws `bad_argument` for a scene whose parts do not fit together.
void check(const scene& s);

}  // namespace kte::view
