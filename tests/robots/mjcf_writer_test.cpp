#include <kte/dynamics/runtime.hpp>
#include <kte/elements/free_joint.hpp>
#include <kte/elements/planar_joint.hpp>
#include <kte/robots/load_robot.hpp>
#include <kte/robots/mjcf_writer.hpp>

#include "catch.hpp"
#include "robots/files.hpp"

using namespace kte;
using test::robot_file, test::says;

TEST_CASE("robots written as MJCF move as they did") {
  const auto name = GENERATE("iiwa14.urdf", "everything.xml", "everything.sdf");
  auto d = load_robot(robot_file(name));
  for (auto& x : d.limits.rate) x = joint_limits<>::none;
  for (auto& x : d.limits.upper)
    if (x == 1) x = joint_limits<>::none;  // a limit to one side alone
  const auto text = to_mjcf(d);
  const auto again = to_robot(from_mjcf(text, "again"));
  CHECK(again.chain.gravity() == d.chain.gravity());
  REQUIRE(again.chain.dofs() == d.chain.dofs());
  CHECK(again.limits.lower == d.limits.lower);
  CHECK(again.limits.effort == d.limits.effort);
  auto s = d.chain.make_state(), t = again.chain.make_state();
  const int n = d.chain.dofs();
  Eigen::VectorXd step(n), v(n), a(n);
  for (int i = 0; i < n; ++i) step[i] = std::sin(i + 1.0), v[i] = std::cos(i + 1.0), a[i] = std::sin(2 * i);
  const auto q = integrate(d.chain, neutral_configuration(d.chain), step, 1.0);
  const auto& tau = inverse_dynamics(d.chain, s, q, v, a);
  const auto& same = inverse_dynamics(again.chain, t, q, v, a);
  for (std::size_t i = 0; i < static_cast<std::size_t>(n); ++i) CHECK(tau[i] == within(same[i], 4e-14));
}

TEST_CASE("what MJCF cannot say is refused by name") {
  kte_map_chain c;
  c << free_joint_3D("trunk", "ground", "body");
  CHECK_THROWS_MATCHES(to_mjcf(c), bad_argument,
                       says("kte: joint 'trunk': it floats in another link than the world, which MJCF cannot say"));
  kte_map_chain p;
  p << planar_joint_3D("puck", "ground", "body");
  CHECK_THROWS_MATCHES(to_mjcf(p), bad_argument, says("kte: joint 'puck': it is planar"));
  CHECK_THROWS_MATCHES(to_mjcf(load_robot(robot_file("everything.sdf"), {.fold_fixed = true})), bad_argument,
                       says("kte: link 'world': it has a mass"));
  CHECK_THROWS_MATCHES(to_mjcf(load_robot(robot_file("iiwa14.urdf"))), bad_argument,
                       says("kte: joint 'q1': its rate has a limit"));
}
