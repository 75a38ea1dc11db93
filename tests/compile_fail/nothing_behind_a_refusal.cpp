// expect: error: static.*kte: call it as rigid_link_2D.base, end, position
#include <kte/kte.hpp>

// clang-format off
inline constexpr struct q_     final : kte::coord_key<"q">         {} q;
inline constexpr struct base_  final : kte::frame_2D_key<"base">   {} base;
inline constexpr struct joint_ final : kte::frame_2D_key<"joint">  {} joint;
inline constexpr struct tip_   final : kte::frame_2D_key<"tip">    {} tip;
// clang-format on

// Uses of the chain of a refused element cause no further errors: one mistake, one sentence.
double angle() {
  const auto pendulum = kte::chain(kte::revolute_joint_2D(q, base, joint), kte::rigid_link_2D(joint, tip, 0.5),
                                   kte::inertia_2D(tip, kte::point_mass(1.0)));
  auto s = kte::make_state(pendulum);
  pendulum.doMotion(s);
  return s[q].q + s[tip].position.x;
}
