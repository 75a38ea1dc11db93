#include <kte/contract/joint_axis.hpp>
#include <kte/contract/varying_joint.hpp>
#include <kte/elements/variable_pitch_screw_joint.hpp>

#include "catch.hpp"
#include "dynamics/two_hinges.hpp"

namespace varying_joint_test {

using namespace kte;
using kte::test::within;

double off(const vec3<>& a, const vec3<>& b) { return std::hypot(a.x - b.x, a.y - b.y, a.z - b.z); }

TEST_CASE("a joint of varying axes: the number of axes and their derivatives") {
  STATIC_REQUIRE(detail::count_of_axes(1, false) == 2);
  STATIC_REQUIRE(detail::count_of_axes(1, true) == 3);
  STATIC_REQUIRE(detail::count_of_axes(2, true) == 2 + 4 + 8);
}

TEST_CASE("the pose and the axis of a screw of variable pitch, with its derivatives") {
  const double h = 0.3, k = -0.2, q = 0.7;
  const auto joint = variable_pitch_screw_joint_3D("q", "base", "end", axis::z, h, k).core;
  std::array<detail::joint_axis<double>, 3> axes;
  const auto at = detail::place_varying_joint<double>(joint, &q, axes.data(), true);
  CHECK(off(at.position, {0, 0, h * q + k * q * q / 2}) < 1e-16);
  CHECK(off(at.rotation.x, {std::cos(q), -std::sin(q), 0}) < 1e-15);
  CHECK(off(axes[0].linear, {0, 0, h + k * q}) < 1e-16);
  CHECK(off(axes[0].angular, {0, 0, 1}) < 1e-16);
  CHECK(off(axes[1].linear, {0, 0, k}) < 1e-16);
  CHECK(off(axes[1].angular, {}) + off(axes[2].linear, {}) < 1e-16);
}

TEST_CASE("the axes of a joint of two coordinates in its end") {
  // first about x, then about y: s_1 = Rot(y, q2)^T x, s_2 = y
  const double q[]{0.4, -0.9}, s = std::sin(q[1]), c = std::cos(q[1]);
  std::array<detail::joint_axis<double>, detail::count_of_axes(2, true)> axes;
  (void)detail::place_varying_joint<double>(test::two_hinges{}, q, axes.data(), true);
  CHECK(off(axes[0].angular, {c, 0, s}) < 1e-15);
  CHECK(off(axes[1].angular, {0, 1, 0}) < 1e-15);
  CHECK(off(axes[2].angular, {}) < 1e-15);          // ds_1 / dq_1
  CHECK(off(axes[3].angular, {-s, 0, c}) < 1e-15);  // ds_1 / dq_2
  CHECK(off(axes[4].angular, {}) + off(axes[5].angular, {}) < 1e-15);
  CHECK(off(axes[2 + 4 + 3].angular, {-c, 0, -s}) < 1e-15);  // d2 s_1 / dq_2^2
}

}  // namespace varying_joint_test
