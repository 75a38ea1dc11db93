// expect: error: .*kte: this algorithm does not support contacts; contact_dynamics
// clang-format off
#include <kte/kte.hpp>
#include <kte/elements/rigid_contact.hpp>
// clang-format on

inline constexpr struct foot_ final : kte::contact_key<"foot"> {
} foot;
inline constexpr struct q_ final : kte::coord_key<"q"> {
} q;
inline constexpr struct base_ final : kte::frame_2D_key<"base"> {
} base;
inline constexpr struct end_ final : kte::frame_2D_key<"end"> {
} end;

int main() {
  constexpr auto c =
      kte::chain(kte::prismatic_joint_2D(q, base, end, kte::axis::y), kte::inertia_2D(end, kte::point_mass(1.0)),
                 kte::point_contact_2D(foot, base, end, kte::half_space{}, {0.5, 0}));
  const double zero[1]{};
  return static_cast<int>(kte::nonlinear_effects(c, zero, zero)[0]);
}
