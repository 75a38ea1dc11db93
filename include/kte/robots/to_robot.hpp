#pragma once

#include <kte/detail/compiled.hpp>
#include <kte/robots/robot.hpp>

namespace kte {

/// A robot as a chain. Throws `bad_file` where links and joints make no tree or a joint cannot be had (with file and
/// line), `bad_argument` for options that do not fit. Bodies whose principal moments no body can have are taken as
/// published, with a warning.
robot to_robot(const robot_description& description, const robot_options& options = {});

}  // namespace kte

#ifdef KTE_FUNCTION
#  include <kte/robots/detail/chain_builder.hpp>

namespace kte {
KTE_FUNCTION robot to_robot(const robot_description& description, const robot_options& options) {
  return detail::chain_builder(description, options).build();
}
}  // namespace kte
#endif
