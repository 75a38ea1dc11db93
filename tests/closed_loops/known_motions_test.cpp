#include "closed_loops/known_motions.hpp"

#include <kte/integrators/runge_kutta4.hpp>

namespace known_motions_test {

using namespace kte;
using namespace kte::test;
using namespace kte::test::loops;

auto bar_of(double length) { return planar_body(1.0, length * length / 12, along_x(length / 2)); }
runtime_chain falling() { return std::move(runtime_chain().gravity(along_y(-9.81))); }

/// A crank of r at the origin, and a lever about (0, -e) in whose slot its pin slides. With r = e the lever turns half
/// as fast; at y = -pi/2 the pin is at the lever's pivot, and the closure has rank 0.
known_motion quick_return(double r, double e) {
  auto c = falling();
  c << revolute_joint_2D("crank", "base", "a") << inertia_2D("a", bar_of(r)) << rigid_link_2D("a", "pin", along_x(r))
    << revolute_joint_2D("lever", "base", "b").at(vec2<>{0, -e}) << inertia_2D("b", bar_of(0.8))
    << point_on_line_2D("slot", "b", "pin", axis::x);
  const auto lever = [=](const second& y) {
    return r == e ? second(0.5 * y + pi / 4) : second(atan2(r * sin(y) + e, r * cos(y)));
  };
  return {c,
          [=](const second& y) {
            return std::vector{y, lever(y)};
          },
          [=](const second& y) {
            const second w = lever(y);
            return std::vector{moving_mass{1, r / 2 * cos(y), r / 2 * sin(y)}, turning(r * r / 12, y),
                               moving_mass{1, 0.4 * cos(w), 0.4 * sin(w) - e}, turning(0.64 / 12, w)};
          }};
}

/// Galloway's kite: crank and coupler of 1 m, ground and rocker of 2 m, so that the end B of the coupler is the mirror
/// image of the origin in the line from the crank's tip to the rocker's pivot. At y = 0 and pi it may also stay at the
/// origin.
known_motion kite() {
  auto c = falling();
  c << revolute_joint_2D("crank", "base", "a") << inertia_2D("a", bar_of(1)) << rigid_link_2D("a", "A", along_x(1.0))
    << revolute_joint_2D("coupler", "A", "b") << inertia_2D("b", bar_of(1)) << rigid_link_2D("b", "B", along_x(1.0))
    << revolute_joint_2D("rocker", "base", "c").at(vec2<>{2, 0}) << inertia_2D("c", bar_of(2))
    << rigid_link_2D("c", "C", along_x(2.0)) << coincident_points_2D("pin", "B", "C");
  struct places {
    second ax, ay, bx, by, coupler, rocker;
  };
  const auto places_at = [](const second& y) {
    places p{cos(y), sin(y), {}, {}, {}, {}};
    const second ux = 2.0 - p.ax, uy = -p.ay, along = -(p.ax * ux + p.ay * uy) / (ux * ux + uy * uy);
    p.bx = 2.0 * (p.ax + along * ux), p.by = 2.0 * (p.ay + along * uy);
    p.coupler = atan2(p.by - p.ay, p.bx - p.ax), p.rocker = atan2(p.by, p.bx - 2.0);
    return p;
  };
  return {c,
          [=](const second& y) {
            const auto p = places_at(y);
            return std::vector{y, second(p.coupler - y), p.rocker};
          },
          [=](const second& y) {
            const auto p = places_at(y);
            return std::vector{moving_mass{1, 0.5 * p.ax, 0.5 * p.ay},
                               turning(1.0 / 12, y),
                               moving_mass{1, 0.5 * (p.ax + p.bx), 0.5 * (p.ay + p.by)},
                               turning(1.0 / 12, p.coupler),
                               moving_mass{1, 0.5 * (p.bx + 2.0), 0.5 * p.by},
                               turning(4.0 / 12, p.rocker)};
          }};
}

/// Scissors of n cells of two bars of 1 m at the angles y and pi - y, crossing at their middles; the lower end of one
/// slides along x. With all bars along x, or upright, each cell may move separately.
known_motion scissors(int n) {
  auto c = falling();
  std::string from = "base";
  for (int k = 0; k < n; ++k) {
    const auto i = std::to_string(k);
    c << revolute_joint_2D("a" + i, from, "A" + i) << inertia_2D("A" + i, bar_of(1))
      << rigid_link_2D("A" + i, "middle" + i, along_x(0.5)) << rigid_link_2D("A" + i, "right" + i, along_x(1.0))
      << revolute_joint_2D("b" + i, "middle" + i, "B" + i) << inertia_2D("B" + i, planar_body(1.0, 1.0 / 12))
      << rigid_link_2D("B" + i, "left" + i, along_x(0.5)) << rigid_link_2D("B" + i, "foot" + i, along_x(-0.5));
    if (k == 0)
      c << point_on_line_2D("slot", "base", "foot0", axis::x);
    else
      c << coincident_points_2D("pin" + i, "right" + std::to_string(k - 1), "foot" + i);
    from = "left" + i;
  }
  return {c,
          [n](const second& y) {
            std::vector<second> q;
            for (int k = 0; k < n; ++k) q.push_back(k == 0 ? y : 2.0 * y - pi), q.push_back(pi - 2.0 * y);
            return q;
          },
          [n](const second& y) {
            std::vector<moving_mass> m;
            for (int k = 0; k < n; ++k)
              m.push_back({2, 0.5 * cos(y), (k + 0.5) * sin(y)}), m.push_back(turning(2.0 / 12, y));
            return m;
          }};
}

/// Cranks of 0.4 m about (0, 0) and (1, 0), geared to turn against each other, and two bars of 1 m to a common tip,
/// which moves along x = 1/2; a slot there is redundant.
known_motion geared_five_bar() {
  auto c = falling();
  for (const std::string s : {"l", "r"})
    c << revolute_joint_2D("crank " + s, "base", "c" + s).at(vec2<>{s == "l" ? 0.0 : 1.0, 0})
      << inertia_2D("c" + s, bar_of(0.4)) << rigid_link_2D("c" + s, "pin " + s, along_x(0.4));
  for (const std::string s : {"l", "r"})
    c << revolute_joint_2D("bar " + s, "pin " + s, "b" + s) << inertia_2D("b" + s, bar_of(1))
      << rigid_link_2D("b" + s, "tip " + s, along_x(1.0));
  c << rigid_link_2D("base", "centre", vec2<>{0.5, 0}) << coincident_points_2D("tip", "tip l", "tip r")
    << coupled_coordinates("gear", "crank l", "crank r", 1.0, 1.0, pi)
    << point_on_line_2D("slot", "centre", "tip l", axis::y);
  const auto tip = [](const second& y) {
    const second x = 0.5 - 0.4 * cos(y);
    return second(0.4 * sin(y) + sqrt(1.0 - x * x));
  };
  const auto angle = [tip](const second& y) { return second(atan2(tip(y) - 0.4 * sin(y), 0.5 - 0.4 * cos(y))); };
  return {c,
          [=](const second& y) {
            return std::vector{y, second(pi - y), second(angle(y) - y), second(y - angle(y))};
          },
          [=](const second& y) {
            return std::vector{moving_mass{2, 0.2 * cos(y), 0.2 * sin(y)}, turning(2 * 0.16 / 12, y),
                               moving_mass{2, 0.5 * (0.4 * cos(y) + 0.5), 0.5 * (0.4 * sin(y) + tip(y))},
                               turning(2 * 1.0 / 12, angle(y))};
          }};
}

/// A universal joint between shafts at the angle beta: tan y2 = tan y / cos(beta). Its closure has one row that is not
/// zero, and each row is closed twice.
known_motion cardan(double beta) {
  auto c = falling();
  c << revolute_joint_3D("input", "base", "a", axis::x) << inertia_3D("a", point_mass(1.0, vec3<>{0.1, 0, 0.2}))
    << rigid_link_3D("base", "bearing", vec3<>{}, rotation_about(axis::z, beta))
    << revolute_joint_3D("output", "bearing", "b", axis::x) << inertia_3D("b", point_mass(1.5, vec3<>{0.3, 0, 0.2}))
    << universal_3D("cross", "a", "b", along_y(1.0), along_z(1.0))
    << universal_3D("again", "a", "b", along_y(1.0), along_z(1.0));
  const auto output = [beta](const second& y) { return second(atan2(sin(y), std::cos(beta) * cos(y))); };
  return {c,
          [=](const second& y) {
            return std::vector{y, output(y)};
          },
          [=](const second& y) {
            const second w = output(y), across = -0.2 * sin(w);
            return std::vector{moving_mass{1, second(0.1), -0.2 * sin(y), 0.2 * cos(y)},
                               moving_mass{1.5, 0.3 * std::cos(beta) - std::sin(beta) * across,
                                           0.3 * std::sin(beta) + std::cos(beta) * across, 0.2 * cos(w)}};
          }};
}

/// A wedge of 0.5 rad on a slide, and a block on it that a guide holds upright: a loop of prismatic joints.
known_motion wedge() {
  auto c = falling();
  c << prismatic_joint_2D("wedge", "base", "w", axis::x) << inertia_2D("w", planar_body(2.0, 0.1))
    << prismatic_joint_2D("block", "w", "b", vec2<>{std::cos(0.5), std::sin(0.5)})
    << inertia_2D("b", planar_body(1.5, 0.1)) << sliding_2D("guide", "base", "b", axis::y);
  return {c,
          [](const second& y) {
            return std::vector{y, second(-y / std::cos(0.5))};
          },
          [](const second& y) {
            return std::vector{moving_mass{2, y, second(0.0)}, moving_mass{1.5, second(0.0), -std::tan(0.5) * y}};
          }};
}

struct expected_report {
  int rank;
  std::size_t dependent;
};
void check_report(const known_motion& k, double y, const expected_report& expected) {
  auto s = k.chain.make_state();
  const auto r = kte::loops(k.chain, s, k.q(y));
  CHECK(r.rank == expected.rank);
  CHECK(r.mobility == k.chain.dofs() - expected.rank);
  CHECK(r.dependent.size() == expected.dependent);
  CHECK(r.gap < 1e-14);
}

TEST_CASE("a quick return, also at its change point") {
  const auto whitworth = quick_return(0.3, 0.2), change = quick_return(0.3, 0.3);
  check_report(whitworth, 0.3, {1, 0});
  check_dynamics(whitworth, "crank", 0.3, 2, 1e-13);
  check_motion(whitworth, 0.3, 2, 3, 1e-9, 1e-6);
  check_report(change, 0.3, {1, 0});
  check_report(change, -pi / 2, {0, 1});
  check_dynamics(change, "crank", 0.3, 9, 1e-13);
  check_motion(change, 0.3, 9, 3, 1e-9, 1e-5);
}

TEST_CASE("Galloway's kite passes its change points on its branch") {
  const auto k = kite();
  check_report(k, 0.6, {2, 0});
  check_report(k, 0, {1, 1});
  check_dynamics(k, "crank", 0.6, 8, 1e-13);
  for (const double tolerance : {1e-6, 1e-9}) check_motion(k, 0.6, 8, 4, tolerance, 1e4 * tolerance);
}

TEST_CASE("fixed steps through change points stay on their branch, or stop") {
  const auto k = kite();
  const manipulator_dynamics_model<runtime_chain> model(k.chain);
  int stopped = 0;
  for (const double h : {0.01, 0.006, 0.004}) {
    INFO(h);
    runge_kutta4 solver(std::cref(model), 0.0, model.make_x(k.q(0.6), k.v(0.6, 7)), h);
    try {
      solver.integrate(3.0);
    } catch (const integration_failure& e) {
      stopped += std::string(e.what()).find("ends on another branch of the loops of 'pin'") != std::string::npos;
      CHECK_THAT(e.what(), contains_text("'pin'"));
    }
    CHECK(k.off_branch(solver.state().head(3)) < 1e-7);
  }
  CHECK(stopped > 0);
}

TEST_CASE("scissors of several cells, through the posture in which all bars are aligned") {
  check_report(scissors(10), 1.0, {19, 0});
  check_dynamics(scissors(10), "a0", 1.0, 0.5, 1e-12);
  check_report(scissors(3), 0, {3, 2});
  check_motion(scissors(3), 1.0, 0.5, 2, 1e-9, 1e-5);
}

TEST_CASE("a five-bar with a gear and a redundant slot") {
  const auto k = geared_five_bar();
  check_report(k, 1.0, {3, 1});
  check_dynamics(k, "crank l", 1.0, 2, 1e-13);
  check_motion(k, 1.0, 2, 3, 1e-9, 1e-6);
}

TEST_CASE("a universal joint turns by tan y2 = tan y / cos(beta)") {
  const auto k = cardan(0.8);
  check_report(k, 0.3, {1, 7});
  check_dynamics(k, "input", 0.3, 5, 1e-13);
  check_motion(k, 0.3, 5, 3, 1e-9, 1e-6);
}

TEST_CASE("a loop of prismatic joints") {
  const auto k = wedge();
  check_report(k, -0.2, {1, 1});
  check_dynamics(k, "wedge", -0.2, 0.1, 1e-13);
  check_motion(k, -0.2, 0.1, 1, 1e-9, 1e-9);
}

}  // namespace known_motions_test
