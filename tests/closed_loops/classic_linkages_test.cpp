#include <kte/elements/dyad.hpp>

#include "catch.hpp"
#include "closed_loops/mechanisms.hpp"

namespace classic_linkages_test {

using namespace kte;
using namespace kte::test;
using namespace kte::test::loops;

using model = manipulator_dynamics_model<runtime_chain>;

/// A bar of 1 kg on a revolute joint of the given name, with its end at the given length.
void add_bar(runtime_chain& c, const std::string& name, const std::string& on, double length,
             const vec2<>& at = {0, 0}) {
  c << revolute_joint_2D("q" + name, on, name).at(at)
    << inertia_2D(name, planar_body(1.0, length * length / 12, along_x(length / 2)))
    << rigid_link_2D(name, name + " end", along_x(length));
}
struct runs {
  double open = 0, energy_off = 0;
  vector x;
};
/// A simulation to t_end; visit(q) at 40 times.
template <class Visit>
runs simulated(const runtime_chain& c, const vector& q, const vector& v, double t_end, const Visit& visit) {
  const model m(c);
  auto s = c.make_state();
  prince_dormand87 solver(std::cref(m), 0.0, m.make_x(q, v), {.absolute = 1e-12, .relative = 1e-12});
  const auto energy_at = [&](const vector& x) {
    const auto e = energy(c, s, vector(m.positions_of(x)), vector(m.velocities_of(x)));
    return e.kinetic + e.potential;
  };
  const double start = energy_at(solver.state());
  runs r;
  solver.integrate(t_end, every(t_end / 40), [&](double, const vector& x) {
    r.open = (std::max)(r.open, open_by(c, s, m, x));
    r.energy_off = (std::max)(r.energy_off, std::abs(energy_at(x) - start));
    visit(vector(m.positions_of(x)));
  });
  r.x = solver.state();
  return r;
}
/// The largest difference of accelerations from those of the equations in one matrix, relative to the largest.
/// `tree`: the chain without closures.
double off_one_matrix(const runtime_chain& c, const runtime_chain& tree, const vector& q, const vector& v) {
  auto s = c.make_state(), t = tree.make_state();
  const vector none = vector::Zero(c.dofs()), bias = inverse_dynamics(tree, t, q, v, none);
  const vector a = constrained_dynamics(c, s, q, v, none).a, all = by_one_matrix(c, s, q, v, none, bias);
  return (a - all.head(c.dofs())).cwiseAbs().maxCoeff() / a.cwiseAbs().maxCoeff();
}

/// Peaucellier and Lipkin's linkage: bars of 1 m from O to A and C, a rhombus A B C P of sides 0.45 m, and a crank of
/// d = 0.4 m from (d, 0) to B, so that B moves on a circle through O, and P on the line
///
///   x = (1 - 0.45^2) / (2 d)          (1)
runtime_chain peaucellier(bool closed = true) {
  runtime_chain c;
  c.gravity(along_x(9.81));
  add_bar(c, "crank", "base", 0.4, {0.4, 0});
  add_bar(c, "BA", "crank end", 0.45), add_bar(c, "BC", "crank end", 0.45);
  add_bar(c, "AP", "BA end", 0.45), add_bar(c, "CP", "BC end", 0.45);
  add_bar(c, "OA", "base", 1.0), add_bar(c, "OC", "base", 1.0);
  if (closed)
    c << coincident_points_2D("A", "OA end", "BA end") << coincident_points_2D("C", "OC end", "BC end")
      << coincident_points_2D("P", "AP end", "CP end");
  return c;
}

/// Bricard's linkage with threefold symmetry: six hinges, links of 1 m, twists of 90 and -90 degrees in turn. With
/// angles theta, phi in turn (Chen, You and Tarnai, Int. J. Solids and Structures 42, 2005),
///
///   cos theta + cos phi + cos theta cos phi = 0          (2)
///
/// The closing hinge has 5 rows of rank 4 for 5 coordinates.
runtime_chain bricard() {
  const rigid_body<> body{1.0, vec3<>{0.5, 0.1, 0.05}, sym3<>{0.02, 0, 0, 0.1, 0, 0.11}};
  runtime_chain c;
  std::string from = "base";
  for (int i = 1; i <= 5; ++i) {
    const auto n = std::to_string(i);
    c << revolute_joint_3D("q" + n, from, "j" + n, axis::z) << inertia_3D("j" + n, body)
      << rigid_link_3D("j" + n, "e" + n, vec3<>{1, 0, 0}, rotation_about(axis::x, i % 2 == 1 ? pi / 2 : -pi / 2));
    from = "e" + n;
  }
  const mat3<vec3<>> back = as<double>(matrix(rotation_about(axis::x, pi / 2)));
  c << rigid_link_3D("base", "f6", back * vec3<>{-1, 0, 0}, back) << hinge_3D("hinge", "f6", "e5", axis::z);
  return c;
}

/// A leg of Jansen's walking machine, lengths in m: closed by three pins, or by four-bars and a dyad, or open.
enum class closed { by_pins, by_followers, no };
runtime_chain jansen(closed by) {
  const vec2<> pivot{-0.38, -0.078};
  const double crank = 0.15, j = 0.5, b = 0.415, k = 0.619, lower = 0.393, d = 0.401, e = 0.558, f = 0.394, g = 0.367;
  const double turn = std::acos((b * b + d * d - e * e) / (2 * b * d));  // from b to d of the upper triangle
  runtime_chain c;
  c.gravity(along_y(-9.81));
  if (by == closed::by_followers)
    c << four_bar_2D("qcrank", "qj", "qb", {pivot, crank, j, b, -1})
      << four_bar_2D("qcrank", "qk", "qc", {pivot, crank, k, lower, 1}) << mimic_gen("qb", "qd", 1.0, turn)
      << dyad_2D("qd", "qc", "f in d", "qg", {.pivot = {0, 0}, .crank1 = d, .bar1 = f, .bar2 = g, .crank2 = lower})
      << mimic_gen("f in d", "qf", 1.0, turn);
  add_bar(c, "crank", "base", crank);
  add_bar(c, "j", "crank end", j), add_bar(c, "k", "crank end", k);
  add_bar(c, "b", "base", b, pivot), add_bar(c, "c", "base", lower, pivot);
  c << rigid_link_2D("b", "V", vec2<>{d * std::cos(turn), d * std::sin(turn)});
  add_bar(c, "f", "V", f), add_bar(c, "g", "c end", g);
  c << rigid_link_2D("g", "foot", vec2<>{0.2, 0.45}) << inertia_2D("foot", point_mass(0.5));
  if (by == closed::by_pins)
    c << coincident_points_2D("W", "j end", "b end") << coincident_points_2D("U", "k end", "c end")
      << coincident_points_2D("T", "f end", "g end");
  return c;
}

/// Stephenson's six-bar: ternary links P and Q of joints a, b, c; binary links a-a, b-b, and two from c to c that meet
/// in d. Its first kind stands on the link a-a, the second on the link from c of P to d, the third on P. All angles are
/// zero where the joints are at these points. Closed by pins, or open.
struct six_bar {
  struct point {
    double x, y;
  };
  static constexpr point pa{0, 0}, pb{1.2, 0.1}, pc{1.9, -0.2}, qa{0.2, 0.7}, qb{1.3, 0.9}, qc{1.0, 1.3}, d{2.1, 1.0};
  runtime_chain c;

