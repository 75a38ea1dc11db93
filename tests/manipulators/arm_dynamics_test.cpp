#include <kte/dynamics/configuration_space.hpp>
#include <kte/dynamics/forward_dynamics.hpp>
#include <kte/manipulators/era.hpp>
#include <kte/manipulators/iiwa14.hpp>
#include <kte/manipulators/opw.hpp>
#include <kte/manipulators/p3r3r.hpp>
#include <kte/manipulators/panda.hpp>
#include <kte/manipulators/runtime_manipulator.hpp>
#include <kte/manipulators/scara.hpp>
#include <kte/manipulators/ssrms.hpp>
#include <kte/manipulators/three_r.hpp>
#include <kte/manipulators/three_r_three_r.hpp>
#include <kte/manipulators/uav.hpp>
#include <kte/manipulators/ur.hpp>
#include <kte/models/inverse_dynamics_model.hpp>
#include <kte/models/runtime_dynamics_model.hpp>
#include <kte/runtime_chain/runtime_chain.hpp>

#include "catch.hpp"
#include "chain/registered.hpp"
#include "random.hpp"

// Every ready arm as the models of it: kinematics, dynamics and inverse dynamics agree, and it has its limits. All as
// lists of elements, which is what files hold; of static chains some, of each kind of joint and of the plane.

namespace arm_dynamics_test {

using namespace kte;

struct motion_of {
  Eigen::VectorXd q, v, tau;
};
motion_of random_motion(const runtime_chain& c) {
  random_numbers random(1);
  motion_of x;
  const int n = c.dofs();
  x.v.resize(n), x.tau.resize(n);
  for (int i = 0; i < n; ++i) x.v[i] = random(2), x.tau[i] = random(10);
  x.q = integrate(c, neutral_configuration(c), x.v, 0.7);
  return x;
}
struct found {
  Eigen::VectorXd a, driven;  ///< accelerations of no forces, and under forces
};

/// For a model of either kind: its rates are those of forward dynamics, whose inverse is inverse dynamics.
template <class Moving, class Forces, class Forward>
found check_models(const Moving& moving, const Forces& forces, const Forward& forward, const motion_of& at) {
  const auto n = at.v.size();
  const Eigen::VectorXd none = Eigen::VectorXd::Zero(n);
  const Eigen::VectorXd rate = moving.computeStateRate(0.0, moving.make_x(at.q, at.v));
  CHECK(rate.head(n) == at.v);
  const Eigen::VectorXd a = rate.tail(n), driven = forward(at.q, at.v, at.tau);
  CHECK((forward(at.q, at.v, none) - a).norm() <= 1e-14 * a.norm());
  // Forces are sums: exact to rounding of what they are sums of.
  const Eigen::MatrixXd m = forces.getMassMatrix(at.q).cwiseAbs();
  const double bias = Eigen::VectorXd(forces.computeForces(at.q, at.v, none)).norm();
  const auto size = [&](const Eigen::VectorXd& x) { return (m * x.cwiseAbs()).norm() + bias; };
  CHECK(forces.computeForces(at.q, at.v, a).norm() <= 1e-14 * size(a));
  CHECK((forces.computeForces(at.q, at.v, driven) - at.tau).norm() <= 1e-14 * size(driven));
  return {a, driven};
}

template <class Chain>
runtime_chain runtime(const Chain& c) {
  return models::registered(record_of(c));
}
found check(const char* name, const runtime_chain& c) {
  INFO(name);
  auto s = c.make_state();
  const auto at = random_motion(c);
  const auto x = check_models(
      manipulator_dynamics_model(c), inverse_dynamics_model(c),
      [&](const auto& q, const auto& v, const auto& tau) { return Eigen::VectorXd(forward_dynamics(c, s, q, v, tau)); },
      at);
  // The tool moves by J v.
  const manipulator arm(c, "tool");
  const double h = 1e-6;
  const auto next = arm.getDependentPoses(integrate(c, at.q, at.v, h))[0].position,
             last = arm.getDependentPoses(integrate(c, at.q, at.v, -h))[0].position;
  const auto velocity = arm.getDependentVelocities(at.q, at.v);
  const vec3<> moved = (0.5 / h) * (next - last);
  const double most = 1e-8 * (1 + arm.structure().reach);
  CHECK(moved.x == within(velocity[0], most));
  CHECK(moved.y == within(velocity[1], most));
  CHECK(moved.z == within(velocity[2], most));
  return x;
}
template <class Chain, class Limits>
void check(const char* name, const Chain& c, const Limits& limits) {
  check(name, runtime(c));
  INFO(name);
  check_limits(c, limits);
  for (const double x : limits.lower) CHECK(std::isfinite(x));
  for (const double x : limits.upper) CHECK(std::isfinite(x));
}
/// Checks the static chain against the list of its elements.
template <class Arm>
void check_static(const char* name, const Arm& arm) {
  const auto c = runtime(arm.chain());
  const auto b = check(name, c);
  INFO(name);
  const auto a = check_models(
      manipulator_dynamics_model(arm), inverse_dynamics_model(arm),
      [&](const auto& q, const auto& v, const auto& tau) { return Eigen::VectorXd(forward_dynamics(arm, q, v, tau)); },
      random_motion(c));
  CHECK((a.a - b.a).norm() <= 1e-13 * a.a.norm());
  CHECK((a.driven - b.driven).norm() <= 1e-13 * a.driven.norm());
}

TEST_CASE("every arm as models of it") {
  check("3R", runtime(three_r_chain()));
  check("3R3R", three_r_three_r_chain(), three_r_three_r_limits());
  check("P3R3R", p3r3r_chain(), p3r3r_limits());
  check("IRB 2400", opw_chain(), opw_limits());
  check("UR5", ur_chain(), ur_limits());
  check("iiwa14", iiwa14_chain(), iiwa14_limits());
  check("Panda", panda_chain(), panda_limits());
  check("ERA", era_chain(), era_limits());
  check("SSRMS", ssrms_chain(), ssrms_limits());
  check("free body", runtime(free_floater_chain()));
  check("free body in the plane", runtime(free_floater_2D_chain()));
  check_static("3R in the plane", three_r_2D());
  check_static("SCARA", scara());
  check_static("UAV", uav());
}

}  // namespace arm_dynamics_test
