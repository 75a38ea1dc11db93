#include <kte/elements/driving_actuator.hpp>
#include <kte/elements/free_joint.hpp>
#include <kte/elements/inertia.hpp>
#include <kte/elements/joint_lugre.hpp>
#include <kte/elements/position_control.hpp>
#include <kte/elements/revolute_joint.hpp>
#include <kte/elements/rigid_link.hpp>
#include <kte/integrators/dormand_prince45.hpp>
#include <kte/models/runtime_dynamics_model.hpp>

#include <cmath>

#include "allocations.hpp"
#include "catch.hpp"
#include "random.hpp"

namespace runtime_dynamics_model_test {

using namespace kte;
using kte::test::contains_text;

// clang-format off
constexpr struct trunk_pose_ final : pose_3D_key<"pose">     {} trunk_pose;
constexpr struct q_          final : coord_key<"q">          {} q;
constexpr struct world_      final : frame_3D_key<"world">   {} world;
constexpr struct trunk_      final : frame_3D_key<"trunk">   {} trunk;
constexpr struct hip_        final : frame_3D_key<"hip">     {} hip;
constexpr struct foot_       final : frame_3D_key<"foot">    {} foot;
constexpr struct motor_      final : input_key<"motor">      {} motor;
constexpr struct hairs_      final : internal_key<"bristles"> {} bristles;
// clang-format on

constexpr lugre_parameters friction{
    .sigma0 = 50, .sigma1 = 1, .sigma2 = 0.4, .coulomb = 1, .stiction = 1.5, .stribeck_velocity = 0.1};

/// A free trunk with a leg, a motor and friction in its hip: as a static and as a runtime chain.
const rigid_body<> body{2.0, {0.01, -0.02, 0.03}, {0.02, 0.001, 0.0, 0.03, 0.0, 0.025}};
const auto fixed =
    chain(free_joint_3D(trunk_pose, world, trunk), inertia_3D(trunk, body), revolute_joint_3D(q, trunk, hip, axis::y),
          rigid_link_3D(hip, foot, along_z(-0.3)), inertia_3D(foot, point_mass(0.5)), driving_actuator_gen(q, motor),
          joint_lugre_gen(q, bristles, friction))
        .gravity(along_z(-9.81));
runtime_chain appended() {
  runtime_chain c;
  c.gravity(along_z(-9.81)) << free_joint_3D("pose", "world", "trunk") << inertia_3D("trunk", body)
                            << revolute_joint_3D("q", "trunk", "hip", axis::y)
                            << rigid_link_3D("hip", "foot", along_z(-0.3)) << inertia_3D("foot", point_mass(0.5))
                            << driving_actuator_gen("q", "motor") << joint_lugre_gen("q", "bristles", friction);
  return c;
}
template <class Model>
auto start(const Model& m) {
  return m.make_x(std::array{1.0, 2.0, 3.0, 0.5, -0.5, 0.5, 0.5, 0.4}, std::array{0.1, -0.2, 0.3, 0.4, 2.0, -0.6, 0.7},
                  std::array{0.01});
}

TEST_CASE("a model of a runtime chain is the same system as that of a static chain") {
  manipulator_dynamics_model still(fixed);
  manipulator_dynamics_model moving(appended());
  still.input(motor) = 0.3, moving.input("motor") = 0.3;
  const auto x = start(still);
  const Eigen::VectorXd x_runtime = start(moving);
  REQUIRE(x_runtime == x);
  REQUIRE(moving.rates() == 15);
  const auto r = still.computeStateRate(0, x);
  // equal formulas in another order: M has a condition of some 100, so 1e-13 of the largest number
  CHECK((moving.computeStateRate(0, x_runtime) - r).norm() <= 1e-13 * r.norm());
  CHECK(r[14] != 0);

  dormand_prince45 a(std::ref(still), 0.0, x, {.absolute = 1e-9, .relative = 1e-9});
  dormand_prince45 b(std::cref(moving), 0.0, x_runtime, {.absolute = 1e-9, .relative = 1e-9});
  a.integrate(1), b.integrate(1);
  CHECK(a.statistics().steps == b.statistics().steps);
  // Roundings enter the error estimates, 1e-7 of the tolerance, and by them the steps: far less than the tolerance.
  CHECK((a.state() - b.state()).norm() < 1e-2 * 1e-9 * a.state().norm());
  CHECK(a.state().segment<4>(3).norm() == within_relative(1, 1e-15));
}

TEST_CASE("states of the chain and vectors of a model are the same numbers") {
  manipulator_dynamics_model still(fixed);
  manipulator_dynamics_model moving(appended());
  const auto x = start(still);
  CHECK(still.getJointStates(still.state_at(0, x)) == x);
  CHECK(moving.getJointStates(moving.state_at(0, x)) == Eigen::VectorXd(x));
  CHECK(moving.state_at(0, x).frame_3D("foot").position.x == still.state_at(0, x)[foot].position.x);
  CHECK(moving.computeOutput(0, x) == Eigen::VectorXd(x.head(15)));
  auto height = moving.with_output(
      [](const runtime_state& s) { return Eigen::VectorXd::Constant(1, s.frame_3D("foot").position.z); });
  CHECK(height.computeOutput(0, x)[0] == moving.state_at(0, x).frame_3D("foot").position.z);
  CHECK_THROWS_WITH(moving.input("moter"), contains_text("no input 'moter'"));
  CHECK_THROWS_WITH(moving.make_x(std::array{1.0}, std::array{1.0}), contains_text("q has 1 numbers"));
  const Eigen::VectorXd few = Eigen::VectorXd::Zero(5);
  CHECK_THROWS_WITH(moving.positions_of(few), contains_text("x has 5 numbers, the chain has "));
  CHECK_THROWS_WITH(moving.velocities_of(few), contains_text("x has 5 numbers, the chain has "));
  CHECK_THROWS_WITH(moving.internals_of(few), contains_text("x has 5 numbers, the chain has "));
}

TEST_CASE("the Jacobian of a model has the column of an internal state, by which friction pulls") {
  const manipulator_dynamics_model model(fixed);
  const auto x = start(model);
  auto more = x, less = x;
  more[15] += 1e-3, less[15] -= 1e-3;  // rates are linear in it
  const auto by_z = ((model(0, more) - model(0, less)) / 2e-3).eval();
  CHECK(by_z.segment<7>(7).norm() > 1);
  CHECK((model.jacobian(0, x).col(14) - by_z).norm() < 1e-10 * by_z.norm());
}

TEST_CASE("inputs of three numbers and the time are put into states of the chain") {
  static constexpr struct p_ final : vector_key<"p"> {
  } p;
  static constexpr struct v_ final : vector_key<"v"> {
  } v;
  static constexpr struct a_ final : vector_key<"a"> {
  } a;
  manipulator_dynamics_model still(chain(position_control_3D(p, v, a, world, trunk),
                                         revolute_joint_3D(q, trunk, hip, axis::y), inertia_3D(hip, body),
                                         driving_actuator_gen(q, chain_time)));
  runtime_chain c;
  c << position_control_3D("p", "v", "a", "world", "trunk") << revolute_joint_3D("q", "trunk", "hip", axis::y)
    << inertia_3D("hip", body) << driving_actuator_gen("q", "time");
  manipulator_dynamics_model moving(c);
  still.input(p) = moving.vector("p") = Eigen::Vector3d(1, 2, 3);
  const auto x = still.make_x(std::array{0.0}, std::array{0.0});
  const auto s = still.state_at(0.5, x);
  const auto& t = moving.state_at(0.5, x);
  for (const auto& seen : {s[p], t.vector("p")}) {
    CHECK(seen.x == 1);
    CHECK(seen.y == 2);
    CHECK(seen.z == 3);
  }
  CHECK(s[chain_time] == 0.5);
  CHECK(t.input("time") == 0.5);
  const std::vector<double> none(9, std::nan(""));
  const std::string first = "kte: an input of 'p' must be finite, got nan";
  CHECK_THROWS_WITH(still.setInput(none), first);
  CHECK_THROWS_WITH(moving.setInput(none), first);
  CHECK_THROWS_WITH(moving.input("time"), contains_text("'time' is not an input"));
}

TEST_CASE("an internal state belongs to one element") {
  runtime_chain c = appended();
  CHECK_THROWS_WITH(c << joint_lugre_gen("q", "bristles", friction),
                    contains_text("it writes 'bristles', which is then written twice"));
  CHECK(c.make_state().internal("bristles").z == 0);
}

TEST_CASE("rates of a model allocate nothing") {
  manipulator_dynamics_model still(fixed);
  manipulator_dynamics_model moving(appended());
  const auto x = start(still);
  const Eigen::VectorXd x_runtime = x;
  double sum = moving(0, x_runtime).sum();
  CHECK(allocations::during([&] { sum += still(0, x).sum() + moving(0, x_runtime).sum(); }) == 0);
  CHECK(std::isfinite(sum));
  dormand_prince45 solver(std::cref(still), 0.0, x);
  CHECK(allocations::during(
            [&] { solver.integrate(1, every(0.01), [&](double t, const auto& y) { sum += t + y[0]; }); }) == 0);
}

}  // namespace runtime_dynamics_model_test
