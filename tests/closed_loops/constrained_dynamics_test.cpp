#include "catch.hpp"
#include "closed_loops/tangle.hpp"
#include "random.hpp"

namespace constrained_dynamics_test {

using namespace kte;
using namespace kte::test;
using namespace kte::test::loops;
using Catch::Matchers::Message;

double largest_difference(const vector& a, const vector& b) { return (a - b).cwiseAbs().maxCoeff(); }

/// Against `by_one_matrix`, at random states off the loops as well: a, and each lambda.
void check_against_one_matrix(const tangle& x, int rows, random_numbers& draw) {
  auto s = x.closed.make_state(), tree = x.open.make_state();
  for (int i = 0; i < 5; ++i) {
    const vector v = vector::NullaryExpr(x.open.dofs(), [&] { return draw(); });
    const vector tau = vector::NullaryExpr(x.open.dofs(), [&] { return draw(); });
    const vector q = integrate(x.open, neutral_configuration(x.open),
                               vector::NullaryExpr(x.open.dofs(), [&] { return draw(); }), 1.0);
    const vector zero = vector::Zero(x.open.dofs());
    const vector bias = kte::inverse_dynamics(x.open, tree, q, v, zero);
    const vector expected = by_one_matrix(x.closed, s, q, v, tau, bias);
    const auto r = constrained_dynamics(x.closed, s, q, v, tau);
    CHECK(r.rank == rows);
    CHECK(r.mobility == x.open.dofs() - rows);
    const double size = 1 + expected.head(r.a.size()).cwiseAbs().maxCoeff();
    CHECK(largest_difference(r.a, expected.head(r.a.size())) < 1e-8 * size);  // of differences
    vector forces(rows);
    for (std::size_t k = 0, row = 0; k < r.names.size(); ++k) {
      const auto& elements = x.closed.wiring().elements;
      const auto at = std::find_if(elements.begin(), elements.end(),
                                   [&](const auto& e) { return e.closes && e.element->names().back() == r.names[k]; });
      const closure_rows of = at->element->rows();
      for (int n = 0; n < of.count(); ++n)
        forces[static_cast<Eigen::Index>(row++)] = detail::row_of(r.loops[k].force, r.loops[k].torque, of, n);
    }
    CHECK(largest_difference(forces, expected.tail(rows)) < 1e-7 * (1 + expected.tail(rows).cwiseAbs().maxCoeff()));
  }
}

TEST_CASE("accelerations and forces of closures solve the equations in one matrix") {
  random_numbers draw(3);
  const vec3<> u{0.6, 0, 0.8}, t{0, 1, 0};
  const auto closed_by = [&](const auto& closure, int rows, bool follows = false) {
    tangle x(follows);
    x.closed << closure;
    check_against_one_matrix(x, rows, draw);
  };
  SECTION("points") { closed_by(coincident_points_3D("l", "le", "re"), 3); }
  SECTION("frames") { closed_by(coincident_frames_3D("l", "le", "re"), 6); }
  SECTION("a hinge") { closed_by(hinge_3D("l", "le", "re", u), 5); }
  SECTION("a sleeve") { closed_by(cylindrical_3D("l", "le", "re", u), 4); }
  SECTION("a carriage") { closed_by(sliding_3D("l", "le", "re", u), 5); }
  SECTION("a cross") { closed_by(universal_3D("l", "le", "re", u, t), 4); }
  SECTION("a slot") { closed_by(point_on_line_3D("l", "le", "re", u), 2); }
  SECTION("a plane") { closed_by(point_on_plane_3D("l", "le", "re", u), 1); }
  SECTION("a rod") { closed_by(distance_3D("l", "le", "re", 0.5), 1); }
  SECTION("to the ground") { closed_by(hinge_3D("l", "world", "re", u), 5); }
  SECTION("coordinates") { closed_by(coupled_coordinates("l", "l1", "r1", 2.0, -1.0, 0.1), 1); }
  SECTION("a function of coordinates") {
    closed_by(coupled_by("l", "l1", "r1", "r3",
                         [](const auto& a, const auto& b, const auto& c) {
                           using std::sin;
                           return a - b * sin(c) + c * c;
                         }),
              1);
  }
  SECTION("where coordinates follow others") { closed_by(coincident_points_3D("l", "lf", "rf"), 3, true); }
  SECTION("several") {
    tangle x;
    x.closed << coincident_points_3D("l", "lb", "re") << point_on_plane_3D("m", "ld", "rd", u)
             << coupled_coordinates("n", "l1", "l3", 1.0, 1.0);
    check_against_one_matrix(x, 5, draw);
  }
}

TEST_CASE("a row of four-bars has the accelerations of its one equation, also near its singular configuration") {
  const double rate = 1.3;
  for (const int n : {1, 2, 10}) {
    const auto plain = four_bars(n), twice = four_bars(n, true), space = four_bars_in_space(n);
    for (const double delta : {1.0, 1e-2, 1e-4, 1e-6}) {
      const double phi = pi / 2 + delta, exact = four_bar_constant(n) * std::sin(phi);
      const vector q = four_bar_q(n, phi), v = four_bar_v(n, rate), none = vector::Zero(q.size());
      const vector a = four_bar_v(n, exact);
      // J is known to the rounding of angles, and the closed direction by its singular value, delta.
      const double allowed = 1e-15 * n * 40 * exact / delta;
      const auto check = [&](const runtime_chain& c, int rows) {
        auto s = c.make_state();
        const auto r = constrained_dynamics(c, s, q, v, none);
        CHECK(r.rank == 2 * n);
        CHECK(r.mobility == 1);
        CHECK(static_cast<int>(r.dependent.size()) == rows - 2 * n);
        CHECK(largest_difference(r.a, a) < allowed);
      };
      check(plain, 2 * n), check(twice, 4 * n), check(space, 5 * n);
    }
  }
}

TEST_CASE("what loops are like at a configuration") {
  const auto c = four_bars_in_space(2);
  auto s = c.make_state();
  auto r = kte::loops(c, s, four_bar_q(2, 0.3));
  CHECK(r.rows == 10);
  CHECK(r.rank == 4);
  CHECK(r.mobility == 1);
  CHECK(r.gap < 1e-15);
  CHECK(r.blocks == std::vector<std::string>{"pin0, pin1"});
  CHECK(r.dependent == std::vector<std::string>{"pin0[3]", "pin0[4]", "pin0[5]", "pin1[3]", "pin1[4]", "pin1[5]"});
  r = kte::loops(c, s, four_bar_q(2, pi / 2));  // horizontal
  CHECK(r.rank == 2);
  CHECK(r.mobility == 3);
  r = kte::loops(c, s, four_bar_q(2, pi / 2 + 1e-4));
  CHECK(r.pivot_ratio < 1e-3);
  CHECK(r.pivot_ratio > 1e-6);
  vector off = four_bar_q(2, 0.3);
  off[4] += 0.01;
  r = kte::loops(c, s, off);
  CHECK(r.widest == "pin1");
  CHECK(r.gap == within(0.01, 1e-3));

  runtime_chain apart;  // two that share nothing
  for (const std::string x : {"a", "b"})
    apart << revolute_joint_2D(x + "1", "base", x + "p") << inertia_2D(x + "p", bar)
          << revolute_joint_2D(x + "2", "base", x + "q") << inertia_2D(x + "q", bar)
          << coincident_points_2D("pin " + x, x + "p", x + "q");
  auto state = apart.make_state();
  CHECK(kte::loops(apart, state, vector::Zero(4)).blocks == std::vector<std::string>{"pin a", "pin b"});
}

TEST_CASE("forward dynamics is that of constrained dynamics, of loops that are assembled") {
  const auto c = four_bars(2);
  auto s = c.make_state();
  vector q = four_bar_q(2, 0.4);
  const vector v = four_bar_v(2, 1.3), tau = numbers({1, 2, 3, -2, -1});
  const vector a = constrained_dynamics(c, s, q, v, tau).a;
  CHECK(largest_difference(kte::forward_dynamics(c, s, q, v, tau), a) == 0);
  q[4] += 0.019;  // the coupler of 1 m; the chain is 2 m long
  CHECK_NOTHROW(kte::forward_dynamics(c, s, q, v, tau));
  q[4] += 0.003;
  CHECK_THROWS_MATCHES(kte::forward_dynamics(c, s, q, v, tau), bad_argument,
                       says("kte: forward_dynamics: 'pin1' is open by 0.02"));
  CHECK(constrained_dynamics(c, s, q, v, tau).gap > 0.01);
  q[0] = std::numeric_limits<double>::quiet_NaN();
  CHECK_THROWS_AS(kte::forward_dynamics(c, s, q, v, tau), bad_argument);
}

TEST_CASE("forces of closures are those of statics") {
  // Two bars from (0, 0) and (1, 0) to their pin at (1/2, h), a mass on it: each carries m g / (2 sin) along itself.
  const double h = 0.8, length = std::hypot(0.5, h), angle = std::atan2(h, 0.5);
  runtime_chain truss;
  truss.gravity(along_y(-10.0)) << revolute_joint_2D("l", "base", "lj") << rigid_link_2D("lj", "lt", along_x(length))
                                << revolute_joint_2D("r", "base", "rj").at(vec2<>{1, 0})
                                << rigid_link_2D("rj", "rt", along_x(length)) << inertia_2D("lt", point_mass(3.0))
                                << inertia_2D("rj", planar_body(0.0, 1e-3))
                                << rigid_link_2D("lt", "level", vec2<>{0, 0}, rotation_by(-angle))
                                << coincident_points_2D("pin", "level", "rt");
  auto s = truss.make_state();
  const vector q = numbers({angle, pi - angle}), none = vector::Zero(2);
  const auto r = constrained_dynamics(truss, s, q, none, none);
  CHECK(r.mobility == 0);
  CHECK(r.a.cwiseAbs().maxCoeff() < 1e-11);
  // On the right bar, in axes of the world: down and outward, as its half of 30 N.
  CHECK(r.loop("pin").force.y == within(-15, 1e-11));
  CHECK(r.loop("pin").force.x == within(15 * 0.5 / h, 1e-11));
  // and the reactions of the pivots hold the weight
  truss.doMotion(s), truss.clearForce(s), truss.doForce(s);
  CHECK(s.frame_2D("base").force.y == within(-30, 1e-10));
  CHECK(s.frame_2D("base").force.x == within(0, 1e-10));
}

TEST_CASE("a closure is the limit of a stiff spring") {
  const auto closed = four_bars(1);
  auto s = closed.make_state();
  const vector q = four_bar_q(1, 0.7), v = four_bar_v(1, 1.1), none = vector::Zero(3);
  const auto r = constrained_dynamics(closed, s, q, v, none);
  const auto& force = r.loop("pin0").force;
  // The spring gives the force if its ends are force / k apart.
  const Eigen::MatrixXd j = loop_jacobian(closed, s, q);
  double last = 0;
  for (const double k : {1e6, 1e7}) {
    runtime_chain sprung;
    sprung.gravity(along_y(-9.81));
    for (const auto& e : closed.wiring().elements)
      if (!e.closes) sprung.append(e.element->clone());
    sprung << spring_2D("t1", "e0", 0.0, k);
    auto t = sprung.make_state();
    const vector apart = j.transpose() * (j * j.transpose()).fullPivLu().solve(numbers({-force.x / k, -force.y / k}));
    const vector a = kte::forward_dynamics(sprung, t, vector(q + apart), v, none);
    const double off = largest_difference(a, r.a);
    CHECK(off < 1e4 / k * 10);
    if (last > 0) CHECK(off < 0.2 * last);
    last = off;
  }
}

TEST_CASE("velocities on the loops, and after an impact") {
  const auto c = four_bars(2);
  auto s = c.make_state();
  const vector q = four_bar_q(2, 0.4), v = numbers({1, -0.5, 0.3, 0.2, 2});
  const vector on = consistent_velocities(c, s, q, v);
  const Eigen::MatrixXd j = loop_jacobian(c, s, q), m = mass_matrix(c, s, q);
  CHECK((j * on).cwiseAbs().maxCoeff() < 1e-15);
  // the change is by impulses of closures: M (on - v) is in the range of J^T
  const vector impulses = m * (on - v);
  const vector by = j.transpose().fullPivLu().solve(impulses);
  CHECK(largest_difference(j.transpose() * by, impulses) < 1e-14);
  CHECK(largest_difference(impulse(c, s, q, v), on) == 0);
  CHECK(largest_difference(velocities(s), on) == 0);
}

TEST_CASE("inverse dynamics by actuated coordinates undoes constrained dynamics") {
  const auto c = four_bars(2);
  auto s = c.make_state();
  const vector q = four_bar_q(2, 0.4), v = four_bar_v(2, 1.3);
  for (const std::string by : {"q0", "q2", "c1"}) {
    vector tau = vector::Zero(5);
    const int row = by == "q0" ? 0 : by == "q2" ? 2 : 4;
    tau[row] = 7.5;
    const auto r = constrained_dynamics(c, s, q, v, tau);
    const vector back = inverse_dynamics(c, s, q, v, r.a, actuated(by));
    REQUIRE(back.size() == 1);
    CHECK(back[0] == within(7.5, 1e-13));
  }
  const Eigen::MatrixXd g = loop_motion(c, s, q, actuated("q1"));
  CHECK(largest_difference(g, numbers({1, 1, 1, -1, -1})) < 1e-14);
  const double m = (g.transpose() * mass_matrix(c, s, q) * g)(0, 0);
  CHECK(m == within(3 / 3.0 + 2, 1e-14));

  // at rest the accelerations of the closures are rounding errors of gravity
  const vector none = vector::Zero(5);
  const vector holds = inverse_dynamics(c, s, q, none, none, actuated("q1"));
  CHECK(holds[0] == within((g.transpose() * gravity_forces(c, s, q))[0], 1e-13));
  CHECK_THROWS_AS(inverse_dynamics(c, s, q, none, numbers({1e-4, 0, 0, 0, 0}), actuated("q0")), bad_argument);

  CHECK_THROWS_MATCHES(
      loop_motion(c, s, q, actuated("q0", "q1")), bad_argument,
      Message("kte: this chain has mobility 1 here, so it is driven by as many coordinates, not by 2"));
  CHECK_THROWS_AS(loop_motion(c, s, q, actuated("q7")), unknown_name);
  CHECK_THROWS_MATCHES(inverse_dynamics(c, s, q, v, numbers({1, 0, 0, 0, 0}), actuated("q0")), bad_argument,
                       Message("kte: these accelerations do not keep 'pin0' closed: those of constrained_dynamics do"));
}

TEST_CASE("coordinates that do not determine the motion are refused") {
  // At its dead point the slider moves by nothing: it cannot drive the crank.
  runtime_chain c;
  c << revolute_joint_2D("crank", "base", "b") << inertia_2D("b", bar) << rigid_link_2D("b", "t", along_x(1.0))
    << revolute_joint_2D("rod", "t", "r") << inertia_2D("r", bar) << rigid_link_2D("r", "end", along_x(2.0))
    << prismatic_joint_2D("slider", "base", "s", axis::x) << inertia_2D("s", bar)
    << coincident_points_2D("pin", "s", "end");
  auto s = c.make_state();
  const vector q = numbers({0, 0, 3});
  CHECK_THROWS_MATCHES(loop_motion(c, s, q, actuated("slider")), no_solution,
                       Message("kte: the actuated coordinates do not determine the motion of the loops here"));
  CHECK(largest_difference(loop_motion(c, s, q, actuated("crank")), numbers({1, -1.5, 0})) < 1e-14);
}

TEST_CASE("algorithms of trees refuse chains with loops, by name") {
  const auto c = four_bars(1);
  auto s = c.make_state();
  const vector q = four_bar_q(1, 0.4), v = four_bar_v(1, 1.3), none = vector::Zero(3);
  CHECK_THROWS_MATCHES(
      kte::inverse_dynamics(c, s, q, v, none), bad_argument,
      Message("kte: this algorithm does not know closures of loops, as coincident_points_2D (frame1 "
              "'t1', frame2 'e0', loop 'pin0'): inverse_dynamics(c, s, q, v, a, kte::actuated(\"q1\")) "
              "of kte/loops.hpp does"));
  CHECK_THROWS_AS(c.make_state<float>(), bad_argument);
  const std::string refusal = "kte: this algorithm does not know closures of loops, as coincident_points_2D";
  CHECK_THROWS_MATCHES(static_forces(c, s, q), bad_argument, says(refusal));
  CHECK_THROWS_MATCHES(nonlinear_effects(c, s, q, v), bad_argument, says(refusal));
  CHECK_THROWS_MATCHES(mass_matrix_inverse(c, s, q), bad_argument, says(refusal));
  CHECK(s.coordinate("q0").q == 0);  // the state is as before
  CHECK_NOTHROW(mass_matrix(c, s, q));
  CHECK_NOTHROW(energy(c, s, q, v));
}

TEST_CASE("closures on a base that turns act as on a heavy hub that turns as fast") {
  const auto arm_on = [](runtime_chain c, const std::string& hub) {
    std::string below = hub;
    for (const std::string n : {"1", "2", "3", "4"}) {
      const bool even = n == "2" || n == "4";
      c << rigid_link_3D(below, "place" + n, vec3<>{0.1, 0.05, 0.3})
        << revolute_joint_3D("q" + n, "place" + n, "link" + n, vec3<>{0, even ? 1.0 : 0.0, even ? 0.0 : 1.0})
        << inertia_3D("link" + n, rigid_body{1.0, vec3<>{0.01, 0.02, 0.1}, sym3<>{0.02, 0, 0, 0.02, 0, 0.01}});
      below = "link" + n;
    }
    c << inertia_gen("lone", 0.3) << point_on_plane_3D("plane", hub, "link2", along_x(1.0))
      << coupled_coordinates("belt", "lone", "q4", 1.0, -2.0, 0.1);
    return c;
  };
  runtime_chain turning, heavy;
  turning.gravity(along_z(-9.81)) << base_3D("hub");
  heavy.gravity(along_z(-9.81)) << revolute_joint_3D("turn", "base", "hub", axis::z)
                                << inertia_3D("hub", rigid_body{1.0, vec3<>{}, sym3<>{1e14, 0, 0, 1e14, 0, 1e14}});
  const auto on_base = arm_on(std::move(turning), "hub"), on_hub = arm_on(std::move(heavy), "hub");
  const double speed_up = GENERATE(0.0, 0.8);  // rad/s^2
  auto s = on_base.make_state(), t = on_hub.make_state();
  s.frame_3D("hub").ang_velocity = {0, 0, 1.7};
  s.frame_3D("hub").ang_acceleration = {0, 0, speed_up};
  t.coordinate("turn").q_dot = 1.7;
  double q = 0.3;
  for (const char* n : {"q1", "q2", "q3", "q4", "lone"}) {
    for (auto* x : {&s.coordinate(n), &t.coordinate(n)}) x->q = q, x->q_dot = 0.5 - q;
    q += 0.2;
  }
  const vector drive = 1e14 * speed_up * vector::Unit(on_hub.dofs(), 0);
  constrained_dynamics(on_base, s, positions(s), velocities(s), vector::Zero(on_base.dofs()));
  constrained_dynamics(on_hub, t, positions(t), velocities(t), drive);
  CHECK(t.coordinate("turn").q_ddot == within(speed_up, 1e-12));
  for (const char* n : {"q1", "q2", "q3", "q4", "lone"})
    CHECK(std::abs(s.coordinate(n).q_ddot - t.coordinate(n).q_ddot) < 1e-10);
  CHECK(std::abs(s.loop("plane").force.x - t.loop("plane").force.x) < 1e-10);
  CHECK(std::abs(s.coordinate("q2").q_ddot) > 1e-3);
}

}  // namespace constrained_dynamics_test
