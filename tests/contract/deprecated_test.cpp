#include <kte/contract/coordinate_holder.hpp>
#include <kte/deprecated.hpp>
#include <kte/dynamics/centroidal.hpp>
#include <kte/dynamics/subtree_inertia.hpp>
#include <kte/elements/inertia.hpp>
#include <kte/elements/revolute_joint.hpp>
#include <kte/manipulators/iiwa14.hpp>
#include <kte/manipulators/numerical_inverse_kinematics.hpp>
#include <kte/math/out_of_line.hpp>

#include "catch.hpp"

namespace deprecated_test {

// Former names are those of today (tests/compile_fail/former_names.cpp: with a warning that says which).
#pragma GCC diagnostic ignored "-Wdeprecated-declarations"

using namespace kte;

// clang-format off
inline constexpr struct q_    final : coord_key<"q">       {} q;
inline constexpr struct base_ final : frame_3D_key<"base"> {} base;
inline constexpr struct tip_  final : frame_3D_key<"tip">  {} tip;
// clang-format on

TEST_CASE("former names of functions") {
  const auto c = chain(revolute_joint_3D(q, base, tip), inertia_3D(tip, point_mass(2.0, along_x(0.5))));
  const std::array x{0.3};
  CHECK(carried_inertia(c, x, tip).moment == subtree_inertia(c, x, tip).moment);
  CHECK(centroidal_map(c, x) == centroidal_momentum_matrix(c, x));
  kte_map_chain made;
  made << c;
  auto s = make_state(made);
  CHECK(dofs(made) == dofs(c));
  CHECK(carried_inertia(made, s, x, "tip").mass == 2);
  CHECK(centroidal_map(made, s, x) == centroidal_momentum_matrix(made, s, x));

  constexpr auto arm = iiwa14();
  const std::array start{0.0, 0.5, 0.0, -1.0, 0.0, 0.5, 0.0};
  const auto goal = reach(arm_names::tool, forward_kinematics(arm, start, arm_names::tool));
  const clik_options numerically{.numeric = true};
  CHECK(clik(arm, goal, start).status == clik_status::reached);
  CHECK(clik(arm, goal, start, numerically).q == numerical_inverse_kinematics(arm, goal, start, numerically).q);
}

TEST_CASE("former names of types") {
  STATIC_REQUIRE(std::is_same_v<kte_map_chain, runtime_chain>);
  STATIC_REQUIRE(std::is_same_v<coordinate_holder, coordinate_lock>);
  STATIC_REQUIRE(std::is_same_v<lean<double>, out_of_line<double>>);
}

}  // namespace deprecated_test
