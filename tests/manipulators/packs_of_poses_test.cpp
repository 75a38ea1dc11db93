#include <kte/manipulators/iiwa14.hpp>
#include <kte/manipulators/inverse_kinematics.hpp>
#include <kte/manipulators/p3r3r.hpp>
#include <kte/manipulators/panda.hpp>
#include <kte/manipulators/scara.hpp>
#include <kte/manipulators/three_r_three_r.hpp>
#include <kte/manipulators/ur.hpp>

#include "catch.hpp"
#include "random.hpp"

// Several poses at once, in the lanes of packs, have the solutions of single poses.

namespace packs_of_poses_test {

using namespace kte;
using four = pack<double, 4>;

using pose_of_one = detail::plain_pose_of<double>;
using pose_of_four = detail::plain_pose_of<four>;

four packed(const std::array<pose_of_one, 4>& x, const auto& number) {
  four p;
  for (std::size_t l = 0; l < 4; ++l) p.set(l, number(x[l]));
  return p;
}
vec3<four> packed_vector(const std::array<pose_of_one, 4>& x, const auto& vector) {
  return {packed(x, [&](const auto& y) { return vector(y).x; }), packed(x, [&](const auto& y) { return vector(y).y; }),
          packed(x, [&](const auto& y) { return vector(y).z; })};
}
pose_of_four packed(const std::array<pose_of_one, 4>& x) {
  return {{packed_vector(x, [](const auto& y) { return y.rotation.x; }),
           packed_vector(x, [](const auto& y) { return y.rotation.y; }),
           packed_vector(x, [](const auto& y) { return y.rotation.z; })},
          packed_vector(x, [](const auto& y) { return y.position; })};
}
bool in_lane(const four::mask& truth, std::size_t lane) { return select(truth, four(1), four(0))[lane] != 0; }

/// Of random postures, with the joint `stops` at 0 in every second, and every fourth pose beyond reach.
template <class Arm, class... Request>
void compare(const char* name, const Arm& arm, std::size_t stops, const Request&... request) {
  INFO(name);
  const auto& geometry = arm.structure().original;
  random_numbers random(3);
  int differ = 0, exact = 0;
  double far = 0;
  for (int k = 0; k < 25; ++k) {
    std::array<pose_of_one, 4> x;
    for (std::size_t l = 0; l < 4; ++l) {
      detail::by_joint<double> q{};
      for (std::size_t i = 0; i < static_cast<std::size_t>(geometry.n); ++i) q[i] = random(3.0);
      if (l % 2 == 1) q[stops] = 0;
      x[l] = detail::tool_pose(geometry, q);
      if (l == 2) x[l].position = 2.0 * x[l].position;
    }
    const auto all = inverse_kinematics(arm, packed(x), request...);
    for (std::size_t l = 0; l < 4; ++l) {
      const auto own = inverse_kinematics(arm, x[l], request...);
      REQUIRE(own.size() == all.size());
      for (std::size_t i = 0; i < own.size(); ++i) {
        differ += own[i].branch != all[i].branch || own[i].exact != in_lane(all[i].exact, l) ||
                  own[i].within_limits != in_lane(all[i].within_limits, l) || own[i].free != all[i].free[l];
        exact += own[i].exact;
        for (Eigen::Index j = 0; j < own[i].q.size(); ++j)
          far = test::worse(far, std::abs(std::remainder(own[i].q[j] - all[i].q[j][l], 2 * M_PI)));
      }
    }
  }
  CHECK(differ == 0);
  CHECK(exact > 100);
  CHECK(far <= 1e-12);
}

TEST_CASE("packs of poses: the answers of each lane are those of its pose alone, also if singular or out of reach") {
  compare("3R3R", three_r_three_r(), 4);
  compare("UR5", ur(), 4);
  compare("iiwa14", iiwa14(), 5, arm_angle(0.3));
  compare("P3R3R", p3r3r(), 5, locked("track", 0.3));
  compare("SCARA", scara(), 1);
}

TEST_CASE("packs of poses: what is no pose in one lane, and arms of equations of degree four, are refused") {
  pose_of_one x{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, {0.3, 0.1, 0.2}};
  std::array<pose_of_one, 4> four_of_it{x, x, x, x};
  four_of_it[2].position.x = NAN;
  CHECK_THROWS_AS(inverse_kinematics(ur(), packed(four_of_it)), bad_argument);
  four_of_it[2] = x, four_of_it[3].rotation.x = {-1, 0, 0};
  CHECK_THROWS_AS(inverse_kinematics(ur(), packed(four_of_it)), bad_argument);
  try {
    (void)inverse_kinematics(panda(), packed({x, x, x, x}));
    FAIL("accepted");
  } catch (const no_closed_form& e) {
    CHECK(std::string(e.what()).find("take the poses of this one by one") != std::string::npos);
  }
}

}  // namespace packs_of_poses_test
