#include <limits>

#include "data/iiwa14.hpp"
#include "dynamics/small_chains.hpp"
#include "robots/iiwa14.hpp"
#include "static_models/static_model.hpp"

namespace frame_motion_test {

// Poses, velocities and accelerations of frames: against differences, Jacobians and single poses, static and runtime.

using namespace kte;
using namespace kte::test;
using namespace kte::test::small_chains;

/// Sums of a few products along at most 8 frames, of numbers that are large beside the result where terms cancel: less
/// than 100 roundings of the largest, which `gap` is relative to, or of 1.
constexpr double rounding = 100 * std::numeric_limits<double>::epsilon();

/// Pose at 50 digits along a motion of given v and a: R^T p', vec(R' R^T) and the second derivatives; the skew part of
/// R'' R^T is the angular acceleration.
void check_by_differences(const model& x, const char* frame, unsigned seed, double tolerance = by_differences) {
  using vector = static_model<big>::vector3;
  using matrix = Eigen::Matrix<big, 3, 3>;
  const auto& c = x.exact;
  random_numbers random(seed);
  for (int round = 0; round < 5; ++round) {
    const random_motion<big> m(x.runtime, random);
    const auto at = [&](const big& t) { return c.forward_kinematics(m.position_at(c, t), frame); };
    const auto here = at(0), before = at(-step), after = at(step);
    const matrix back = here.rotation.transpose();
    const auto first = [](const auto& a, const auto& b) { return ((b - a) / (2 * step)).eval(); };
    const auto second = [](const auto& a, const auto& y, const auto& b) {
      return ((a - 2 * y + b) / (step * step)).eval();
    };
    static_model<big>::vector6 velocity, acceleration;
    velocity << vector(back * first(before.position, after.position)),
        vector(back * vector_of_skew(matrix(first(before.rotation, after.rotation) * back)));
    acceleration << vector(back * second(before.position, here.position, after.position)),
        vector(back * vector_of_skew(matrix(second(before.rotation, here.rotation, after.rotation) * back)));
    CHECK(gap(c.frame_velocity(m.q, m.v, frame), velocity) < tolerance);
    CHECK(gap(c.frame_acceleration(m.q, m.v, m.a, frame), acceleration) < tolerance);
    CHECK(gap(static_model<big>::vector(c.jacobian(m.q, frame) * m.v), velocity) < tolerance);
  }
}

void check_double(const model& x, const char* frame, unsigned seed) {
  random_numbers random(seed);
  auto s = x.runtime.make_state();
  for (int round = 0; round < 20; ++round) {
    const random_motion<double> m(x.runtime, random);
    const auto up = [](const auto& y) { return y.template cast<big>(); };
    const auto v = x.in_double.frame_velocity(m.q, m.v, frame);
    const auto a = x.in_double.frame_acceleration(m.q, m.v, m.a, frame);
    CHECK(gap(v, x.exact.frame_velocity(up(m.q), up(m.v), frame)) < rounding);
    CHECK(gap(a, x.exact.frame_acceleration(up(m.q), up(m.v), up(m.a), frame)) < rounding);
    CHECK(gap(eigen(frame_velocity(x.runtime, s, m.q, m.v, frame)), v) < rounding);
    CHECK(gap(eigen(frame_acceleration(x.runtime, s, m.q, m.v, m.a, frame)), a) < rounding);
    CHECK(gap(eigen(frame_velocity(x.runtime, s, frame)), v) < rounding);
    CHECK(gap(eigen(frame_acceleration(x.runtime, s, frame)), a) < rounding);
  }
}

/// All poses at once against one alone: equal formulas, which the compiler may contract differently.
template <class Chain, class Frame>
void check_poses(const Chain& c, const Frame& frame, unsigned seed) {
  random_numbers random(seed);
  const auto model = models::element_by_element(c);
  auto s = model.make_state();
  for (int round = 0; round < 10; ++round) {
    const auto q = random_configuration<double>(c, random);
    const auto one = in_space(forward_kinematics(c, q, frame));
    const auto same = [&](const auto& pose) {
      const auto x = in_space(pose);
      CHECK(gap(x.position, one.position) < rounding);
      CHECK(gap(x.rotation, one.rotation) < rounding);
    };
    same(forward_kinematics(c, q)[frame]);
    const auto& moved = forward_kinematics(model, s, q);
    if constexpr (Frame::what == kind::frame_2D) {
      same(pose{moved.frame_2D(frame.name).rotation, moved.frame_2D(frame.name).position});
    } else {
      same(pose{moved.frame_3D(frame.name).rotation, moved.frame_3D(frame.name).position});
    }
  }
}

TEST_CASE("velocities and accelerations of frames by differences at 50 digits", "[laws]") {
  check_by_differences(static_models::iiwa14(), "tool", 1);
  check_by_differences(static_models::floating(), "body", 2);
  check_by_differences(static_models::floating(), "tip", 3);
  check_by_differences(static_models::planar(), "disc", 4);
  check_by_differences(static_models::geared(), "palm", 5);
  check_by_differences(static_models::tree(), "shank", 6, 1e-14);  // an axis that is a unit vector to half an eps
}

TEST_CASE("velocities and accelerations of frames in double, and of runtime chains") {
  check_double(static_models::iiwa14(), "tool", 11);
  check_double(static_models::floating(), "tip", 12);
  check_double(static_models::planar(), "disc", 13);
  check_double(static_models::geared(), "palm", 14);
  check_double(static_models::tree(), "shank", 15);
}

TEST_CASE("poses of all frames that are too far away for numbers") {
  const auto c = chain(prismatic_joint_3D(q1, ground, body, axis::x), prismatic_joint_3D(q2, body, hand, axis::x));
  const std::array<double, 2> far{1e308, 1e308};
  CHECK_THROWS_AS(forward_kinematics(c, far), bad_argument);
  CHECK_THROWS_AS(forward_kinematics(c, far, hand), bad_argument);
}

TEST_CASE("poses of all frames") {
  check_poses(robots::iiwa14, robots::iiwa14_names::tool, 21);
  check_poses(robots::iiwa14, robots::iiwa14_names::link3, 22);
  check_poses(floating, aside, 23);
  check_poses(planar, disc, 24);
  check_poses(planar, cart, 25);
  check_poses(geared, tip, 26);
  for (const auto& x : reference::iiwa14) {
    const auto p = forward_kinematics(robots::iiwa14, x.q)[robots::iiwa14_names::tool].position;
    CHECK(off(std::array{p.x, p.y, p.z}, x.tool_position, 3) < 1e-15L);  // as one pose (reference_test.cpp)
  }
  const auto still = forward_kinematics(planar, neutral_configuration(planar));
  CHECK(still[table].position == vec2{0.0, 0.0});
  CHECK(still[rail].position == vec2{0.3, 0.4});
  CHECK(still.get<kind::frame_2D>().size() == 4);
  CHECK(still.get<kind::frame_3D>().empty());
}

TEST_CASE("the base does not move, whatever gravity is") {
  random_numbers random(31);
  const random_motion_of<double, std::remove_const_t<decltype(floating)>> m(floating, random);
  const auto model = models::element_by_element(floating);
  auto s = model.make_state();
  CHECK(eigen(frame_velocity(floating, m.q, m.v, ground)).isZero(0));
  CHECK(eigen(frame_acceleration(floating, m.q, m.v, m.a, ground)).isZero(0));
  CHECK(eigen(frame_velocity(model, s, m.q, m.v, "ground")).isZero(0));
  CHECK(eigen(frame_acceleration(model, s, m.q, m.v, m.a, "ground")).isZero(0));
  CHECK(eigen(frame_acceleration(floating.gravity(along_z(1.0)), m.q, m.v, m.a, tip)) ==
        eigen(frame_acceleration(floating, m.q, m.v, m.a, tip)));
}

TEST_CASE("motion of frames for bad arguments") {
  const auto& c = robots::iiwa14;
  const auto& tool = robots::iiwa14_names::tool;
  const auto model = models::element_by_element(c);
  auto s = model.make_state();
  const std::array<double, 7> good{0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7};
  const std::vector two{1.0, 2.0};
  CHECK_THROWS_AS(frame_velocity(c, good, two, tool), bad_argument);
  CHECK_THROWS_AS(frame_velocity(c, two, good, tool), bad_argument);
  CHECK_THROWS_AS(frame_acceleration(c, good, good, two, tool), bad_argument);
  CHECK_THROWS_AS(forward_kinematics(c, two), bad_argument);
  CHECK_THROWS_AS(forward_kinematics(model, s, two), bad_argument);
  for (std::size_t i = 0; i < 7; ++i)
    for (const double x : {std::numeric_limits<double>::quiet_NaN(), HUGE_VAL}) {
      auto bad = good;
      bad[i] = x;
      CHECK_THROWS_AS(frame_velocity(c, good, bad, tool), bad_argument);
      CHECK_THROWS_AS(frame_velocity(c, bad, good, tool), bad_argument);
      CHECK_THROWS_AS(frame_acceleration(c, good, good, bad, tool), bad_argument);
      CHECK_THROWS_AS(frame_acceleration(c, good, bad, good, tool), bad_argument);
      CHECK_THROWS_AS(forward_kinematics(c, bad), bad_argument);
      CHECK_THROWS_AS(frame_velocity(model, s, good, bad, "tool"), bad_argument);
      CHECK_THROWS_AS(frame_acceleration(model, s, good, good, bad, "tool"), bad_argument);
      CHECK_THROWS_AS(forward_kinematics(model, s, bad), bad_argument);
    }
  auto fast = good;
  fast[0] = 1e200;
  CHECK_THROWS_AS(frame_acceleration(c, good, fast, good, tool), bad_argument);  // its square is infinite
}

}  // namespace frame_motion_test
