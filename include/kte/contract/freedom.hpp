#pragma once

#include <kte/contract/key.hpp>

namespace kte::detail {

/// A coordinate that is a degree of freedom, or several: thing `slot` of its kind, whose numbers begin at place `q` of
/// a configuration and at place `v` of velocities, accelerations and forces.
struct freedom {
  kind what{};
  int slot{};
  int q{};
  int v{};
};

}  // namespace kte::detail
