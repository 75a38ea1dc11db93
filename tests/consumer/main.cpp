// What a user writes: a pendulum of 2 kg at 0.5 m, held horizontally.
#include <kte/kte.hpp>
#ifdef WITH_IO
#  include <kte/io.hpp>
#endif

#include <cmath>

// clang-format off
inline constexpr struct q_ final : kte::coord_key<"q"> {} q;
inline constexpr struct base_ final : kte::frame_3D_key<"base"> {} base;
inline constexpr struct arm_ final : kte::frame_3D_key<"arm"> {} arm;
// clang-format on

constexpr auto pendulum =
    kte::chain(kte::revolute_joint_3D(q, base, arm),
               kte::inertia_3D(arm, kte::rigid_body{2.0, kte::along_x(0.5), kte::diagonal(0.1, 0.1, 0.1)}))
        .gravity(kte::along_y(-9.81));

int main() {
  const double zero[1]{};
  return std::abs(kte::inverse_dynamics(pendulum, zero, zero, zero)[0] - 2 * 0.5 * 9.81) < 1e-12 ? 0 : 1;
}
