#include <kte/manipulators/free_floater.hpp>
#include <kte/manipulators/joint_motion.hpp>
#include <kte/manipulators/straight_line.hpp>
#include <kte/manipulators/three_r.hpp>

#include "catch.hpp"

// Motions from rest to rest, against their limits, their integrals and their ends.

namespace joint_motion_test {

using namespace kte;
using test::says;

constexpr manipulator arm(three_r_chain(), arm_names::tool, [] {
  auto limits = unlimited(three_r_chain());
  limits.lower = {-2, -2, -2}, limits.upper = {2, 2, 2};
  limits.rate = {1, 2, 0.5}, limits.acceleration = {2, 1, 3}, limits.jerk = {20, 30, 40};
  return limits;
}());
using three = joint_vector<double, 3>;

/// The largest |v|, |a| over the limits, and the largest gap between rates and differences.
template <class Motion>
auto largest(const Motion& m, double jumps) {
  struct {
    double rate = 0, acceleration = 0, gap = 0;
  } most;
  const double h = 1e-5;
  for (int i = 0; i <= 1000; ++i) {
    const double t = m.duration() * i / 1000;
    const auto x = m(t);
    for (int k = 0; k < 3; ++k) {
      const auto u = static_cast<std::size_t>(k);
      most.rate = std::max(most.rate, std::abs(x.v[k]) / arm.limits().rate[u]);
      most.acceleration = std::max(most.acceleration, std::abs(x.a[k]) / arm.limits().acceleration[u]);
    }
    if (t < h || m.duration() - t < h) continue;
    const three v = (m(t + h).q - m(t - h).q) / (2 * h), a = (m(t + h).v - m(t - h).v) / (2 * h);
    const double gap = (v - x.v).norm() + ((a - x.a).norm() > jumps ? (a - x.a).norm() : 0);
    most.gap = std::max(most.gap, gap);
  }
  return most;
}

TEST_CASE("a trapezoidal motion is as fast as its limits let it, and ends at its end") {
  const three from(0, 0.5, -1), to(1.5, -0.5, -0.8);
  const auto m = trapezoidal_motion(arm, from, to);
  CHECK((m(0).q - from).norm() == 0);
  CHECK((m(m.duration()).q - to).norm() < 1e-15);
  CHECK(m(m.duration() + 1).v.norm() < 1e-15);
  CHECK(m(m.duration()).a.norm() == 0);  // at rest
  CHECK(m(m.duration() * (1 - 1e-9)).a[1] == within(1, 1e-15));
  CHECK(m(-1).v.norm() == 0);
  // Rate 1 of the first over 1.5, acceleration 1 of the second over 1: t_a = 2/3, T = t_a + 3/2.
  CHECK(m.duration() == within(2.0 / 3 + 1.5, 1e-15));
  const auto most = largest(m, 4);  // its accelerations jump
  CHECK(most.rate == within(1, 1e-15));
  CHECK(most.acceleration == within(1, 1e-15));
  CHECK(most.gap < 1e-4);
  const auto near = trapezoidal_motion(arm, from, three(0, 0.6, -1));  // a triangle
  CHECK(near.duration() == within(2 * std::sqrt(0.1), 1e-15));
  CHECK(near(near.duration() / 2).v[1] == within(std::sqrt(0.1), 1e-15));
}

TEST_CASE("a quintic motion keeps limits of jerk too") {
  const three from(0, 0.5, -1), to(1.5, -0.5, -0.8);
  const auto m = quintic_motion(arm, from, to);
  CHECK(m.duration() == within(1.875 * 1.5, 1e-15));  // the rate of the first
  CHECK((m(m.duration()).q - to).norm() < 1e-15);
  const auto most = largest(m, 0);
  CHECK(most.rate == within(1, 1e-15));
  CHECK(most.acceleration < 1);
  CHECK(most.gap < 1e-8);
  CHECK(quintic_motion(arm, from, to, 7.0).duration() == 7);
  const auto jerky = quintic_motion(arm, from, three(0, 0.5, -0.999)).duration();
  CHECK(jerky == within_relative(std::cbrt(60 * 0.001 / 40), 1e-13));
  // The largest acceleration of (2).
  const quintic_profile<double> unit({}, 1.0);
  CHECK(unit((3 - std::sqrt(3.0)) / 6).s_ddot == within(10 / std::sqrt(3.0), 1e-14));
}

TEST_CASE("poses move along constant rates, tools along straight lines") {
  const auto body = free_floater();
  const auto start = neutral_configuration(body);
  joint_vector<double, 6> d;
  d << 1, 2, 3, 0.3, -0.2, 0.5;
  const auto end = integrate(body, start, d, 1.0);
  const auto m = quintic_motion(body, start, end, 2.0);
  CHECK((difference(body, m(2.0).q, end)).norm() < 1e-14);
  const auto middle = m(1.0);
  CHECK((difference(body, start, middle.q) - d / 2).norm() < 1e-14);
  CHECK((middle.v - 1.875 / 2 * d).norm() < 1e-14);

  const pose from{rotation_about(axis::z, 0.2), vec3{1.0, 0.0, 0.0}},
      to{rotation_about(axis::z, 1.2), vec3{1.0, 2.0, 0.5}};
  const straight_line line(from, to);
  const auto [r, p] = line(0.25);
  CHECK(p.y == within(0.5, 1e-16));
  CHECK(p.z == within(0.125, 1e-16));
  CHECK(std::atan2(r.y.x, r.x.x) == within(0.45, 1e-15));
  CHECK(line.way()[5] == within(1, 1e-15));
  CHECK(pose_error(line(1.0), to).norm() < 1e-15);
  const pose rolled{rotation_about(axis::x, 1.0), vec3{0.0, 0.0, 0.0}};
  CHECK(pose_error(straight_line(from, rolled)(1.0), rolled).norm() < 1e-15);
}

TEST_CASE("motions that is invalid are refused") {
  const three from(0, 0.5, -1);
  CHECK_THROWS_MATCHES(trapezoidal_motion(arm, from, three(0, 2.5, 0)), bad_argument,
                       says("to is beyond the limits of coordinate 'q2'"));
  CHECK_THROWS_MATCHES(trapezoidal_motion(three_r(), from, from), bad_argument,
                       says("trapezoidal_motion: from and to are the same, and nothing moves"));
  CHECK_NOTHROW(trapezoidal_motion(arm, from, three(-2, 2, -1)));  // on limits
  CHECK_THROWS_MATCHES(trapezoidal_motion(three_r(), from, three(0, 1, 0)), bad_argument,
                       says("kte: trapezoidal_motion: coordinate 'q2' has no limit of acceleration, nor has another "
                            "that moves: give the manipulator one, as by limits.acceleration[1] = 2, which files of "
                            "robots do not have"));
  CHECK_THROWS_MATCHES(quintic_motion(three_r(), from, three(0, 1, 0)), bad_argument,
                       says("coordinate 'q2' has no limit of rate, acceleration or jerk"));
  CHECK_THROWS_MATCHES(quintic_motion(arm, from, three(0, NAN, 0)), bad_argument, says("to[1] of 'q2' is nan"));
  for (const double bad : {double(NAN), -1.0, double(INFINITY)})
    CHECK_THROWS_AS(quintic_motion(arm, from, three(0, 1, 0), bad), bad_argument);
  CHECK_THROWS_MATCHES(quintic_motion(arm, from, three(0, 1, 0))(NAN), bad_argument, says("time along a path is NaN"));
  CHECK_THROWS_AS(trapezoidal_motion(arm, from, three(0, 1, 0))(NAN), bad_argument);
  for (const double bad : {double(NAN), -1.0, 0.0}) {
    CHECK_THROWS_MATCHES(trapezoidal_profile<double>({bad, 1, 1}), bad_argument, says("the limit of rate"));
    CHECK_THROWS_MATCHES(trapezoidal_profile<double>({1, bad, 1}), bad_argument, says("the limit of acceleration"));
    CHECK_THROWS_MATCHES(trapezoidal_profile<double>({1, 1, bad}), bad_argument, says("the limit of jerk"));
    CHECK_THROWS_AS(quintic_profile<double>({bad, 1, 1}), bad_argument);
    CHECK_THROWS_AS(quintic_profile<double>({1, bad, 1}), bad_argument);
    CHECK_THROWS_AS(quintic_profile<double>({1, 1, bad}), bad_argument);
  }
  CHECK_THROWS_MATCHES(trapezoidal_profile<double>({1e-320, 1}), bad_argument, says("infinitely long"));
}

TEST_CASE("lines between poses that are not finite are refused") {
  const auto at = [](double x, double y) { return pose{rotation_about(axis::z, 0.2), vec3{x, y, 0.0}}; };
  for (const double bad : {double(NAN), double(INFINITY)}) {
    CHECK_THROWS_AS(pose_error(at(bad, 1), at(0, 1)), bad_argument);
    CHECK_THROWS_AS(pose_error(at(0, 1), at(0, bad)), bad_argument);
    CHECK_THROWS_MATCHES(straight_line(at(0, 1), at(0, bad)), bad_argument, says("is not finite"));
    CHECK_THROWS_AS(straight_line(at(0, 1), at(1, 1))(bad), bad_argument);
  }
  CHECK_THROWS_AS(pose_error(at(-1e308, 1), at(1e308, 1)), bad_argument);
  CHECK_THROWS_AS(straight_line(at(0, 1), at(1e300, 1))(1e20), bad_argument);
  CHECK_THROWS_AS(straight_line<float>(at(1e300, 1), at(1e300, 2)), bad_argument);
  CHECK_NOTHROW(straight_line(at(0, 1), at(1, 1))(-3.0));
}

}  // namespace joint_motion_test
