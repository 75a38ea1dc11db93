#include <kte/dynamics/derivatives.hpp>
#include <kte/kte.hpp>

#include "catch.hpp"
#include "random.hpp"

// Which coordinates change the forces on each other, and products that leave out the others.

namespace column_groups_test {

using namespace kte;

constexpr struct ground_ final : frame_3D_key<"ground"> {
} ground;
constexpr struct trunk_ final : frame_3D_key<"trunk"> {
} trunk;
constexpr struct thigh_ final : frame_3D_key<"thigh"> {
} thigh;
constexpr struct shank_ final : frame_3D_key<"shank"> {
} shank;
constexpr struct arm_ final : frame_3D_key<"arm"> {
} arm;
constexpr struct floating_ final : pose_3D_key<"floating"> {
} floating;
constexpr struct hip_ final : coord_key<"hip"> {
} hip;
constexpr struct knee_ final : coord_key<"knee"> {
} knee;
constexpr struct shoulder_ final : coord_key<"shoulder"> {
} shoulder;
constexpr rigid_body body{1.5, vec3{0.02, -0.03, 0.1}, sym3{0.03, 0.001, -0.002, 0.025, 0.003, 0.02}};

/// A trunk that moves freely, with a leg and an arm.
template <class... E>
constexpr auto figure(const E&... more) {
  return chain(free_joint_3D(floating, ground, trunk), inertia_3D(trunk, body),
               revolute_joint_3D(hip, trunk, thigh, axis::x), inertia_3D(thigh, body),
               revolute_joint_3D(knee, thigh, shank, axis::y), inertia_3D(shank, body),
               revolute_joint_3D(shoulder, trunk, arm, vec3{0.0, 0.6, 0.8}), inertia_3D(arm, body), more...)
      .gravity(along_z(-9.81));
}
template <class Chain>
constexpr auto groups = detail::group_columns<Chain, detail::is_analytical<Chain>>();

template <class Chain>
void check_products(const Chain& c) {
  constexpr int n = Chain::dofs;
  random_numbers random(7);
  for (int round = 0; round < 10; ++round) {
    std::array<double, Chain::nq> q;
    std::array<double, n> v, tau;
    for (auto& x : q) x = random(1);
    for (auto& x : v) x = random(2);
    for (auto& x : tau) x = random(5);
    const auto r = forward_dynamics_derivatives(c, q, v, tau);
    const auto forces = inverse_dynamics_derivatives(c, q, v, r.a);
    // Sums of at most n products, in another order: each rounding is of the size of the products of the norms.
    const auto most = [&](const auto& b) { return 2 * n * 0x1p-53 * r.by_tau.norm() * b.norm(); };
    CHECK((r.by_q + r.by_tau * forces.by_q).norm() <= most(forces.by_q));
    CHECK((r.by_v + r.by_tau * forces.by_v).norm() <= most(forces.by_v));
  }
}

TEST_CASE("columns of a leg and of an arm have their rows and those of the trunk") {
  constexpr auto c = figure();
  constexpr auto g = groups<std::remove_const_t<decltype(c)>>;
  STATIC_REQUIRE(g.count == 3);
  STATIC_REQUIRE((g.group[0].first == 0 && g.group[0].end == 6 && g.group[0].count == 9));
  STATIC_REQUIRE((g.group[1].first == 6 && g.group[1].end == 8 && g.group[1].count == 8));
  STATIC_REQUIRE((g.group[2].first == 8 && g.group[2].end == 9 && g.group[2].count == 7 && g.group[2].row[6] == 8));
  check_products(c);
}

TEST_CASE("a spring between coordinates of two limbs gives both a row more") {
  constexpr auto c = figure(spring_gen(knee, shoulder, 0.25, 20.0));
  constexpr auto g = groups<std::remove_const_t<decltype(c)>>;
  STATIC_REQUIRE(g.count == 4);  // the hip does not feel it
  STATIC_REQUIRE((g.group[1].count == 8 && g.group[2].count == 9 && g.group[3].count == 8));
  check_products(c);
}

TEST_CASE("a spring between frames may change everything") {
  constexpr auto c = figure(spring_3D(shank, arm, 0.1, 20.0));
  constexpr auto g = groups<std::remove_const_t<decltype(c)>>;
  STATIC_REQUIRE((g.count == 1 && g.group[0].count == 9 && g.group[0].end == 9));
  check_products(c);
}

}  // namespace column_groups_test
