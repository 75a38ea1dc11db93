#include <kte/elements/free_joint.hpp>
#include <kte/runtime_chain/from_record.hpp>

#include "catch.hpp"
#include "chain/registered.hpp"
#include "elements/laws.hpp"

namespace free_joint_test {

using namespace kte;
using namespace kte::test;

// clang-format off
inline constexpr struct trunk_  final : pose_3D_key<"trunk">   {} trunk;
inline constexpr struct puck_   final : pose_2D_key<"puck">    {} puck;
inline constexpr struct ground_ final : frame_3D_key<"ground"> {} ground;
inline constexpr struct body_   final : frame_3D_key<"body">   {} body;
inline constexpr struct table_  final : frame_2D_key<"table">  {} table;
inline constexpr struct disc_   final : frame_2D_key<"disc">   {} disc;
// clang-format on

template <class S>
void check_laws() {
  random_numbers draw(1);
  const auto check = [&](const auto& joint) {
    CHECK(testing::motion_is_derivative<S>(joint, draw) <= by_differences<S>);
    CHECK(testing::power_is_kept<S>(joint, draw) <= rounding<S>);
  };
  check(free_joint_2D("X", "base", "end"));
  check(free_joint_3D("X", "base", "end"));
}

/// All of a frame but its loads is the same to a tolerance.
template <class S>
bool same_motion(const frame_3D<S>& x, const frame_3D<S>& y, const S& tolerance) {
  return near(x.position, y.position, tolerance) && near(x.rotation.x, y.rotation.x, tolerance) &&
         near(x.rotation.y, y.rotation.y, tolerance) && near(x.rotation.z, y.rotation.z, tolerance) &&
         near(x.velocity, y.velocity, tolerance) && near(x.ang_velocity, y.ang_velocity, tolerance) &&
         near(x.acceleration, y.acceleration, tolerance) && near(x.ang_acceleration, y.ang_acceleration, tolerance);
}
frame_3D<> in_space(const frame_2D<>& x) {
  frame_3D<> y;
  set_motion(y, spatial(x));
  y.force = as<double>(load_of(x).force), y.torque = as<double>(load_of(x).torque);
  return y;
}

TEST_CASE("free joints obey the laws") {
  check_laws<double>();
  check_laws<digits50>();
}

TEST_CASE("a free joint moves its end as its coordinate says") {
  auto x = trial_of(free_joint_3D("X", "base", "end"), 1);
  x.at<1>() = {};  // a base at rest
  x.at<0>() = {.position = {1.0, 2.0, 3.0},
               .rotation = {0.5, 0.5, 0.5, 0.5},  // x to y to z to x
               .velocity = {4.0, -1.0, 0.5},
               .ang_velocity = {0.0, 2.0, 0.0},
               .acceleration = {0.25, 8.0, -6.0},
               .ang_acceleration = {7.0, -3.0, 5.0}};
  x.doMotion();
  const auto& e = x.output();
  CHECK(e.position == vec3{1.0, 2.0, 3.0});
  CHECK(e.rotation == mat3<>{{0.0, 0.0, 1.0}, {1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}});
  CHECK(e.velocity == vec3{4.0, -1.0, 0.5});
  CHECK(e.ang_velocity == vec3{0.0, 2.0, 0.0});
  CHECK(e.acceleration == vec3{0.25 + 1.0, 8.0, -6.0 - 8.0});  // a + w x v
  CHECK(e.ang_acceleration == vec3{7.0, -3.0, 5.0});
}

TEST_CASE("the force on a pose is that of virtual power on each axis") {
  // Each axis is one of the end: f is the wrench on the end, number by number, wherever the base is.
  for (unsigned seed = 1; seed <= 20; ++seed) {
    auto x = trial_of(free_joint_3D("X", "base", "end"), seed);
    x.output().force = {1.0, -2.0, 0.5}, x.output().torque = {0.25, 3.0, -1.0};
    x.doForce();
    CHECK(x.at<0>().force == x.output().force);
    CHECK(x.at<0>().torque == x.output().torque);
    auto y = trial_of(free_joint_2D("X", "base", "end"), seed);
    y.output().force = {1.0, -2.0}, y.output().torque = 0.25;
    y.doForce();
    CHECK(y.at<0>().force == vec2{1.0, -2.0});
    CHECK(y.at<0>().torque == 0.25);
  }
}

TEST_CASE("loads on a pose add up, and are cleared") {
  auto x = trial_of(free_joint_3D("X", "base", "end"), 1);
  x.output().force = {1.0, -2.0, 0.5}, x.output().torque = {0.25, 3.0, -1.0};
  x.doForce(), x.doForce();
  CHECK(x.at<0>().force == vec3{2.0, -4.0, 1.0});
  CHECK(x.at<0>().torque == vec3{0.5, 6.0, -2.0});
  clear_load(x.at<0>());
  CHECK(x.at<0>().force == vec3{0.0, 0.0, 0.0});
  CHECK(x.at<0>().torque == vec3{0.0, 0.0, 0.0});
  pose_coord_2D<> p{.force = {1.0, 2.0}, .torque = 3.0};
  clear_load(p);
  CHECK(p.force == vec2{0.0, 0.0});
  CHECK(p.torque == 0.0);
}

TEST_CASE("a free joint in the plane is one in space about z") {
  for (unsigned seed = 1; seed <= 20; ++seed) {
    auto x = trial_of(free_joint_2D("X", "base", "end"), seed);
    auto y = trial_of(free_joint_3D("X", "base", "end"), seed);
    const auto& c = x.at<0>();
    y.at<0>() = {.position = {c.position.x, c.position.y, 0.0},
                 .rotation = to_quaternion(vec3{0.0, 0.0, c.angle}),
                 .velocity = {c.velocity.x, c.velocity.y, 0.0},
                 .ang_velocity = {0.0, 0.0, c.ang_velocity},
                 .acceleration = {c.acceleration.x, c.acceleration.y, 0.0},
                 .ang_acceleration = {0.0, 0.0, c.ang_acceleration}};
    y.at<1>() = in_space(x.at<1>());
    y.doMotion();
    CHECK(same_motion(in_space(x.output()), y.output(), rounding<double>));
    x.output().force = {1.0, -2.0}, x.output().torque = 0.5;
    y.output().force = {1.0, -2.0, 0.0}, y.output().torque = {0.0, 0.0, 0.5};
    y.at<1>().force = {}, y.at<1>().torque = {};
    x.doForce(), y.doForce();
    CHECK(y.at<0>().force == vec3{x.at<0>().force.x, x.at<0>().force.y, 0.0});
    CHECK(y.at<0>().torque == vec3{0.0, 0.0, x.at<0>().torque});
    CHECK(load_difference(in_space(x.at<1>()), y.at<1>()) <= rounding<double>);
  }
}

TEST_CASE("the length of the quaternion of a pose does not matter") {
  for (unsigned seed = 1; seed <= 20; ++seed) {
    auto x = trial_of(free_joint_3D("X", "base", "end"), seed);
    for (const double s : {-1.0, 1.5, 1e-100, 1e100}) {
      auto y = x;
      auto& r = y.at<0>().rotation;
      r = {s * r.w, s * r.x, s * r.y, s * r.z};
      y.doMotion();
      CHECK(same_motion(x.output(), y.output(), rounding<double>));
    }
  }
}

TEST_CASE("a free joint keeps NaN") {
  auto x = trial_of(free_joint_3D("X", "base", "end"), 3);
  x.at<0>().rotation.y = not_a_number;
  x.doMotion();
  CHECK(std::isnan(x.output().rotation.x.x));
  auto y = trial_of(free_joint_2D("X", "base", "end"), 3);
  y.at<0>().angle = not_a_number;
  y.doMotion();
  CHECK(std::isnan(y.output().rotation.cos));
}

TEST_CASE("a free joint in a runtime chain wants names of its kinds") {
  runtime_chain c;
  c << revolute_joint_3D("q", "ground", "arm") << base_2D("table");
  const auto fails = [&c](const auto& e, const std::string& what) {
    CHECK_THROWS_AS(c << e, bad_wiring);
    CHECK_THROWS_WITH(c << e, what);
  };
  fails(free_joint_3D("q", "arm", "body"),
        "kte: free_joint_3D (coordinate 'q', base 'arm', end 'body'): 'q' is a coordinate, not a 3D pose");
  fails(free_joint_2D("q", "table", "disc"),
        "kte: free_joint_2D (coordinate 'q', base 'table', end 'disc'): 'q' is a coordinate, not a 2D pose");
  fails(free_joint_3D("X", "table", "body"),
        "kte: free_joint_3D (coordinate 'X', base 'table', end 'body'): 'table' is a 2D frame, not a 3D frame");
  CHECK_NOTHROW(c << free_joint_3D("X", "arm", "body"));
  fails(revolute_joint_3D("X", "body", "hand"),
        "kte: revolute_joint_3D (coordinate 'X', base 'body', end 'hand'): 'X' is a 3D pose, not a coordinate");
  fails(free_joint_3D("Y", "arm", "body"),
        "kte: free_joint_3D (coordinate 'Y', base 'arm', end 'body'): it writes 'body', which is then written twice");
  fails(free_joint_3D("", "arm", "other"),
        "kte: free_joint_3D (coordinate '', base 'arm', end 'other'): its coordinate has no name");
  CHECK(c.dofs() == 7);
  CHECK(c.nq() == 8);
  auto s = c.make_state();
  CHECK_THROWS_WITH(s.pose_2D("X"), "kte: 'X' is a 3D pose, not a 2D pose");
  CHECK_THROWS_WITH(s.pose_3D("Y"), "kte: this chain has no 3D pose 'Y' (there are 'X')");
}

TEST_CASE("free joints go to records and back") {
  constexpr auto in_plane = chain(free_joint_2D(puck, table, disc), inertia_2D(disc, planar_body(2.0, 0.5)));
  constexpr auto solid = chain(free_joint_3D(trunk, ground, body), inertia_3D(body, point_mass(2.0, along_x(0.25))));
  const auto check = [](const auto& c, const std::string& type) {
    const auto r = record_of(c);
    CHECK(r.elements[0].type == type);
    CHECK(r.elements[0].connections.size() == 3);
    CHECK(r.elements[0].connections[0].role == "coordinate");
    CHECK(r.elements[0].parameters.empty());
    CHECK(record_of(from_record(c, r)) == r);
    CHECK(record_of(models::registered(r)) == r);
    CHECK(models::registered(r).dofs() == std::remove_cvref_t<decltype(c)>::dofs);
    CHECK(models::registered(r).nq() == std::remove_cvref_t<decltype(c)>::nq);
    auto other = r;
    other.elements[0].parameters.push_back({"axis", {0, 0, 1}});
    CHECK_THROWS_WITH(models::registered(other), contains_text("no parameter 'axis'"));
    other = r;
    other.elements[0].connections.erase(other.elements[0].connections.begin());
    CHECK_THROWS_WITH(models::registered(other), contains_text(type + " has no connection 'coordinate'"));
  };
  check(in_plane, "free_joint_2D");
  check(solid, "free_joint_3D");
}

}  // namespace free_joint_test
