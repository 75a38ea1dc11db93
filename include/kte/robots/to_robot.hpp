#pragma once

#include <kte/detail/compiled.hpp>
#include <kte/robots/robot.hpp>

namespace kte {

/// Makes the chain of a robot. Throws `bad_file`, with file and line, if links and joints do not form a tree or a joint
/// is not supported, `bad_argument` for options that do not fit. Bodies with principal moments that are not physically
/// realizable are accepted as published, with a warning.
[[nodiscard]] robot to_robot(const robot_description& description, const robot_options& options = {});

}  // namespace kte

#ifdef KTE_FUNCTION
#  include <kte/robots/detail/chain_builder.hpp>

namespace kte {
KTE_FUNCTION robot to_robot(const robot_description& description, const robot_options& options) {
  return detail::chain_builder(description, options).build();
}
}  // namespace kte
#endif
