#include <kte/dynamics/forward_dynamics.hpp>
#include <kte/dynamics/frame_motion.hpp>
#include <kte/dynamics/inverse_dynamics.hpp>
#include <kte/dynamics/jacobian.hpp>
#include <kte/dynamics/mass_matrix.hpp>
#include <kte/manipulators/era.hpp>
#include <kte/manipulators/iiwa14.hpp>
#include <kte/manipulators/opw.hpp>
#include <kte/manipulators/p3r3r.hpp>
#include <kte/manipulators/panda.hpp>
#include <kte/manipulators/scara.hpp>
#include <kte/manipulators/ssrms.hpp>
#include <kte/manipulators/three_r.hpp>
#include <kte/manipulators/uav.hpp>
#include <kte/manipulators/ur.hpp>
#include <kte/runtime_chain/runtime_chain.hpp>

#include <Eigen/Cholesky>
#include <Eigen/Geometry>

#include "catch.hpp"
#include "chain/registered.hpp"
#include "random.hpp"
#include "robots/iiwa14.hpp"
#include "robots/ur5.hpp"

// The models of arms: where their tools are, written out from their tables a second time; their masses and limits.

namespace models_test {

using namespace kte;
using arm_names::tool;

using place = Eigen::Isometry3d;
place turn(const Eigen::Vector3d& axis, double angle) { return place(Eigen::AngleAxisd(angle, axis)); }
place x(double a) { return turn(Eigen::Vector3d::UnitX(), a); }
place y(double a) { return turn(Eigen::Vector3d::UnitY(), a); }
place z(double a) { return turn(Eigen::Vector3d::UnitZ(), a); }
place by(double px, double py, double pz) { return place(Eigen::Translation3d(px, py, pz)); }
/// A row of Denavit-Hartenberg parameters, as modified by Craig.
place craig(double a, double alpha, double d, double q) { return by(a, 0, 0) * x(alpha) * by(0, 0, d) * z(q); }
/// A row as Denavit and Hartenberg have it.
place classic(double a, double alpha, double d, double q) { return z(q) * by(a, 0, d) * x(alpha); }

constexpr double half = 3.141592653589793, quarter = half / 2;

/// The largest difference of the tool's pose at random configurations from that of a formula, and of the Jacobian from
/// differences; of the model as a list of elements, which is what files hold.
template <class Arm, class Formula>
void check(const Arm& arm, const Formula& formula, double tolerance = 4e-15) {
  const auto c = models::registered(record_of(arm));
  auto s = c.make_state();
  random_numbers random(7);
  const int n = c.dofs();
  double pose_error = 0, jacobian_error = 0;
  for (int i = 0; i < 5; ++i) {
    Eigen::VectorXd q(n);
    for (int k = 0; k < n; ++k) q[k] = random(3);
    const place wanted = formula(q);
    const auto& [r, p] = forward_kinematics(c, s, q, "tool");
    Eigen::Matrix<double, 3, 4> found, expected;
    found << r.x.x, r.x.y, r.x.z, p.x, r.y.x, r.y.y, r.y.z, p.y, r.z.x, r.z.y, r.z.z, p.z;
    expected << wanted.linear(), wanted.translation();
    const double size = 1 + expected.col(3).norm();
    pose_error = test::worse(pose_error, (found - expected).cwiseAbs().maxCoeff() / size);
    const Eigen::MatrixXd j = jacobian(c, s, q, "tool", in_world_axes);
    for (int k = 0; k < n; ++k) {
      const double h = 1e-6;
      Eigen::VectorXd to = q, from = q;
      to[k] += h, from[k] -= h;
      const Eigen::Vector3d rate = (formula(to).translation() - formula(from).translation()) / (2 * h);
      jacobian_error = test::worse(jacobian_error, (j.col(k).head<3>() - rate).norm() / size);
    }
    const Eigen::MatrixXd m = mass_matrix(c, s, q);
    CHECK(Eigen::LLT<Eigen::MatrixXd>(m).info() == Eigen::Success);
  }
  CHECK(pose_error < tolerance);
  CHECK(jacobian_error < 1e-8);
}
double total_mass(const model_record& record) {
  double m = 0;
  for (const auto& e : record.elements)
    for (const auto& p : e.parameters)
      if (p.name == "mass") m += p.values.at(0);
  return m;
}
template <class Limits>
void check_between(const Limits& limits, std::size_t i, double lower, double upper) {
  CHECK(limits.lower[i] == within(lower, 1e-15));
  CHECK(limits.upper[i] == within(upper, 1e-15));
}

TEST_CASE("iiwa14: its table, the maker's description, its limits") {
  check(iiwa14_chain(), [](const auto& q) {
    return classic(0, -quarter, 0.36, q[0]) * classic(0, quarter, 0, q[1]) * classic(0, quarter, 0.42, q[2]) *
           classic(0, -quarter, 0, q[3]) * classic(0, -quarter, 0.4, q[4]) * classic(0, quarter, 0, q[5]) *
           classic(0, 0, 0.126, q[6]);
  });
  // One robot, in our axes and in the manufacturer's axes of links.
  const auto ours = models::registered(record_of(iiwa14_chain())),
             theirs = models::registered(record_of(robots::iiwa14));
  auto a = ours.make_state(), b = theirs.make_state();
  random_numbers random(1);
  for (int i = 0; i < 5; ++i) {
    Eigen::VectorXd q(7), v(7), acc(7);
    for (int k = 0; k < 7; ++k) q[k] = random(3), v[k] = random(2), acc[k] = random(5);
    CHECK((inverse_dynamics(ours, a, q, v, acc) - inverse_dynamics(theirs, b, q, v, acc)).norm() < 1e-12);
  }
  constexpr auto arm = iiwa14();
  static_assert(arm.family() == arm_family::srs);
  check_between(arm.limits(), 1, -2 * half / 3, 2 * half / 3);
  CHECK(arm.limits().rate[3] == within(75 * half / 180, 1e-15));
}

TEST_CASE("UR5: the maker's parameters, its limits") {
  check(ur_chain(), [](const auto& q) {
    return z(half) * classic(0, quarter, 0.089159, q[0]) * classic(-0.425, 0, 0, q[1]) * classic(-0.39225, 0, 0, q[2]) *
           classic(0, quarter, 0.10915, q[3]) * classic(0, -quarter, 0.09465, q[4]) * classic(0, 0, 0.0823, q[5]);
  });
  const auto ours = models::registered(record_of(ur_chain())), theirs = models::registered(record_of(robots::ur5));
  auto a = ours.make_state(), b = theirs.make_state();
  const Eigen::VectorXd q = Eigen::VectorXd::LinSpaced(6, -1, 2);
  CHECK((inverse_dynamics(ours, a, q, q, q) - inverse_dynamics(theirs, b, q, q, q)).norm() < 1e-8);  // 4.9e-12 rad
  constexpr auto arm = ur();
  static_assert(arm.family() == arm_family::three_parallel);
  check_between(arm.limits(), 0, -2 * half, 2 * half);
  check_between(arm.limits(), 2, -half, half);
}

TEST_CASE("Panda: the maker's parameters, its limits") {
  check(panda_chain(), [](const auto& q) {
    return craig(0, 0, 0.333, q[0]) * craig(0, -quarter, 0, q[1]) * craig(0, quarter, 0.316, q[2]) *
           craig(0.0825, quarter, 0, q[3]) * craig(-0.0825, -quarter, 0.384, q[4]) * craig(0, quarter, 0, q[5]) *
           craig(0.088, quarter, 0, q[6]) * by(0, 0, 0.107);
  });
  constexpr auto arm = panda();
  static_assert(arm.family() == arm_family::offset_7R);
  check_between(arm.limits(), 3, -3.0718, -0.0698);
  check_between(arm.limits(), 5, -0.0175, 3.7525);
  CHECK(total_mass(record_of(panda_chain())) == within(16.062132, 1e-12));
}

TEST_CASE("arms of the catalogue") {
  check(three_r_chain(1, 0.8, 0.3, 0.1, 0.2, 0.4),
        [](const auto& q) { return z(q[0]) * by(1, 0, 0.1) * z(q[1]) * by(0.8, 0, 0.2) * z(q[2]) * by(0.3, 0, 0.4); });
  check(three_r_2D_chain(1, 0.8, 0.3),
        [](const auto& q) { return z(q[0]) * by(1, 0, 0) * z(q[1]) * by(0.8, 0, 0) * z(q[2]) * by(0.3, 0, 0); });
  check(scara_chain(0.4, 0.3, -0.1),
        [](const auto& q) { return z(q[0]) * by(0.4, 0, 0) * z(q[1]) * by(0.3, 0, q[2] - 0.1) * z(q[3]); });
  const auto wrist = [](const auto& q, double h, double a, double b1, double b2, double d) {
    return z(q[0]) * by(0, 0, h) * y(-q[1]) * by(0, 0, a) * y(-q[2]) * by(0, 0, b1) * z(q[3]) * by(0, 0, b2) *
           y(-q[4]) * by(0, 0, d) * z(q[5]);
  };
  check(three_r_three_r_chain(), [&](const auto& q) { return wrist(q, 0, 1, 0.5, 0.5, 0.2); });
  check(p3r3r_chain(),
        [&](const auto& q) { return by(q[0], 0, 0) * wrist(q.tail(6).eval(), 0.3302, 0.3048, 0.150, 0.1802, 0.0762); });
  check(opw_chain(), [](const auto& q) {
    return z(q[0]) * by(0.1, 0, 0.615) * y(q[1]) * by(0, 0, 0.705) * y(q[2]) * by(-0.135, 0, 0.755) * z(q[3]) *
           y(q[4]) * z(q[5]) * by(0, 0, 0.085);
  });
  constexpr auto on_track = p3r3r();
  static_assert(on_track.family() == arm_family::on_track);
  check_between(p3r3r_limits(), 0, 0, 1);
  check_between(three_r_three_r_limits(), 5, -half, half);
  check_between(opw_limits(), 2, half / 6, 155 * half / 180);
}

TEST_CASE("arms of space stations") {
  check(era_chain(), [](const auto& q) {
    return z(q[0]) * by(0, 0, 1.228) * y(q[1]) * by(0, 0, 0.34) * x(q[2]) * by(0, 0, 4.072) * x(q[3]) *
           by(0, 0, 4.072) * x(q[4]) * by(0, 0, 0.34) * y(q[5]) * by(0, 0, 1.228) * z(q[6]);
  });
  check(ssrms_chain(), [](const auto& q) {
    return z(q[0]) * by(0, -0.635, 0) * y(-q[1]) * by(0.38, 0, 0.504) * z(q[2]) * by(6.85, 0, 0.504) * z(q[3]) *
           by(6.85, 0, 0.504) * z(q[4]) * by(0.38, 0, 0) * y(-q[5]) * by(0, -0.635, 0) * x(half) * z(q[6]);
  });
  CHECK(total_mass(record_of(era_chain())) == within(630, 1e-12));  // ESA
  CHECK(total_mass(record_of(ssrms_chain())) == within(4 * 105.98 + 314.88 + 279.2 + 243.66, 1e-12));
  check_between(era_limits(), 3, -0.75 * half, 0.75 * half);
  check_between(ssrms_limits(), 6, -1.5 * half, 1.5 * half);
}

TEST_CASE("bodies that move freely, with tools") {
  const auto c = models::registered(record_of(uav_chain(vec3{0.1, 0.2, 0.3}, quarter_turn_x)));
  auto s = c.make_state();
  const std::array<double, 7> q{1, 2, 3, 0.5, 0.5, 0.5, 0.5};  // x to y, y to z, z to x
  const auto p = forward_kinematics(c, s, q, "tool").position;
  CHECK(p.x == within(1.3, 4e-16));
  CHECK(p.y == within(2.1, 4e-16));
  CHECK(p.z == within(3.2, 4e-16));
  const std::array<double, 6> none{};
  CHECK(forward_dynamics(c, s, std::array<double, 7>{0, 0, 0, 1, 0, 0, 0}, none, none)[2] == within(-9.81, 2e-15));
  CHECK(record_of(free_floater_2D_chain(along_x(0.3), 2.0, 0.1)).elements.size() == 3);
  CHECK(free_floater().tools().size() == 1);
}

}  // namespace models_test
