#include <kte/elements/spherical_joint.hpp>
#include <kte/runtime_chain/from_record.hpp>

#include "catch.hpp"
#include "chain/registered.hpp"
#include "elements/laws.hpp"

namespace spherical_joint_test {

using namespace kte;
using namespace kte::test;

// clang-format off
inline constexpr struct turn_   final : rotation_3D_key<"turn"> {} turn;
inline constexpr struct ground_ final : frame_3D_key<"ground">  {} ground;
inline constexpr struct body_   final : frame_3D_key<"body">    {} body;
// clang-format on

template <class S>
void check_laws() {
  random_numbers draw(1);
  const auto joint = spherical_joint_3D("X", "base", "end");
  CHECK(testing::motion_is_derivative<S>(joint, draw) <= by_differences<S>);
  CHECK(testing::power_is_kept<S>(joint, draw) <= rounding<S>);
}

TEST_CASE("spherical joints obey the laws") {
  check_laws<double>();
  check_laws<digits50>();
}

TEST_CASE("a spherical joint turns its end as its coordinate says") {
  auto x = trial_of(spherical_joint_3D("X", "base", "end"), 1);
  x.at<1>() = {.position = {1.0, 2.0, 3.0}, .velocity = {4.0, 5.0, 6.0}, .acceleration = {-1.0, -2.0, -3.0}};
  x.at<0>() = {.rotation = {0.5, 0.5, 0.5, 0.5},  // x to y to z to x
               .ang_velocity = {0.0, 2.0, 0.0},
               .ang_acceleration = {7.0, -3.0, 5.0}};
  x.doMotion();
  const auto& e = x.output();
  CHECK(e.position == vec3{1.0, 2.0, 3.0});
  CHECK(e.rotation == mat3<>{{0.0, 0.0, 1.0}, {1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}});
  CHECK(e.velocity == vec3{5.0, 6.0, 4.0});
  CHECK(e.ang_velocity == vec3{0.0, 2.0, 0.0});
  CHECK(e.acceleration == vec3{-2.0, -3.0, -1.0});
  CHECK(e.ang_acceleration == vec3{7.0, -3.0, 5.0});
}

TEST_CASE("the force on a rotation is that of virtual power on each axis") {
  // Each axis is one of the end, and so is the torque on it; forces pass to the base.
  for (unsigned seed = 1; seed <= 20; ++seed) {
    auto x = trial_of(spherical_joint_3D("X", "base", "end"), seed);
    x.output().force = {1.0, -2.0, 0.5}, x.output().torque = {0.25, 3.0, -1.0};
    x.doForce();
    CHECK(x.at<0>().torque == x.output().torque);
    const auto f = transpose(x.output().rotation) * (x.at<1>().rotation * x.at<1>().force);
    CHECK(near(f, x.output().force, rounding<double>));
    x.doForce();  // loads add up
    CHECK(x.at<0>().torque == vec3{0.5, 6.0, -2.0});
    clear_load(x.at<0>());
    CHECK(x.at<0>().torque == vec3{0.0, 0.0, 0.0});
  }
}

TEST_CASE("a spherical joint that turns about z is a revolute joint") {
  for (unsigned seed = 1; seed <= 20; ++seed) {
    auto x = trial_of(spherical_joint_3D("X", "base", "end"), seed);
    auto y = trial_of(revolute_joint_3D("q", "base", "end"), seed);
    const auto& c = y.at<0>();
    x.at<0>() = {.rotation = to_quaternion(vec3{0.0, 0.0, c.q}),
                 .ang_velocity = {0.0, 0.0, c.q_dot},
                 .ang_acceleration = {0.0, 0.0, c.q_ddot}};
    x.at<1>() = y.at<1>();
    x.doMotion();
    CHECK(near(x.output().rotation.x, y.output().rotation.x, rounding<double>));
    CHECK(near(x.output().rotation.y, y.output().rotation.y, rounding<double>));
    CHECK(near(x.output().velocity, y.output().velocity, rounding<double>));
    CHECK(near(x.output().acceleration, y.output().acceleration, rounding<double>));
    CHECK(near(x.output().ang_acceleration, y.output().ang_acceleration, rounding<double>));
    x.output().force = y.output().force = {1.0, -2.0, 0.5}, x.output().torque = y.output().torque = {0.25, 3.0, -1.0};
    x.doForce(), y.doForce();
    CHECK(x.at<0>().torque.z == y.at<0>().f);
    CHECK(load_difference(x.at<1>(), y.at<1>()) <= rounding<double>);
  }
}

TEST_CASE("the length of a quaternion does not matter") {
  auto x = trial_of(spherical_joint_3D("X", "base", "end"), 5);
  for (const double s : {-1.0, 1.5, 1e-100, 1e100}) {
    auto y = x;
    auto& r = y.at<0>().rotation;
    r = {s * r.w, s * r.x, s * r.y, s * r.z};
    y.doMotion();
    CHECK(near(x.output().rotation.x, y.output().rotation.x, rounding<double>));
    CHECK(near(x.output().rotation.y, y.output().rotation.y, rounding<double>));
    CHECK(near(x.output().rotation.z, y.output().rotation.z, rounding<double>));
  }
  x.at<0>().rotation.y = not_a_number;
  x.doMotion();
  CHECK(std::isnan(x.output().rotation.x.x));
}

TEST_CASE("a spherical joint in a runtime chain wants names of its kinds") {
  runtime_chain c;
  c << revolute_joint_3D("q", "ground", "arm") << base_2D("table");
  const auto fails = [&c](const auto& e, const std::string& what) {
    CHECK_THROWS_AS(c << e, bad_wiring);
    CHECK_THROWS_WITH(c << e, what);
  };
  fails(spherical_joint_3D("q", "arm", "body"),
        "kte: spherical_joint_3D (coordinate 'q', base 'arm', end 'body'): 'q' is a coordinate, not a rotation");
  fails(spherical_joint_3D("X", "table", "body"),
        "kte: spherical_joint_3D (coordinate 'X', base 'table', end 'body'): 'table' is a 2D frame, not a 3D frame");
  CHECK_NOTHROW(c << spherical_joint_3D("X", "arm", "body"));
  fails(revolute_joint_3D("X", "body", "hand"),
        "kte: revolute_joint_3D (coordinate 'X', base 'body', end 'hand'): 'X' is a rotation, not a coordinate");
  CHECK(c.dofs() == 4);
  CHECK(c.nq() == 5);
  auto s = c.make_state();
  CHECK_THROWS_WITH(s.pose_3D("X"), "kte: 'X' is a rotation, not a 3D pose");
  CHECK_THROWS_AS(s.rotation_3D("Y"), unknown_name);
}

TEST_CASE("spherical joints go to records and back") {
  constexpr auto c = chain(spherical_joint_3D(turn, ground, body), inertia_3D(body, point_mass(2.0, along_x(0.25))));
  const auto r = record_of(c);
  CHECK(r.elements[0].type == "spherical_joint_3D");
  CHECK(r.elements[0].parameters.empty());
  CHECK(record_of(from_record(c, r)) == r);
  CHECK(record_of(models::registered(r)) == r);
  CHECK(models::registered(r).dofs() == 3);
  CHECK(models::registered(r).nq() == 4);
}

}  // namespace spherical_joint_test
