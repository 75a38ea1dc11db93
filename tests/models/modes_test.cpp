#include <kte/elements/joint_stiction.hpp>
#include <kte/elements/law_signal.hpp>
#include <kte/simulation.hpp>

#include <cmath>
#include <numbers>

#include "catch.hpp"
#include "chain/registered.hpp"

using namespace kte;

/// Elements that hold a coordinate, in models of static and runtime chains.
namespace {

constexpr struct x_ final : coord_key<"x"> {
} x;
constexpr struct mode_ final : internal_key<"mode"> {
} rest;
constexpr struct ground_ final : frame_2D_key<"ground"> {
} ground;
constexpr struct block_ final : frame_2D_key<"block"> {
} block;
constexpr struct grip_ final : input_key<"grip"> {
} grip;

constexpr double g = 9.81, slope = std::numbers::pi / 6;

/// A block of 1 kg on a slope of 30 degrees; x points down.
auto on_slope(double coulomb, double stiction) {
  return chain(prismatic_joint_2D(x, ground, block, axis::x), inertia_2D(block, point_mass(1.0)),
               joint_stiction_gen(x, rest, {coulomb, stiction}))
      .gravity(vec3{g * std::sin(slope), -g * std::cos(slope), zero});
}

}  // namespace

TEST_CASE("a block rests on a slope of 30 degrees") {
  const auto c = on_slope(5.0, 5.5);  // its weight along the slope is 4.905 N
  manipulator_dynamics_model model(c);
  const auto start = settled(model, 0.0, model.make_x(std::array{0.3}, std::array{0.0}));
  CHECK(start[2] == within(mode::held, 0));
  prince_dormand87 solver(std::cref(model), 0.0, start, {.absolute = 1e-9, .relative = 1e-9});
  const auto report = solver.integrate(1e4, element_events(model));
  CHECK(report.count == 0);
  CHECK(solver.state()[0] == within(0.3, 0));
  CHECK(solver.state()[1] == within(0, 0));
}

TEST_CASE("a block slides to rest, in the time and over the way of constant friction") {
  const auto c = on_slope(7.0, 8.0);
  const bool at_run_time = GENERATE(false, true);
  const auto check = [](auto& model) {
    using state = std::remove_cvref_t<decltype(model.make_x(std::array{0.0}, std::array{0.0}))>;
    const state start = settled(model, 0.0, model.make_x(std::array{0.0}, std::array{2.0}));
    CHECK(start[2] == within(mode::forward, 0));
    prince_dormand87 solver(std::cref(model), 0.0, start, {.absolute = 1e-12, .relative = 1e-12});
    const auto report = solver.integrate(10.0, element_events(model));
    // dry friction of 7 N while it moves fast; the Stribeck velocity of 1 m/s adds to it: the time by a quadrature
    REQUIRE(report.count == 1);
    CHECK(solver.state()[1] == within(0, 0));
    CHECK(solver.state()[2] == within(mode::held, 0));
    double time = 0, way = 0;
    const int n = 2000;  // Simpson's rule over the speed
    for (int i = 0; i <= n; ++i) {
      const double v = 2.0 * i / n, a = 7 + std::exp(-v * v) - g * std::sin(slope);
      const double w = (i == 0 || i == n ? 1 : i % 2 == 1 ? 4 : 2) * 2.0 / n / 3;
      time += w / a, way += w * v / a;
    }
    CHECK(report.events.front().time == within(time, 1e-11));
    CHECK(solver.state()[0] == within(way, 1e-11));
  };
  if (at_run_time) {
    kte_map_chain r;
    r << prismatic_joint_2D("x", "ground", "block", axis::x) << inertia_2D("block", point_mass(1.0))
      << joint_stiction_gen("x", "mode", {7.0, 8.0});
    r.gravity(vec3{g * std::sin(slope), -g * std::cos(slope), zero});
    manipulator_dynamics_model model(r);
    check(model);
  } else {
    manipulator_dynamics_model model(c);
    check(model);
  }
}

TEST_CASE("a block breaks away when the slope becomes too steep, and slides on") {
  const auto c = on_slope(3.0, 4.0);
  manipulator_dynamics_model model(c);
  const auto start = settled(model, 0.0, model.make_x(std::array{0.0}, std::array{0.0}));
  CHECK(start[2] == within(mode::forward, 0));  // 4.905 N pull
  const auto rate = model(0.0, start);
  CHECK(rate[1] == within(g * std::sin(slope) - 4.0, 1e-15));
}

TEST_CASE("a brake holds, lets go and holds again as it is pressed") {
  const auto press = [](const auto& t) {
    using S = std::remove_cvref_t<decltype(t)>;
    return t < S(1) ? S(2.0 - 1.5 * t) : S(1.5 * t - 1.0);
  };
  const auto c = chain(prismatic_joint_2D(x, ground, block, axis::x), inertia_2D(block, point_mass(1.0)),
                       law_signal(press, chain_time, grip), brake_gen(x, rest, grip))
                     .gravity(along_x(1.0));
  manipulator_dynamics_model model(c);
  const auto start = settled(model, 0.0, model.make_x(std::array{0.0}, std::array{0.0}));
  CHECK(start[2] == within(mode::held, 0));
  dormand_prince45 solver(std::cref(model), 0.0, start, {.absolute = 1e-12, .relative = 1e-12});
  // 1 N pulls. The grip falls below that at 2/3 s and rises above it at 4/3 s: v' = 1 - (2 - 1.5 t), then 1 - (1.5 t -
  // 1).
  const auto report = solver.integrate(3.0, element_events(model));
  REQUIRE(report.count == 2);
  CHECK(report.events[0].time == within(2.0 / 3, 1e-11));
  // v(4/3) = 1/6; then v' = -1.5 s, s = t - 4/3, to v = 0
  CHECK(report.events[1].time == within(4.0 / 3 + std::sqrt(2.0 / 9), 1e-10));  // the grip has a kink
  CHECK(solver.state()[1] == within(0, 0));
  CHECK(solver.state()[2] == within(mode::held, 0));
}

TEST_CASE("derivatives of a model in which a coordinate is held") {
  kte_map_chain c;
  c << revolute_joint_2D("q1", "ground", "a") << rigid_link_2D("a", "b", along_x(0.5)) << inertia_2D("b", point_mass(1.0))
    << revolute_joint_2D("q2", "b", "c") << rigid_link_2D("c", "d", along_x(0.4)) << inertia_2D("d", point_mass(2.0))
    << joint_stiction_gen("q1", "mode", {50.0, 60.0});
  c.gravity(along_y(-9.81));
  auto s = c.make_state();
  s.internal("mode").z = mode::held;
  const Eigen::Vector2d q(0.3, -0.5), v(0, 0.7), tau(0.2, 0.4);
  const Eigen::Vector2d a = forward_dynamics(c, s, q, v, tau);
  CHECK(a[0] == within(0, 0));
  // a pendulum of 0.4 m on a fixed point
  CHECK(a[1] == within((0.4 - 2 * 9.81 * 0.4 * std::cos(q[0] + q[1])) / (2 * 0.4 * 0.4), 1e-13));
  const auto r = forward_dynamics_derivatives(c, s, q, v, tau);
  CHECK(r.by_tau(0, 0) == within(0, 0));
  CHECK(r.by_tau(1, 1) == within(1 / (2 * 0.4 * 0.4), 1e-14));
  CHECK(r.by_q(1, 1) == within(9.81 * std::sin(q[0] + q[1]) / 0.4, 1e-13));
  CHECK(r.by_q(0, 1) == within(0, 0));
}
