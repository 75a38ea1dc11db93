#include <kte/dynamics/batch.hpp>
#include <kte/dynamics/closed_loops/static_derivatives.hpp>
#include <kte/dynamics/closed_loops/statics.hpp>
#include <kte/models/runtime_dynamics_model.hpp>

#include "catch.hpp"
#include "closed_loops/mechanisms.hpp"
#include "dynamics/two_hinges.hpp"
#include "random.hpp"

// Joints whose axes depend on their coordinates, in closed loops and in packs.

namespace varying_joints_test {

using namespace kte;
using namespace kte::test;
using namespace kte::test::loops;

// clang-format off
inline constexpr struct q_      final : coord_key<"q">         {} q;
inline constexpr struct p_      final : coord_key<"p">         {} p;
inline constexpr struct u_      final : coord_key<"u">         {} u;
inline constexpr struct w_      final : coord_key<"w">         {} w;
inline constexpr struct ground_ final : frame_3D_key<"ground"> {} ground;
inline constexpr struct nut_    final : frame_3D_key<"nut">    {} nut;
inline constexpr struct hand_   final : frame_3D_key<"hand">   {} hand;
inline constexpr struct tip_    final : frame_3D_key<"tip">    {} tip;
inline constexpr struct rod_    final : loop_key<"rod">        {} rod;
// clang-format on

constexpr rigid_body brick{2.5, vec3{0.1, -0.2, 0.15}, sym3{0.3, 0.02, -0.03, 0.4, 0.05, 0.35}};
constexpr vec3 weight{0.5, -1.5, -9.81};

template <class... Closure>
auto arm(const Closure&... closure) {
  return chain(variable_pitch_screw_joint_3D(q, ground, nut, axis::z, 0.3, 0.2), inertia_3D(nut, brick),
               revolute_joint_3D(p, nut, hand, axis::y).at(vec3<>{0.4, 0, 0}), inertia_3D(hand, brick),
               connect(two_hinges{}, u, w, hand, tip), inertia_3D(tip, brick), closure...)
      .gravity(weight);
}
const auto closed = arm(distance_3D(rod, ground, tip, 0.6));

/// Of fourth order, at 0.
template <class F>
vector difference(const F& f, double h = 2e-4) {
  return (8 * (f(h) - f(-h)) - (f(2 * h) - f(-2 * h))) / (12 * h);
}
double off(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b) {
  return (a - b).cwiseAbs().maxCoeff() / (1 + b.cwiseAbs().maxCoeff());
}
vector drawn(random_numbers& draw) {
  return vector::NullaryExpr(4, [&] { return draw(); });
}

TEST_CASE("loops through joints of varying axes: accelerations and derivatives") {
  runtime_chain c;
  c << closed;
  auto s = c.make_state();
  random_numbers draw(3);
  const vector x = assemble(c, s, drawn(draw)), v = consistent_velocities(c, s, x, drawn(draw)), tau = drawn(draw);
  CHECK(kte::loops(c, s, x).gap < 1e-15);
  const auto r = constrained_dynamics_derivatives(c, s, x, v, tau);
  const auto t = constrained_dynamics_derivatives(closed, x, v, tau);
  CHECK(off(t.by_q, r.by_q) + off(t.by_v, r.by_v) + off(t.lambda_by_q, r.lambda_by_q) == 0);
  CHECK(off(constrained_dynamics(closed, x, v, tau).a, r.a) < 1e-14);
  const auto at = [&](const vector& q_there, const vector& v_there) -> vector {
    return constrained_dynamics(c, s, q_there, v_there, tau).a;
  };
  for (Eigen::Index k = 0; k < 4; ++k) {
    const vector e = vector::Unit(4, k);
    CHECK(off(r.by_q.col(k), difference([&](double h) { return at(x + h * e, v); })) < 1e-8);
    CHECK(off(r.by_v.col(k), difference([&](double h) { return at(x, v + h * e); })) < 1e-8);
  }
  // accelerations keep the loop closed: the residual along x + v t + a t^2 / 2 is of third order
  const auto gap = [&](double h) {
    vector g(1);
    const vector there = x + h * v + h * h / 2 * r.a;
    constrained_dynamics(c, s, there, v, tau);
    g[0] = s.loop("rod").residual.x;
    return g;
  };
  CHECK(std::abs(gap(1e-3)[0]) < 1e-7);
}

TEST_CASE("a loop through joints of varying axes stays closed") {
  runtime_chain c;
  c << closed;
  auto s = c.make_state();
  random_numbers draw(4);
  const vector x = assemble(c, s, drawn(draw)), v = consistent_velocities(c, s, x, drawn(draw));
  const manipulator_dynamics_model m(c);
  prince_dormand87 solver(std::cref(m), 0.0, m.make_x(x, v), {.absolute = 1e-10, .relative = 1e-10});
  const auto energy_of = [&] {
    const auto e = energy(c, s, vector(m.positions_of(solver.state())), vector(m.velocities_of(solver.state())));
    return e.kinetic + e.potential;
  };
  const double before = energy_of();
  solver.integrate(1.0);
  CHECK(open_by(c, s, m, solver.state()) < 1e-13);
  CHECK(energy_of() == within(before, 1e-7));
}

TEST_CASE("an equilibrium of joints of varying axes, with and without loops") {
  runtime_chain c;
  c << arm() << spring_3D("ground", "tip", 0.3, 40.0);
  for (const char* coordinate : {"q", "p", "u", "w"}) c << joint_stiffness_gen(coordinate, 2000.0);
  auto s = c.make_state();
  const vector none = vector::Zero(4);
  const auto r = static_equilibrium(c, s, none);
  CHECK(forward_dynamics(c, s, vector(r.q), none, none).cwiseAbs().maxCoeff() < 1e-7);
  c << distance_3D("rod", "ground", "hand", 0.45);
  auto t = c.make_state();
  const vector on = assemble(c, t, r.q, held("p", "u", "w"));
  const auto by = actuated("p", "u", "w");
  const auto x = static_equilibrium(c, t, on, by);
  CHECK(constrained_dynamics(c, t, x.q, none, none).a.cwiseAbs().maxCoeff() < 1e-6);
  CHECK(natural_modes(c, t, x.q, by).frequency.size() == 3);
}

TEST_CASE("joints of varying axes in packs, with and without loops") {
  const auto open = arm();
  const Eigen::MatrixXd x = Eigen::MatrixXd::Random(4, 19), v = Eigen::MatrixXd::Random(4, 19),
                        tau = Eigen::MatrixXd::Random(4, 19);
  Eigen::MatrixXd a(4, 19), f(4, 19);
  batch::forward_dynamics<8>(open, x, v, tau, a);
  batch::inverse_dynamics<8>(open, x, v, a, f);
  for (Eigen::Index k = 0; k < 19; ++k)
    CHECK(off(a.col(k), forward_dynamics(open, x.col(k).eval(), v.col(k).eval(), tau.col(k).eval())) < 1e-13);
  CHECK(off(f, tau) < 1e-12);

  runtime_chain c;
  c << open;
  const auto check_runtime = [&](const Eigen::MatrixXd& q, double tolerance) {
    batch::forward_dynamics<8>(c, q, v, tau, a);
    auto s = c.make_state();
    for (Eigen::Index k = 0; k < 19; ++k)
      CHECK(off(a.col(k), forward_dynamics(c, s, q.col(k).eval(), v.col(k).eval(), tau.col(k).eval())) < tolerance);
  };
  check_runtime(x, 1e-13);
  c << distance_3D("rod", "ground", "tip", 0.6);
  auto s = c.make_state();
  Eigen::MatrixXd assembled = x;
  for (Eigen::Index k = 0; k < 19; ++k) try {
      assembled.col(k) = assemble(c, s, x.col(k).eval());
    } catch (const cannot_assemble&) {
      assembled.col(k) = assembled.col(k - 1);
    }
  check_runtime(assembled, 1e-11);
}

}  // namespace varying_joints_test
