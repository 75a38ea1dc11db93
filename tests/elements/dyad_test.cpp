#include <kte/dynamics.hpp>
#include <kte/elements/dyad.hpp>
#include <kte/elements/four_bar.hpp>
#include <kte/simulation.hpp>

#include <cmath>

#include "catch.hpp"
#include "chain/registered.hpp"
#include "elements/laws.hpp"

namespace dyad_test {

using namespace kte;
using namespace kte::test;

constexpr dyad_lengths lengths{.pivot = {0.2, 0.03}, .crank1 = 0.15, .bar1 = 0.3, .bar2 = 0.28, .crank2 = 0.12};

/// A five-bar linkage with two motors. The hand is at the end of the first bar, the second ends there too.
runtime_chain five_bar() {
  runtime_chain c;
  c.gravity(along_y(-9.81));
  c << base_2D("ground") << dyad_2D("q1", "q2", "b1", "b2", lengths) << revolute_joint_2D("q1", "ground", "crank 1")
    << inertia_2D("crank 1", planar_body(0.4, 0.004, along_x(0.07)))
    << rigid_link_2D("crank 1", "knee 1", along_x(0.15)) << revolute_joint_2D("b1", "knee 1", "bar 1")
    << inertia_2D("bar 1", planar_body(0.3, 0.01, along_x(0.15))) << rigid_link_2D("bar 1", "hand", along_x(0.3))
    << inertia_2D("hand", point_mass(0.5)) << rigid_link_2D("ground", "pivot 2", lengths.pivot)
    << revolute_joint_2D("q2", "pivot 2", "crank 2") << inertia_2D("crank 2", planar_body(0.4, 0.003, along_x(0.06)))
    << rigid_link_2D("crank 2", "knee 2", along_x(0.12)) << revolute_joint_2D("b2", "knee 2", "bar 2")
    << inertia_2D("bar 2", planar_body(0.25, 0.008, along_x(0.14))) << rigid_link_2D("bar 2", "end", along_x(0.28))
    << driving_actuator_gen("q1", "motor 1") << driving_actuator_gen("q2", "motor 2");
  return c;
}

TEST_CASE("a five-bar linkage stays closed, and its dynamics agree") {
  const auto c = five_bar();
  auto s = c.make_state();
  random_numbers draw(1);
  for (int i = 0; i < 10; ++i) {
    const Eigen::Vector2d q(2 + 0.4 * draw(), 1 + 0.4 * draw()), v(draw(), draw()), tau(draw(), draw());
    const Eigen::Vector2d a = forward_dynamics(c, s, q, v, tau);
    CHECK((Eigen::Vector2d(inverse_dynamics(c, s, q, v, a)) - tau).norm() < 1e-14);
    set_positions(s, q), set_velocities(s, v), set_accelerations(s, a);
    c.doMotion(s);
    const auto &hand = s.frame_2D("hand"), &end = s.frame_2D("end");
    CHECK(std::hypot(hand.position.x - end.position.x, hand.position.y - end.position.y) < 3e-16);
    const auto apart = [&](const auto& x, const auto& y) {
      const auto a1 = hand.rotation * x, a2 = end.rotation * y;
      return std::hypot(a1.x - a2.x, a1.y - a2.y);
    };
    CHECK(apart(hand.velocity, end.velocity) < 2e-15);
    CHECK(apart(hand.acceleration, end.acceleration) < 1e-13);
  }
}

TEST_CASE("two motors move a five-bar linkage, and energy is what they put in") {
  const auto c = five_bar();
  manipulator_dynamics_model model(c);
  model.input("motor 1") = 1.2, model.input("motor 2") = -0.4;
  const Eigen::VectorXd start = model.make_x(std::array{2.2, 0.9}, std::array{0.0, 0.0});
  const auto energy = [&](const Eigen::VectorXd& x) {
    auto s = model.state_at(0, x);
    return kinetic_energy(c, s) + potential_energy(c, s);
  };
  const double before = energy(start);
  prince_dormand87 solver(std::cref(model), 0.0, start, {.absolute = 1e-13, .relative = 1e-13});
  solver.integrate(0.2);
  const Eigen::VectorXd moved = solver.state() - start;
  CHECK(std::abs(moved[0]) > 0.01);
  CHECK(energy(solver.state()) - before == within(1.2 * moved[0] - 0.4 * moved[1], 1e-12));
}

TEST_CASE("with its second crank at rest it is a four-bar") {
  const auto same = [](const auto& q1) {
    const double q2 = 0.7;
    const four_bar_lengths bars{
        {lengths.pivot.x + lengths.crank2 * std::cos(q2), lengths.pivot.y + lengths.crank2 * std::sin(q2)},
        lengths.crank1,
        lengths.bar1,
        lengths.bar2,
        1};
    CHECK(core::dyad_bar1(lengths).value(q1, q2) == within(core::four_bar_coupler(bars).value(q1), 2e-15));
    CHECK(core::dyad_bar2(lengths).value(q1, q2) + q2 == within(core::four_bar_rocker(bars).value(q1), 2e-15));
  };
  for (const double q : {1.2, 2.0, 2.9}) same(q);
}

TEST_CASE("a dyad that cannot be closed, with invalid parameters, and in files") {
  auto short_bars = lengths;
  short_bars.bar1 = 0.01, short_bars.bar2 = 0.02;
  CHECK_THROWS_MATCHES(core::dyad_bar1(short_bars).value(2.0, 1.0), bad_argument,
                       test::says("dyad_2D cannot be closed at crank angles 2 rad, 1 rad, beyond a dead point"));
  const auto says = [](double dyad_lengths::*which, double value) {
    auto l = lengths;
    l.*which = value;
    return complaint([&] { (void)dyad_2D("a", "b", "c", "d", l); });
  };
  CHECK(says(&dyad_lengths::crank1, 0) == "");
  CHECK(says(&dyad_lengths::crank2, -1).find("crank2 must be finite and not negative, got -1") != std::string::npos);
  CHECK(says(&dyad_lengths::bar2, 0).find("bar2 must be finite and positive, got 0") != std::string::npos);
  CHECK(says(&dyad_lengths::side, 0).find("side must be 1 or -1, got 0") != std::string::npos);
  const auto c = five_bar();
  CHECK(record_of(models::registered(record_of(c))) == record_of(c));
}

}  // namespace dyad_test
