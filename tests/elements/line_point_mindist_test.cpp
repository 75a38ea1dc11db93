#include <kte/dynamics.hpp>
#include <kte/elements/line_point_mindist.hpp>
#include <kte/elements/plane_point_mindist.hpp>

#include <cmath>

#include "catch.hpp"
#include "chain/registered.hpp"
#include "elements/laws.hpp"

// Frames at the nearest point of a line, and of a plane.

namespace line_point_mindist_test {

using namespace kte;
using namespace kte::test;

template <class S>
void check_laws() {
  random_numbers draw(1);
  const auto check = [&draw](const auto& e) {
    CHECK(testing::power_is_kept<S>(e, draw) <= rounding<S>);
    CHECK(testing::motion_is_derivative<S>(e, draw) <= by_differences<S>);
  };
  const vec3<S, S, S> n{S(2) / S(7), S(-3) / S(7), S(6) / S(7)}, o{S(1) / S(4), S(-1) / S(2), S(1)};
  check(line_point_mindist_2D("a", "b", vec2<S>{S(3) / S(5), S(-4) / S(5)}, vec2<S>{S(1) / S(4), S(1)}));
  check(line_point_mindist_3D("a", "b", n, o));
  check(plane_point_mindist_3D("a", "b", n, o));
}

// clang-format off
inline constexpr struct x_      final : coord_key<"x">           {} x_key;
inline constexpr struct ground_ final : frame_3D_key<"ground">   {} ground;
inline constexpr struct mass_   final : frame_3D_key<"mass">     {} mass;
inline constexpr struct arm_    final : frame_3D_key<"arm">      {} arm;
inline constexpr struct foot_   final : frame_3D_key<"foot">     {} foot;
// clang-format on

/// A mass on two sliding joints across each other, tied by a spring to a nearest point.
template <class Nearest>
runtime_chain tied(const Nearest& nearest) {
  runtime_chain c;
  c << prismatic_joint_3D("x", "ground", "a", axis::x) << prismatic_joint_3D("y", "a", "b", axis::y)
    << prismatic_joint_3D("z", "b", "mass", axis::z) << inertia_3D("mass", point_mass(2.0)) << nearest
    << spring_3D("mass", "nearest", 0.0, 50.0) << damper_3D("mass", "nearest", 3.0);
  return c;
}

TEST_CASE("nearest points move as they should and hand loads back") {
  check_laws<double>(), check_laws<digits50>();
  random_numbers draw(2);
  auto x = trial_of(plane_point_mindist_3D("a", "b", vec3<>{2.0 / 7, -3.0 / 7, 6.0 / 7}, vec3<>{0.25, -0.5, 1}), 3);
  const auto &p = x.at<0>().position, &foot = x.at<1>().position;
  CHECK(dot(vec3<>{2, -3, 6}, foot) == within(2 * 0.25 + 3 * 0.5 + 6, 4e-15));  // in the plane
  const vec3<> way = as<double>(p - foot);
  CHECK(near(cross(way, vec3<>{2, -3, 6}), vec3<>{}, 1e-14));  // along its normal
}

TEST_CASE("a spring to the nearest point of a line or plane") {
  const vec3<> n{2.0 / 7, -3.0 / 7, 6.0 / 7}, o{0.25, -0.5, 1};
  const bool plane = GENERATE(false, true);
  const auto c = plane ? tied(plane_point_mindist_3D("mass", "nearest", n, o))
                       : tied(line_point_mindist_3D("mass", "nearest", n, o));
  auto s = c.make_state();
  const Eigen::Vector3d q(0.3, 0.2, -0.7), v(1, -2, 0.5), none(0, 0, 0), e(n.x, n.y, n.z);
  // K = k P: across the line P = I - e e^T, along the normal of the plane e e^T
  const Eigen::Matrix3d P =
      plane ? Eigen::Matrix3d(e * e.transpose()) : Eigen::Matrix3d(Eigen::Matrix3d::Identity() - e * e.transpose());
  const Eigen::Vector3d away = q - Eigen::Vector3d(o.x, o.y, o.z);
  // the damper acts along the spring: for a line along the way from the nearest point
  const Eigen::Vector3d u = (P * away).normalized();
  const Eigen::Vector3d expected = -(50 * P * away + 3 * u * u.dot(P * v)) / 2;
  const Eigen::VectorXd a = forward_dynamics(c, s, q, v, none);
  CHECK((a - expected).norm() < 2e-14);
  CHECK((mass_matrix(c, s, q) - 2 * Eigen::Matrix3d::Identity()).norm() < 1e-14);
  CHECK(Eigen::Vector3d(inverse_dynamics(c, s, q, v, a)).norm() < 4e-14);
  const auto d = forward_dynamics_derivatives(c, s, q, Eigen::Vector3d::Zero().eval(), none);
  CHECK((d.by_q + 25 * P).norm() < 2e-14);
  CHECK((d.by_v + 1.5 * u * u.transpose()).norm() < 2e-14);
  CHECK(record_of(models::registered(record_of(c))) == record_of(c));
}

TEST_CASE("nearest points reject what is no direction") {
  CHECK(complaint([] {
          (void)line_point_mindist_3D("a", "b", vec3<>{1, 1, 0}, vec3<>{});
        }).find("tangent must have length 1") != std::string::npos);
  CHECK(complaint([] {
          (void)line_point_mindist_2D("a", "b", vec2<double>{1, 0}, vec2<double>{0, infinity});
        }).find("origin must be finite") != std::string::npos);
  CHECK(complaint([] {
          (void)plane_point_mindist_3D("a", "b", vec3<>{0, 0, 2}, vec3<>{});
        }).find("normal must have length 1") != std::string::npos);
}

TEST_CASE("the nearest point of a line under gravity is accelerated as in the world") {
  const bool plane = GENERATE(false, true), turned = GENERATE(false, true);
  runtime_chain c;
  c.gravity(along_y(-9.75)) << prismatic_joint_3D("x", "ground", "mass", axis::x)
                            << inertia_3D("mass", point_mass(2.0));
  if (plane)
    c << plane_point_mindist_3D("mass", "foot", vec3<>{0, 1, 0}, vec3<>{0, 1, 0});
  else
    c << line_point_mindist_3D("mass", "foot", vec3<>{1, 0, 0}, vec3<>{0, 1, 0});
  c << line_point_mindist_3D("ground", "rest", vec3<>{0, 1, 0}, vec3<>{});
  auto s = c.make_state();
  vec3<> a{2, 0, 0};
  if (turned) {  // the ground about z by 90 degrees: gravity is -x of the ground
    s.frame_3D("ground").rotation = mat3<>{{0, -1, 0}, {1, 0, 0}, {0, 0, 1}};
    s.frame_3D("ground").acceleration = {9.75, 0, 0};
    a = {};  // along y, which neither the line nor the plane has
  }
  s.coordinate("x").q_ddot = 2;
  CHECK(near(frame_acceleration(c, s, "foot").linear, a, 1e-15));
  CHECK(near(frame_acceleration(c, s, "rest").linear, vec3<>{}, 1e-15));
  CHECK(near(bias_acceleration(c, s, "foot").linear, vec3<>{}, 1e-15));
  CHECK(near(frame_acceleration(c, s, "mass").linear, vec3<>{2, 0, 0}, 1e-15));
}

TEST_CASE("frames at nearest points of static chains move as their positions do") {
  const auto c =
      chain(revolute_joint_3D(x_key, ground, mass, axis::z), inertia_3D(mass, point_mass(2.0)),
            rigid_link_3D(mass, arm, along_x(0.5)), line_point_mindist_3D(arm, foot, axis::x, vec3{0.0, 1.0, 0.0}))
          .gravity(along_y(-9.75));
  const std::array q{0.0}, v{2.0}, a{3.0};  // the foot stands at x = cos(q) / 2
  CHECK(near(frame_velocity(c, q, v, foot).linear, vec3<>{}, 1e-15));
  CHECK(near(frame_acceleration(c, q, v, a, foot).linear, vec3<>{-2, 0, 0}, 1e-15));
  CHECK(near(bias_acceleration(c, q, v, foot).linear, vec3<>{-2, 0, 0}, 1e-15));
}

TEST_CASE("a mass on a nearest point bars what is about masses, not what is about motion") {
  const auto nearest = line_point_mindist_3D("mass", "nearest", axis::x, vec3<>{0, 0.5, 0});
  const auto plain = tied(nearest);
  auto weighted = tied(nearest);
  weighted << inertia_3D("nearest", point_mass(1.0));
  auto s = plain.make_state();
  auto t = weighted.make_state();
  const Eigen::Vector3d q(0.3, 0.2, -0.7);
  for (const char* frame : {"mass", "nearest"}) CHECK(jacobian(weighted, t, q, frame) == jacobian(plain, s, q, frame));
  CHECK_THROWS_MATCHES(mass_matrix(weighted, t, q), bad_argument, says("has a mass on a frame that follows others"));
}

}  // namespace line_point_mindist_test
