#include <kte/manipulators/nearest.hpp>
#include <kte/math/dual.hpp>

#include <Eigen/LU>

#include <optional>

#include "arms.hpp"

// Closed forms where they are hard: postures at which any arm is singular, found by its Jacobian; what is nearer than
// an arm can reach; limits that go around; arms that are singular everywhere; derivatives of every family.

namespace hard_arms_test {

using namespace kte;
using namespace arms;
using test::says;

using model = manipulator<runtime_chain>;

/// The six joints that the formulas solve, of seven without the locked joint.
double determinant(const model& arm, const numbers& q) {
  const Eigen::MatrixXd j = arm.getJacobianMatrix(q);
  return Eigen::MatrixXd(arm.structure().held == 0 ? j.rightCols(6) : j.leftCols(6)).determinant();
}
/// A posture with q_joint changed by less than 1 rad so that the arm is singular.
std::optional<numbers> singular(const model& arm, numbers q, int joint) {
  const double here = determinant(arm, q);
  numbers to = q;
  to[joint] += 1;
  if (determinant(arm, to) * here > 0) return std::nullopt;
  for (int half = 0; half < 60; ++half) {
    numbers middle = q;
    middle[joint] = (q[joint] + to[joint]) / 2;
    (determinant(arm, middle) * here > 0 ? q : to) = middle;
  }
  return q;
}
outcome answers_at(const model& arm, const numbers& q) {
  const int held = arm.structure().held;
  if (held < 0) return check_answers(arm, q);
  return check_answers(arm, q, locked("q" + std::to_string(held + 1), q[held]));
}
/// Next to every posture that is singular by joint 2, 3, 4 or 5 there are exact answers; `tolerance` of these.
void check_singular(const model& arm, double tolerance) {
  const int first = arm.structure().held == 0 ? 1 : 0;
  int found = 0;
  random_numbers random(31);
  for (int joint = first + 1; joint < first + 5; ++joint)
    for (int k = 0; k < 10; ++k) {
      const auto at = singular(arm, random_posture(random, arm.dofs()), joint);
      if (!at) continue;
      ++found;
      for (const double step : steps()) {
        INFO("joint " << joint + 1 << " at " << step << " from singular");
        auto q = *at;
        q[joint] += step;
        const auto r = answers_at(arm, q);
        CHECK(r.exact > 0);
        CHECK(r.finite);
        CHECK(r.position <= tolerance);
        CHECK(r.rotation <= tolerance);
        // The determinant is as small as the step.
        if (step >= 1e-6) CHECK(r.found <= 1e-8 / step);
      }
    }
  CHECK(found > 5);
}

TEST_CASE("wherever the determinant is zero answers are exact to rounding") {
  for (const auto& c : {plain_3R3R(), irb2400(), ur5(), arms::era()}) check_singular(model(c, "tool"), 1e-14);
}

// Axis 6 is known to be along the parallel axes to 24 ulp; within four times that a turn about it may miss.
TEST_CASE("there equations of degree four have answers too, as exact") {
  for (const auto& c : {bent(), ur5_with_offset(), arms::panda(), arms::ssrms()})
    check_singular(model(c, "tool"), 100 * std::numeric_limits<double>::epsilon());
}

TEST_CASE("a stretched elbow, axes along parallel ones: answers of equations of degree four at right angles") {
  struct {
    model arm;
    int joint;
    double at;
  } const all[]{{model(arms::panda(), "tool"), 3, 0},
                {model(arms::ssrms(), "tool"), 1, 0},
                {model(arms::ssrms(), "tool"), 1, M_PI},
                {model(ur5_with_offset(), "tool"), 4, M_PI}};
  for (const auto& a : all) {
    random_numbers random(32);
    for (int k = 0; k < 10; ++k) {
      auto q = random_posture(random, a.arm.dofs());
      for (const double step : steps()) {
        INFO("joint " << a.joint + 1 << " at " << a.at << " + " << step);
        q[a.joint] = a.at + step;
        const auto r = answers_at(a.arm, q);
        CHECK(r.exact > 0);
        CHECK(r.position <= 100 * std::numeric_limits<double>::epsilon());
        CHECK(r.rotation <= 100 * std::numeric_limits<double>::epsilon());
        if (step >= 1e-9) CHECK(r.found <= 1e-12 / step);
      }
    }
  }
}

TEST_CASE("inside the hole of unequal links: its border, with the right rotation") {
  const auto unequal = chain(none, {{e_z, {0, 0, 1}},
                                    {minus_y, {0, 0, 1}},
                                    {minus_y, {0, 0, .2}},
                                    {e_z, {0, 0, .3}},
                                    {minus_y, {0, 0, .2}},
                                    {e_z, none}});
  const auto seven = chain(none, {{e_z, {0, 0, .36}},
                                  {e_y, none},
                                  {e_z, {0, 0, .42}},
                                  {minus_y, none},
                                  {e_z, {0, 0, .3}},
                                  {e_y, none},
                                  {e_z, {0, 0, .126}}});
  struct {
    model arm;
    int elbow;
    double shoulder, wrist, hole;  ///< heights of the shoulder, of the tool over the wrist, |l1 - l2|
  } const all[]{{model(unequal, "tool"), 2, 1, .2, .5}, {model(seven, "tool"), 3, .36, .126, .12}};
  random_numbers random(7);
  for (const auto& a : all)
    for (const double inside : {1e-15, 1e-12, 1e-9, 1e-6, 1e-3, 0.1}) {
      auto q = random_posture(random, a.arm.dofs());
      q[a.elbow] = M_PI;
      auto x = a.arm.getDependentPoses(q)[0];
      const vec3<> wrist = x.position - a.wrist * (x.rotation * e_z), from = wrist - a.shoulder * e_z;
      x.position = x.position - inside / a.hole * from;
      const auto answers = inverse_kinematics(a.arm, x);
      CHECK(answers.size() == 8);
      for (const auto& y : answers) {
        CHECK(y.position == within(inside, 1e-6 * inside + 4e-15));
        CHECK(y.rotation <= 1e-14);
        CHECK(y.exact == (inside <= 1e-9));
      }
    }
}

TEST_CASE("arms with parallel axes miss what is too near to them or too far by no more than they must") {
  const model arm(ur5(), "tool");
  random_numbers random(8);
  for (const double beyond : {1e-12, 1e-9, 1e-6, 1e-3, 1.0})
    for (const bool folded : {false, true}) {
      auto q = random_posture(random, 6);
      q[2] = folded ? M_PI : 0;
      auto x = arm.getDependentPoses(q)[0];
      const vec3<> way = turned(e_z, angle_of(q[0]), turned(e_y, angle_of(q[1]), e_x));  // along the links
      x.position = x.position + (folded ? -beyond : beyond) * way;
      double least = 1e300;
      for (const auto& y : inverse_kinematics(arm, x)) {
        CHECK(y.rotation <= 1e-14);
        CHECK(std::isfinite(y.position));
        least = std::min(least, y.position);
      }
      CHECK(least <= beyond * (1 + 1e-6) + 1e-15);
    }
}

TEST_CASE("limits of less than a turn across pi, and of two turns") {
  const auto c = arms::iiwa14();
  auto limits = unlimited(c);
  limits.lower = {2, -2, -4.5, -2, 2.5, -2, -5}, limits.upper = {4.5, 2, -2, 2, 5, 2, -2};
  const model arm(c, "tool", limits);
  random_numbers random(9);
  const auto inside = [&](const numbers& q) {
    for (std::size_t i = 0; i < 7; ++i)
      if (const double t = q[Eigen::Index(i)]; t < limits.lower[i] || t > limits.upper[i]) return false;
    return true;
  };
  for (int k = 0; k < 100; ++k) {
    numbers q(7), from(7);
    for (std::size_t i = 0; i < 7; ++i) {
      const double middle = (limits.lower[i] + limits.upper[i]) / 2, size = (limits.upper[i] - limits.lower[i]) / 2;
      q[Eigen::Index(i)] = middle + random(size), from[Eigen::Index(i)] = middle + random(size);
    }
    const auto x = arm.getDependentPoses(q)[0];
    const double psi = arm_angle_of(arm, q);
    bool held = false;
    for (const auto& way : arm_angle_intervals(arm, x))
      held |= std::abs(std::remainder(psi - (way.lower + way.upper) / 2, 2 * M_PI)) <= (way.upper - way.lower) / 2;
    CHECK(held);
    CHECK((inverse_kinematics(arm, x, nearest(q)).q - q).norm() < 1e-7);
    const auto y = inverse_kinematics(arm, x, nearest(from));
    CHECK(y.exact);
    CHECK(inside(y.q));
  }
  // Of joints of two turns, the turn that is nearest.
  const auto six = ur5();
  auto twice = unlimited(six);
  for (auto& l : twice.lower) l = -2 * M_PI;
  for (auto& l : twice.upper) l = 2 * M_PI;
  const model two(six, "tool", twice);
  for (int k = 0; k < 100; ++k) {
    numbers q = 2 * random_posture(random, 6), near = q;
    for (auto& t : near) t += random(0.1);
    const auto y = inverse_kinematics(two, two.getDependentPoses(q)[0], nearest(near));
    CHECK((y.q - near).norm() <= (q - near).norm() + 1e-9);
  }
}

TEST_CASE("arms that are singular in every posture say so") {
  const joint turn{e_z, {0, 0, 1}}, lift{minus_y, {0, 0, 1}}, wrist4{e_z, none}, wrist5{minus_y, {0, 0, .2}},
      wrist6{e_z, none};
  for (const auto& c : {chain(none, {turn, lift, {minus_y, none}, wrist4, wrist5, wrist6}),  // 3, 4, 5, 6 meet
                        chain(none, {turn, lift, {e_x, none}, wrist4, wrist5, wrist6}),      // axis 3 general
                        chain(none, {{e_z, none}, {e_y, none}, {e_x, {0, 0, 1}}, wrist4, wrist5, wrist6}),
                        chain(none, {turn, {minus_y, {0, .5, 0}}, lift, wrist4, wrist5, wrist6}),  // 2, 3 are one
                        chain(none, {{e_z, none}, {e_z, {.4, 0, 0}}, {e_z, {.1, 0, 0}}}),
                        chain(none, {{e_z, none}, {e_z, {.4, 0, 0}}, {e_z, none, true}})}) {
    const model arm(c, "tool");
    CHECK(arm.family() == arm_family::none);
    CHECK_THROWS_MATCHES(inverse_kinematics(arm, arm.getDependentPoses(numbers::Zero(arm.dofs()))[0]), no_closed_form,
                         says("joints that is singular in every posture"));
  }
}

TEST_CASE("axes that almost lie as formulas have them, within a tolerance") {
  const auto off = [](const vec3<>& axis, double x, double y) {
    const vec3<> v = axis + vec3<>{x, y, -x};
    return vec3<>{(1 / std::sqrt(dot(v, v))) * v};
  };
  // An industrial arm, a UR5, an iiwa14 and a Panda as calibrated.
  const auto industrial = chain(none, {{e_z, {1e-4, 0, 1}},
                                       {off(minus_y, 3e-5, 0), {0, -7e-5, 1}},
                                       {minus_y, {5e-5, 1e-4, .5}},
                                       {off(e_z, 2e-5, -1e-5), {1e-4, -6e-5, .5}},
                                       {minus_y, {-8e-5, 0, .2}},
                                       {e_z, none}});
  const auto universal = chain({0, 0, .089159}, {{e_z, {0, .13585, 0}},
                                                 {e_y, {.425, -.1197, 1e-4}},
                                                 {off(e_y, 4e-5, 1e-5), {.39225, 0, 0}},
                                                 {e_y, {0, .093, 0}},
                                                 {off(minus_z, 1e-4, 0), {5e-5, 0, -.09465}},
                                                 {e_y, {0, .0823, 0}}});
  const auto kuka = chain(none, {{e_z, {0, 1e-4, .36}},
                                 {e_y, {5e-5, 0, 0}},
                                 {e_z, {0, 0, .42}},
                                 {minus_y, none},
                                 {e_z, {0, 1e-4, .4}},
                                 {off(e_y, 0, 3e-5), none},
                                 {e_z, {0, 0, .126}}});
  const auto franka = chain({0, 0, .333}, {{e_z, {1e-4, 0, 0}},
                                           {e_y, {0, 0, .316}},
                                           {off(e_z, 1e-5, 1e-5), {.0825, 0, 0}},
                                           {minus_y, {-.0825, 0, .384}},
                                           {e_z, none},
                                           {minus_y, {.088, 0, 0}},
                                           {minus_z, {0, 0, -.107}}});
  for (const auto& c : {industrial, universal, kuka, franka}) {
    const model strict(c, "tool");
    CHECK(strict.family() == arm_family::none);
    const auto arm = strict.with_axes_within(1e-3);
    REQUIRE(arm.family() != arm_family::none);
    random_numbers random(12);
    int exact = 0, found = 0;
    for (int k = 0; k < 100; ++k) {
      const auto q = random_posture(random, arm.dofs());
      const auto r =
          arm.family() == arm_family::srs ? check_answers(arm, q, arm_angle(arm_angle_of(arm, q))) : answers_at(arm, q);
      CHECK(r.position <= 1e-14);
      CHECK(r.rotation <= 1e-14);
      CHECK(r.finite);
      exact += r.exact, found += r.found < 1e-9;
    }
    CHECK(exact >= 500);
    // Of arms with an arm angle this is as near to what was asked for as axes are to each other.
    if (arm.family() != arm_family::srs) CHECK(found >= 97);
  }
  const model arm(industrial, "tool");
  CHECK(arm.with_axes_within(1e-6).family() == arm_family::none);
  CHECK_THROWS_MATCHES(arm.with_axes_within(0), bad_parameter, says("between 0 and 0.1, got 0"));
  CHECK_THROWS_AS(arm.with_axes_within(NAN), bad_parameter);
}

TEST_CASE("derivatives of the answers of every family are those of the Jacobian") {
  using number = dual<double, 1>;
  const vec3<> u{0.2, -0.4, 0.7}, w{-0.5, 0.3, 0.1};
  for (const auto& c : {plain_3R3R(), ur5(), bent(), ur5_with_offset(), arms::iiwa14(), arms::panda(), arms::era()}) {
    const model arm(c, "tool");
    numbers q(7);
    q << 0.3, 0.4, -0.7, 0.9, 0.6, 0.5, 0.2;
    q.conservativeResize(arm.dofs());
    const auto x = arm.getDependentPoses(q)[0];
    const auto turning = as<double>(cross_matrix(w) * x.rotation);
    const pose goal{mat3<vec3<number>>{moving(x.rotation.x, turning.x), moving(x.rotation.y, turning.y),
                                       moving(x.rotation.z, turning.z)},
                    moving(x.position, u)};
    const int held = arm.structure().held;
    const auto all = held < 0 ? inverse_kinematics(arm, goal)
                              : inverse_kinematics(arm, goal, locked("q" + std::to_string(held + 1), q[held]));
    int exact = 0;
    for (const auto& a : all) {
      if (!a.exact) continue;
      ++exact;
      numbers rates(arm.dofs()), at(arm.dofs());
      for (Eigen::Index i = 0; i < at.size(); ++i) at[i] = a.q[i].value, rates[i] = a.q[i].derivative[0];
      const numbers twist = arm.getJacobianMatrix(at) * rates;
      const double wanted[]{u.x, u.y, u.z, w.x, w.y, w.z};
      for (Eigen::Index i = 0; i < 6; ++i) CHECK(twist[i] == within(wanted[i], 1e-12 * (1 + rates.norm())));
    }
    CHECK(exact >= 2);
  }
}

TEST_CASE("answers in float and in long double") {
  const auto ask = [](auto scalar, double margin, double same) {
    using S = decltype(scalar);
    random_numbers random(13);
    for (const auto& c : {plain_3R3R(), ur5(), ur5_with_offset(), arms::iiwa14()}) {
      const model arm(c, "tool");
      for (int k = 0; k < 20; ++k) {
        const auto q = random_posture(random, arm.dofs());
        const auto x = arm.getDependentPoses(q)[0];
        double nearest = 10;
        const auto look = [&](const auto& all) {
          for (const auto& a : all) {
            if (!a.exact) continue;
            CHECK(double(a.position) <= margin * arm.structure().reach);
            CHECK(double(a.rotation) <= margin);
            nearest = std::min(nearest, distance(a.q.template cast<double>(), q));
          }
        };
        const pose wanted{as<S>(x.rotation), as<S>(x.position)};
        if (arm.family() == arm_family::srs)
          look(inverse_kinematics(arm, wanted, arm_angle(arm_angle_of(arm, q))));
        else
          look(inverse_kinematics(arm, wanted));
        CHECK(nearest <= same);
      }
    }
  };
  // Poses are given to rounding of the scalar, or of double; next to singular postures angles are known less well.
  ask(float{}, 5e-6, 1e-2);
  ask(0.0L, 5e-18, 1e-9);
}

}  // namespace hard_arms_test
