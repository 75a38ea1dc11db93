#include <kte/manipulators/inverse_kinematics.hpp>
#include <kte/math/dual.hpp>

#include "arms.hpp"

using namespace kte;
using namespace arms;
using test::says;

namespace {
struct named_arm {
  const char* name;
  manipulator<kte_map_chain> arm;
  arm_family family;
  int least;  ///< answers that are exact, at random
};
const std::vector<named_arm>& six_axes() {
  static const std::vector<named_arm> all{
      {"3R3R", manipulator(plain_3R3R(), "tool"), arm_family::spherical_wrist, 8},
      {"IRB 2400", manipulator(irb2400(), "tool"), arm_family::spherical_wrist, 4},
      {"UR5", manipulator(ur5(), "tool"), arm_family::three_parallel, 4},
      {"bent", manipulator(bent(), "tool"), arm_family::spherical_wrist, 3},
      {"UR5 with offset", manipulator(ur5_with_offset(), "tool"), arm_family::three_parallel, 3}};
  return all;
}
/// Of these those without equations of degree four.
std::vector<named_arm> right_wrists() { return {six_axes().begin(), six_axes().begin() + 3}; }
/// Every answer to the pose of q is good, and there is one.
outcome check_hard(const named_arm& a, const numbers& q) {
  const auto r = check_answers(a.arm, q);
  CHECK(r.exact > 0);
  CHECK(r.finite);
  CHECK(r.position <= 1e-14);
  CHECK(r.rotation <= 1e-14);
  return r;
}
}  // namespace

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
  CHECK_THROWS_MATCHES(inverse_kinematics(arm, bad), bad_argument, says("the position is not finite"));
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

TEST_CASE("planar arms and SCARA") {
  const manipulator planar(planar_3R(), "tool"), four(scara(), "tool");
  CHECK(planar.family() == arm_family::planar_3R);
  CHECK(four.family() == arm_family::scara);
  random_numbers random(8);
  for (int k = 0; k < 2000; ++k)
    for (const auto* arm : {&planar, &four}) {
      const auto r = check_answers(*arm, random_posture(random, arm->dofs()));
      CHECK(r.exact == 2);
      CHECK(r.position <= 1e-14);
      CHECK(r.rotation <= 1e-14);
      CHECK(r.found <= 1e-9);
    }
}

TEST_CASE("arms without a closed form say what their axes miss") {
  const auto no = [](const kte_map_chain& c, const char* text) {
    const manipulator arm(c, "tool");
    CHECK(arm.family() == arm_family::none);
    CHECK_THROWS_MATCHES(inverse_kinematics(arm, arm.getDependentPoses(numbers::Zero(arm.dofs()))[0]), no_closed_form,
                         says(text));
  };
  no(chain(none, {{e_z, {0, 0, 1}},
                  {e_y, {1, .1, .1}},
                  {e_x, {0, 0, .5}},
                  {e_z, {0, 1e-4, .5}},
                  {e_y, {0, 0, 0}},
                  {e_z, none}}),
     "axes 4, 5, 6 pass within");
  no(chain(none, {{e_z, {0, 0, 1}},
                  {e_y, {1, .1, .1}},
                  {e_y, {0, .1, .5}},
                  {{std::sin(1e-5), std::cos(1e-5), 0}, {0, 1e-4, .5}},
                  {e_z, {.1, 0, 0}},
                  {e_x, none}}),
     "axes 3, 4, 5 are 1.5707963267948");
  no(chain(none, {{e_z, {0, 0, 1}}, {e_y, none}}), "for an arm of 2 joints that turn");
  no(chain(none, {{e_z, {0, 0, 1}}, {e_y, {1, 0, 0}}, {e_y, none}}), "whose axes are not parallel");
}

TEST_CASE("seven axes without an arm angle: the first or last joint is held") {
  const std::vector<named_arm> all{{"Panda", manipulator(panda(), "tool"), arm_family::offset_7R, 6},
                                   {"ERA", manipulator(era(), "tool"), arm_family::offset_7R, 7},
                                   {"SSRMS", manipulator(ssrms(), "tool"), arm_family::offset_7R, 6}};
  for (const auto& a : all) {
    INFO(a.name);
    CHECK(a.arm.family() == a.family);
    const int held = a.arm.structure().held;
    const std::string name = "q" + std::to_string(held + 1);
    random_numbers random(9);
    const int count = 1000;
    int exact = 0;
    for (int k = 0; k < count; ++k) {
      const auto q = random_posture(random, 7);
      const auto r = check_answers(a.arm, q, locked(name, q[held]));
      CHECK(r.position <= 1e-14);
      CHECK(r.rotation <= 1e-14);
      CHECK(r.found <= 1e-7);
      exact += r.exact;
    }
    CHECK(exact >= a.least * count);
  }
  const auto& arm = all[0].arm;
  const auto x = arm.getDependentPoses(numbers::Zero(7))[0];
  CHECK_THROWS_MATCHES(inverse_kinematics(arm, x, locked("q3", 0.1)), no_closed_form, says("with 'q3' locked"));
  CHECK_THROWS_MATCHES(inverse_kinematics(arm, x, locked("q9", 0.1)), unknown_name, says("'q9'"));
  CHECK_THROWS_AS(inverse_kinematics(arm, x, locked("q7", NAN)), bad_argument);
}

