#include <kte/manipulators/nearest.hpp>

#include "arms.hpp"

namespace nearest_test {

using namespace kte;
using namespace arms;
using test::says;

constexpr double deg = M_PI / 180;
joint_limits<> iiwa_limits(const runtime_chain& c, double part = 1) {
  auto l = unlimited(c);
  l.upper = {170 * deg, 120 * deg, 170 * deg, 120 * deg, 170 * deg, 120 * deg, 175 * deg};
  for (auto& x : l.upper) x *= part;
  for (std::size_t i = 0; i < 7; ++i) l.lower[i] = -l.upper[i];
  return l;
}
numbers within_limits(random_numbers& random, const joint_limits<>& l) {
  numbers q(static_cast<Eigen::Index>(l.lower.size()));
  for (std::size_t i = 0; i < l.lower.size(); ++i)
    q[static_cast<Eigen::Index>(i)] = (l.lower[i] + l.upper[i]) / 2 + random((l.upper[i] - l.lower[i]) / 2);
  return q;
}
bool inside(const numbers& q, const joint_limits<>& l) {
  for (std::size_t i = 0; i < l.lower.size(); ++i)
    if (!(l.lower[i] <= q[static_cast<Eigen::Index>(i)] && q[static_cast<Eigen::Index>(i)] <= l.upper[i])) return false;
  return true;
}

TEST_CASE("seven axes by arm angle: eight answers, and the posture at its own angle") {
  const manipulator arm(iiwa14(), "tool");
  CHECK(arm.family() == arm_family::srs);
  random_numbers random(1);
  for (int k = 0; k < 2000; ++k) {
    const auto q = random_posture(random, 7);
    const double psi = arm_angle_of(arm, q);
    const auto r = check_answers(arm, q, arm_angle(psi));
    CHECK(r.exact == 8);
    CHECK(r.position <= 1e-14);
    CHECK(r.rotation <= 1e-14);
    CHECK(r.found <= 1e-9);
    for (const auto& a : inverse_kinematics(arm, arm.getDependentPoses(q)[0], arm_angle(psi)))
      CHECK(turn_between(arm_angle_of(arm, a.q), psi) <= 1e-9);
  }
}

TEST_CASE("arm angles from the first axis: at 0 the elbow is above the line from shoulder to wrist") {
  const auto c = iiwa14();
  const manipulator arm(c, "tool", iiwa_limits(c));
  constexpr auto from = arm_angle_from::first_axis;
  // With q3 = 0 the elbow is in the plane of axis 1.
  numbers up(7);
  up << 0.3, 0.5, 0, 1.2, 0.4, 0.6, -0.2;  // axis 4 is -y: the forearm goes down in front
  CHECK(std::abs(std::cos(arm_angle_of(arm, up, from))) == within(1, 1e-14));
  random_numbers random(12);
  for (int k = 0; k < 50; ++k) {
    const auto q = within_limits(random, arm.limits());
    const auto x = arm.getDependentPoses(q)[0];
    const double psi = arm_angle_of(arm, q, from), here = arm_angle_of(arm, q);
    double nearest = 10;
    for (const auto& a : inverse_kinematics(arm, x, arm_angle(psi, from)))
      nearest = std::min(nearest, distance(a.q, q));
    CHECK(nearest < 1e-9);
    // The elbow of psi = 0 is above the line, in the plane of axis 1 and the line.
    const vec3<> shoulder = .36 * e_z, wrist = x.position - .126 * (x.rotation * e_z), w = wrist - shoulder;
    for (const auto& a : inverse_kinematics(arm, x, arm_angle(0, from))) {
      const vec3<> elbow = turned(e_z, angle_of(a.q[0]), turned(e_y, angle_of(a.q[1]), .42 * e_z));
      CHECK(dot(elbow, cross(w, e_z)) == within(0, 1e-14));
      CHECK(dot(elbow, cross(cross(w, e_z), w)) > 0);
    }
    const auto these = arm_angle_intervals(arm, x, from), those = arm_angle_intervals(arm, x);
    REQUIRE(these.size() == those.size());
    for (std::size_t i = 0; i < these.size(); ++i) {
      CHECK(turn_between(these[i].lower - psi, those[i].lower - here) < 1e-12);
      CHECK(turn_between(these[i].upper - psi, those[i].upper - here) < 1e-12);
      CHECK(std::abs(these[i].lower) <= M_PI);
    }
  }
}

TEST_CASE("seven axes next to singular postures") {
  const manipulator arm(iiwa14(), "tool");
  for (const double step : steps())
    for (const Eigen::Index joint : {1, 3, 5})
      for (const double at : {0.0, M_PI}) {
        INFO("joint " << joint + 1 << " at " << at << " + " << step);
        random_numbers random(2);
        for (int k = 0; k < 10; ++k) {
          auto q = random_posture(random, 7);
          q[joint] = at + step;
          const auto r = check_answers(arm, q, arm_angle(random(M_PI)));
          CHECK(r.exact == 8);
          CHECK(r.finite);
          CHECK(r.position <= 1e-14);
          CHECK(r.rotation <= 1e-14);
        }
      }
}

TEST_CASE("arm angle intervals hold the angle of every posture within limits, and nothing else") {
  const auto c = iiwa14();
  for (const double part : {1.0, 0.3}) {
    const auto limits = iiwa_limits(c, part);
    const manipulator arm(c, "tool", limits);
    random_numbers random(3);
    for (int k = 0; k < 100; ++k) {
      const auto q = within_limits(random, limits);
      const auto x = arm.getDependentPoses(q)[0];
      const double psi = arm_angle_of(arm, q);
      unsigned branch = 99;
      for (const auto& a : inverse_kinematics(arm, x, arm_angle(psi)))
        if (distance(a.q, q) < 1e-7) branch = a.branch;
      REQUIRE(branch < 8);
      bool held = false;
      for (const auto& i : arm_angle_intervals(arm, x)) {
        held |= i.branch == branch &&
                std::remainder(psi - (i.lower + i.upper) / 2, 2 * M_PI) <= (i.upper - i.lower) / 2 &&
                std::remainder(psi - (i.lower + i.upper) / 2, 2 * M_PI) >= -(i.upper - i.lower) / 2;
        // Within at both ends; beyond them not.
        const double e = 1e-6;
        const auto good = [&](double angle) {
          for (const auto& a : inverse_kinematics(arm, x, arm_angle(angle)))
            if (a.branch == i.branch) return a.exact && a.within_limits && inside(a.q, limits);
          return false;
        };
        if (i.upper - i.lower < 2 * e || i.upper - i.lower > 2 * M_PI - 1e-3) continue;
        CHECK(good(i.lower + e));
        CHECK(good(i.upper - e));
        CHECK_FALSE((good(i.lower - e) && good(i.upper + e)));
      }
      CHECK(held);
    }
  }
}

TEST_CASE("an interval as narrow as its limits") {
  const auto c = iiwa14();
  numbers q(7);
  q << 0.5, 0.7, -0.4, 1.2, 0.3, -0.8, 1.1;
  auto limits = iiwa_limits(c);
  limits.lower[2] = q[2] - 5e-7, limits.upper[2] = q[2] + 5e-7;
  const manipulator arm(c, "tool", limits);
  const auto x = arm.getDependentPoses(q)[0];
  const double psi = arm_angle_of(arm, q);
  bool held = false;
  for (const auto& i : arm_angle_intervals(arm, x)) {
    CHECK(i.upper - i.lower < 1e-4);
    held |= i.lower <= psi && psi <= i.upper;
  }
  CHECK(held);
  numbers away = q;
  away[2] = 2, away[0] = -1;
  const auto near = inverse_kinematics(arm, x, nearest(away));
  CHECK(near.exact);
  CHECK(inside(near.q, limits));
}

TEST_CASE("nearest: the posture itself, within limits, also of seven axes") {
  const auto seven = iiwa14(), six = plain_3R3R();
  const manipulator arm(seven, "tool", iiwa_limits(seven));
  auto pi = unlimited(six);
  for (auto& x : pi.lower) x = -M_PI;
  for (auto& x : pi.upper) x = M_PI;
  const manipulator industrial(six, "tool", pi);
  random_numbers random(4);
  for (int k = 0; k < 300; ++k) {
    const auto q = within_limits(random, arm.limits());
    CHECK(distance(inverse_kinematics(arm, arm.getDependentPoses(q)[0], nearest(q)).q, q) < 1e-7);
    const auto p = within_limits(random, pi);
    CHECK(distance(inverse_kinematics(industrial, industrial.getDependentPoses(p)[0], nearest(p)).q, p) < 1e-9);
    // From anywhere, within limits, exact.
    const auto a = inverse_kinematics(arm, arm.getDependentPoses(q)[0], nearest(within_limits(random, arm.limits())));
    CHECK(a.exact);
    CHECK(inside(a.q, arm.limits()));
  }
}

TEST_CASE("nearest goes on through a stretched wrist") {
  const manipulator arm(plain_3R3R(), "tool");
  numbers now(6);
  now << 0.3, 0.4, -0.7, 0.9, -0.01, 0.5;
  for (int k = -99; k <= 100; ++k) {
    numbers q = now;
    q[4] = k * 1e-4;  // through 0
    const auto a = inverse_kinematics(arm, arm.getDependentPoses(q)[0], nearest(now));
    CHECK(distance(a.q, q) <= 1e-10);
    CHECK((a.free != 0) == (k == 0));
    now = a.q;
  }
}

TEST_CASE("what cannot be reached says why") {
  const auto c = plain_3R3R();
  auto limits = unlimited(c);
  limits.lower[1] = 0, limits.upper[1] = 0.1;
  const manipulator arm(c, "tool", limits);
  numbers q(6);
  q << 0.3, -1.4, 0.7, 0.9, 0.7, 0.5;
  auto x = arm.getDependentPoses(q)[0];
  const auto caught = [&] {
    try {
      (void)inverse_kinematics(arm, x, nearest(q));
    } catch (const unreachable& e) {
      return e;
    }
    return unreachable("", unreachable_reason::local_minimum, {}, 0, 0);
  };
  CHECK(caught().reason == unreachable_reason::limits);
  CHECK(caught().q.size() == 6);
  CHECK(caught().position < 1e-13);
  x.position.x += 10;
  CHECK(caught().reason == unreachable_reason::distance);
  CHECK(caught().position > 7);
  q[0] = NAN;
  CHECK_THROWS_MATCHES(inverse_kinematics(arm, x, nearest(q)), bad_argument, says("q_now[0] of"));
  CHECK_THROWS_AS(inverse_kinematics(arm, x, nearest(numbers(5))), bad_argument);
  const manipulator seven(iiwa14(), "tool");
  for (const double bad : {double(NAN), double(INFINITY)}) {
    numbers at = numbers::Constant(7, 0.5);
    at[4] = bad;
    for (const auto from : {arm_angle_from::stereographic, arm_angle_from::first_axis})
      CHECK_THROWS_MATCHES(arm_angle_of(seven, at, from), bad_argument, says("q[4] of 'q5' is"));
  }
  CHECK_THROWS_AS(arm_angle_of(seven, numbers(6)), bad_argument);
  // Lengths whose squares overflow: no closed form, and no end of a search for their root either.
  const manipulator far(chain(none, {{e_z, {1e200, 0, 0}}, {e_z, {1, 0, 0}}, {e_z, {1, 0, 0}}}), "tool");
  CHECK(far.family() == arm_family::none);
  CHECK_THROWS_MATCHES(inverse_kinematics(far, x), no_closed_form, says("squares of its lengths overflow"));
  CHECK_THROWS_MATCHES(inverse_kinematics(arm, x, arm_angle(0)), bad_argument, says("no arm angle"));
}

TEST_CASE("what has no answer at all has no best one") {
  const manipulator arm(bent(), "tool");
  const numbers q = numbers::Constant(6, 0.3);
  auto x = arm.getDependentPoses(q)[0];
  x.position.x += 100;
  CHECK(inverse_kinematics(arm, x).empty());
  try {
    (void)inverse_kinematics(arm, x, nearest(q));
    FAIL("reached");
  } catch (const unreachable& e) {
    CHECK(e.reason == unreachable_reason::distance);
    CHECK(e.q.empty());
    CHECK(std::isinf(e.position));
    CHECK(std::string_view(e.what()) == "kte: this pose cannot be reached");
  }
}

TEST_CASE("joints of two turns have all their answers") {
  const auto c = ur5();
  auto limits = unlimited(c);
  for (auto& l : limits.lower) l = -2 * M_PI;
  for (auto& l : limits.upper) l = 2 * M_PI;
  limits.lower[2] = -M_PI, limits.upper[2] = M_PI;
  const manipulator arm(c, "tool", limits);
  numbers q(6);
  q << 0.3, -1.4, 0.7, 0.9, 0.7, 0.5;
  const auto x = arm.getDependentPoses(q)[0];
  const auto few = inverse_kinematics(arm, x);
  const auto all = unwrapped(arm, few);
  int good = 0;
  for (const auto& a : few) good += a.within_limits;
  CHECK(all.size() == static_cast<std::size_t>(good) * 32);  // five joints of two turns
  for (const auto& a : all) {
    CHECK(inside(a.q, limits));
    CHECK(between(arm.getDependentPoses(a.q)[0], x).position < 1e-14);
  }
}

TEST_CASE("an arm on a track, or with a slide at its tool") {
  const auto arm_of = [](const vec3<>& along, bool first) {
    const std::initializer_list<joint> on{
        {along, {.1, 0, 0}, true}, {e_z, {0, 0, 1}},      {minus_y, {0, 0, 1}}, {minus_y, {0, 0, .5}},
        {e_z, {0, 0, .5}},         {minus_y, {0, 0, .2}}, {e_z, none}};
    const std::initializer_list<joint> behind{{e_z, {0, 0, 1}},         {minus_y, {0, 0, 1}},  {minus_y, {0, 0, .5}},
                                              {e_z, {0, 0, .5}},        {minus_y, {0, 0, .2}}, {e_z, none},
                                              {along, {.1, 0, 0}, true}};
    const auto c = chain(none, first ? on : behind);
    auto limits = unlimited(c);
    const std::size_t slide = first ? 0 : 6;
    limits.lower[slide] = 1, limits.upper[slide] = 19;
    return manipulator(c, "tool", limits);
  };
  random_numbers random(21);
  for (const bool first : {true, false}) {
    const auto arm = arm_of(vec3<>{.6, 0, .8}, first);
    CHECK(arm.family() == arm_family::on_track);
    const Eigen::Index slide = first ? 0 : 6;
    const std::string name = first ? "q1" : "q7";
    for (int k = 0; k < 80; ++k) {
      numbers q = random_posture(random, 7);
      q[slide] = 10 + random(9);
      const auto r = check_answers(arm, q, locked(name, q[slide]));
      CHECK(r.exact == 8);
      CHECK(r.position <= 1e-14);
      CHECK(r.rotation <= 1e-14);
      CHECK(r.found <= 1e-9);
      const auto x = arm.getDependentPoses(q)[0];
      CHECK(distance(inverse_kinematics(arm, x, nearest(q)).q, q) < 1e-9);
      numbers far = q;
      far[slide] = k % 2 == 0 ? 19 : 0.5;  // 0.5 is beyond the limits
      const auto near_far = inverse_kinematics(arm, x, nearest(far));
      CHECK((near_far.exact && near_far.within_limits));
      CHECK(std::abs(near_far.q[slide] - far[slide]) <= std::abs(q[slide] - far[slide]) + arm.structure().reach / 32);
    }
  }
  CHECK_THROWS_MATCHES(
      inverse_kinematics(arm_of(e_x, true), arm_of(e_x, true).getDependentPoses(numbers::Zero(7))[0], locked("q7", 0)),
      no_closed_form, says("with 'q7' locked"));
}

}  // namespace nearest_test
