#include "data/solo12.hpp"
#include "dynamics/floating_bodies.hpp"
#include "robots/solo12.hpp"

// A robot that floats.

namespace floating_robot_test {

using namespace kte;
using namespace kte::test::floating_bodies;
using models::element_by_element;

/// max |x - reference| / max |reference|
template <class X>
long double off(const X& x, const long double* reference, std::size_t n) {
  long double difference = 0, size = 0;
  for (std::size_t i = 0; i < n; ++i) {
    const long double d = std::fabs(static_cast<long double>(x[static_cast<int>(i)]) - reference[i]);
    if (!(d <= difference)) difference = d;  // NaN too
    size = std::max(size, std::fabs(reference[i]));
  }
  return difference / size;
}
template <class M>
long double error_of_matrix(const M& m, const long double* upper) {
  std::vector<double> u;
  for (Eigen::Index i = 0; i < m.rows(); ++i)
    for (Eigen::Index j = i; j < m.cols(); ++j) {
      u.push_back(m(i, j));
      if (m(i, j) != m(j, i)) return 1;
    }
  return off(u, upper, u.size());
}

TEST_CASE("solo12 against 31 digits") {
  // Bounds as for arms (reference_test.cpp): sums over four bodies in a row, a few eps of the largest number; measured
  // 2e-16. Forward dynamics may lose the condition of M, which is 2e4: 2.5 kg to move, 1e-4 kg m^2 of a lower leg to
  // turn. Articulated bodies divide by each inertia separately, and errors are relative to the largest accelerations,
  // those of the light legs: measured 2e-16 as well. The bound is that of the arms.
  constexpr long double bound = 1e-15L, bound_of_forward = 5e-15L;
  constexpr std::size_t n = 18;
  const auto& c = robots::solo12;
  STATIC_REQUIRE(decltype(robots::solo12)::dofs == 18);
  const auto& foot = robots::solo12_names::hr.foot;
  const auto model = element_by_element(c), loaded = models::registered(record_of(c));
  CHECK(record_of(model) == record_of(c));
  CHECK(record_of(loaded) == record_of(c));
  auto s = make_state(c);
  auto r = model.make_state(), l = loaded.make_state();
  const double zeros[n]{};
  const auto check_pose = [&](const auto& pose, const auto& x) {
    const auto& [R, p] = pose;
    const double rotation[]{R.x.x, R.x.y, R.x.z, R.y.x, R.y.y, R.y.z, R.z.x, R.z.y, R.z.z}, position[]{p.x, p.y, p.z};
    CHECK(off(rotation, x.foot_rotation, 9) < bound);
    CHECK(off(position, x.foot_position, 3) < bound);
  };
  for (const auto& x : reference::solo12) {
    CHECK(off(inverse_dynamics(c, x.q, x.v, x.a), x.inverse_dynamics, n) < bound);
    CHECK(off(inverse_dynamics(c, x.q, x.v, zeros), x.bias, n) < bound);
    CHECK(error_of_matrix(mass_matrix(c, x.q), x.mass_matrix) < bound);
    CHECK(off(forward_dynamics(c, x.q, x.v, x.tau), x.forward_dynamics, n) < bound_of_forward);
    check_pose(forward_kinematics(c, x.q, foot), x);

    set_all(s, x.q, x.v, x.a);
    CHECK(off(inverse_dynamics(c, s), x.inverse_dynamics, n) < bound);
    CHECK(error_of_matrix(mass_matrix(c, s), x.mass_matrix) < bound);
    check_pose(forward_kinematics(c, s, foot), x);
    c.doMotion(s), c.clearForce(s), c.doForce(s);
    CHECK(off((-forces(s)).eval(), x.inverse_dynamics, n) < bound);
    check_pose(pose{s[foot].rotation, s[foot].position}, x);

    const auto check_runtime = [&](const runtime_chain& m, runtime_state& t) {
      CHECK(off(inverse_dynamics(m, t, x.q, x.v, x.a), x.inverse_dynamics, n) < bound);
      CHECK(off(inverse_dynamics(m, t, x.q, x.v, zeros), x.bias, n) < bound);
      CHECK(error_of_matrix(mass_matrix(m, t, x.q), x.mass_matrix) < bound);
      CHECK(off(forward_dynamics(m, t, x.q, x.v, x.tau), x.forward_dynamics, n) < bound_of_forward);
      CHECK(off(accelerations(t), x.forward_dynamics, n) < bound_of_forward);
      check_pose(forward_kinematics(m, t, x.q, foot.name), x);
      set_all(t, x.q, x.v, x.a);
      m.doMotion(t), m.clearForce(t), m.doForce(t);
      CHECK(off((-forces(t)).eval(), x.inverse_dynamics, n) < bound);
    };
    check_runtime(model, r);
    check_runtime(loaded, l);

    // Energy and the velocity of the foot, from the Jacobian of the reference.
    const Eigen::Map<const joint_vector<double, 18>> v(x.v);
    CHECK(0.5 * v.dot(mass_matrix(c, x.q) * v) == within_relative(static_cast<double>(x.kinetic_energy), 1e-15));
    double velocity[6]{};
    for (std::size_t i = 0; i < 6; ++i)
      for (std::size_t j = 0; j < n; ++j) velocity[i] += static_cast<double>(x.foot_jacobian[i * n + j]) * x.v[j];
    const auto linear = eigen(as<double>(s[foot].rotation * s[foot].velocity)),
               angular = eigen(as<double>(s[foot].rotation * s[foot].ang_velocity));
    for (int i = 0; i < 3; ++i) {
      CHECK(linear[i] == within(velocity[i], 20 * eps));  // sums of 18 products of size 1
      CHECK(angular[i] == within(velocity[3 + i], 20 * eps));
    }
  }
}

TEST_CASE("the length of a quaternion does not matter to any algorithm") {
  const auto& c = robots::solo12;
  const auto model = element_by_element(c);
  auto r = model.make_state();
  const auto& x = reference::solo12[1];
  const auto check = [&](double scale) {
    double q[19];
    std::copy_n(x.q, 19, q);
    for (std::size_t i = 3; i < 7; ++i) q[i] *= scale;
    // Bounds as against the reference, twice for two numbers with errors.
    const auto close = [](const auto& a, const auto& b, double bound) {
      CHECK(gap(a, b) <= bound * b.cwiseAbs().maxCoeff());
    };
    close(inverse_dynamics(c, q, x.v, x.a), inverse_dynamics(c, x.q, x.v, x.a), 2e-15);
    close(mass_matrix(c, q), mass_matrix(c, x.q), 2e-15);
    close(forward_dynamics(c, q, x.v, x.tau), forward_dynamics(c, x.q, x.v, x.tau), 1e-14);
    close(inverse_dynamics(model, r, q, x.v, x.a), inverse_dynamics(c, x.q, x.v, x.a), 2e-15);
    close(mass_matrix(model, r, q), mass_matrix(c, x.q), 2e-15);
    close(forward_dynamics(model, r, q, x.v, x.tau), forward_dynamics(c, x.q, x.v, x.tau), 1e-14);
    const auto& foot = robots::solo12_names::hr.foot;
    close(eigen(forward_kinematics(c, q, foot).rotation), eigen(forward_kinematics(c, x.q, foot).rotation), 2e-15);
    close(eigen(forward_kinematics(model, r, q, foot.name).position), eigen(forward_kinematics(c, x.q, foot).position),
          2e-15);
  };
  check(1.5), check(-1.0), check(1e-100), check(1e100);
}

}  // namespace floating_robot_test
