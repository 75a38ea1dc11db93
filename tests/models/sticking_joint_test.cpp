#include <kte/elements/constant_force.hpp>
#include <kte/elements/sticking_joint.hpp>
#include <kte/kte.hpp>
#include <kte/simulation.hpp>

#include <cmath>
#include <numbers>

#include "catch.hpp"
#include "chain/registered.hpp"
#include "random.hpp"

// Joints whose friction by what they carry brings them to rest, against closed forms. Static chains, and the same at
// run time.

namespace sticking_joint_test {

using namespace kte;

// clang-format off
inline constexpr struct q_       final : coord_key<"q">         {} q;
inline constexpr struct s_       final : coord_key<"s">         {} s;
inline constexpr struct q_mode_  final : internal_key<"q.mode"> {} q_mode;
inline constexpr struct s_mode_  final : internal_key<"s.mode"> {} s_mode;
inline constexpr struct ground_  final : frame_3D_key<"ground"> {} ground;
inline constexpr struct disc_    final : frame_3D_key<"disc">   {} disc;
inline constexpr struct wall_    final : frame_2D_key<"wall">   {} wall;
inline constexpr struct wheel_   final : frame_2D_key<"wheel">  {} wheel;
inline constexpr struct tip_     final : frame_2D_key<"tip">    {} tip;
inline constexpr struct upper_   final : frame_2D_key<"upper">  {} upper;
// clang-format on

constexpr double g = 9.81;

/// check(model, as static chain and at run time).
template <class Chain, class Check>
void in_both(const Chain& c, const Check& check) {
  const manipulator_dynamics_model fixed(c);
  check(fixed);
  const runtime_chain r = models::registered(record_of(c));
  const manipulator_dynamics_model at_run_time(r);
  check(at_run_time);
}
/// A simulation from q, v to 1e-13.
template <class Model, std::size_t N>
auto simulated(const Model& model, double t_end, const std::array<double, N>& at, const std::array<double, N>& rate) {
  using state = typename Model::state;
  const state start = settled(model, 0.0, model.make_x(at, rate));
  long long evaluations = 0;
  const auto counted = [&](double t, const state& x) -> typename Model::rate { return ++evaluations, model(t, x); };
  prince_dormand87 solver(counted, 0.0, start, {.absolute = 1e-13, .relative = 1e-13});
  auto report = solver.integrate(t_end, element_events(model));
  struct result {
    decltype(report) events;
    state end;
    long long evaluations;
  };
  return result{std::move(report), solver.state(), evaluations};
}

/// n joints that turn and slide in turn about random axes, each with friction mu by what it carries.
runtime_chain random_arm(int n, double mu, unsigned seed) {
  random_numbers draw(seed);
  runtime_chain c;
  c.gravity(along_z(-g)) << base_3D("ground");
  std::string base = "ground";
  for (int i = 0; i < n; ++i) {
    const auto name = "q" + std::to_string(i), mode = name + ".mode", end = "e" + std::to_string(i);
    const double x = draw(), y = draw(), z = draw(), length = std::sqrt(x * x + y * y + z * z);
    const vec3<> axis{x / length, y / length, z / length};
    const vec3<> mount{draw(0.3), draw(0.3), draw(0.3)};
    if (i % 2 == 0)
      c << sticking_revolute_joint_3D(name, mode, base, end, axis, 0.05, {mu, mu * 1.3, 0.2})
               .at(mount, as<double>(matrix(no_rotation{})));
    else
      c << sticking_prismatic_joint_3D(name, mode, base, end, axis, {mu, mu * 1.2, 0.5})
               .at(mount, as<double>(matrix(no_rotation{})));
    const double mass = 1 + draw(0.5);
    const vec3<> centre{draw(0.1), draw(0.1), draw(0.1)};
    c << inertia_3D(end, rigid_body{mass, centre, sym3{0.1, 0.0, 0.0, 0.12, 0.0, 0.09}});
    base = end;
  }
  return c;
}

TEST_CASE("friction of several joints that is settled to rounding is no jam", "[long]") {
  for (const auto& [mu, n] : {std::pair{0.05, 2}, {0.05, 4}, {0.05, 6}, {0.3, 2}, {0.3, 4}, {0.3, 6}})
    for (unsigned seed = 1; seed <= 12; ++seed) {
      const auto arm = random_arm(n, mu, seed);
      const manipulator_dynamics_model model(arm);
      random_numbers draw(seed + 1000);
      Eigen::VectorXd position(n);
      for (auto& x : position) x = draw();
      const Eigen::VectorXd none = Eigen::VectorXd::Zero(n);
      CAPTURE(mu, n, seed);
      const auto start = settled(model, 0.0, model.make_x(position, none));
      dormand_prince45 solver(std::cref(model), 0.0, start);
      CHECK_NOTHROW(solver.integrate(1.0, element_events(model)));
    }
}

TEST_CASE("a flywheel runs down on dry bearings and rests") {
  constexpr double m = 3.0, I = 0.2, mu = 0.2, radius = 0.01, start = 50.0;
  const auto check = [&](const auto& model, double load) {
    const double slows = mu * radius * load / I, stops = start / slows;
    const auto run = simulated(model, 1e6, std::array{0.3}, std::array{start});
    REQUIRE(run.events.count == 1);
    CHECK(run.events.events[0].time == within_relative(stops, 1e-13));
    CHECK(run.end[0] == within_relative(0.3 + start * stops / 2, 1e-13));
    CHECK(run.end[1] == 0);
    CHECK(run.end[2] == mode::held);
    CHECK(run.evaluations <= 450);
    const auto half = simulated(model, stops / 2, std::array{0.3}, std::array{start});
    CHECK(half.end[1] == within_relative(start / 2, 1e-13));
  };
  SECTION("in the plane") {
    in_both(chain(sticking_revolute_joint_2D(q, q_mode, wall, wheel, radius, {mu}).at(vec2{0.3, 0.1}, rotation_by(0.7)),
                  inertia_2D(wheel, planar_body(m, I)))
                .gravity(along_y(-g)),
            [&](const auto& model) { check(model, m * g); });
  }
  SECTION("in space, overhung: its weight presses on two bearings at +-0.1 m, 0.3 m away") {
    // m g/2 +- m g 0.3/0.2: both press across the axis, with 3 m g together
    const auto inertia = sym3{0.1, 0.0, 0.0, I, 0.0, 0.1};
    in_both(chain(sticking_revolute_joint_3D(q, q_mode, ground, disc, axis::y, radius, {.friction = mu, .span = 0.2}),
                  inertia_3D(disc, rigid_body{m, along_y(0.3), inertia}))
                .gravity(vec3{0.6 * g, 0.0, -0.8 * g}),
            [&](const auto& model) { check(model, 3 * m * g); });
  }
}

TEST_CASE("a pendulum stops at an angle and stays there") {
  // From the horizontal, below the bearing and with d the way of swing: u = q'^2 obeys, as in elements/rotor_test.cpp,
  //
  //   u' + 2 k d u = (2 g/L) (k d sin q - cos q),  k = R / sqrt(L^2 - R^2)
  //
  // with the solution a sin q + b cos q, and exp(-2 k d q). It rests where |cos q| <= R_s/L.
  constexpr double L = 0.5, radius = 0.05, mu = 0.3, mu_s = 0.4, R = mu * radius;
  const double k = R / std::sqrt(L * L - R * R), bottom = -std::numbers::pi / 2;
  const auto next_rest = [&](double from, double d) {
    const double a = 2 * g / L * (2 * k * k - 1) / (1 + 4 * k * k), b = 2 * k * d * (a - g / L);
    const auto part = [&](double x) { return a * std::sin(x) + b * std::cos(x); };
    const auto u = [&](double x) { return part(x) - part(from) * std::exp(-2 * k * d * (x - from)); };
    const double away = std::abs(from - bottom);
    double moving = from + 1e-3 * d * away, still = bottom + d * away;  // u > 0, u < 0
    for (int i = 0; i < 100; ++i) (u((moving + still) / 2) > 0 ? moving : still) = (moving + still) / 2;
    return moving;
  };
  const double start = bottom + 0.9;
  std::vector<double> rests;
  for (double at = start, d = -1; std::abs(std::cos(at)) > mu_s * radius / L; d = -d)
    rests.push_back(at = next_rest(at, d));
  REQUIRE(rests.size() > 10);
  in_both(chain(sticking_revolute_joint_2D(q, q_mode, wall, wheel, radius, {mu, mu_s}),
                rigid_link_2D(wheel, tip, along_x(L)), inertia_2D(tip, point_mass(2.0)))
              .gravity(along_y(-g)),
          [&](const auto& model) {
            const auto run = simulated(model, 1e4, std::array{start}, std::array{0.0});
            REQUIRE(run.events.events.size() == rests.size());
            for (std::size_t i = 0; i < rests.size(); ++i) {
              CHECK(run.events.events[i].after[0] == within(rests[i], 1e-11));
              const int next = i + 1 == rests.size() ? mode::held : i % 2 == 0 ? mode::forward : mode::backward;
              CHECK(run.events.events[i].after[2] == next);
            }
            CHECK(run.end[0] == run.events.events.back().after[0]);
            CHECK(run.end[1] == 0);
          });
}

TEST_CASE("a block on an incline sticks, slides, and comes back as its friction says") {
  constexpr double mu = 0.3, v = 2.0;
  const auto incline = [](double angle, double mu_s) {
    return chain(
               sticking_prismatic_joint_2D(s, s_mode, wall, wheel, vec2{std::cos(angle), std::sin(angle)}, {mu, mu_s}),
               inertia_2D(wheel, planar_body(3.0, 0.1)))
        .gravity(along_y(-g));
  };
  const double angle = GENERATE(0.2, 0.35, 0.5);
  const double mu_s = 0.4, down = g * (std::sin(angle) - mu * std::cos(angle)),
               up = g * (std::sin(angle) + mu * std::cos(angle));
  in_both(incline(angle, mu_s), [&](const auto& model) {
    const bool sticks = std::tan(angle) <= mu_s;
    const auto from_rest = simulated(model, 1.0, std::array{0.3}, std::array{0.0});
    CHECK(from_rest.events.count == 0);
    CHECK(from_rest.end[0] == within(sticks ? 0.3 : 0.3 - down / 2, sticks ? 0.0 : 1e-14));
    CHECK(from_rest.end[2] == (sticks ? mode::held : mode::backward));
    const auto thrown = simulated(model, 3.0, std::array{0.0}, std::array{v});
    REQUIRE(thrown.events.count == 1);
    const auto& top = thrown.events.events[0];
    CHECK(top.time == within(v / up, 1e-14));
    CHECK(top.after[0] == within(v * v / (2 * up), 1e-14));
    CHECK(top.after[1] == 0);
    CHECK(top.after[2] == (sticks ? mode::held : mode::backward));
    const double later = 3 - v / up;
    CHECK(thrown.end[0] == within(v * v / (2 * up) - (sticks ? 0 : down * later * later / 2), 1e-12));
    CHECK(thrown.end[1] == within(sticks ? 0 : -down * later, 1e-12));
    CHECK(thrown.evaluations <= 300);
  });
}

TEST_CASE("of two blocks on each other one is held and one slides") {
  constexpr double m1 = 2.0, m2 = 1.0, mu2 = 0.3;
  struct expectation {
    double mu1, force;
    int lower, upper;
    double a1, a2;  ///< the second on the first
  };
  const double rubs = mu2 * m2 * g;
  const auto x = GENERATE_COPY(expectation{0.2, 8.0, mode::held, mode::forward, 0, (8 - rubs) / m2},
                               expectation{0.05, 8.0, mode::forward, mode::forward, (rubs - 0.05 * 3 * g) / m1,
                                           (8 - rubs) / m2 - (rubs - 0.05 * 3 * g) / m1},
                               expectation{0.2, 2.0, mode::held, mode::held, 0, 0},
                               expectation{0.05, 2.0, mode::forward, mode::held, (2 - 0.05 * 3 * g) / 3, 0},
                               expectation{0.05, -8.0, mode::backward, mode::backward, -(rubs - 0.05 * 3 * g) / m1,
                                           -(8 - rubs) / m2 + (rubs - 0.05 * 3 * g) / m1});
  in_both(chain(sticking_prismatic_joint_2D(q, q_mode, wall, wheel, axis::x, {x.mu1}),
                inertia_2D(wheel, planar_body(m1, 0.1)),
                sticking_prismatic_joint_2D(s, s_mode, wheel, upper, axis::x, {mu2}).at(along_y(0.2)),
                inertia_2D(upper, planar_body(m2, 0.1)), constant_force_2D(upper, along_x(x.force)))
              .gravity(along_y(-g)),
          [&](const auto& model) {
            const auto start = settled(model, 0.0, model.make_x(std::array{0.0, 0.0}, std::array{0.0, 0.0}));
            CHECK(start[4] == x.lower);
            CHECK(start[5] == x.upper);
            const Eigen::VectorXd rate = model(0.0, start);
            CHECK(rate[2] == within(x.a1, 1e-14));
            CHECK(rate[3] == within(x.a2, 1e-14));
            // what slides on what is held does not move it
            const auto run = simulated(model, 1.0, std::array{0.0, 0.0}, std::array{0.0, 0.0});
            CHECK(run.end[0] == within(x.a1 / 2, x.lower == mode::held ? 0.0 : 1e-14));
            CHECK(run.end[1] == within(x.a2 / 2, x.upper == mode::held ? 0.0 : 1e-14));
          });
}

TEST_CASE("a drawer that is pulled aside of its guide jams") {
  // Pulled by P at b from the guide of length L, the bearings carry P b/L each: it moves where 2 mu b < L, however hard
  // it is pulled.
  constexpr double L = 0.3, mu = 0.25, m = 2.0;
  const double P = GENERATE(1.0, 1e6), b = GENERATE(0.59, 0.61);
  in_both(chain(sticking_prismatic_joint_2D(s, s_mode, wall, wheel, axis::x, {.friction = mu, .span = L}),
                inertia_2D(wheel, planar_body(m, 0.1)), rigid_link_2D(wheel, tip, along_y(b)),
                constant_force_2D(tip, along_x(P))),
          [&](const auto& model) {
            const auto start = settled(model, 0.0, model.make_x(std::array{0.0}, std::array{0.0}));
            CHECK(start[2] == (b < L / (2 * mu) ? mode::forward : mode::held));
            const double a = b < L / (2 * mu) ? P * (1 - 2 * mu * b / L) / m : 0;
            CHECK(model(0.0, start)[1] == within(a, 1e-14 * P));
          });
}

TEST_CASE("a trolley lets go when the pendulum below pulls more than friction") {
  // A pendulum of mass m, from the angle A: the rod pulls with T = m g (3 cos a - 2 cos A), and the trolley M lets go
  // at the first T sin a = mu_s (M g + T cos a).
  constexpr double M = 3.0, m = 1.0, L = 0.8, A = 1.2, mu_s = 0.2;
  const auto pulls = [](double a) {
    const double T = m * g * (3 * std::cos(a) - 2 * std::cos(A));
    return T * std::sin(a) - mu_s * (M * g + T * std::cos(a));
  };
  REQUIRE(pulls(A) < 0);
  REQUIRE(pulls(0.7) > 0);
  double held = A, gone = 0.7;
  for (int i = 0; i < 100; ++i) (pulls((held + gone) / 2) < 0 ? held : gone) = (held + gone) / 2;
  const double pi = std::numbers::pi;
  in_both(chain(sticking_prismatic_joint_2D(s, s_mode, wall, wheel, axis::x, {0.15, mu_s}),
                inertia_2D(wheel, planar_body(M, 0.1)), revolute_joint_2D(q, wheel, upper),
                rigid_link_2D(upper, tip, along_x(L)), inertia_2D(tip, point_mass(m)))
              .gravity(along_y(-g)),
          [&](const auto& model) {
            const auto run = simulated(model, 1.0, std::array{0.0, A - pi / 2}, std::array{0.0, 0.0});
            REQUIRE(run.events.events.size() >= 1);
            CHECK(run.events.events[0].after[0] == 0);
            CHECK(run.events.events[0].after[1] == within(gone - pi / 2, 1e-11));
            CHECK(run.events.events[0].after[4] == mode::forward);
          });
}

TEST_CASE("what is pulled more between two calls of integrate is let go") {
  runtime_chain c;
  c << sticking_prismatic_joint_2D("s", "s.mode", "ground", "block", axis::x, {0.2, 0.3})
    << inertia_2D("block", planar_body(1.0, 0.1)) << driving_actuator_gen("s", "pull");
  c.gravity(along_y(-10.0));
  manipulator_dynamics_model model(c);
  model.input("pull") = 2.9;
  dormand_prince45 solver(std::cref(model), 0.0, settled(model, 0.0, model.make_x(std::array{0.0}, std::array{0.0})));
  CHECK(solver.integrate(1.0, element_events(model)).count == 0);
  CHECK(solver.state()[0] == 0);
  model.input("pull") = 3.1;
  const auto report = solver.integrate(2.0, element_events(model));
  REQUIRE(report.count == 1);
  CHECK(report.events[0].time == 1);
  CHECK(report.events[0].name.starts_with("sticking_prismatic_joint_2D (coordinate 's', mode 's.mode'"));
  CHECK(solver.state()[0] == within(1.1 / 2, 1e-14));
  // a brake on the same coordinate holds too
  c << brake_gen("s", "brake.mode", "grip");
  manipulator_dynamics_model braked(c);
  braked.input("pull") = 3.1, braked.input("grip") = 0.2;
  const auto start = settled(braked, 0.0, braked.make_x(std::array{0.0}, std::array{0.0}));
  CHECK(start[2] == mode::held);
  CHECK(start[3] == mode::held);
  braked.input("pull") = 3.3;
  CHECK(settled(braked, 0.0, start)[2] == mode::forward);
}

TEST_CASE("stiff methods and fixed steps go by modes too") {
  const double angle = 0.2, mu = 0.3, v = 2.0, up = g * (std::sin(angle) + mu * std::cos(angle));
  in_both(chain(sticking_prismatic_joint_2D(s, s_mode, wall, wheel, vec2{std::cos(angle), std::sin(angle)}, {mu}),
                inertia_2D(wheel, planar_body(3.0, 0.1)))
              .gravity(along_y(-g)),
          [&](const auto& model) {
            const auto start = settled(model, 0.0, model.make_x(std::array{0.0}, std::array{v}));
            const auto check = [&](auto&& solver) {
              const auto report = solver.integrate(10.0, element_events(model));
              REQUIRE(report.count == 1);
              CHECK(report.events[0].time == within(v / up, 1e-8));
              CHECK(solver.state()[0] == within(v * v / (2 * up), 1e-8));
              CHECK(solver.state()[1] == 0);
            };
            check(tr_bdf2(std::cref(model), 0.0, start, {.absolute = 1e-10, .relative = 1e-10}));
            check(rodas(std::cref(model), 0.0, start, {.absolute = 1e-10, .relative = 1e-10}));
            check(kennedy_carpenter34(std::cref(model), 0.0, start, {.absolute = 1e-10, .relative = 1e-10}));
            check(runge_kutta4(std::cref(model), 0.0, start, 0.01));
          });
}

}  // namespace sticking_joint_test
