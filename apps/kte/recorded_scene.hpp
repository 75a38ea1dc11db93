#pragma once

#include <kte/io/table.hpp>
#include <kte/view/scene.hpp>

#include "start.hpp"

namespace kte_tool {

/// A mechanism as it stands, for pages: at the start that the command line says, or else in the first configuration of
/// its file, or where all is 0 within its limits.
kte::scene scene_of(const mechanism& m, const start_options& start);

/// A mechanism that moves as a recording says, under a name. Its columns are called as `kte simulate` or the library
/// calls them, or q_0, q_1, ... as of `kte eval`. `plotted` are plotted at first: columns of the table, a vector by its
/// components, or else quantities that its coordinates determine. Throws `unknown_name` for coordinates without columns
/// and for names that neither has, and `bad_argument` for quantities that coordinates do not determine.
kte::scene scene_of(const mechanism& m, kte::table recording, const std::string& name,
                    const std::vector<std::string>& plotted);

/// The meshes that a page does not draw, with reasons: missing, broken, or of a format that is not read.
std::vector<std::string> meshes_not_drawn(const mechanism& m);

}  // namespace kte_tool
