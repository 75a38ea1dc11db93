#pragma once

#include <kte/contact/friction_solver.hpp>

#include <algorithm>
#include <functional>

#include "catch.hpp"
#include "contact/friction_scenes.hpp"

namespace kte::test {

/// Solves `count` random problems; returns the largest violation of the laws of friction.
inline double worst_of(int count, const std::function<friction_scene(friction_scenes&)>& make, unsigned seed = 7) {
  friction_scenes random(seed);
  friction_solver<> solver;
  double worst = 0;
  for (int i = 0; i < count; ++i) {
    const friction_scene s = make(random);
    const auto& x = solver.solve(s.problem());
    INFO("problem " << i << ", residual " << x.residual);
    REQUIRE(x.solved());
    REQUIRE(x.residual <= 1e-12);
    worst = std::max(worst, violation(s, x.lambda));
  }
  return worst;
}

}  // namespace kte::test
