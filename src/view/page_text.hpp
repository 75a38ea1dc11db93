#pragma once

#include <kte/view/options.hpp>
#include <kte/view/scene.hpp>

#include <string_view>

namespace kte::view {

/// The page with a scene in its place, within the limits of the options, and with a title: theirs, that of the scene,
/// or another. A live page also has the element `kte-live`, and asks for states where it was loaded from.
std::string page_text(const scene& s, const page_options& options, std::string_view other_title, bool live = false);

}  // namespace kte::view
