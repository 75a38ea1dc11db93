#pragma once

#include "closed_loops/mechanisms.hpp"

namespace kte::test::loops {

/// A tree in space on a floating base, with closures of all kinds between its branches. `open` has no closures.
struct tangle {
  runtime_chain closed, open;
  explicit tangle(bool follows = false) {
    const rigid_body<> body{1.5, vec3<>{0.1, 0.2, -0.1}, sym3<>{0.3, 0.01, 0, 0.4, 0.02, 0.5}};
    open.gravity(vec3<>{0, 0, -9.81});
    open << free_joint_3D("float", "world", "hull") << inertia_3D("hull", body);
    for (const std::string x : {"l", "r"}) {
      open << revolute_joint_3D(x + "1", "hull", x + "a", axis::z).at(vec3<>{0.3, x == "l" ? 0.2 : -0.2, 0})
           << inertia_3D(x + "a", body) << rigid_link_3D(x + "a", x + "b", vec3<>{0.5, 0, 0.1})
           << spherical_joint_3D(x + "2", x + "b", x + "c") << inertia_3D(x + "c", body)
           << rigid_link_3D(x + "c", x + "d", vec3<>{0.1, 0.4, 0})
           << prismatic_joint_3D(x + "3", x + "d", x + "e", vec3<>{0.6, 0, 0.8}) << inertia_3D(x + "e", body);
      if (follows)
        open << mimic_gen(x + "1", x + "4", 2.0) << revolute_joint_3D(x + "4", x + "e", x + "f", axis::y)
             << inertia_3D(x + "f", body);
    }
    closed = open;
  }
};

}  // namespace kte::test::loops
