#include <kte/manipulators/free_floater.hpp>
#include <kte/manipulators/iiwa14.hpp>
#include <kte/manipulators/numerical_inverse_kinematics.hpp>
#include <kte/manipulators/runtime_manipulator.hpp>
#include <kte/manipulators/three_r.hpp>

#include <Eigen/LU>

#include "arms.hpp"

// Numerical inverse kinematics: goals attained, limits kept, what cannot be attained.

namespace numerical_inverse_kinematics_test {

using namespace kte;
using arm_names::tool;
using test::says;

constexpr auto kuka = iiwa14();
using seven = joint_vector<double, 7>;

seven random_posture(random_numbers& random) {
  seven q;
  for (int i = 0; i < 7; ++i) q[i] = random(kuka.limits().upper[static_cast<std::size_t>(i)]);
  return q;
}
template <class Q>
bool within_limits(const Q& q) {
  for (int i = 0; i < 7; ++i)
    if (!(std::abs(q[i]) <= kuka.limits().upper[static_cast<std::size_t>(i)])) return false;
  return true;
}
/// The distance of the tool at q from a pose: m, rad.
template <class Q, class Pose>
std::pair<double, double> gap(const Q& q, const Pose& wanted) {
  const auto e = pose_error(forward_kinematics(kuka, q, tool), wanted);
  return {e.template head<3>().norm(), e.template tail<3>().norm()};
}
/// A chain of three axes about z as three_r_2D: joints by names.
manipulator<runtime_chain> runtime_three() {
  runtime_chain c;
  c << three_r_2D_chain();
  return manipulator(c, "tool");
}

TEST_CASE("numerical inverse kinematics attains random poses within limits") {
  random_numbers random(1);
  double position = 0, rotation = 0;
  for (int i = 0; i < 300; ++i) {
    const seven from = random_posture(random), to = random_posture(random);
    const auto wanted = forward_kinematics(kuka, to, tool);
    const auto r = numerical_inverse_kinematics(kuka, reach(tool, wanted), from, {.numeric = i % 2 == 0});
    REQUIRE(r.status == numerical_ik_status::reached);
    REQUIRE(within_limits(r.q));
    const auto [m, rad] = gap(r.q, wanted);
    position = test::worse(position, m), rotation = test::worse(rotation, rad);
    CHECK(std::abs(m - r.position) < 1e-14);
  }
  CHECK(position < 1.3e-9);  // the tolerance, of a reach below 1.3 m
  CHECK(rotation < 1e-9);
}

TEST_CASE("numerical inverse kinematics is reproducible, and starts within limits wherever it is told to start") {
  random_numbers random(2);
  const auto wanted = forward_kinematics(kuka, random_posture(random), tool);
  const seven far = seven::Constant(7);
  const auto a = numerical_inverse_kinematics(kuka, reach(tool, wanted), far),
             b = numerical_inverse_kinematics(kuka, reach(tool, wanted), far);
  CHECK(a.q == b.q);
  CHECK(a.iterations == b.iterations);
  CHECK(within_limits(a.q));
  CHECK(within_limits(numerical_inverse_kinematics(kuka, reach(tool, wanted), far, {.iterations = 1}).q));
  // At the answer nothing is to be done.
  const auto again = numerical_inverse_kinematics(kuka, reach(tool, wanted), a.q);
  CHECK(again.q == a.q);
  CHECK(again.iterations == 0);
}

TEST_CASE("numerical inverse kinematics attains singular poses: stretched, folded, with aligned wrists") {
  random_numbers random(3);
  for (const seven& q : {seven(0, 0, 0, 0, 0, 0, 0), seven(0.3, 0.5, 0.2, 0, 0.4, 0.7, 0),
                         seven(0.3, 0.5, 0.2, 1, 0.4, 0, 0), seven(0.3, 0, 0.2, 1e-8, 0.4, 0, 0)}) {
    const auto wanted = forward_kinematics(kuka, q, tool);
    const auto r = numerical_inverse_kinematics(kuka, reach(tool, wanted), random_posture(random));
    CHECK(r.status == numerical_ik_status::reached);
    CHECK(within_limits(r.q));
  }
}

TEST_CASE("what is out of reach is missed by its distance, and said") {
  const auto arm = three_r();
  using three = joint_vector<double, 3>;
  for (const double beyond : {1e-6, 1e-3, 0.1, 3.0, 20.0}) {
    const auto r = numerical_inverse_kinematics(arm, reach_position(tool, vec3{0.0, 2 + beyond, 0.0}),
                                                three(0.1, 0.7, 0), {.iterations = 200});
    CHECK(r.status == numerical_ik_status::local_minimum);
    CHECK(r.position == within(beyond, 1e-6 * beyond));
  }
  CHECK(numerical_inverse_kinematics(arm, reach_position(tool, vec3{0.0, 2.0, 0.0}), three(0.1, 0.7, 0)).status ==
        numerical_ik_status::reached);
  const auto wanted = pose{unit_quaternion<double>{}, vec3<>{0.0, 0.0, 3.0}};
  try {
    (void)numerical_inverse_kinematics(kuka, reach(tool, wanted), seven(seven::Zero()),
                                       {.iterations = 100, .must_reach = true});
    FAIL("reached");
  } catch (const unreachable& e) {
    CHECK(e.position > 1);
    CHECK(e.q.size() == 7);
    CHECK_THAT(e.what(), test::contains_text("a goal is missed by"));
  }
}

TEST_CASE("soft goals have the freedom that hard ones leave") {
  random_numbers random(4);
  for (int i = 0; i < 5; ++i) {
    const seven from = random_posture(random), rest = 0.3 * random_posture(random);
    const auto wanted = forward_kinematics(kuka, seven(0.6 * random_posture(random)), tool);
    const auto alone = numerical_inverse_kinematics(kuka, reach(tool, wanted), from);
    const auto r = numerical_inverse_kinematics(kuka, goals(reach(tool, wanted), posture(rest)), from);
    REQUIRE(r.status == numerical_ik_status::reached);
    REQUIRE(within_limits(r.q));
    CHECK((r.q - rest).norm() <= (alone.q - rest).norm());
    // Along the self-motion, whose direction belongs to 7 - 6 singular values, there is nothing nearer, unless a
    // limit is in the way.
    Eigen::Matrix<double, 7, 7> square = Eigen::Matrix<double, 7, 7>::Zero();
    square.topRows<6>() = kuka.getJacobianMatrix(r.q);
    seven along;  // the cofactors of a row below: normal to all six
    for (int k = 0; k < 7; ++k) {
      Eigen::Matrix<double, 6, 6> minor;
      for (int c = 0, at = 0; c < 7; ++c)
        if (c != k) minor.col(at++) = square.col(c).head<6>();
      along[k] = (k % 2 ? -1 : 1) * minor.determinant();
    }
    along.normalize();
    bool held = false;
    for (int k = 0; k < 7; ++k) held |= std::abs(r.q[k]) == kuka.limits().upper[static_cast<std::size_t>(k)];
    // What the pose may be off, 1e-13, over a singular value of 1e-2, is what the square of this may be.
    if (!held) CHECK(std::abs(along.dot(r.q - rest)) < 1e-4);
  }
}

TEST_CASE("goals of each kind") {
  random_numbers random(5);
  const seven from(0.1, 0.4, 0.2, 1, 0.3, 0.5, 0.2);
  const vec3<> point{0.5, -0.3, 0.6};
  const auto at = numerical_inverse_kinematics(kuka, reach_position(tool, point), from);
  CHECK(at.status == numerical_ik_status::reached);
  CHECK(at.rotation == 0);
  CHECK(std::abs(forward_kinematics(kuka, at.q, tool).position.y + 0.3) < 1.3e-9);

  const auto looking = numerical_inverse_kinematics(
      kuka, goals(reach_position(tool, point), look_at(tool, axis::z, vec3<>{2.0, 1.0, 0.0})), from);
  CHECK(looking.status == numerical_ik_status::reached);
  const auto p = forward_kinematics(kuka, looking.q, tool);
  const vec3<> d = vec3<>{2.0, 1.0, 0.0} - p.position, z = p.rotation * vec3<>{0.0, 0.0, 1.0}, off = cross(z, d);
  CHECK(std::sqrt(dot(off, off)) < 1e-8);
  CHECK(dot(z, d) > 0);

  const auto middle = numerical_inverse_kinematics(kuka, away_from_limits(), from);
  CHECK(middle.q.norm() < 1e-6);
  const auto near = numerical_inverse_kinematics(kuka, posture(from), seven(seven::Zero()));
  CHECK((near.q - from).norm() < 1e-6);
  CHECK(numerical_inverse_kinematics(kuka, goals(posture(from, {1, 1, 1, 1, 1, 1, 0})), seven(seven::Zero())).q[6] ==
        0);

  // Away from the stretched arm: the measure grows.
  const auto wanted = reach_position(tool, vec3<>{0.4, 0.2, 0.9});
  const auto plain = numerical_inverse_kinematics(kuka, wanted, from),
             free = numerical_inverse_kinematics(kuka, goals(wanted, manipulability()), from);
  const auto measure = [](const seven& q) {
    return std::sqrt((kuka.getJacobianMatrix(q) * kuka.getJacobianMatrix(q).transpose()).determinant());
  };
  CHECK(free.status == numerical_ik_status::reached);
  CHECK(measure(free.q) > measure(plain.q));

  // Two soft goals that contradict: between them by their weights. The first of `then` alone decides.
  const seven other = -from;
  const auto between =
      numerical_inverse_kinematics(kuka, goals(soft(3, posture(from)), posture(other)), seven(seven::Zero()));
  CHECK((between.q - from / 2).norm() < 1e-6);
  CHECK(
      (numerical_inverse_kinematics(kuka, then(posture(from), posture(other)), seven(seven::Zero())).q - from).norm() <
      1e-4);
  const auto ordered = numerical_inverse_kinematics(
      kuka, then(reach_position(tool, point), reach_position(tool, vec3<>{0.5, 0.3, 0.6})), from);
  CHECK(ordered.status == numerical_ik_status::reached);
}

TEST_CASE("runtime arms, arms in the plane, free bodies") {
  const auto arm = runtime_three();
  const std::vector q{0.3, 0.5, 0.2};
  const auto wanted = arm.getDependentPoses(q)[0];
  const auto r = numerical_inverse_kinematics(arm, reach("tool", wanted), std::vector{1.0, 1.0, 1.0});
  CHECK(r.status == numerical_ik_status::reached);
  const auto found = arm.getDependentPoses(r.q)[0];
  CHECK(found.position.x == within(wanted.position.x, 3e-9));
  CHECK(found.rotation.x.x == within(wanted.rotation.x.x, 1e-9));
  CHECK_THROWS_MATCHES(numerical_inverse_kinematics(arm, reach("tol", wanted), q), unknown_name, says("no tool 'tol'"));

  const auto body = free_floater(along_x(0.2));
  const pose there{to_quaternion(axis_angle<double>{3, {0.6, 0, 0.8}}), vec3<>{1.0, 2.0, 30.0}};
  const auto floating = numerical_inverse_kinematics(body, reach(tool, there), neutral_configuration(body));
  CHECK(floating.status == numerical_ik_status::reached);
  CHECK(floating.restarts == 0);
  const auto flat = free_floater_2D();
  const auto slid = numerical_inverse_kinematics(
      flat, reach(planar_arm_names::tool, forward_kinematics(flat, std::array{3.0, 2.0, 1.0}, planar_arm_names::tool)),
      std::array{0.0, 0.0, 0.0});
  CHECK(slid.q[0] == within(3, 1e-8));
  CHECK(slid.q[2] == within(1, 1e-8));
}

TEST_CASE("numerical inverse kinematics in float") {
  const auto arm = three_r();
  const Eigen::Vector3f q(0.4f, 0.7f, -0.3f);
  const auto wanted = forward_kinematics(arm, q, tool);
  const auto r = numerical_inverse_kinematics(arm, reach_position(tool, wanted.position),
                                              Eigen::Vector3f(0.1f, 0.2f, 0.1f), {.tolerance = 1e-6});
  CHECK(r.status == numerical_ik_status::reached);
  const auto p = forward_kinematics(arm, r.q, tool).position;
  CHECK(p.x == within(wanted.position.x, 4e-6));
  CHECK(p.y == within(wanted.position.y, 4e-6));
}

TEST_CASE("invalid input is refused") {
  const seven q = seven::Zero();
  const double nan = std::nan("");
  CHECK_THROWS_AS(reach_position(tool, vec3{nan, 0.0, 0.0}), bad_argument);
  CHECK_THROWS_MATCHES(reach_position(tool, vec3{1.0 / 0.0, 0.0, 0.0}), bad_argument,
                       test::says("a desired position must be finite, as must its square, got (inf, 0, 0)"));
  CHECK_THROWS_MATCHES(reach_position(tool, vec3{1.0, 1e200, 0.0}), bad_argument,
                       test::says("got (1, 9.9999999999999997e+199, 0)"));
  CHECK_THROWS_AS(reach(tool, pose{mat3{axis::x, axis::y, axis::minus_z}, zero3{}}), bad_argument);
  CHECK_THROWS_AS(reach(tool, pose{mat3{vec3{1.1, 0.0, 0.0}, vec3{0.0, 1.0, 0.0}, vec3{0.0, 0.0, 1.0}}, zero3{}}),
                  bad_argument);
  CHECK_THROWS_AS(reach(tool, pose{unit_quaternion{nan, 0.0, 0.0, 0.0}, zero3{}}), bad_argument);
  CHECK_THROWS_AS(reach(tool, pose{unit_quaternion<double>{}, zero3{}}, {0, 0}), bad_argument);
  CHECK_THROWS_AS(look_at(tool, vec3{1.0, 1.0, 0.0}, zero3{}), bad_argument);
  CHECK_THROWS_AS(soft(-1, away_from_limits()), bad_argument);
  CHECK_THROWS_AS(numerical_inverse_kinematics(kuka, posture(std::vector{1.0}), q), bad_argument);
  CHECK_THROWS_AS(numerical_inverse_kinematics(kuka, away_from_limits(), std::vector{1.0}), bad_argument);
  CHECK_THROWS_AS(numerical_inverse_kinematics(kuka, away_from_limits(), seven(seven::Constant(nan))), bad_argument);
  CHECK_THROWS_AS(numerical_inverse_kinematics(kuka, away_from_limits(), q, {.iterations = 0}), bad_argument);
  CHECK_THROWS_AS(numerical_inverse_kinematics(kuka, away_from_limits(), q, {.tolerance = INFINITY}), bad_argument);
  CHECK_THROWS_AS(numerical_inverse_kinematics(kuka, away_from_limits(), q, {.length = INFINITY}), bad_argument);
}

TEST_CASE("an arm as calibrated, whose axes almost meet: from the answers of the arm as drawn") {
  const manipulator nominal(arms::plain_3R3R(), "tool");
  const auto off = [](double x, double y) { return vec3<>{x, y, .5}; };
  const manipulator real(arms::chain(arms::none, {{arms::e_z, {1e-4, 0, 1}},
                                                  {arms::minus_y, {0, -7e-5, 1}},
                                                  {arms::minus_y, off(5e-5, 1e-4)},
                                                  {arms::e_z, off(1e-4, -6e-5)},
                                                  {arms::minus_y, {-8e-5, 0, .2}},
                                                  {arms::e_z, arms::none}}),
                         "tool");
  CHECK_THROWS_MATCHES(inverse_kinematics(real, real.getDependentPoses(std::vector(6, 0.1))[0]), no_closed_form,
                       says("axes 4, 5, 6 pass within 9.99"));
  random_numbers random(6);
  for (int k = 0; k < 20; ++k) {
    arms::numbers q = arms::random_posture(random, 6);
    q[2] = 1 + random(0.5), q[4] = 1 + random(0.5);  // not next to singular
    const auto wanted = real.getDependentPoses(q)[0];
    double nearest = 10;
    for (const auto& start : inverse_kinematics(nominal, wanted)) {
      if (!start.exact) continue;
      const auto r = numerical_inverse_kinematics(real, reach("tool", wanted), start.q);
      CHECK(r.status == numerical_ik_status::reached);
      CHECK(r.restarts == 0);
      CHECK(r.iterations <= 6);
      nearest = std::min(nearest, arms::distance(r.q, q));
      if (arms::distance(start.q, q) < 0.01) CHECK(arms::distance(r.q, q) < 1e-8);
    }
    CHECK(nearest < 1e-8);
  }
}

}  // namespace numerical_inverse_kinematics_test
