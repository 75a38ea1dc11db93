#include <kte/dynamics/derivatives.hpp>
#include <kte/dynamics/external_wrenches.hpp>
#include <kte/dynamics/forward_dynamics.hpp>
#include <kte/dynamics/forward_kinematics.hpp>
#include <kte/dynamics/hybrid_dynamics.hpp>
#include <kte/dynamics/inverse_dynamics.hpp>
#include <kte/dynamics/mass_matrix.hpp>
#include <kte/dynamics/mass_matrix_inverse.hpp>
#include <kte/dynamics/regressor.hpp>
#include <kte/elements/virtual_kte_interface.hpp>
#include <kte/runtime_chain/runtime_chain.hpp>

#include "dynamics/small_chains.hpp"

// Virtual models on real mechanisms: against the same models attached in earnest.

namespace virtual_kte_interface_test {

using namespace kte;
using namespace kte::test;
using namespace kte::test::small_chains;

/// A two-link arm with a walker attached to its hand by `attach(hand, palm)`: a mass, a slide with a mass, a spring and
/// a damper to the ground.
template <class Attach>
constexpr auto arm_with_walker(const Attach& attach) {
  return chain(revolute_joint_3D(q1, ground, body, axis::y), inertia_3D(body, brick),
               revolute_joint_3D(q2, body, hand, axis::x).at(along_z(0.4), quarter_turn_y), inertia_3D(hand, stick),
               attach(hand, palm), inertia_3D(palm, brick), prismatic_joint_3D(f1, palm, tip, axis::z),
               inertia_3D(tip, stick), spring_3D(ground, tip, 0.1, 30.0), damper_3D(ground, tip, 2.0))
      .gravity(weight);
}
constexpr auto welded = [](const auto& b, const auto& e) { return fixed_joint_3D(b, e); };
constexpr auto virtually = [](const auto& b, const auto& e) { return virtual_kte_interface_3D(b, e); };
constexpr auto arm =
    chain(revolute_joint_3D(q1, ground, body, axis::y), inertia_3D(body, brick),
          revolute_joint_3D(q2, body, hand, axis::x).at(along_z(0.4), quarter_turn_y), inertia_3D(hand, stick))
        .gravity(weight);

template <class Chain>
runtime_chain at_run_time(const Chain& c) {
  runtime_chain r;
  r << c;
  return r;
}

/// Three results of some 30 roundings each, relative to the largest torque: 8 eps.
template <class S>
const S rounding = 8 * std::numeric_limits<S>::epsilon();

/// The largest difference of what the virtual walker gives from: on the real joints the arm less what the walker would
/// add in earnest, on the walker's own slide what it is in earnest.
template <class S>
S off_by(const joint_vector<S, 3>& with_virtual, const joint_vector<S, 3>& with_real, const joint_vector<S, 2>& alone) {
  joint_vector<S, 3> expected = with_real;
  expected.template head<2>() = S(2) * alone - with_real.template head<2>();
  return (with_virtual - expected).cwiseAbs().maxCoeff() / with_real.cwiseAbs().maxCoeff();
}

template <class S>
S off_in_random_motion(unsigned seed) {
  random_numbers random(seed);
  joint_vector<S, 3> q, v, a;
  for (int i = 0; i < 3; ++i) q[i] = S(random()), v[i] = S(random()), a[i] = S(random());
  return off_by<S>(
      inverse_dynamics(arm_with_walker(virtually), q, v, a), inverse_dynamics(arm_with_walker(welded), q, v, a),
      inverse_dynamics(arm, joint_vector<S, 2>(q.template head<2>()), joint_vector<S, 2>(v.template head<2>()),
                       joint_vector<S, 2>(a.template head<2>())));
}

TEST_CASE("a virtual model moves with the real one and loads it backwards") {
  for (unsigned seed = 1; seed < 6; ++seed) {
    CHECK(off_in_random_motion<double>(seed) < rounding<double>);
    CHECK(off_in_random_motion<big>(seed) < rounding<big>);
  }
  // at run time, and the passes
  const auto c = at_run_time(arm_with_walker(virtually));
  auto s = c.make_state();
  const Eigen::Vector3d q(0.3, -0.8, 0.2), v(1, -0.5, 0.7), a(-0.4, 2, 0.6);
  const Eigen::Vector3d tau = inverse_dynamics(c, s, q, v, a),
                        compiled = inverse_dynamics(arm_with_walker(virtually), q, v, a);
  CHECK((tau - compiled).norm() < 1e-14 * tau.norm());
  const auto palm_pose = forward_kinematics(c, s, q, "palm"), hand_pose = forward_kinematics(c, s, q, "hand");
  CHECK(palm_pose.position == hand_pose.position);
  CHECK(jacobian(c, s, q, "palm") == jacobian(c, s, q, "hand"));
}

TEST_CASE("virtual models in the plane and on coordinates") {
  runtime_chain mast;
  mast << prismatic_joint_2D("q1", "table", "cart", axis::x) << inertia_2D("cart", point_mass(2.0))
       << virtual_kte_interface_2D("cart", "ghost") << rigid_link_2D("ghost", "tip", along_y(0.5))
       << spring_2D("table", "tip", 0.5, 40.0);
  auto s = mast.make_state();
  const std::array<double, 1> q{0.3}, v{0.7}, a{1.5};
  const double length = std::sqrt(0.3 * 0.3 + 0.25);
  const double spring = -40 * (length - 0.5) * 0.3 / length;                        // on the tip, N
  CHECK(inverse_dynamics(mast, s, q, v, a)[0] == within(2 * 1.5 + spring, 1e-14));  // the motor does what it would do

  runtime_chain wheel;
  wheel << base_gen("wall") << inertia_gen("q", 0.5) << virtual_kte_interface_gen("q", "ghost")
        << spring_gen("wall", "ghost", 0.0, 20.0) << inertia_gen("ghost", 0.1);
  auto t = wheel.make_state();
  CHECK(inverse_dynamics(wheel, t, q, v, a)[0] == within((0.5 - 0.1) * 1.5 - 20 * 0.3, 1e-14));
}

TEST_CASE("what needs loads to be those of motions refuses virtual models") {
  const auto c = at_run_time(arm_with_walker(virtually));
  auto s = c.make_state();
  const Eigen::Vector3d x(0.1, 0.2, 0.3);
  const auto named = says("virtual_kte_interface_3D (base 'hand', end 'palm') returns loads that are not the dual");
  CHECK_THROWS_MATCHES(mass_matrix(c, s, x), bad_argument, named);
  CHECK_THROWS_MATCHES(forward_dynamics(c, s, x, x, x), bad_argument, named);
  CHECK_THROWS_MATCHES(mass_matrix_inverse(c, s, x), bad_argument, named);
  CHECK_THROWS_MATCHES(inverse_dynamics_derivatives(c, s, x, x, x), bad_argument, named);
  CHECK_THROWS_MATCHES(external_forces(c, s, x, {{"palm", {1, 0, 0}}}), bad_argument, named);
  CHECK_THROWS_MATCHES(centroidal_momentum_matrix(c, s, x), bad_argument, named);
  runtime_chain wheel;
  wheel << inertia_gen("q", 0.5) << virtual_kte_interface_gen("q", "ghost") << inertia_gen("ghost", 0.1);
  auto t = wheel.make_state();
  const std::array<double, 1> y{0.3};
  CHECK_THROWS_MATCHES(forward_dynamics(wheel, t, y, y, y), bad_argument, says("virtual_kte_interface_gen"));
  CHECK_THROWS_MATCHES(mass_matrix(wheel, t, y), bad_argument, says("virtual_kte_interface_gen"));
}

}  // namespace virtual_kte_interface_test
