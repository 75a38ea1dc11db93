#pragma once

#include <kte/view/options.hpp>
#include <kte/view/scene.hpp>

namespace kte::view {

/// A scene with meshes and recordings within the sizes of a page. Its notes list omissions.
scene within_limits(const scene& s, const page_options& options);

}  // namespace kte::view
