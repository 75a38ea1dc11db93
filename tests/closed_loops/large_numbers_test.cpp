#include "catch.hpp"
#include "closed_loops/mechanisms.hpp"

// Loops whose coordinates are large numbers, so that residuals have their rounding errors, and loops of any size.

namespace large_numbers_test {

using namespace kte;
using namespace kte::test;
using namespace kte::test::loops;

/// The state after a time, and the largest gap, m or rad.
struct run {
  vector x;
  double gap = 0;
};
run simulated(const runtime_chain& c, const vector& q, const vector& v, double t,
              const tolerances<double>& to = {.absolute = 1e-9, .relative = 1e-9}) {
  const manipulator_dynamics_model<runtime_chain> m(c);
  auto s = c.make_state();
  prince_dormand87 solver(std::cref(m), 0.0, m.make_x(q, v), to);
  run r;
  solver.integrate(t, every(t / 10), [&](double, const vector& x) {
    r.gap = (std::max)(r.gap, kte::loops(c, s, vector(m.positions_of(x))).gap);
  });
  r.x = solver.state();
  return r;
}

TEST_CASE("a slider-crank after many turns") {
  runtime_chain c;
  c << revolute_joint_2D("crank", "base", "a") << inertia_2D("a", bar) << rigid_link_2D("a", "tip", along_x(1.0))
    << revolute_joint_2D("rod", "tip", "b") << inertia_2D("b", planar_body(1.0, 0.3, along_x(1.0)))
    << rigid_link_2D("b", "end", along_x(2.0)) << point_on_line_2D("slot", "base", "end", axis::x);
  auto s = c.make_state();
  for (const double turns : {1e2, 1e4, 1e6}) {
    INFO(turns);
    const vector q = assemble(c, s, numbers({0.3 + 2 * pi * turns, -0.5 - 2 * pi * turns}), held("crank"));
    const vector v = consistent_velocities(c, s, q, numbers({300, 0}));
    const auto r = simulated(c, q, v, 0.1);
    CHECK(r.x[0] > q[0] + 20);
    CHECK(r.gap < 1e-14 * turns);
  }
}

TEST_CASE("a gear after many turns") {
  runtime_chain c;
  c << revolute_joint_2D("motor", "base", "a") << inertia_2D("a", planar_body(1.0, 1e-3))
    << revolute_joint_2D("wheel", "base", "b").at(vec2<>{1, 0}) << inertia_2D("b", bar)
    << coupled_coordinates("gear", "motor", "wheel", 1.0, -97.0);
  for (const double angle : {1e3, 1e5, 1e7}) {
    INFO(angle);
    const auto r = simulated(c, numbers({angle, angle / 97}), numbers({97, 1}), 10);
    CHECK(r.x[1] == within(angle / 97 + 10, 1e-9));
    CHECK(r.gap < 1e-15 * angle);
  }
}

TEST_CASE("a tether between two bodies in orbit") {
  const auto body = [](double m) { return rigid_body<>{m, vec3<>{}, sym3<>{0.1 * m, 0, 0, 0.1 * m, 0, 0.1 * m}}; };
  runtime_chain c;
  c << free_joint_3D("f1", "base", "s1") << inertia_3D("s1", body(100)) << free_joint_3D("f2", "base", "s2")
    << inertia_3D("s2", body(50)) << distance_3D("tether", "s1", "s2", 100.0);
  const double r = 7e6, speed = 7500;
  const vector q = numbers({r, 0, 0, 1, 0, 0, 0, r + 100, 0, 0, 1, 0, 0, 0});
  const vector v = numbers({0, speed, 0, 0, 0, 0, 0, speed + 3, 0, 0, 0, 0});
  auto s = c.make_state();
  CHECK(kte::loops(c, s, q).gap == 0);
  const auto end = simulated(c, q, v, 20, {.absolute = 1e-6, .relative = 1e-12});
  CHECK(end.gap < 1e-8);  // some roundings of 7e6 m
  // without other forces both turn about their centre of mass at 3/100 rad/s
  const double angle = 0.03 * 20;
  CHECK(end.x[7] - end.x[0] == within(100 * std::cos(angle), 1e-3));
  CHECK(end.x[8] - end.x[1] == within(100 * std::sin(angle), 1e-3));
}

TEST_CASE("a pendulum of any length") {
  for (const double length : {1e-6, 1.0, 1e6}) {
    INFO(length);
    runtime_chain c;
    c.gravity(along_y(-9.81)) << prismatic_joint_2D("x", "base", "a", axis::x)
                              << prismatic_joint_2D("y", "a", "b", axis::y) << inertia_2D("b", point_mass(1.0))
                              << distance_2D("rod", "base", "b", length);
    auto s = c.make_state();
    const vector q = assemble(c, s, numbers({-2 * length, 0.5 * length}));
    CHECK(q.norm() == within_relative(length, 1e-15));
    const manipulator_dynamics_model<runtime_chain> m(c);
    CHECK_THROWS_AS(m.make_x(numbers({-1.0001 * length, 0}), numbers({0, 0})), bad_argument);
    // (A01) in units of its length: the position after one second for 1 m
    const auto r = simulated(c, numbers({-length, 0}), numbers({0, 0}), std::sqrt(length),
                             {.absolute = 1e-11 * length, .relative = 1e-11});
    CHECK(r.x[0] / length == within(0.986291751131875, 1e-8));
    CHECK(r.x[1] / length == within(-0.165010853125541, 1e-8));
    CHECK(r.gap < 1e-15 * length);
  }
}

}  // namespace large_numbers_test
