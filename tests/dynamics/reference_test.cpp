#include "catch.hpp"
#include "chain/models.hpp"
#include "data/iiwa14.hpp"
#include "data/ur5.hpp"
#include "robots/iiwa14.hpp"
#include "robots/ur5.hpp"

// Real arms against 31-digit values. Bounds: the errors of forward recursions over seven bodies add up to a few eps of
// the largest number; measured 5e-16, 4e-16 and 7e-16. Forward dynamics has the condition of M on top, which is 2600
// for the iiwa14, but errors in the direction of the small eigenvalues are as small.

namespace reference_test {

/// max |x - reference| / max |reference|
template <class X>
long double error(const X& x, const long double* reference, std::size_t n) {
  long double difference = 0, size = 0;
  for (std::size_t i = 0; i < n; ++i) {
    difference = kte::test::worse(difference, std::fabs(static_cast<long double>(x[i]) - reference[i]));
    size = std::max(size, std::fabs(reference[i]));
  }
  return difference / size;
}
template <class M, int n>
long double error_of_matrix(const M& m, const long double (&upper)[n]) {
  std::vector<double> u;
  for (Eigen::Index i = 0; i < m.rows(); ++i)
    for (Eigen::Index j = i; j < m.cols(); ++j) {
      u.push_back(m(i, j));
      CHECK(m(i, j) == m(j, i));
    }
  REQUIRE(u.size() == n);
  return error(u, upper, n);
}
template <class Pose, class State>
void check_pose(const Pose& x, const State& s) {
  const auto& [R, p] = x;
  const double rotation[]{R.x.x, R.x.y, R.x.z, R.y.x, R.y.y, R.y.z, R.z.x, R.z.y, R.z.z}, position[]{p.x, p.y, p.z};
  CHECK(error(rotation, s.tool_rotation, 9) < 1e-15L);
  CHECK(error(position, s.tool_position, 3) < 1e-15L);
}

template <class Chain, std::size_t N, int n, class Tool>
void check(const Chain& arm, const kte::reference::state<n> (&states)[N], const Tool& tool) {
  const auto model = models::element_by_element(arm);
  const auto loaded = models::registered(record_of(arm));
  auto r = model.make_state();
  auto l = loaded.make_state();
  auto s = kte::make_state(arm);
  for (const auto& x : states) {
    const auto set = [&](const double(&a)[n]) {
      for (int i = 0; i < n; ++i)
        s.coordinate(i).q = x.q[i], s.coordinate(i).q_dot = x.v[i], s.coordinate(i).q_ddot = a[i];
    };
    set(x.a);
    CHECK(error(kte::inverse_dynamics(arm, x.q, x.v, x.a), x.inverse_dynamics, n) < 1e-15L);
    CHECK(error(kte::inverse_dynamics(arm, s), x.inverse_dynamics, n) < 1e-15L);
    CHECK(error(kte::inverse_dynamics(model, r, x.q, x.v, x.a), x.inverse_dynamics, n) < 1e-15L);
    CHECK(error(kte::inverse_dynamics(loaded, l, x.q, x.v, x.a), x.inverse_dynamics, n) < 1e-15L);
    arm.doMotion(s), arm.clearForce(s), arm.doForce(s);
    double f[n];
    for (int i = 0; i < n; ++i) f[i] = -s.coordinate(i).f;
    CHECK(error(f, x.inverse_dynamics, n) < 1e-15L);

    CHECK(error_of_matrix(kte::mass_matrix(arm, x.q), x.mass_matrix) < 1e-15L);
    CHECK(error_of_matrix(kte::mass_matrix(arm, s), x.mass_matrix) < 1e-15L);
    CHECK(error_of_matrix(kte::mass_matrix(model, r, x.q), x.mass_matrix) < 1e-15L);
    CHECK(error_of_matrix(kte::mass_matrix(loaded, l, x.q), x.mass_matrix) < 1e-15L);

    CHECK(error(kte::forward_dynamics(arm, x.q, x.v, x.tau), x.forward_dynamics, n) < 5e-15L);
    CHECK(error(kte::forward_dynamics(model, r, x.q, x.v, x.tau), x.forward_dynamics, n) < 5e-15L);
    CHECK(error(kte::forward_dynamics(loaded, l, x.q, x.v, x.tau), x.forward_dynamics, n) < 5e-15L);
    const double zeros[n]{};
    CHECK(error(kte::inverse_dynamics(arm, x.q, x.v, zeros), x.bias, n) < 1e-15L);

    check_pose(kte::forward_kinematics(arm, x.q, tool), x);
    check_pose(kte::forward_kinematics(arm, s, tool), x);
    check_pose(kte::forward_kinematics(model, r, x.q, tool.name), x);
    check_pose(kte::forward_kinematics(loaded, l, tool.name), x);
  }
}

TEST_CASE("iiwa14 against 31 digits") { check(robots::iiwa14, kte::reference::iiwa14, robots::iiwa14_names::tool); }
TEST_CASE("ur5 against 31 digits") { check(robots::ur5, kte::reference::ur5, robots::ur5_names::tool); }

}  // namespace reference_test
