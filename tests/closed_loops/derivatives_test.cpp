#include <kte/dynamics/closed_loops/static_derivatives.hpp>
#include <kte/dynamics/jacobian_rate.hpp>

#include "catch.hpp"
#include "closed_loops/tangle.hpp"
#include "dynamics/small_chains.hpp"
#include "random.hpp"

namespace derivatives_test {

using namespace kte;
using namespace kte::test;
using namespace kte::test::loops;
using Catch::Matchers::Message;

double largest_difference(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b) {
  return a.size() == 0 ? 0 : (a - b).cwiseAbs().maxCoeff() / (1 + b.cwiseAbs().maxCoeff());
}
/// Of fourth order, at 0.
template <class F>
vector difference(const F& f, double h = 2e-4) {
  return (8 * (f(h) - f(-h)) - (f(2 * h) - f(-2 * h))) / (12 * h);
}

/// The tree `floating` with the tip at a distance of the ground and the origin of the branch on a plane, by the whole
/// equations of motion in 50 digits: accelerations and both forces.
namespace floating_loops {
constexpr double length = 0.8;
constexpr vec3<> normal{0.6, 0, 0.8};

using vector_13 = Eigen::Matrix<digits50, 13, 1>;
template <class Q, class V>
vector_13 equations(const Q& q, const V& v, const V& tau) {
  using namespace small_chains;
  const auto& c = small_chains::floating;
  const auto in_numbers = [](const auto& x) { return Eigen::Matrix<big, 3, 1>(big(x.x), big(x.y), big(x.z)); };
  const auto p = in_numbers(forward_kinematics(c, q, tip).position), n = in_numbers(normal);
  const Eigen::Matrix<big, 3, 11> j = jacobian(c, q, tip, in_world_axes).topRows(3),
                                  k = jacobian(c, q, aside, in_world_axes).topRows(3);
  const Eigen::Matrix<big, 3, 1> rate = j * v;
  Eigen::Matrix<big, 2, 11> rows;
  rows << p.transpose() * j / big(length), n.transpose() * k;
  Eigen::Matrix<big, 13, 13> all = Eigen::Matrix<big, 13, 13>::Zero();
  all.topLeftCorner(11, 11) = mass_matrix(c, q);
  all.topRightCorner(11, 2) = -rows.transpose(), all.bottomLeftCorner(2, 11) = rows;
  vector_13 right;
  right.head(11) = tau - nonlinear_effects(c, q, v);
  right[11] =
      -(p.dot(in_numbers(bias_acceleration(c, q, v, tip, in_world_axes).linear)) + rate.dot(rate)) / big(length);
  right[12] = -n.dot(in_numbers(bias_acceleration(c, q, v, aside, in_world_axes).linear));
  return all.fullPivLu().solve(right);
}
}  // namespace floating_loops

/// A static chain of these elements.
inline constexpr struct rod_ final : loop_key<"rod"> {
} rod;
inline constexpr struct plane_ final : loop_key<"plane"> {
} plane;
const auto closed_floating =
    chain(small_chains::floating, distance_3D(rod, small_chains::ground, small_chains::tip, floating_loops::length),
          point_on_plane_3D(plane, small_chains::ground, small_chains::aside, floating_loops::normal))
        .gravity(small_chains::weight);

/// Derivatives of a and lambda by differences in all directions, where no row depends on others.
void check_by_differences(const runtime_chain& c, const vector& q, const vector& v, const vector& tau) {
  auto s = c.make_state();
  const auto r = constrained_dynamics_derivatives(c, s, q, v, tau);
  const Eigen::Index n = c.dofs(), m = r.lambda.size();
  CHECK(static_cast<Eigen::Index>(r.rank) == m);
  CHECK(r.mobility == n - m);
  const auto at = [&](const vector& q_there, const vector& v_there, const vector& tau_there) {
    const auto x = constrained_dynamics(c, s, q_there, v_there, tau_there);
    vector all(n + m);
    all.head(n) = x.a;
    Eigen::Index row = n;
    for (std::size_t k = 0; k < x.names.size(); ++k) {
      const auto& elements = c.wiring().elements;
      const auto of = std::find_if(elements.begin(), elements.end(), [&](const auto& e) {
                        return e.closes && e.element->names().back() == x.names[k];
                      })->element->rows();
      for (int i = 0; i < of.count(); ++i) all[row++] = detail::row_of(x.loops[k].force, x.loops[k].torque, of, i);
    }
    return all;
  };
  Eigen::MatrixXd by_q(n + m, n), by_v(n + m, n), by_tau(n + m, n);
  for (Eigen::Index k = 0; k < n; ++k) {
    const vector e = vector::Unit(n, k);
    by_q.col(k) = difference([&](double h) { return at(integrate(c, q, e, h), v, tau); });
    by_v.col(k) = difference([&](double h) { return at(q, v + h * e, tau); });
    by_tau.col(k) = difference([&](double h) { return at(q, v, tau + h * e); });
  }
  const vector here = at(q, v, tau);
  CHECK(largest_difference(r.a, here.head(n)) < 1e-14);
  CHECK(largest_difference(r.lambda, here.tail(m)) < 1e-14);
  CHECK(largest_difference(r.by_q, by_q.topRows(n)) < 1e-8);
  CHECK(largest_difference(r.by_v, by_v.topRows(n)) < 1e-8);
  CHECK(largest_difference(r.by_tau, by_tau.topRows(n)) < 1e-8);
  CHECK(largest_difference(r.lambda_by_q, by_q.bottomRows(m)) < 1e-8);
  CHECK(largest_difference(r.lambda_by_v, by_v.bottomRows(m)) < 1e-8);
  CHECK(largest_difference(r.lambda_by_tau, by_tau.bottomRows(m)) < 1e-8);
}

/// Three bars on the ground, held at their ends by a rod, a gear and a slot: mobility 1. The second end is
/// displaced along its axis and turned.
runtime_chain held_bars(double length, double constant, double factor, double displaced, double turned) {
  runtime_chain c;
  c.gravity(along_y(-9.81)) << revolute_joint_2D("q0", "base", "b0") << inertia_2D("b0", bar)
                            << rigid_link_2D("b0", "t0", along_x(0.5))
                            << revolute_joint_2D("q1", "base", "b1").at(vec2<>{1.2, 0.1}) << inertia_2D("b1", bar)
                            << rigid_link_2D("b1", "t1",
                                             vec2<>{0.9 + displaced * std::cos(0.3), displaced * std::sin(0.3)},
                                             rotation_2D{std::cos(0.3 + turned), std::sin(0.3 + turned)})
                            << revolute_joint_2D("q2", "base", "b2").at(vec2<>{2.2, 0.1}) << inertia_2D("b2", bar)
                            << distance_2D("rod", "t0", "t1", length)
                            << coupled_coordinates("gear", "q1", "q2", factor, -1.0, constant)
                            << revolute_joint_2D("q3", "base", "b3").at(vec2<>{1.5, 0.8}) << inertia_2D("b3", bar)
                            << rigid_link_2D("b3", "t3", along_x(0.5))
                            << point_on_line_2D("slot", "t1", "t3", vec2<>{0.6, 0.8});
  return c;
}

TEST_CASE("derivatives of constrained dynamics equal those of the equations of motion in 50 digits") {
  using namespace small_chains;
  runtime_chain c;
  c << small_chains::floating << distance_3D("rod", "ground", "tip", floating_loops::length)
    << point_on_plane_3D("plane", "ground", "aside", floating_loops::normal);
  auto s = c.make_state();
  random_numbers draw(11);
  const auto drawn = [&] { return vector::NullaryExpr(11, [&] { return draw(); }).eval(); };
  const vector q = assemble(c, s, integrate(c, neutral_configuration(c), drawn(), 1.0));
  const vector v = consistent_velocities(c, s, q, drawn()), tau = drawn();
  const std::array all{constrained_dynamics_derivatives(c, s, q, v, tau),
                       constrained_dynamics_derivatives(closed_floating, q, v, tau)};

  using vector_11 = Eigen::Matrix<big, 11, 1>;
  const Eigen::Matrix<big, 13, 1> q_big = q.cast<big>();
  const vector_11 v_big = v.cast<big>(), tau_big = tau.cast<big>();
  const big step("1e-16");
  const auto slope = [&](const auto& f) { return ((f(step) - f(-step)) / (2 * step)).template cast<double>().eval(); };
  const vector here = floating_loops::equations(q_big, v_big, tau_big).cast<double>();
  for (const auto& r : all) {
    CHECK(largest_difference(r.a, here.head(11)) < 1e-13);
    CHECK(largest_difference(r.lambda, here.tail(2)) < 1e-13);
  }
  for (int k = 0; k < 11; ++k) {
    const vector_11 e = vector_11::Unit(k);
    const vector by_q = slope([&](const big& h) {
      return floating_loops::equations(integrate(small_chains::floating, q_big, e, h), v_big, tau_big);
    });
    const vector by_v =
        slope([&](const big& h) { return floating_loops::equations(q_big, vector_11(v_big + h * e), tau_big); });
    const vector by_tau =
        slope([&](const big& h) { return floating_loops::equations(q_big, v_big, vector_11(tau_big + h * e)); });
    for (const auto& r : all) {
      CHECK(largest_difference(r.by_q.col(k), by_q.head(11)) < 1e-12);
      CHECK(largest_difference(r.by_v.col(k), by_v.head(11)) < 1e-12);
      CHECK(largest_difference(r.by_tau.col(k), by_tau.head(11)) < 1e-12);
      CHECK(largest_difference(r.lambda_by_q.col(k), by_q.tail(2)) < 1e-12);
      CHECK(largest_difference(r.lambda_by_v.col(k), by_v.tail(2)) < 1e-12);
      CHECK(largest_difference(r.lambda_by_tau.col(k), by_tau.tail(2)) < 1e-12);
    }
  }
}

TEST_CASE("derivatives with closures of all kinds equal differences") {
  random_numbers draw(5);
  const vec3<> u{0.6, 0, 0.8}, t{0, 1, 0};
  const auto closed_by = [&](const auto& closure, bool follows = false) {
    tangle x(follows);
    x.closed << closure;
    const auto drawn = [&] { return vector::NullaryExpr(x.open.dofs(), [&] { return draw(); }).eval(); };
    const vector q = integrate(x.open, neutral_configuration(x.open), drawn(), 1.0);
    check_by_differences(x.closed, q, drawn(), drawn());
  };
  SECTION("points") { closed_by(coincident_points_3D("l", "le", "re")); }
  SECTION("frames") { closed_by(coincident_frames_3D("l", "le", "re")); }
  SECTION("a hinge to the ground") { closed_by(hinge_3D("l", "world", "re", u)); }
  SECTION("a sleeve") { closed_by(cylindrical_3D("l", "le", "re", u)); }
  SECTION("a carriage") { closed_by(sliding_3D("l", "le", "re", u)); }
  SECTION("a cross") { closed_by(universal_3D("l", "le", "re", u, t)); }
  SECTION("a slot") { closed_by(point_on_line_3D("l", "le", "re", u)); }
  SECTION("a rod") { closed_by(distance_3D("l", "le", "re", 0.5)); }
  SECTION("coordinates") { closed_by(coupled_coordinates("l", "l1", "r1", 2.0, -1.0, 0.1)); }
  SECTION("a polynomial") { closed_by(coupled_by_polynomial("l", "l1", "r1", 0.1, 0.5, -0.2, 0.3, 0.1)); }
  SECTION("a function of coordinates") {
    closed_by(coupled_by("l", "l1", "r1", "r3", [](const auto& a, const auto& b, const auto& c) {
      using std::sin;
      return a - b * sin(c) + c * c;
    }));
  }
  SECTION("where coordinates follow others") { closed_by(coincident_points_3D("l", "lf", "rf"), true); }
  SECTION("with a spring between frames") {
    tangle x;
    x.closed << spring_3D("le", "rc", 0.3, 40.0) << coincident_points_3D("l", "lb", "re")
             << coupled_coordinates("n", "l1", "l3", 1.0, 1.0);
    const auto drawn = [&] { return vector::NullaryExpr(x.open.dofs(), [&] { return draw(); }).eval(); };
    check_by_differences(x.closed, integrate(x.open, neutral_configuration(x.open), drawn(), 1.0), drawn(), drawn());
  }
}

/// The path between the frames of a closure against dual numbers of all bodies, which a spring without stiffness
/// demands: on moving bases, with joints of all kinds.
TEST_CASE("derivatives along the paths of closures equal those of all bodies in dual numbers") {
  random_numbers draw(8);
  const rigid_body<> body{1.5, vec3<>{0.1, 0.2, -0.1}, sym3<>{0.3, 0.01, 0, 0.4, 0.02, 0.5}};
  runtime_chain c;
  c.gravity(vec3<>{0, 0, -9.81});
  c << base_3D("right") << screw_joint_3D("l1", "left", "la", vec3<>{0, 0.6, 0.8}, 0.2).at(vec3<>{0.3, 0, 0.1})
    << inertia_3D("la", body) << spherical_joint_3D("l2", "la", "lb") << inertia_3D("lb", body)
    << rigid_link_3D("lb", "le", vec3<>{0.5, 0, 0.1}) << free_joint_3D("float", "right", "hull")
    << inertia_3D("hull", body) << prismatic_joint_3D("r1", "hull", "ra", axis::y).at(vec3<>{0, 0.2, 0.4})
    << inertia_3D("ra", body) << revolute_joint_3D("turn", "ra", "rb", axis::x) << inertia_3D("rb", body)
    << joint_stiffness_gen("r1", 30.0, 0.1) << spherical_joint_3D("r2", "rb", "rc") << inertia_3D("rc", body)
    << revolute_joint_3D("r3", "rc", "re", axis::z).at(vec3<>{0.1, 0.4, 0}) << inertia_3D("re", body)
    << coincident_frames_3D("bases", "le", "hull") << distance_3D("rod", "lb", "re", 0.5)
    << coupled_coordinates("gear", "l1", "r3", 2.0, -1.0, 0.1);
  runtime_chain by_duals = c;
  by_duals << spring_3D("left", "re", 0.3, 0.0);
  const auto drawn = [&](int n) { return vector::NullaryExpr(n, [&] { return draw(); }).eval(); };
  const vector q = integrate(c, neutral_configuration(c), drawn(c.dofs()), 1.0), v = drawn(c.dofs()),
               tau = drawn(c.dofs());
  const auto derive = [&](const runtime_chain& chain) {
    auto s = chain.make_state();
    for (const char* const base : {"left", "right"}) {
      random_numbers numbers(base[0]);
      const auto any = [&] { return vec3<>{numbers(), numbers(), numbers()}; };
      auto& f = s.frame_3D(base);
      f.position = any(), f.velocity = any(), f.ang_velocity = any(), f.acceleration = any(),
      f.ang_acceleration = any();
    }
    return constrained_dynamics_derivatives(chain, s, q, v, tau);
  };
  const auto x = derive(c), y = derive(by_duals);
  CHECK(x.rank == 8);
  for (const auto m :
       {&constrained_dynamics_derivatives_result::by_q, &constrained_dynamics_derivatives_result::by_v,
        &constrained_dynamics_derivatives_result::by_tau, &constrained_dynamics_derivatives_result::lambda_by_q,
        &constrained_dynamics_derivatives_result::lambda_by_v, &constrained_dynamics_derivatives_result::lambda_by_tau})
    CHECK(largest_difference(x.*m, y.*m) < 1e-12);
}

TEST_CASE("derivatives along motions on the loops do not depend on redundant rows") {
  const auto check = [](const runtime_chain& c, const vector& guess) {
    auto s = c.make_state();
    const vector q = assemble(c, s, guess, held("q0"));
    const auto on_loops = [&](double dq, double rate, double force) {
      const vector there =
          assemble(c, s, integrate(c, q, vector(loop_motion(c, s, q, actuated("q0")).col(0)), dq), held("q0"));
      const vector v = loop_motion(c, s, there, actuated("q0")) * rate;
      const vector tau = vector::Constant(c.dofs(), force);
      const auto r = constrained_dynamics(c, s, there, v, tau);
      vector all(2 * c.dofs() + 1);
      all << v, r.a, 0;
      return all;
    };
    const Eigen::MatrixXd g = loop_motion(c, s, q, actuated("q0"));
    const vector v = g * 1.3;
    const vector by_angle = difference([&](double h) { return on_loops(h, 1.3, 0.4); }),
                 by_rate = difference([&](double h) { return on_loops(0, 1.3 + h, 0.4); }),
                 by_force = difference([&](double h) { return on_loops(0, 1.3, 0.4 + h); });
    const Eigen::Index n = c.dofs();
    const auto r = constrained_dynamics_derivatives(c, s, q, v, vector(vector::Constant(n, 0.4)));
    CHECK(r.mobility == 1);
    CHECK(largest_difference(r.by_q * g + r.by_v * by_angle.head(n), by_angle.segment(n, n)) < 1e-8);
    CHECK(largest_difference(r.by_v * g, by_rate.segment(n, n)) < 1e-8);
    CHECK(largest_difference(r.by_tau * vector::Ones(n), by_force.segment(n, n)) < 1e-8);
  };
  check(four_bars(1), four_bar_q(1, 0.7));
  check(four_bars(2, true), four_bar_q(2, 0.7));
  check(four_bars_in_space(2), four_bar_q(2, 0.7));
}

TEST_CASE("derivatives by parameters of closures equal differences of mechanisms assembled again") {
  const vector tau = numbers({-1, -0.5, 0.2, 0.4}), guess = numbers({0.8, 1.2, 2.2, 0.4});
  const auto at = [&](double length, double constant, double factor, double displaced, double turned) {
    const auto c = held_bars(length, constant, factor, displaced, turned);
    auto s = c.make_state();
    const vector q = assemble(c, s, guess, held("q0")), v = loop_motion(c, s, q, actuated("q0")) * 1.3;
    const auto r = constrained_dynamics(c, s, q, v, tau);
    vector x(15);
    x << q, v, r.a, r.loop("rod").force.x, r.loop("gear").torque.x, r.loop("slot").force.x;
    return x;
  };
  const auto c = held_bars(1.1, 0.3, 2, 0, 0);
  auto s = c.make_state();
  const vector here = at(1.1, 0.3, 2, 0, 0), q = here.head(4), v = here.segment(4, 4);
  const auto r = closure_derivatives(c, s, q, v, tau,
                                     {{"rod", "length"},
                                      {"gear", "constant"},
                                      {"gear", "factor1"},
                                      {"slot", "frame1.rz"},
                                      {"rod", "frame2.x"},
                                      {"slot", "frame1.x"}},
                                     actuated("q0"));
  Eigen::MatrixXd all(15, 6);
  all << r.q, r.v, r.a, r.lambda;
  all.col(4) += all.col(5);  // both are on the end that is displaced
  const auto check = [&](int column, const auto& f) {
    CHECK(largest_difference(all.col(column), difference(f, 1e-4)) < 1e-9);
  };
  check(0, [&](double h) { return at(1.1 + h, 0.3, 2, 0, 0); });
  check(1, [&](double h) { return at(1.1, 0.3 + h, 2, 0, 0); });
  check(2, [&](double h) { return at(1.1, 0.3, 2 + h, 0, 0); });
  check(3, [&](double h) { return at(1.1, 0.3, 2, 0, h); });
  check(4, [&](double h) { return at(1.1, 0.3, 2, h, 0); });
  // With q and v held, a rod of another length has the same direction.
  CHECK(r.a_in_place.col(0).cwiseAbs().maxCoeff() < 1e-12);
  CHECK(r.a_in_place.col(1).cwiseAbs().maxCoeff() < 1e-12);

  const auto derive = [&](const char* closure, const char* parameter) {
    return closure_derivatives(c, s, q, v, tau, {{closure, parameter}}, actuated("q0"));
  };
  CHECK_THROWS_MATCHES(derive("rods", "length"), unknown_name, Message("kte: this chain has no closure 'rods'"));
  CHECK_THROWS_MATCHES(derive("gear", "length"), unknown_name,
                       Message("kte: closure 'gear' has no parameter 'length'"));
  CHECK_THROWS_AS(derive("rod", "frame1.z"), unknown_name);
  CHECK_THROWS_AS(derive("gear", "frame1.x"), unknown_name);

  const auto twice = four_bars(1, true);
  auto t = twice.make_state();
  const vector q2 = four_bar_q(1, 0.7), v2 = four_bar_v(1, 1.0), none = vector::Zero(3);
  CHECK_THROWS_MATCHES(
      closure_derivatives(twice, t, q2, v2, none, {{"pin0", "frame2.x"}}, actuated("q0")), no_solution,
      Message("kte: 'frame2.x' of 'pin0' cannot change: redundant closures would contradict each other"));
}

}  // namespace derivatives_test
