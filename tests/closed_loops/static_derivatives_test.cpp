#include <kte/control/linearize_loops.hpp>
#include <kte/dynamics/closed_loops/statics.hpp>

#include "catch.hpp"
#include "closed_loops/mechanisms.hpp"
#include "closed_loops/static_four_bar.hpp"

// Derivatives and statics of static chains with loops are those of the same chain at run time.

namespace static_derivatives_test {

using namespace kte;
using namespace kte::test;
using namespace kte::test::loops;
using namespace kte::test::loops::with_keys;
using Catch::Matchers::Message;

struct both {
  runtime_chain c = runtime_chain() << four_bar;
  runtime_state s = c.make_state();
  Eigen::Vector3d q = assemble(four_bar, guess, held(crank));
  Eigen::Vector3d v = consistent_velocities(four_bar, q, Eigen::Vector3d(2, 0, 0)), tau{0.3, -0.2, 0.1};
};
double off(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b) {
  return a.rows() == b.rows() && a.cols() == b.cols() ? (a - b).cwiseAbs().maxCoeff() : 1;
}

TEST_CASE("derivatives of constrained dynamics of a static chain") {
  both x;
  const auto a = constrained_dynamics_derivatives(four_bar, x.q, x.v, x.tau);
  const auto b = constrained_dynamics_derivatives(x.c, x.s, x.q, x.v, x.tau);
  CHECK(off(a.a, constrained_dynamics(four_bar, x.q, x.v, x.tau).a) < 1e-13);
  CHECK(off(a.by_q, b.by_q) + off(a.by_v, b.by_v) + off(a.by_tau, b.by_tau) == 0);
  CHECK(off(a.lambda, b.lambda) + off(a.lambda_by_q, b.lambda_by_q) + off(a.lambda_by_v, b.lambda_by_v) == 0);
  CHECK(a.mobility == 1);

  const std::vector<closure_parameter> parameters{{"pin", "frame1.x"}, {"pin", "frame2.y"}};
  const auto c = closure_derivatives(four_bar, x.q, x.v, x.tau, parameters, actuated(crank));
  const auto d = closure_derivatives(x.c, x.s, x.q, x.v, x.tau, parameters, actuated("crank"));
  CHECK(c.a.cwiseAbs().maxCoeff() > 0.1);
  CHECK(off(c.q, d.q) + off(c.v, d.v) + off(c.a, d.a) + off(c.lambda, d.lambda) == 0);
  CHECK_THROWS_AS(closure_derivatives(four_bar, x.q, x.v, x.tau, {{"pin", "length"}}, actuated(crank)), unknown_name);
  CHECK_THROWS_AS(constrained_dynamics_derivatives(four_bar, vector(vector::Zero(4)), x.v, x.tau), bad_argument);
}

TEST_CASE("hybrid dynamics of a static chain with loops") {
  both x;
  const Eigen::Vector3d known(1.5, -0.2, 0.1);
  const auto r = hybrid_dynamics(four_bar, x.q, x.v, known, prescribed(crank));
  CHECK(r.a[0] == known[0]);
  CHECK((r.tau[1] == known[1] && r.tau[2] == known[2]));
  const auto all = constrained_dynamics(four_bar, x.q, x.v, r.tau);
  CHECK(off(all.a, r.a) < 1e-12);
  CHECK(off(to_eigen(all.force(pin)), to_eigen(r.force(pin))) < 1e-12);
  CHECK(std::abs(r.force(pin).x) > 0.1);
  const auto none = hybrid_dynamics(four_bar, x.q, x.v, known, prescribed());
  CHECK(off(none.a, constrained_dynamics(four_bar, x.q, x.v, known).a) < 1e-13);
  CHECK_THROWS_MATCHES(hybrid_dynamics(four_bar, x.q, x.v, known, prescribed(crank, rocker)), bad_argument,
                       Message("kte: hybrid_dynamics: the closures do not allow this acceleration of 'crank' with the "
                               "others that are prescribed"));
  CHECK_THROWS_AS(hybrid_dynamics(four_bar, x.q, x.v, vector(vector::Zero(2)), prescribed(crank)), bad_argument);
}

TEST_CASE("a static chain in its actuated coordinates") {
  both x;
  const auto by = actuated(crank);
  CHECK(off(mass_matrix(four_bar, x.q, by), mass_matrix(x.c, x.s, x.q, by)) == 0);
  CHECK(off(nonlinear_effects(four_bar, x.q, x.v, by), nonlinear_effects(x.c, x.s, x.q, x.v, by)) == 0);
  CHECK(off(gravity_forces(four_bar, x.q, by), gravity_forces(x.c, x.s, x.q, by)) == 0);
  CHECK(off(bias_acceleration(four_bar, x.q, x.v, by), bias_acceleration(x.c, x.s, x.q, x.v, by)) == 0);
  CHECK(off(jacobian(four_bar, x.q, B1, by), jacobian(x.c, x.s, x.q, "B1", by)) == 0);
  CHECK(off(jacobian(four_bar, x.q, B1, in_world_axes, by), jacobian(x.c, x.s, x.q, "B1", in_world_axes, by)) == 0);
  const auto a = actuated_dynamics_derivatives(four_bar, x.q, x.v, x.tau, by);
  const auto b = actuated_dynamics_derivatives(x.c, x.s, x.q, x.v, x.tau, by);
  CHECK(off(a.a, b.a) + off(a.by_q, b.by_q) + off(a.by_v, b.by_v) + off(a.by_tau, b.by_tau) == 0);
  const auto linear = linearize(four_bar, x.q, x.v, x.tau, by);
  CHECK(linear.A(1, 0) == a.by_q(0, 0));
  CHECK(linear.B(1, 0) == a.by_tau(0, 0));
  CHECK_THROWS_MATCHES(
      mass_matrix(four_bar, x.q, actuated(crank, rocker)), bad_argument,
      Message("kte: this chain has mobility 1 here, so it is driven by as many coordinates, not by 2"));

  // M_y y'' + bias = tau_y
  const vector forces = loop_motion(four_bar, x.q, by).transpose() * x.tau;
  const vector rest = mass_matrix(four_bar, x.q, by) * a.a + nonlinear_effects(four_bar, x.q, x.v, by) - forces;
  CHECK(rest.cwiseAbs().maxCoeff() < 1e-13);
}

TEST_CASE("equilibria, modes and assemblies of a static chain") {
  both x;
  const auto r = static_equilibrium(four_bar, x.q, actuated(crank));
  CHECK(r.status == equilibrium_status::stable);
  CHECK(kte::loops(four_bar, r.q).gap < 1e-14);
  CHECK(off(r.q, static_equilibrium(x.c, x.s, x.q, actuated(crank)).q) == 0);
  const auto modes = natural_modes(four_bar, r.q, actuated(crank));
  const Eigen::Vector3d none(0, 0, 0);
  const auto by = actuated_dynamics_derivatives(four_bar, r.q, none, none, actuated(crank));
  CHECK(modes.frequency[0] == within(std::sqrt(-by.by_q(0, 0)), 1e-10));
  CHECK(assemblies(four_bar, 50, x.q, held(crank)).size() == 2);
}

}  // namespace static_derivatives_test
