#include <kte/manipulators/nearest.hpp>
#include <kte/manipulators/numerical_inverse_kinematics.hpp>
#include <kte/manipulators/poses_of_tools.hpp>
#include <kte/manipulators/uav.hpp>

#include "arms.hpp"
#include "chain/registered.hpp"

// Bodies that move freely: the pose of the tool is the coordinate, but for where the tool is on the body.

namespace free_bodies_test {

using namespace kte;
using arm_names::tool;
using test::says;
using test::within;

constexpr double eps = std::numeric_limits<double>::epsilon();

unit_quaternion<double> random_rotation(random_numbers& random) {
  return to_quaternion(vec3<>{3 * random(), 3 * random(), 3 * random()});
}
vec3<> random_position(random_numbers& random) { return {random(5), random(5), random(5)}; }

template <class Arm>
void check_in_space(const Arm& arm) {
  CHECK(arm.family() == arm_family::free_body);
  random_numbers random(4);
  for (int k = 0; k < 100; ++k) {
    const pose wanted{mat3<vec3<>>(matrix(random_rotation(random))), random_position(random)};
    const auto all = inverse_kinematics(arm, wanted);
    REQUIRE(all.size() == 1);
    CHECK(all[0].exact);
    CHECK(all[0].within_limits);
    const auto gap = arms::between(arm.getDependentPoses(all[0].q)[0], wanted);
    CHECK(gap.position <= 40 * eps);  // lengths up to 10 m
    CHECK(gap.rotation <= 8 * eps);
    CHECK(all[0].position <= 40 * eps);
  }
}

TEST_CASE("a free body with its tool anywhere on it, static and runtime") {
  const auto turned = to_quaternion(vec3<>{0.3, -0.5, 1.1});
  const auto chain = free_floater_chain(vec3{0.2, -0.1, 0.4}, turned);
  check_in_space(manipulator(chain, tool));
  check_in_space(manipulator(models::registered(record_of(chain)), "tool"));
  const auto placed =
      kte::chain(free_joint_3D(arm_names::floating, arm_names::base, arm_names::body).at(vec3{1.0, 2.0, 3.0}, turned),
                 rigid_link_3D(arm_names::body, tool, vec3{0.2, -0.1, 0.4}, turned));
  check_in_space(manipulator(placed, tool));
  check_in_space(manipulator(models::registered(record_of(placed)), "tool"));
  static_assert(uav().family() == arm_family::free_body);
}

TEST_CASE("a free body in the plane has what of a pose lies in it") {
  const auto check = [](const auto& arm) {
    random_numbers random(5);
    for (int k = 0; k < 100; ++k) {
      const arms::numbers q = Eigen::Vector3d(random(5), random(5), random(3));
      const auto wanted = arm.getDependentPoses(q)[0];
      const auto all = inverse_kinematics(arm, wanted);
      REQUIRE(all.size() == 1);
      CHECK(all[0].exact);
      CHECK((all[0].q - q).norm() <= 40 * eps);
    }
    pose above{mat3<vec3<>>{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, vec3<>{1, 2, 0.25}};
    const auto best = inverse_kinematics(arm, above);
    CHECK(!best[0].exact);
    CHECK(best[0].position == within(0.25, eps));
  };
  check(manipulator(free_floater_2D_chain(along_x(0.3)), planar_arm_names::tool));
  check(manipulator(models::registered(record_of(free_floater_2D_chain(along_x(0.3)))), "tool"));
}

TEST_CASE("limits of a free body are those of its position") {
  const auto chain = free_floater_chain();
  auto limits = unlimited(chain);
  limits.upper[2] = 3;
  const manipulator arm(chain, tool, limits);
  const auto at = [](double z) { return pose{mat3<vec3<>>{{0, -1, 0}, {1, 0, 0}, {0, 0, 1}}, vec3<>{1, 2, z}}; };
  const auto now = neutral_configuration(arm);
  CHECK(inverse_kinematics(arm, at(2.5), nearest(now)).q[2] == within(2.5, eps));
  CHECK(!inverse_kinematics(arm, at(3.5))[0].within_limits);
  CHECK_THROWS_MATCHES(inverse_kinematics(arm, at(3.5), nearest(now)), unreachable, says("beyond the limits"));

  const auto flat = free_floater_2D_chain();
  auto turns = unlimited(flat);
  turns.lower[2] = 5, turns.upper[2] = 8;
  const manipulator turning(flat, planar_arm_names::tool, turns);
  const auto one =
      inverse_kinematics(turning, forward_kinematics(turning, std::array{0.0, 0.0, 0.5}, planar_arm_names::tool));
  CHECK(one[0].within_limits);
  CHECK(one[0].q[2] == within(0.5 + 2 * M_PI, 4 * eps));
}

TEST_CASE("a free body with several tools at their poses, static and runtime") {
  static constexpr struct left_ final : frame_3D_key<"left"> {
  } left;
  const auto chain = kte::chain(free_floater_chain(vec3{0.2, -0.1, 0.4}),
                                rigid_link_3D(arm_names::body, left, vec3{-1.0, 0.3, 0.0}, quarter_turn_x));
  const auto check = [](const auto& arm) {
    random_numbers random(6);
    for (int k = 0; k < 50; ++k) {
      auto q = neutral_configuration(arm);
      const auto turn = random_rotation(random);
      q << random(5), random(5), random(5), turn.w, turn.x, turn.y, turn.z;
      auto wanted = arm.getDependentPoses(q);
      const auto all = inverse_kinematics(arm, wanted);
      REQUIRE(all.size() == 1);
      CHECK(all[0].exact);
      CHECK(all[0].position <= 100 * eps);  // lengths up to 10 m
      CHECK(all[0].rotation <= 16 * eps);
      // 0.2 m farther apart than they are: each misses 0.1 m, and no rotation.
      const vec3<> way = wanted[1].position - wanted[0].position;
      wanted[1].position = wanted[1].position + vec3<>(0.2 / std::sqrt(dot(way, way)) * way);
      const auto best = inverse_kinematics(arm, wanted)[0];
      CHECK(!best.exact);
      CHECK(best.position == within(0.1, 100 * eps));
      CHECK(best.rotation <= 16 * eps);
    }
  };
  const manipulator far_away(chain, tool, left);
  auto q = neutral_configuration(far_away);
  q.head<3>() << 7e9, -2e9, 1e9;
  CHECK(inverse_kinematics(far_away, far_away.getDependentPoses(q))[0].exact);  // 1e-6 m are a unit of the last place
  check(far_away);
  check(manipulator(models::registered(record_of(chain)), {"tool", "left"}));
  const manipulator arm(models::registered(record_of(chain)), {"tool", "base"});
  CHECK_THROWS_MATCHES(inverse_kinematics(arm, arm.getDependentPoses(std::vector{1.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0})),
                       no_closed_form, says("tool 2"));
  const pose somewhere{mat3<vec3<>>{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, vec3<>{1, 2, 3}};
  CHECK_THROWS_MATCHES(inverse_kinematics(arm, std::array{somewhere}), bad_argument, says("2 tools"));
}

TEST_CASE("a pose fitted to points is that of the body, and never a reflection") {
  random_numbers random(7);
  std::vector<vec3<>> body, measured;
  for (int k = 0; k < 6; ++k) body.push_back(random_position(random));
  const pose x{random_rotation(random), vec3<>{1e6, -2e6, 3e6}};
  const auto put = [&](const pose<unit_quaternion<double>, vec3<>>& at) {
    measured.clear();
    for (const auto& p : body) measured.push_back(at.rotation * p + at.position);
  };
  put(x);
  const auto found = fitted_pose(body, measured);
  CHECK(arms::between(pose{mat3<vec3<>>(matrix(found.rotation)), found.position},
                      pose{mat3<vec3<>>(matrix(x.rotation)), x.position})
            .rotation <= 1e6 * 4 * eps);  // of points known to 4e-10 m
  for (std::size_t i = 0; i < body.size(); ++i) {
    const vec3<> off = found.rotation * body[i] + found.position - measured[i];
    CHECK(std::sqrt(dot(off, off)) <= 4e6 * 8 * eps);
  }
  for (auto& p : measured) p = vec3<>{p.x, p.y, -p.z};
  const auto r = matrix(fitted_pose(body, measured).rotation);
  CHECK(dot(r.x, cross(r.y, r.z)) == within(1, 4 * eps));
  body.pop_back();
  CHECK_THROWS_AS(fitted_pose(body, measured), bad_argument);
  body.push_back({NAN, 0, 0});
  CHECK_THROWS_MATCHES(fitted_pose(body, measured), bad_argument, says("point 6"));
}

TEST_CASE("numerical inverse kinematics of a free body begins with the answer") {
  const auto body = free_floater(along_x(0.2));
  const pose there{to_quaternion(axis_angle<double>{3, {0.6, 0, 0.8}}), vec3<>{1.0, 2.0, 30.0}};
  const auto r = numerical_inverse_kinematics(body, reach(tool, there), neutral_configuration(body));
  CHECK(r.status == numerical_ik_status::reached);
  CHECK(r.iterations <= 1);
}

TEST_CASE("a body that moves freely and a joint on it have no closed form") {
  runtime_chain c;
  c << free_joint_3D("pose", "base", "body") << revolute_joint_3D("q", "body", "arm", axis::z)
    << rigid_link_3D("arm", "tool", along_x(1.0));
  const manipulator arm(c, "tool");
  CHECK(arm.family() == arm_family::none);
  CHECK_THROWS_MATCHES(inverse_kinematics(arm, pose{mat3<vec3<>>{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, vec3<>{1, 2, 0}}),
                       no_closed_form, says("has a joint of several degrees of freedom"));
}

}  // namespace free_bodies_test
