// mistakes: 9
// expect: error: .*kte: carried_inertia is now subtree_inertia
// expect: error: .*kte: centroidal_map is now centroidal_momentum_matrix
// expect: error: .*kte: clik is now numerical_inverse_kinematics
// expect: error: .*kte: clik_options is now numerical_ik_options
// expect: error: .*kte: clik_status is now numerical_ik_status
// expect: error: .*kte: coordinate_holder is now coordinate_lock
// expect: error: .*kte: the flag reads_reaction of an element core is now load_dependent_friction
// expect: error: .*kte: the flag spreads_mass of an element core is now distributed_mass
// Of alias templates clang 14 has no warnings.
#pragma GCC diagnostic error "-Wdeprecated-declarations"
#include <kte/dynamics/centroidal.hpp>
#include <kte/dynamics/subtree_inertia.hpp>
#include <kte/elements/inertia.hpp>
#include <kte/elements/revolute_joint.hpp>
#include <kte/manipulators/iiwa14.hpp>
#include <kte/manipulators/numerical_inverse_kinematics.hpp>

#include <array>

// clang-format off
inline constexpr struct q_    final : kte::coord_key<"q">       {} q;
inline constexpr struct base_ final : kte::frame_3D_key<"base"> {} base;
inline constexpr struct tip_  final : kte::frame_3D_key<"tip">  {} tip;
// clang-format on

constexpr auto pendulum = kte::chain(kte::revolute_joint_3D(q, base, tip), kte::inertia_3D(tip, kte::point_mass(2.0)));
using one = std::array<double, 1>;
double mass(const one& x) { return kte::carried_inertia(pendulum, x, tip).mass; }
double momentum(const one& x) { return kte::centroidal_map(pendulum, x)(0, 0); }

constexpr auto arm = kte::iiwa14();
using seven = std::array<double, 7>;
auto found(const seven& x, const kte::pose<kte::mat3<>, kte::vec3<>>& at) {
  return kte::clik(arm, kte::reach(kte::arm_names::tool, at), x);
}
auto numerically(const seven& x, const kte::pose<kte::mat3<>, kte::vec3<>>& at) {
  return kte::clik(arm, kte::reach(kte::arm_names::tool, at), x, {.numeric = true});
}
const kte::clik_options options;
kte::clik_status status;

kte::coordinate_holder* lock;
struct old_core {
  static constexpr bool spreads_mass = true, reads_reaction = true;
};
static_assert(kte::distributed_mass<old_core> && kte::load_dependent_friction<old_core>);
