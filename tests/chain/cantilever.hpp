#pragma once

#include <kte/dynamics/configuration_space.hpp>
#include <kte/elements/flexible_beam.hpp>
#include <kte/elements/free_joint.hpp>
#include <kte/runtime_chain/runtime_chain.hpp>

#include <string>

namespace kte::test {

/// A cantilever of n beams along x from the wall, with nodes "1" to "n" that move freely.
template <class Section>
runtime_chain cantilever(int n, double length, const Section& section) {
  runtime_chain c;
  for (int i = 0; i < n; ++i) {
    const auto before = i == 0 ? "wall" : std::to_string(i), node = std::to_string(i + 1);
    if constexpr (std::is_same_v<Section, planar_beam_section>) {
      c << free_joint_2D("at " + node, "wall", node) << flexible_beam_2D(before, node, length / n, section);
    } else {
      c << free_joint_3D("at " + node, "wall", node) << flexible_beam_3D(before, node, length / n, section);
    }
  }
  return c;
}
/// Where its nodes stand at rest.
inline Eigen::VectorXd straight(const runtime_chain& c, int n, double length) {
  Eigen::VectorXd q = neutral_configuration(c);
  for (int i = 0; i < n; ++i) q[c.nq() / n * i] = length * (i + 1) / n;
  return q;
}

}  // namespace kte::test
