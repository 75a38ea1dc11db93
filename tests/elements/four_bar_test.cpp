#include <kte/dynamics.hpp>
#include <kte/elements/four_bar.hpp>
#include <kte/elements/slider_crank.hpp>
#include <kte/simulation.hpp>

#include <cmath>

#include "catch.hpp"
#include "chain/registered.hpp"

namespace four_bar_test {

using namespace kte;
using kte::test::says;

/// Andrews' squeezer (Hairer and Wanner, Solving Ordinary Differential Equations II, section VII.7): three four-bars of
/// seven bodies. All three meet in the point that K2 and K3 have in common.
runtime_chain squeezer() {
  const vec2<double> a{-0.06934, -0.00227}, b{-0.03635, 0.03273}, c{0.014, 0.072};
  const vec2<double> from_b_to_a{a.x - b.x, a.y - b.y};
  const auto body = [](double m, double i, double x, double y) { return planar_body(m, i, vec3{x, y, zero}); };
  runtime_chain k;
  k << base_2D("O") << rigid_link_2D("O", "A", a) << rigid_link_2D("O", "B", b) << rigid_link_2D("O", "C", c)
    << four_bar_2D("q1", "q2", "q3", {b, 0.007, 0.028, 0.035, 1})
    << four_bar_2D("q3", "q4", "q5", {from_b_to_a, 0.035, 0.02, 0.04, -1})
    << four_bar_2D("q3", "q6", "q7", {from_b_to_a, 0.035, 0.02, 0.04, 1}) << revolute_joint_2D("q1", "O", "K1")
    << inertia_2D("K1", body(0.04325, 2.194e-6, 0.00092, 0)) << rigid_link_2D("K1", "P", along_x(0.007))
    << revolute_joint_2D("q2", "P", "K2") << inertia_2D("K2", body(0.00365, 4.410e-7, 0.0115, 0))
    << rigid_link_2D("K2", "E2", along_x(0.028)) << revolute_joint_2D("q3", "B", "K3")
    << inertia_2D("K3", body(0.02373, 5.255e-6, 0.01874, 0.01043)) << rigid_link_2D("K3", "E", along_x(0.035))
    << rigid_link_2D("K3", "D", vec2<double>{0.018, 0.02}) << spring_2D("D", "C", 0.07785, 4530.0)
    << revolute_joint_2D("q4", "E", "K4") << inertia_2D("K4", body(0.00706, 5.667e-7, 0.01421, 0))
    << rigid_link_2D("K4", "F4", along_x(0.02)) << revolute_joint_2D("q5", "A", "K5")
    << inertia_2D("K5", body(0.07050, 1.169e-5, 0.02308, 0.00916)) << rigid_link_2D("K5", "F5", along_x(0.04))
    << revolute_joint_2D("q6", "E", "K6") << inertia_2D("K6", body(0.00706, 5.667e-7, 0.01421, 0))
    << rigid_link_2D("K6", "F6", along_x(0.02)) << revolute_joint_2D("q7", "A", "K7")
    << inertia_2D("K7", body(0.05498, 1.912e-5, 0.01228, -0.00449)) << rigid_link_2D("K7", "F7", along_x(0.04))
    << driving_actuator_gen("q1", "motor");
  return k;
}
double gap(const runtime_state& s, const char* a, const char* b) {
  const auto &p = s.frame_2D(a).position, &q = s.frame_2D(b).position;
  return std::hypot(p.x - q.x, p.y - q.y);
}

/// The largest difference of closed forms from dual numbers, relative to the largest of both.
template <class Core>
double off_duals(const Core& core, double q, double v, double a) {
  const gen_coord<double> at{q, v, a};
  const coordinate known{q, v, a, std::cos(q), std::sin(q)};
  const auto& by_duals = static_cast<const coordinate_follower<Core>&>(core);
  const auto expected = by_duals.doMotion(at);
  double off = 0;
  const auto compare = [&](double x, double y) {
    off = (std::max)(off, std::abs(x - y) / (std::max)(1.0, std::abs(y)));
  };
  for (const auto& x : {core.doMotion(at), core.doMotion(known)}) {
    compare(x.q, expected.q), compare(x.q_dot, expected.q_dot), compare(x.q_ddot, expected.q_ddot);
    if constexpr (!detail::has_skip<std::remove_cvref_t<decltype(x.cos)>>)
      compare(x.cos, std::cos(x.q)), compare(x.sin, std::sin(x.q));
  }
  compare(core.doMotion(coordinate{q, skip{}, skip{}, skip{}, skip{}}).q, expected.q);
  compare(core.doMotion(coordinate{q, v, skip{}, skip{}, skip{}}).q_dot, expected.q_dot);
  compare(core.doMotion(coordinate{q, v, zero, skip{}, skip{}}).q_ddot,
          by_duals.doMotion(gen_coord<double>{q, v, 0.0}).q_ddot);
  compare(nth<0>(core.doForce(at, 2.0)), nth<0>(by_duals.doForce(at, 2.0)));
  return off;
}

TEST_CASE("closed forms of linkages are the derivatives of their positions") {
  for (const double side : {1.0, -1.0})
    for (const double q : {-2.9, -1.2, 0.4, 1.1, 2.6, 7.5}) {
      const four_bar_lengths bars{{1, 0.1}, 0.4, 1.1, 0.8, side};
      CHECK(off_duals(core::four_bar_coupler(bars), q, 2, -3) < 5e-15);
      CHECK(off_duals(core::four_bar_rocker(bars), q, 2, -3) < 5e-15);
      const slider_crank_lengths crank{0.1, 0.25, 0.02, side};
      CHECK(off_duals(core::slider_crank_rod(crank), q, 2, -3) < 5e-15);
      CHECK(off_duals(core::slider_crank_slider(crank), q, 2, -3) < 5e-15);
    }
}

TEST_CASE("Andrews' squeezer of four-bars") {
  const auto k = squeezer();
  manipulator_dynamics_model model(k);
  model.input("motor") = 0.033;
  const double beta = -0.0617138900142764496;
  const Eigen::VectorXd start = model.make_x(std::array{beta}, std::array{0.0});
  // accelerations at the start, to 30 digits by an independent calculation
  const Eigen::VectorXd rate = model(0.0, start);
  CHECK(rate[1] == within(14222.4439199541138705911, 1e-8));
  const auto& at_start = model.state_at(0, start);
  CHECK(at_start.coordinate("q3").q == within(0.45527981916307038 - std::acos(0.0), 1e-14));
  CHECK(at_start.coordinate("q5").q == within(0.48736497954384255, 1e-14));
  CHECK(at_start.coordinate("q7").q == within(1.23054744454982119 - std::acos(0.0), 1e-14));

  prince_dormand87 solver(std::cref(model), 0.0, start, {.absolute = 1e-12, .relative = 1e-12});
  solver.integrate(0.03);
  CHECK(solver.state()[0] == within(15.8107711951537070971, 5e-12));
  CHECK(solver.state()[1] == within(1139.92030225910606419, 1e-8));
  CHECK(solver.statistics().evaluations < 2700);
  const auto& s = model.state_at(0.03, solver.state());
  CHECK(gap(s, "E2", "E") < 1e-16);
  CHECK(gap(s, "F4", "F5") < 1e-16);
  CHECK(gap(s, "F6", "F7") < 1e-16);
}

TEST_CASE("a slider-crank, and where it cannot be closed") {
  runtime_chain c;
  c << slider_crank_2D("q", "rod", "x", {.crank = 0.1, .rod = 0.25, .offset = 0.02, .side = -1})
    << revolute_joint_2D("q", "ground", "crank") << rigid_link_2D("crank", "pin", along_x(0.1))
    << revolute_joint_2D("rod", "pin", "rod body") << rigid_link_2D("rod body", "end", along_x(0.25))
    << rigid_link_2D("ground", "line", along_y(0.02)) << prismatic_joint_2D("x", "line", "slider", axis::x)
    << inertia_2D("slider", point_mass(2.0)) << inertia_2D("crank", planar_body(0.5, 0.01));
  auto s = c.make_state();
  for (const double q : {0.3, 1.7, -2.5}) {
    (void)forward_kinematics(c, s, Eigen::VectorXd::Constant(1, q));
    CHECK(gap(s, "end", "slider") < 1e-16);
    // the slider's velocity over the crank's, by hand
    const double across = 0.02 - 0.1 * std::sin(q), d = -std::sqrt(0.0625 - across * across);
    const double ratio = -0.1 * std::sin(q) + 0.1 * across * std::cos(q) / d;
    CHECK(mass_matrix(c, s)(0, 0) == within(0.01 + 2 * ratio * ratio, 1e-16));
  }
  // sin q = 1/2: the rod is across the line. Positions may be there, velocities not; beyond, nothing
  runtime_chain short_one;
  short_one << slider_crank_2D("q", "rod", "x", {.crank = 0.1, .rod = 0.05}) << inertia_gen("x", 1.0);
  auto t = short_one.make_state();
  const double dead = std::asin(0.5);
  CHECK_NOTHROW(mass_matrix(short_one, t, Eigen::VectorXd::Constant(1, dead - 1e-7)));
  CHECK_THROWS_MATCHES(mass_matrix(short_one, t, Eigen::VectorXd::Constant(1, dead - 1e-9)), dead_point,
                       says("slider_crank_rod_2D (crank 'q', rod 'rod'): slider_crank_2D: dead point at crank angle "
                            "0.5235987"));
  CHECK_THROWS_MATCHES(mass_matrix(short_one, t, Eigen::VectorXd::Constant(1, 1.5)), bad_argument,
                       says("slider_crank_rod_2D (crank 'q', rod 'rod'): slider_crank_2D cannot be closed at crank "
                            "angle 1.5 rad, beyond a dead point"));
  CHECK(core::slider_crank_rod({.crank = 0.1, .rod = 0.1}).value(std::acos(0.0)) == within(-std::acos(-1.0), 1e-15));
}

TEST_CASE("integrators stop at the dead point of a linkage, at any tolerance, and say where") {
  runtime_chain slider, bars;
  slider << base_2D("ground") << slider_crank_2D("q", "rod", "x", {.crank = 0.1, .rod = 0.05})
         << revolute_joint_2D("q", "ground", "crank") << prismatic_joint_2D("x", "ground", "slider", axis::x)
         << inertia_2D("slider", point_mass(2.0)) << inertia_2D("crank", planar_body(0.5, 0.01));
  bars << base_2D("ground") << four_bar_2D("q", "coupler", "rocker", {{0.3, 0.0}, 0.2, 0.2, 0.25, 1})
       << revolute_joint_2D("q", "ground", "crank") << inertia_2D("crank", planar_body(0.5, 0.01, along_x(0.1)))
       << rigid_link_2D("ground", "pivot", along_x(0.3)) << revolute_joint_2D("rocker", "pivot", "arm")
       << inertia_2D("arm", planar_body(0.5, 0.01, along_x(0.1)));
  const auto stops = [](const runtime_chain& c, double rate, const char* text) {
    const manipulator_dynamics_model model(c);
    for (const double tolerance : {1e-3, 1e-6, 1e-10}) {
      prince_dormand87 solver(std::cref(model), 0.0, model.make_x(std::array{0.0}, std::array{rate}),
                              {.absolute = tolerance, .relative = tolerance});
      CHECK_THROWS_MATCHES(solver.integrate(10), dead_point, says(text));
      CHECK(solver.statistics().evaluations < 20000);
      CHECK(solver.state().allFinite());
    }
  };
  stops(slider, 1, "slider_crank_rod_2D (crank 'q', rod 'rod'): slider_crank_2D: dead point at crank angle 0.5235987");
  stops(bars, 5, "four_bar_coupler_2D (crank 'q', coupler 'coupler'): four_bar_2D: dead point at crank angle 2.21951");
}

}  // namespace four_bar_test