TEST_CASE("the formulas of degree four agree with those of parallel axes on arms that fit both") {
  const auto& arm = six_axes()[1].arm;
  auto general = arm.structure();
  general.form = detail::closed_form::wrist_general;
  auto parallel = six_axes()[2].arm.structure();
  auto mixed = parallel;
  mixed.form = detail::closed_form::parallel_general;
  random_numbers random(10);
  const auto compare = [&](const detail::arm_structure& a, const detail::arm_structure& b) {
    detail::by_joint<double> q{};
    for (std::size_t i = 0; i < 6; ++i) q[i] = random(M_PI);
    const auto x = detail::tool_pose(a.original, q);
    const auto one = detail::solve_closed_form<double>(a, x, {}, 0.0),
               two = detail::solve_closed_form<double>(b, x, {}, 0.0);
    for (std::size_t i = 0; i < one.at.size; ++i) {
      if (detail::gap_between(detail::tool_pose(a.original, one.at.posture(i)), x).position > 1e-9) continue;
      double nearest = 10;
      for (std::size_t k = 0; k < two.at.size; ++k) {
        double far = 0;
        for (std::size_t j = 0; j < 6; ++j) far = std::max(far, turn_between(one.at.t[j][i], two.at.t[j][k]));
        nearest = std::min(nearest, far);
      }
      CHECK(nearest < 1e-6);
    }
  };
  for (int k = 0; k < 300; ++k) compare(arm.structure(), general), compare(parallel, mixed);
}

TEST_CASE("branches go on along a path, and derivatives are those of the Jacobian") {
  const auto& arm = six_axes()[1].arm;
  numbers q(6), v(6);
  q << 0.3, 0.4, -0.7, 0.9, 0.6, 0.5;
  v << 0.3, -0.2, 0.4, 0.6, 0.3, -0.7;
  std::vector<numbers> last;
  for (int k = 0; k < 200; ++k, q += 2e-3 * v) {
    const auto all = inverse_kinematics(arm, arm.getDependentPoses(q)[0]);
    for (std::size_t i = 0; i < all.size(); ++i) {
      if (k > 0) CHECK(distance(all[i].q, last[i]) < 0.05);
      CHECK(all[i].branch == i);
    }
    last.clear();
    for (const auto& a : all) last.push_back(a.q);
  }
  // Along a twist in axes of the world: q' = J^-1 twist.
  using number = dual<double, 1>;
  const auto x = arm.getDependentPoses(q)[0];
  const vec3<> u{0.2, -0.4, 0.7}, w{-0.5, 0.3, 0.1};
  const auto turning = as<double>(cross_matrix(w) * x.rotation);
  const pose goal{mat3<vec3<number>>{moving(x.rotation.x, turning.x), moving(x.rotation.y, turning.y),
                                     moving(x.rotation.z, turning.z)},
                  moving(x.position, u)};
  for (const auto& a : inverse_kinematics(arm, goal)) {
    numbers rates(6), at(6);
    for (Eigen::Index i = 0; i < 6; ++i) at[i] = a.q[i].value, rates[i] = a.q[i].derivative[0];
    const numbers twist = arm.getJacobianMatrix(at) * rates;
    const double wanted[]{u.x, u.y, u.z, w.x, w.y, w.z};
    for (Eigen::Index i = 0; i < 6; ++i) CHECK(twist[i] == within(wanted[i], 1e-12));
  }
}

TEST_CASE(
    "equations of degree four: the sign of the determinant, and what is behind them, name branches along a path") {
  for (const std::size_t which : {3u, 4u}) {
    const auto& arm = six_axes()[which].arm;
    const unsigned lasting = which == 3 ? 1 | 4 : 1 | 2;  // not which of those of one sign
    random_numbers random(11);
    int compared = 0;
    for (int path = 0; path < 20; ++path) {
      numbers q = random_posture(random, 6);
      const numbers v = random_posture(random, 6) / 3;
      auto last = inverse_kinematics(arm, arm.getDependentPoses(q)[0]);
      for (int k = 0; k < 50; ++k) {
        q += 1e-3 * v;
        const auto all = inverse_kinematics(arm, arm.getDependentPoses(q)[0]);
        for (const auto& a : all) {
          CHECK((a.branch < 8 || !a.exact));  // two of each sign
          for (const auto& b : all)
            if (&a != &b && a.exact && b.exact) CHECK((a.branch != b.branch || distance(a.q, b.q) < 1e-6));
          const ik_answer<numbers>* same = nullptr;
          for (const auto& b : last)
            if (a.exact && b.exact && distance(a.q, b.q) < 0.01) same = same == nullptr ? &b : &a;  // of two none
          if (same == nullptr || same == &a) continue;
          CHECK((a.branch & lasting) == (same->branch & lasting));
          ++compared;
        }
        last = all;
      }
    }
    CHECK(compared > 3000);
  }
}
