#include <kte/elements/free_joint.hpp>
#include <kte/elements/revolute_joint.hpp>
#include <kte/elements/rigid_link.hpp>
#include <kte/manipulators/accelerations_towards.hpp>
#include <kte/manipulators/runtime_manipulator.hpp>

#include "catch.hpp"
#include "random.hpp"

// Rates that keep limits, of a small static arm and of runtime chains.

namespace rates_towards_test {

using namespace kte;
using test::says;

constexpr struct q1_ final : coord_key<"q1"> {
} q1;
constexpr struct q2_ final : coord_key<"q2"> {
} q2;
constexpr struct q3_ final : coord_key<"q3"> {
} q3;
constexpr struct ground_ final : frame_3D_key<"ground"> {
} ground;
constexpr struct upper_ final : frame_3D_key<"upper"> {
} upper;
constexpr struct lower_ final : frame_3D_key<"lower"> {
} lower;
constexpr struct hand_ final : frame_3D_key<"hand"> {
} hand;
constexpr struct tip_ final : frame_3D_key<"tip"> {
} tip;
constexpr auto three =
    chain(revolute_joint_3D(q1, ground, upper), revolute_joint_3D(q2, upper, lower, axis::y).at(along_x(0.5)),
          revolute_joint_3D(q3, lower, hand, axis::y).at(along_x(0.4)), rigid_link_3D(hand, tip, along_x(0.3)));
constexpr manipulator arm(three, tip, [] {
  auto limits = unlimited(three);
  limits.lower = {-1, -2, -0.5}, limits.upper = {1, 2, 2};
  limits.rate = {2, 3, 4}, limits.acceleration = {5, 10, 20};
  return limits;
}());
using three_rates = joint_vector<double, 3>;
using twist = Eigen::Matrix<double, 6, 1>;

template <class Random>
twist random_twist(Random& random, double size) {
  twist t;
  for (double& x : t) x = random(size);
  return t;
}

TEST_CASE("without limits in the way, rates give the desired twist as well as least squares") {
  const three_rates q(0.3, 0.4, 0.7), none = three_rates::Zero(), v(0.1, -0.2, 0.15);
  const manipulator free_arm(three, tip);
  const twist wanted = arm.getJacobianMatrix(q) * v;
  const auto r = rates_towards(free_arm, q, none, wanted, 0.01, {.damping = 1e-12});
  CHECK(r.status == rate_status::free);
  CHECK((r.v - v).norm() < 1e-10);
  CHECK(r.linear < 1e-10);
  CHECK(r.angular < 1e-10);
  // What no motion gives is missed by as much as the twist has of it.
  twist impossible = wanted;
  impossible[5] += 1;  // about z only joint 1 turns, which moves the tool along y
  const auto missed = rates_towards(free_arm, q, none, impossible, 0.01, {.length = 1e-3, .damping = 1e-12});
  CHECK((missed.v - v).norm() < 1e-4);
  CHECK(missed.angular == within(1, 1e-4));
}

TEST_CASE("limits are kept whatever twist is requested, and the arm moves as well as they let it") {
  random_numbers random(1);
  three_rates q(0, 0, 0.5), v = three_rates::Zero();
  const double dt = 0.01;
  twist wanted = twist::Zero();
  int at_bounds = 0;
  const auto& limits = arm.limits();
  for (int i = 0; i < 3000; ++i) {
    if (i % 40 == 0) wanted = random_twist(random, 2);
    const auto r = rates_towards(arm, q, v, wanted, dt);
    if (r.status == rate_status::recovering) FAIL("recovering at step " << i);
    at_bounds += r.status == rate_status::limited;
    for (int k = 0; k < 3; ++k) {
      const auto u = static_cast<std::size_t>(k);
      REQUIRE(std::abs(r.v[k] - v[k]) <= limits.acceleration[u] * dt + 1e-12);
      REQUIRE(std::abs(r.v[k]) <= limits.rate[u]);
    }
    v = r.v, q = integrate(arm, q, v, dt);
    for (int k = 0; k < 3; ++k) {
      const auto u = static_cast<std::size_t>(k);
      REQUIRE(limits.lower[u] <= q[k]);
      REQUIRE(q[k] <= limits.upper[u]);
    }
  }
  CHECK(at_bounds > 1000);
}

TEST_CASE("started outside its limits an arm comes back, and says so") {
  three_rates q(1.3, 0, 2.5), v(1, 0, 0);
  const twist wanted = twist::Constant(0.3);
  int steps = 0;
  for (auto r = rates_towards(arm, q, v, wanted, 0.01); r.status == rate_status::recovering && steps < 500; ++steps) {
    v = r.v, q = integrate(arm, q, v, 0.01);
    r = rates_towards(arm, q, v, wanted, 0.01);
  }
  CHECK(steps > 20);
  CHECK(steps < 200);
  CHECK(q[0] <= 1);
  CHECK(q[2] <= 2);
}

TEST_CASE("what the tools leave follows the desired rates") {
  const manipulator free_arm(three, tip);
  const three_rates q(0.3, 0.4, 0.7), none = three_rates::Zero(), posture(0, 0.5, 0);
  // A tool that must stand still uses all three joints. Along y alone two of them do not matter.
  CHECK(rates_towards(free_arm, q, none, twist::Zero(), 0.01, {}, posture).v.norm() < 1e-4);
  const auto c = [] {
    runtime_chain all;
    all << revolute_joint_3D("a", "ground", "upper") << revolute_joint_3D("b", "upper", "hand")
        << rigid_link_3D("hand", "tip", along_x(1));
    return all;
  }();
  const manipulator twice(c, "tip");  // two joints about one axis
  const Eigen::Vector2d zeros(0, 0), turn(0.5, -0.5);
  const auto r = rates_towards(twice, zeros, zeros, twist::Zero(), 0.01, {}, turn);
  CHECK((r.v - turn).norm() < 1e-9);
  CHECK(r.linear < 1e-12);
}

TEST_CASE("runtime arms have the rates of static ones; poses have limits of rates") {
  runtime_chain c;
  c << revolute_joint_3D("q1", "ground", "upper") << revolute_joint_3D("q2", "upper", "lower", axis::y).at(along_x(0.5))
    << revolute_joint_3D("q3", "lower", "hand", axis::y).at(along_x(0.4)) << rigid_link_3D("hand", "tip", along_x(0.3));
  joint_limits<> limits = unlimited(c);
  limits.lower = {-1, -2, -0.5}, limits.upper = {1, 2, 2};
  limits.rate = {2, 3, 4}, limits.acceleration = {5, 10, 20};
  const manipulator runtime(c, "tip", limits);
  random_numbers random(3);
  for (int i = 0; i < 20; ++i) {
    const three_rates q(random(), random(), 0.5 + random()), v = three_rates::Constant(random(0.1));
    const twist wanted = random_twist(random, 1);
    CHECK((rates_towards(arm, q, v, wanted, 0.01).v - rates_towards(runtime, q, v, wanted, 0.01).v).norm() < 1e-11);
  }
  runtime_chain drone;
  drone << free_joint_3D("pose", "world", "body");
  joint_limits<> slow = unlimited(drone);
  slow.rate.assign(6, 0.5);
  const std::array q{0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0};
  const std::array<double, 6> still{};
  const auto r = rates_towards(manipulator(drone, "body", slow), q, still, twist{1, 0, 0.1, 0, 0, 0}, 0.01);
  CHECK(r.v[0] == 0.5);
  CHECK(r.v[2] == within(0.1, 1e-6));
  slow.upper[1] = 3;
  CHECK_THROWS_MATCHES(rates_towards(manipulator(drone, "body", slow), q, still, twist::Zero(), 0.01), bad_parameter,
                       says("coordinate 'pose', number 2 of v"));
}

TEST_CASE("accelerations of tools, and joints that give them within limits") {
  runtime_chain c;
  c << revolute_joint_3D("q1", "ground", "upper") << revolute_joint_3D("q2", "upper", "lower", axis::y).at(along_x(0.5))
    << revolute_joint_3D("q3", "lower", "hand", axis::y).at(along_x(0.4)) << rigid_link_3D("hand", "tip", along_x(0.3));
  const manipulator runtime(c, "tip");
  const manipulator free_arm(three, tip);
  const three_rates q(0.3, 0.4, 0.7), v(0.5, -0.8, 0.6), a(2, -1, 3);
  const double h = 1e-5;
  const auto velocity = [&](double t) -> twist {
    return arm.getDependentVelocities(three_rates(q + t * v + t * t / 2 * a), three_rates(v + t * a));
  };
  const twist wanted = arm.getDependentAccelerations(q, v, a);
  CHECK((wanted - (velocity(h) - velocity(-h)) / (2 * h)).norm() < 1e-8);
  CHECK((wanted - runtime.getDependentAccelerations(q, v, a)).norm() < 1e-13);

  const auto free_step = accelerations_towards(free_arm, q, v, wanted, 1e-3, {.damping = 1e-12});
  CHECK((free_step.a - a).norm() < 1e-8);
  CHECK((free_step.v - (v + 1e-3 * a)).norm() < 1e-11);
  CHECK(free_step.linear < 1e-8);
  CHECK(free_step.status == rate_status::free);
  CHECK((accelerations_towards(runtime, q, v, wanted, 1e-3, {.damping = 1e-12}).a - a).norm() < 1e-8);
  // A tool on the first joint's axis with no desired motion: the other two joints follow their desired rates.
  const manipulator shoulder(three, upper);
  const three_rates aim(0, 4, -5);
  CHECK((accelerations_towards(shoulder, q, v, twist::Zero(), 1e-3, {}, aim).a - aim).norm() < 1e-9);
  auto lost = aim;
  lost[0] = NAN;
  CHECK_THROWS_MATCHES(accelerations_towards(shoulder, q, v, twist::Zero(), 1e-3, {}, lost), bad_argument,
                       test::says("a desired acceleration is not finite"));

  three_rates at(0, 0, 0.5), rate = three_rates::Zero();
  random_numbers random(4);
  twist pull = twist::Zero();
  int at_bounds = 0;
  const auto& limits = arm.limits();
  for (int i = 0; i < 2000; ++i) {
    if (i % 40 == 0) pull = random_twist(random, 20);
    const auto step = accelerations_towards(arm, at, rate, pull, 0.01);
    REQUIRE(step.status != rate_status::recovering);
    at_bounds += step.status == rate_status::limited;
    rate = step.v, at = integrate(arm, at, rate, 0.01);
    for (int k = 0; k < 3; ++k) {
      const auto u = static_cast<std::size_t>(k);
      REQUIRE(std::abs(step.a[k]) <= limits.acceleration[u] * (1 + 1e-12));
      REQUIRE(std::abs(rate[k]) <= limits.rate[u]);
      REQUIRE((limits.lower[u] <= at[k] && at[k] <= limits.upper[u]));
    }
  }
  CHECK(at_bounds > 100);
}

TEST_CASE("arguments that are none are refused") {
  const three_rates q(0.3, 0.4, 0.7), v = three_rates::Zero();
  twist t = twist::Zero();
  CHECK_THROWS_MATCHES(rates_towards(arm, q, v, t, 0.0), bad_argument,
                       says("dt of a step must be finite and positive"));
  CHECK_THROWS_MATCHES(rates_towards(arm, q, v, Eigen::VectorXd::Zero(3), 0.1), bad_argument, says("twist has 3"));
  CHECK_THROWS_AS(rates_towards(arm, q, v, t, 0.1, {.damping = 0}), bad_argument);
  CHECK_THROWS_AS(rates_towards(arm, q, v, t, 0.1, {.damping = INFINITY}), bad_argument);
  CHECK_THROWS_AS(rates_towards(arm, q, v, t, 0.1, {.length = INFINITY}), bad_argument);
  t[0] = 1e308;
  CHECK_THROWS_AS(rates_towards(arm, q, v, t, 0.1), bad_argument);
  CHECK_THROWS_MATCHES(rates_towards(arm, q, three_rates(0, NAN, 0), t, 0.1), bad_argument,
                       says("a rate is not finite: v_now[1] of 'q2' is nan"));
  t[3] = std::nan("");
  CHECK_THROWS_MATCHES(rates_towards(arm, q, v, t, 0.1), bad_argument,
                       says("a twist is not finite: twist[3] of tool 'tip' is nan"));
  CHECK_THROWS_AS(rates_towards(arm, three_rates(0, std::nan(""), 0), v, twist::Zero(), 0.1), bad_argument);
  CHECK_THROWS_AS(accelerations_towards(arm, q, v, t, 0.1), bad_argument);
  CHECK_THROWS_MATCHES(accelerations_towards(arm, q, v, Eigen::VectorXd::Zero(3), 0.1), bad_argument,
                       says("desired has 3"));
}

}  // namespace rates_towards_test
