#pragma once

#include <kte/io/table.hpp>
#include <kte/view/scene.hpp>

#include "mechanism.hpp"

namespace kte_tool {

/// A mechanism as it stands, for pages.
kte::scene scene_of(const mechanism& m);

/// A mechanism that moves as a recording says, under a name. Its columns are called as `kte simulate` or the library
/// calls them, or q_0, q_1, ... as of `kte eval`. Throws `unknown_name` for coordinates without columns.
kte::scene scene_of(const mechanism& m, kte::table recording, const std::string& name);

}  // namespace kte_tool
