#include "models/held_block.hpp"

namespace modes_test {

using namespace kte;
using namespace kte::test::held_block;

// Elements that hold a coordinate, in models of static and runtime chains.

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
    runtime_chain r;
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

TEST_CASE("a brake holds, lets go and holds again as the pressure changes") {
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
  runtime_chain c;
  c << revolute_joint_2D("q1", "ground", "a") << rigid_link_2D("a", "b", along_x(0.5))
    << inertia_2D("b", point_mass(1.0)) << revolute_joint_2D("q2", "b", "c") << rigid_link_2D("c", "d", along_x(0.4))
    << inertia_2D("d", point_mass(2.0)) << joint_stiction_gen("q1", "mode", {50.0, 60.0});
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

/// A runtime model with what settles it and its events, to 1e-13.
template <class Model>
auto run(Model& model, double t_end, const typename Model::state& start) {
  prince_dormand87 solver(std::cref(model), 0.0, start, {.absolute = 1e-13, .relative = 1e-13});
  auto report = solver.integrate(t_end, element_events(model));
  return std::pair{std::move(report), typename Model::state(solver.state())};
}
constexpr double pi = std::numbers::pi;

TEST_CASE("an oscillator with dry friction comes to rest after a number of half swings") {
  // x'' = -100 x - 2 sign(x'): half swings of pi/10 s about -+0.02 m, each 0.04 m shorter, until |x| <= 0.02. From 1 m
  // that is 25, to the very middle, at 7.8539816339744830961566 s.
  const auto c = chain(prismatic_joint_2D(x, ground, block, axis::x), inertia_2D(block, point_mass(1.0)),
                       base_gen(wall), spring_gen(wall, x, 0.0, 100.0), joint_stiction_gen(x, rest, {2.0, 2.0}));
  const auto check = [](auto& model, double x0) {
    const auto [report, end] = run(model, 10.0, settled(model, 0.0, model.make_x(std::array{x0}, std::array{0.0})));
    double amplitude = std::abs(x0), side = x0 > 0 ? 1 : -1;
    std::size_t n = 0;
    while (amplitude > 0.02) {
      amplitude -= 0.04, side = -side, ++n;
      REQUIRE(report.events.size() >= n);
      CHECK(report.events[n - 1].time == within(static_cast<double>(n) * pi / 10, 1e-12));
      CHECK(report.events[n - 1].after[0] == within(side * amplitude, 1e-12));
    }
    CHECK(report.count == static_cast<long long>(n));
    CHECK(end[0] == within(side * amplitude, 1e-12));
    CHECK(end[1] == within(0, 0));
    CHECK(end[2] == within(mode::held, 0));
  };
  const double x0 = GENERATE(1.0, -1.013);
  manipulator_dynamics_model fixed(c);
  check(fixed, x0);
  const runtime_chain r = models::registered(record_of(c));
  manipulator_dynamics_model at_run_time(r);
  check(at_run_time, x0);
}

TEST_CASE("a block on a belt sticks and slips") {
  // 1 kg on 100 N/m, friction 3 N at rest, 2 N sliding, belt of 0.05 m/s. It sticks until the spring pulls with 3 N,
  // then slips about 0.02 m with the amplitude 0.01 m and the speed v at its start, until its speed is that of the belt
  // again.
  const double v = 0.05, slip = (2 * pi - 2 * std::atan(0.01 * 10 / v)) / 10, stick = 0.02 / v;
  runtime_chain c;
  c << law_signal([v](const auto& t) { return v * t; }, chain_time.name, "way")
    << law_signal([v](const auto& t) { return v + 0 * t; }, chain_time.name, "speed")
    << law_signal([](const auto& t) { return 0 * t; }, chain_time.name, "none")
    << position_control_gen("way", "speed", "none", "belt") << differential_gen("belt", "on belt", "block", 1.0, 1.0)
    << inertia_gen("block", 1.0) << base_gen("wall") << spring_gen("wall", "block", 0.0, 100.0)
    << joint_stiction_gen("on belt", "mode", {.coulomb = 2.0, .stiction = 3.0, .stribeck_velocity = 0});
  manipulator_dynamics_model model(c);
  const auto [report, end] = run(model, 20.0, settled(model, 0.0, model.make_x(std::array{0.01}, std::array{0.0})));
  REQUIRE(report.count == 49);
  double t = 0;
  for (std::size_t i = 0; i < report.events.size(); ++i) {
    const auto& e = report.events[i];
    t += i % 2 == 0 ? stick : slip;
    CHECK(e.time == within(t, 5e-13 * static_cast<double>(i + 1)));
    CHECK(v * e.time + e.after[0] == within(i % 2 == 0 ? 0.03 : 0.01, 1e-12));
    CHECK(e.after[2] == within(i % 2 == 0 ? mode::backward : mode::held, 0));
  }
}

TEST_CASE("a block is let go when the slope is as steep as friction") {
  // The slope has the angle t / 100; friction is 0.4 times the normal force.
  const auto c = chain(law_signal(
                           [](const auto& t) {
                             using std::sin;
                             return -9.81 * sin(t / 100.0);
                           },
                           chain_time, pull),
                       driving_actuator_gen(x, pull), prismatic_joint_2D(x, ground, block, axis::x),
                       inertia_2D(block, point_mass(1.0)),
                       law_signal(
                           [](const auto& t) {
                             using std::cos;
                             return 0.4 * 9.81 * cos(t / 100.0);
                           },
                           chain_time, grip),
                       brake_gen(x, rest, grip));
  manipulator_dynamics_model model(c);
  const auto [report, end] = run(model, 50.0, settled(model, 0.0, model.make_x(std::array{0.0}, std::array{0.0})));
  REQUIRE(report.count == 1);
  const double release = 100 * std::atan(0.4);
  CHECK(report.events[0].time == within(release, 1e-12));
  CHECK(end[2] == within(mode::backward, 0));
  // then x'' = -g (sin a - mu cos a), a = t / 100: twice integrated, with a_0 = atan(mu)
  const double a = 0.5, a0 = std::atan(0.4), g_over = 9.81 * 1e4;
  const auto f = [](double y) { return -std::sin(y) + 0.4 * std::cos(y); };  // its second derivative is the pull
  const auto f_prime = [](double y) { return -std::cos(y) - 0.4 * std::sin(y); };
  CHECK(end[0] == within(-g_over * (f(a) - f(a0) - (a - a0) * f_prime(a0)), 1e-9));
}

TEST_CASE("two blocks with a spring between them creep like a worm") {
  // The second is pulled by t N, and by a spring of 100 N/m the first. Friction of 1 N and 0.5 N.
  runtime_chain c;
  c << base_gen("wall") << inertia_gen("a", 1.0) << inertia_gen("b", 2.0) << spring_gen("a", "b", 0.0, 100.0)
    << law_signal([](const auto& t) { return t; }, chain_time.name, "hand") << driving_actuator_gen("b", "hand")
    << joint_stiction_gen("a", "mode a", {0.5, 0.5}) << joint_stiction_gen("b", "mode b", {1.0, 1.0});
  manipulator_dynamics_model model(c);
  const auto start = settled(model, 0.0, model.make_x(std::array{0.0, 0.0}, std::array{0.0, 0.0}));
  const auto [report, end] = run(model, 1.8, start);
  // b goes at 1 s: 2 y'' + 100 y = s, s = t - 1: y = (s - sin(w s)/w)/100, w^2 = 50. a goes when 100 y = 1/2.
  REQUIRE(report.count == 2);
  CHECK(report.events[0].time == within(1, 1e-12));
  const double w = std::sqrt(50.0);
  double s = 0.5;
  for (int i = 0; i < 50; ++i) s -= (s - std::sin(w * s) / w - 0.5) / (1 - std::cos(w * s));
  CHECK(report.events[1].time == within(1 + s, 1e-12));
  CHECK(report.events[1].after[0] == within(0, 0));
}

TEST_CASE("friction of two kinds on one coordinate holds by their sum, both ways") {
  const auto push = [](double t) { return 6 * std::sin(t); };
  runtime_chain c;
  c << inertia_gen("x", 1.0) << driving_actuator_gen("x", "push") << joint_stiction_gen("x", "mode 1", {3.0, 3.0})
    << joint_stiction_gen("x", "mode 2", {4.0, 4.0});
  const manipulator_dynamics_model inner(c);
  controlled model(inner, [&](double t, const auto&) { return std::array{push(t)}; });
  const auto start = settled(model, 0.0, model.make_x(std::array{0.0}, std::array{0.0}));
  prince_dormand87 solver(std::ref(model), 0.0, start, {.absolute = 1e-12, .relative = 1e-12});
  CHECK(solver.integrate(10.0, element_events(model)).count == 0);
  CHECK(solver.state()[0] == within(0, 0));
}

TEST_CASE("what one joint does may hold another that was let go") {
  // A slab moves by 10 m for each rad of q, and a block on the slab by s. A force of 10 N on the block; friction of 2 N
  // between them, 25 Nm in q. Both are beyond their limits, q by 75 Nm; but once s slides it carries but 2 N.
  runtime_chain c;
  c << mimic_gen("q", "slab", 10.0) << inertia_gen("slab", 1.0) << differential_gen("slab", "s", "block", 1.0, 1.0)
    << inertia_gen("block", 1.0) << driving_actuator_gen("block", "push")
    << joint_stiction_gen("q", "mode q", {25.0, 25.0}) << joint_stiction_gen("s", "mode s", {2.0, 2.0});
  manipulator_dynamics_model model(c);
  model.input("push") = 10;
  const auto start = settled(model, 0.0, model.make_x(std::array{0.0, 0.0}, std::array{0.0, 0.0}));
  const int at_q = static_cast<int>(model.locks()[0].mode), at_s = model.locks()[1].mode;
  CHECK(start[at_q] == within(mode::held, 0));  // 2 N on the slab are 20 Nm, less than 25
  CHECK(start[at_s] == within(mode::forward, 0));
  const Eigen::VectorXd rate = model(0.0, start);
  CHECK(rate[2 + model.locks()[0].row] == within(0, 0));
  CHECK(rate[2 + model.locks()[1].row] == within(8, 1e-14));
}

TEST_CASE("a brake pressed by a law of time, of a controlled model") {
  const auto press = [](double t, const auto&) { return std::array{t < 1 ? 2.0 - 1.5 * t : 1.5 * t - 1.0}; };
  const auto c =
      chain(prismatic_joint_2D(x, ground, block, axis::x), inertia_2D(block, point_mass(1.0)), brake_gen(x, rest, grip))
          .gravity(along_x(1.0));
  const auto check = [](auto& model) {
    const auto start = settled(model, 0.0, model.make_x(std::array{0.0}, std::array{0.0}));
    CHECK(start[2] == within(mode::held, 0));
    prince_dormand87 solver(std::ref(model), 0.0, start, {.absolute = 1e-12, .relative = 1e-12});
    const auto report = solver.integrate(3.0, element_events(model));
    REQUIRE(report.count == 2);
    CHECK(report.events[0].time == within(2.0 / 3, 1e-12));
    CHECK(report.events[1].time == within(4.0 / 3 + std::sqrt(2.0 / 9), 1e-10));  // as above: the grip has a kink
    CHECK(solver.state()[1] == within(0, 0));
    CHECK(solver.state()[2] == within(mode::held, 0));
  };
  manipulator_dynamics_model inner(c);
  controlled fixed(inner, press);
  check(fixed);
  const runtime_chain r = models::registered(record_of(c));
  const manipulator_dynamics_model of_r(r);
  controlled at_run_time(of_r, press);
  check(at_run_time);
}

TEST_CASE("a brake that is not pressed lets go of what begins to be pulled") {
  // held by nothing, at rest, until the pull begins at 1 s
  runtime_chain c;
  c << inertia_gen("x", 1.0) << driving_actuator_gen("x", "pull") << brake_gen("x", "mode", "grip");
  const manipulator_dynamics_model inner(c);
  controlled model(inner, [](double t, const auto&) { return std::array{t > 1 ? t - 1 : 0.0, 0.0}; });
  const auto start = settled(model, 0.0, model.make_x(std::array{0.0}, std::array{0.0}));
  prince_dormand87 solver(std::ref(model), 0.0, start, {.absolute = 1e-12, .relative = 1e-12});
  solver.integrate(1.0, element_events(model));
  const auto report = solver.integrate(3.0, element_events(model));
  CHECK(report.count == 1);
  CHECK(solver.state()[0] == within(8.0 / 6, 1e-11));
}

}  // namespace modes_test
