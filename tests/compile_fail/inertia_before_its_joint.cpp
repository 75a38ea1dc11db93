// expect: error: .*kte: this element reads a name that only a later element writes: move it behind that element
// expect: inertia.*arm_
#include <kte/kte.hpp>

// clang-format off
inline constexpr struct q_      final : kte::coord_key<"q">          {} q;
inline constexpr struct ground_ final : kte::frame_3D_key<"ground">  {} ground;
inline constexpr struct arm_    final : kte::frame_3D_key<"arm">     {} arm;
// clang-format on

constexpr auto robot = kte::chain(kte::inertia_3D(arm, kte::point_mass(1.0)), kte::revolute_joint_3D(q, ground, arm));
