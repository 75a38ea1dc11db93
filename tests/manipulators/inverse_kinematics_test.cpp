#include <kte/manipulators/inverse_kinematics.hpp>
#include <kte/math/dual.hpp>

#include "manipulators/six_axes.hpp"

namespace inverse_kinematics_test {

using namespace kte;
using namespace arms;
using test::says;

// Six axes: answers at random, next to singular postures, out of reach, within limits.

TEST_CASE("random poses: all answers to rounding, and the posture among them") {
  for (const auto& a : six_axes()) {
    INFO(a.name);
    CHECK(a.arm.family() == a.family);
    random_numbers random(1);
    int exact = 0;
    const int count = 500;  // of ready models more: random_poses_test.cpp
    outcome worst;
    worst.found = 0;
    for (int k = 0; k < count; ++k) {
      const auto r = check_answers(a.arm, random_posture(random, 6));
      worst.position = test::worse(worst.position, r.position),
      worst.rotation = test::worse(worst.rotation, r.rotation);
      worst.found = test::worse(worst.found, r.found), exact += r.exact;
    }
    CHECK(worst.position <= 1e-14);
    CHECK(worst.rotation <= 1e-14);
    CHECK(worst.found <= 1e-9);
    CHECK(exact >= a.least * count);
  }
}

TEST_CASE("a stretched wrist: q5 = 0, next to it, and at half a turn") {
  for (const auto& a : right_wrists())
    for (const double step : steps())
      for (const double at : {0.0, M_PI}) {
        INFO(a.name << ", q5 = " << at << " - " << step);
        random_numbers random(2);
        for (int k = 0; k < 10; ++k) {
          numbers q = random_posture(random, 6);
          q[1] = 0.4, q[2] = -0.7 + random(0.1), q[4] = at - step;  // links far from folded: what is free is known
          const auto r = check_hard(a, q);
          if (step == 0) CHECK((r.free & 0b101000) != 0);  // q4 and q6
          if (step >= 1e-6) CHECK(r.found <= 1e-9 / step);
        }
      }
}

TEST_CASE("a stretched wrist has both flips, half a turn apart") {
  const auto& a = six_axes()[0];
  numbers q(6);
  q << 0.3, 0.4, -0.7, 0.9, 0, 0.5;
  const auto all = inverse_kinematics(a.arm, a.arm.getDependentPoses(q)[0]);
  int pairs = 0;
  for (const auto& x : all)
    for (const auto& y : all)
      if (x.branch + 4 == y.branch && (x.free & 8u) != 0) {
        ++pairs;
        CHECK(turn_between(x.q[3], y.q[3]) == within(M_PI, 1e-15));
        CHECK(turn_between(x.q[5], y.q[5]) == within(M_PI, 1e-14));
        CHECK(x.q[3] == within(0, 0));
      }
  CHECK(pairs >= 1);
}

TEST_CASE("an elbow that is stretched or folded") {
  for (const auto& a : right_wrists())
    for (const double step : steps())
      for (const bool folded : {false, true}) {
        INFO(a.name << ", " << step << (folded ? " from folded" : " from stretched"));
        random_numbers random(3);
        // Where the second link goes on in the direction of the first.
        const auto& s = a.arm.structure();
        const vec3<> l1 = s.p(2) - s.p(1), l2 = s.p(3) - s.p(2);
        const double straight = s.sign[2] * subproblem1(s.h(1), l2, l1).value() + (folded ? M_PI : 0);
        for (int k = 0; k < 10; ++k) {
          numbers q = random_posture(random, 6);
          q[2] = straight + step;
          check_hard(a, q);
        }
      }
}

TEST_CASE("a wrist on the first axis") {
  for (const double step : steps()) {
    INFO(step);
    random_numbers random(4);
    for (int k = 0; k < 10; ++k) {
      numbers q = random_posture(random, 6);
      // 3R3R: both links of 1 m tilted against each other, so that the wrist is above the shoulder.
      q[1] = step + random(1), q[2] = -2 * q[1] + step;
      check_hard(six_axes()[0], q);
      q[1] = step, q[2] = -step / 3, q[4] = step;  // and stretched, with a stretched wrist
      const auto r = check_hard(six_axes()[0], q);
      if (step == 0) CHECK((r.free & 1u) != 0);
    }
  }
}

TEST_CASE("links of equal length folded to a point") {
  const auto& a = six_axes()[0];
  for (const double step : steps()) {
    INFO(step);
    random_numbers random(5);
    for (int k = 0; k < 10; ++k) {
      numbers q = random_posture(random, 6);
      q[2] = M_PI - step;
      const auto r = check_hard(a, q);
      if (step == 0) CHECK((r.free & 2u) != 0);
    }
  }
}

TEST_CASE("UR5 with q5 = 0: q6 is free, but only where the links reach") {
  const auto& a = six_axes()[2];
  random_numbers random(6);
  for (int k = 0; k < 1000; ++k) {
    numbers q = random_posture(random, 6);
    q[4] = 0;
    check_hard(a, q);
    q[2] = 1e-8, q[4] = 1e-8;
    check_hard(a, q);
  }
}

TEST_CASE("out of reach: the nearest point, with the right rotation") {
  const auto& a = six_axes()[0];
  random_numbers random(7);
  for (const double beyond : {1e-15, 1e-12, 1e-9, 1e-6, 1e-3, 1.0, 10.0}) {
    numbers q = random_posture(random, 6);
    q[2] = 0;
    auto x = a.arm.getDependentPoses(q)[0];
    const vec3<> wrist = x.position - 0.2 * (x.rotation * vec3<>{0, 0, 1});
    const vec3<> from = wrist - vec3<>{0, 0, 1};
    x.position = x.position + beyond / 2 * from;  // |from| is 2
    for (const auto& y : inverse_kinematics(a.arm, x)) {
      CHECK(y.position == within(beyond, 1e-6 * beyond + 4e-15));
      CHECK(y.rotation <= 1e-14);
      CHECK(y.exact == (beyond <= 3e-9));
    }
  }
}

TEST_CASE("poses that are none") {
  const auto& arm = six_axes()[0].arm;
  const auto x = arm.getDependentPoses(std::array{0.1, 0.2, 0.3, 0.4, 0.5, 0.6})[0];
  auto bad = x;
  bad.position.y = NAN;
  CHECK_THROWS_MATCHES(inverse_kinematics(arm, bad), bad_argument, says("the position, or its square, is not finite"));
  bad.position.y = 1e200;
  CHECK_THROWS_MATCHES(inverse_kinematics(arm, bad), bad_argument, says("the position, or its square, is not finite"));
  bad.position.y = INFINITY;
  CHECK_THROWS_AS(inverse_kinematics(arm, bad), bad_argument);
  bad = x, bad.rotation.x.x = NAN;
  CHECK_THROWS_MATCHES(inverse_kinematics(arm, bad), bad_argument, says("orthonormal"));
  bad = x, bad.rotation = as<double>(-1.0 * x.rotation);
  CHECK_THROWS_AS(inverse_kinematics(arm, bad), bad_argument);
  bad = x, bad.rotation = as<double>(1.00001 * x.rotation);
  CHECK_THROWS_AS(inverse_kinematics(arm, bad), bad_argument);
  bad = x, bad.rotation = as<double>(1.0000001 * x.rotation);
  for (const auto& a : inverse_kinematics(arm, bad)) CHECK(a.exact);
}

TEST_CASE("limits: on one is within, whole turns are added") {
  const auto c = plain_3R3R();
  auto limits = unlimited(c);
  numbers q(6);
  q << 0.3, 0.4, -0.7, 0.9, 0.7, 0.5;
  for (int i = 0; i < 6; ++i) limits.lower[std::size_t(i)] = q[i], limits.upper[std::size_t(i)] = q[i];
  const auto count = [&](const joint_limits<>& l) {
    const manipulator arm(c, "tool", l);
    int within_limits = 0;
    for (const auto& a : inverse_kinematics(arm, arm.getDependentPoses(q)[0]))
      if (a.within_limits) {
        ++within_limits;
        for (int i = 0; i < 6; ++i) CHECK((l.lower[std::size_t(i)] <= a.q[i] && a.q[i] <= l.upper[std::size_t(i)]));
      }
    return within_limits;
  };
  CHECK(count(limits) == 1);
  limits.lower[0] += 4 * M_PI, limits.upper[0] += 4 * M_PI;
  limits.lower[3] += 2 * M_PI - 0.1, limits.upper[3] += 2 * M_PI + 0.1;
  limits.upper[0] += 1e-12;
  CHECK(count(limits) == 1);
  limits.lower[5] += 0.01, limits.upper[5] += 0.01;
  CHECK(count(limits) == 0);
}

}  // namespace inverse_kinematics_test