  six_bar(int type, bool closed) {
    c.gravity(along_y(-9.81));
    if (type == 1) {
      turn("P", "base", {0, 0}, pa), turn("Q", "base", {0, 0}, qa), turn("b", "P", pa, pb);
      turn("cP", "P", pa, pc), turn("cQ", "Q", qa, qc);
      if (closed) pin("1", "b", pb, "Q", qa, qb), pin("2", "cP", pc, "cQ", qc, d);
    } else if (type == 2) {
      turn("P", "base", {0, 0}, pc), turn("cQ", "base", {0, 0}, d), turn("Q", "cQ", d, qc);
      turn("a", "P", pc, pa), turn("b", "P", pc, pb);
      if (closed) pin("1", "a", pa, "Q", qc, qa), pin("2", "b", pb, "Q", qc, qb);
    } else {
      turn("a", "base", {0, 0}, pa), turn("Q", "a", pa, qa), turn("b", "base", {0, 0}, pb);
      turn("cP", "base", {0, 0}, pc), turn("cQ", "cP", pc, d);
      if (closed) pin("1", "b", pb, "Q", qa, qb), pin("2", "cQ", d, "Q", qa, qc);
    }
  }

 private:
  /// A body on a joint at a point; `origin`: of what it stands on.
  void turn(const std::string& name, const std::string& on, point origin, point at) {
    c << revolute_joint_2D("q" + name, on, name).at(vec2<>{at.x - origin.x, at.y - origin.y})
      << inertia_2D(name, planar_body(1.0, 0.1, vec3{0.2, 0.1, zero}));
  }
  /// A pin at a point of two bodies of the given origins.
  void pin(const std::string& name, const std::string& one, point origin, const std::string& other, point other_origin,
           point at) {
    c << rigid_link_2D(one, one + name, vec2<>{at.x - origin.x, at.y - origin.y})
      << rigid_link_2D(other, other + name, vec2<>{at.x - other_origin.x, at.y - other_origin.y})
      << coincident_points_2D("pin" + name, one + name, other + name);
  }
};

TEST_CASE("Stephenson's six-bars of three kinds") {
  double first = 0;  // the ratio of the first
  for (const int type : {1, 2, 3}) {
    INFO(type);
    const runtime_chain c = six_bar(type, true).c, open = six_bar(type, false).c;
    auto s = c.make_state();
    const vector zero_angles = vector::Zero(5);
    const auto report = kte::loops(c, s, zero_angles);
    CHECK((report.rows == 4 && report.rank == 4 && report.mobility == 1 && report.gap < 1e-15));
    // one linkage on three of its links: the angles between links are the same
    const vector v = consistent_velocities(c, s, zero_angles, vector(vector::Unit(5, 0)));
    const Eigen::MatrixXd g = loop_motion(c, s, zero_angles, actuated(type == 3 ? "qa" : "qP"));
    CHECK((v - g.col(0) * v[0]).cwiseAbs().maxCoeff() < 1e-14);
    const auto over = [&](int i, int k) { return g(i, 0) / g(k, 0); };
    // the rate of Q over that of P, both relative to a: in the order of joints above
    const double ratio = type == 1   ? over(1, 0)
                         : type == 3 ? -over(1, 0)
                                     : (g(1, 0) + g(2, 0) - g(0, 0) - g(3, 0)) / -g(3, 0);
    if (type == 1) first = ratio;
    CHECK(ratio == within(first, 1e-13 * std::abs(first)));
    CHECK(off_one_matrix(c, open, zero_angles, v) < 1e-9);
    double turned = 0;
    const auto r = simulated(c, zero_angles, vector(0.5 * v), 1,
                             [&](const vector& x) { turned = (std::max)(turned, x.cwiseAbs().maxCoeff()); });
    CHECK(turned > 0.1);
    CHECK(r.open < 2e-13);
    CHECK(r.energy_off < 1e-9);
  }
}

TEST_CASE("Peaucellier and Lipkin's linkage moves a point along a line") {
  const auto c = peaucellier();
  auto s = c.make_state();
  // by circles: B, then A and C at 1 m from O and 0.45 m from B
  const double angle = 0.5, bx = 0.4 + 0.4 * std::cos(angle), by = 0.4 * std::sin(angle), ob = std::hypot(bx, by);
  const double to_b = std::atan2(by, bx), at_o = std::acos((1 + ob * ob - 0.45 * 0.45) / (2 * ob));
  const auto way = [&](double t) { return std::atan2(std::sin(t) - by, std::cos(t) - bx); };
  const double oa = to_b + at_o, oc = to_b - at_o, ba = way(oa), bc = way(oc);
  const vector q = numbers({angle, ba - angle, bc - angle, bc - ba, ba - bc, oa, oc}), rest = vector::Zero(7);
  const auto report = kte::loops(c, s, q);
  CHECK((report.rows == 6 && report.rank == 6 && report.mobility == 1 && report.gap < 1e-15));
  const vector v = consistent_velocities(c, s, q, vector(vector::Unit(7, 0)));
  CHECK(off_one_matrix(c, peaucellier(false), q, v) < 1e-9);  // differences with steps of 1e-4
  const double line = (1 - 0.45 * 0.45) / 0.8;
  double off = 0, highest = -1, lowest = 1;
  const auto r = simulated(c, q, rest, 3, [&](const vector& at) {
    (void)forward_kinematics(c, s, at);
    const auto p = s.frame_2D("AP end").position;
    off = (std::max)(off, std::abs(p.x - line)), highest = (std::max)(highest, p.y), lowest = (std::min)(lowest, p.y);
  });
  CHECK(off < 1e-14);
  CHECK((highest > 0.2 && lowest < -0.2));
  CHECK(r.open < 2e-13);
  CHECK(r.energy_off < 1e-9);
}

TEST_CASE("Bricard's linkage moves though its closure has as many rows as it has coordinates") {
  const auto c = bricard();
  auto s = c.make_state();
  const double theta = 1.1, phi = std::acos(-std::cos(theta) / (1 + std::cos(theta)));  // (2)
  const auto at = [](double x, double y) { return numbers({x, y, x, y, x}); };
  const vector q = assemble(c, s, vector(at(theta, phi) + 0.02 * numbers({0, 1, -1, 1, 1})), held("q1"));
  CHECK((q - at(theta, phi)).cwiseAbs().maxCoeff() < 1e-14);
  const auto report = kte::loops(c, s, q);
  CHECK((report.rows == 5 && report.rank == 4 && report.mobility == 1 && report.dependent.size() == 1));
  const vector v = consistent_velocities(c, s, q, numbers({1, 0, 0, 0, 0}));
  // the derivative of (2)
  const double ratio = -std::sin(theta) * (1 + std::cos(phi)) / (std::sin(phi) * (1 + std::cos(theta)));
  CHECK((v - v[0] * at(1, ratio)).cwiseAbs().maxCoeff() < 1e-14);
  double off = 0, turned = 0;
  const auto r = simulated(c, q, v, 2, [&](const vector& x) {
    off = (std::max)(off, (x - at(x[0], x[1])).cwiseAbs().maxCoeff());
    off = (std::max)(off, std::abs(std::cos(x[0]) + std::cos(x[1]) + std::cos(x[0]) * std::cos(x[1])));
    turned = (std::max)(turned, std::abs(x[0] - theta));
  });
  CHECK(off < 1e-14);
  CHECK(turned > 0.3);
  CHECK(r.open < 2e-13);
  CHECK(r.energy_off < 1e-9);
}

TEST_CASE("Jansen's leg by pins, and by four-bars and a dyad") {
  const auto pins = jansen(closed::by_pins), followers = jansen(closed::by_followers);
  auto s = pins.make_state(), t = followers.make_state();
  const auto name = [](int i) { return std::array{"qcrank", "qj", "qk", "qb", "qc", "qf", "qg"}[std::size_t(i)]; };
  for (const double angle : {0.3, 1.8, 3.3, 4.9}) {
    const vector y = numbers({angle}), rate = numbers({2.5}), torque = numbers({0.7});
    const vector a = forward_dynamics(followers, t, y, rate, torque);
    vector q(7), v(7), expected(7);
    followers.doMotion(t);
    for (int i = 0; i < 7; ++i) {
      const auto& x = t.coordinate(name(i));
      q[i] = x.q, v[i] = x.q_dot, expected[i] = x.q_ddot;
    }
    const auto report = kte::loops(pins, s, q);
    CHECK((report.rank == 6 && report.gap < 1e-15));
    CHECK((consistent_velocities(pins, s, q, v) - v).cwiseAbs().maxCoeff() < 1e-13);
    const vector by_pins = constrained_dynamics(pins, s, q, v, vector(0.7 * vector::Unit(7, 0))).a;
    CHECK((by_pins - expected).cwiseAbs().maxCoeff() < 1e-12 * expected.cwiseAbs().maxCoeff());
    CHECK(by_pins[0] == within(a[0], 1e-12 * std::abs(a[0])));
    CHECK(off_one_matrix(pins, jansen(closed::no), q, v) < 1e-9);
  }
}

}  // namespace classic_linkages_test
