#include <sstream>

#include "dynamics/configurations.hpp"
#include "robots/solo12.hpp"

// Where the numbers of a configuration stand, and how they go to a state and back.

namespace configuration_layout_test {

using namespace kte;
using namespace kte::test::configurations;

// The layout is known at compile time.
constexpr auto table_of_model = layout(model);
static_assert(nq == 16 && nv == 14);
static_assert(table_of_model.size() == 5);
static_assert(table_of_model[0] == layout_entry<>{"elbow", kind::gen, 0, 1, 0, 1});
static_assert(table_of_model[1] == layout_entry<>{"trunk", kind::pose_3D, 1, 7, 1, 6});
static_assert(table_of_model[2] == layout_entry<>{"ball", kind::rotation_3D, 8, 4, 7, 3});
static_assert(table_of_model[3] == layout_entry<>{"slide", kind::gen, 12, 1, 10, 1});
static_assert(table_of_model[4] == layout_entry<>{"puck", kind::pose_2D, 13, 3, 11, 3});
static_assert(layout(robots::solo12).size() == 13 && decltype(robots::solo12)::nq == 19);

TEST_CASE("the layout says where coordinates stand, the same at run time") {
  const auto runtime = layout(models::element_by_element(model));
  REQUIRE(runtime.size() == table_of_model.size());
  for (std::size_t i = 0; i < runtime.size(); ++i) CHECK(runtime[i] == table_of_model[i]);
  std::ostringstream text, text_of_runtime;
  print(text, table_of_model);
  print(text_of_runtime, runtime);
  CHECK(text.str() ==
        "elbow  coordinate  q[0]  v[0]\n"
        "trunk  3D pose  q[1..7]  v[1..6]\n"
        "ball  rotation  q[8..11]  v[7..9]\n"
        "slide  coordinate  q[12]  v[10]\n"
        "puck  2D pose  q[13..15]  v[11..13]\n");
  CHECK(text_of_runtime.str() == text.str());
  std::ostringstream one;
  print(print(one, layout(models::pendulum)), std::array<layout_entry<>, 0>{}) << "end";
  CHECK(one.str() == "q  coordinate  q[0]  v[0]\nend");
}

TEST_CASE("coordinates given from outside or written are not in the layout") {
  constexpr auto entries = layout(models::tree);
  const auto names = [](const auto& entries_of) {
    std::string all;
    for (const auto& e : entries_of) all += std::string(e.name) + " ";
    return all;
  };
  CHECK(names(entries) == "hip slide knee ");
  CHECK(names(layout(models::element_by_element(models::tree))) == "hip slide knee ");
  CHECK(entries[2] == layout_entry<>{"knee", kind::gen, 2, 1, 2, 1});
}

TEST_CASE("numbers go to a state and back in the order of the layout") {
  auto s = make_state(model);
  const auto runtime = models::element_by_element(model);
  auto r = runtime.make_state();
  joint_vector<double, nq> q;
  joint_vector<double, nv> v, a;
  for (int i = 0; i < nq; ++i) q[i] = 100 + i;
  for (int i = 0; i < nv; ++i) v[i] = 200 + i, a[i] = 300 + i;
  set_positions(s, q), set_velocities(s, v), set_accelerations(s, a);
  set_positions(r, q), set_velocities(r, v), set_accelerations(r, a);
  CHECK(positions(s) == q);
  CHECK(velocities(s) == v);
  CHECK(accelerations(s) == a);
  CHECK(positions(r) == q);
  CHECK(velocities(r) == v);
  CHECK(accelerations(r) == a);
  const auto check = [](const auto& x, const auto& b, const auto& p, const auto& e) {
    CHECK(e.q == 100);
    CHECK(x.position == vec3{101.0, 102.0, 103.0});
    CHECK(x.rotation == unit_quaternion<>{104.0, 105.0, 106.0, 107.0});
    CHECK(x.velocity == vec3{201.0, 202.0, 203.0});
    CHECK(x.ang_velocity == vec3{204.0, 205.0, 206.0});
    CHECK(x.acceleration == vec3{301.0, 302.0, 303.0});
    CHECK(x.ang_acceleration == vec3{304.0, 305.0, 306.0});
    CHECK(b.rotation == unit_quaternion<>{108.0, 109.0, 110.0, 111.0});
    CHECK(b.ang_velocity == vec3{207.0, 208.0, 209.0});
    CHECK(b.ang_acceleration == vec3{307.0, 308.0, 309.0});
    CHECK(p.position == vec2{113.0, 114.0});
    CHECK(p.angle == 115.0);
    CHECK(p.velocity == vec2{211.0, 212.0});
    CHECK(p.ang_velocity == 213.0);
    CHECK(p.acceleration == vec2{311.0, 312.0});
    CHECK(p.ang_acceleration == 313.0);
  };
  check(s[trunk], s[ball], s[puck], s[elbow]);
  check(r.pose_3D("trunk"), r.rotation_3D("ball"), r.pose_2D("puck"), r.coordinate("elbow"));

  s[trunk].force = {1.0, 2.0, 3.0}, s[trunk].torque = {4.0, 5.0, 6.0}, s[ball].torque = {7.0, 8.0, 9.0};
  s[puck].force = {11.0, 12.0}, s[puck].torque = 13.0, s[slide].f = 10.0;
  r.pose_3D("trunk") = s[trunk], r.rotation_3D("ball") = s[ball], r.pose_2D("puck") = s[puck];
  r.coordinate("slide") = s[slide];
  for (int i = 0; i < nv; ++i) CHECK(forces(s)[i] == i);
  CHECK(forces(r) == forces(s));
}

TEST_CASE("vectors of the wrong size say so") {
  const auto runtime = models::element_by_element(model);
  auto s = make_state(model);
  auto r = runtime.make_state();
  const Eigen::VectorXd q = neutral_configuration(runtime), v = Eigen::VectorXd::Zero(nv);
  const auto check = [](const auto& c, auto& state, const Eigen::VectorXd& positions_of, const Eigen::VectorXd& rates) {
    const std::string long_q = "kte: q has 17 numbers, the chain has 16 numbers of a configuration",
                      short_q = "kte: q has 14 numbers, the chain has 16 numbers of a configuration",
                      long_v = "kte: v has 16 numbers, the chain has 14 degrees of freedom";
    const Eigen::VectorXd more = Eigen::VectorXd::Zero(nq + 1);
    CHECK_THROWS_AS(integrate(c, more, rates, 0.1), bad_argument);
    CHECK_THROWS_WITH(integrate(c, more, rates, 0.1), long_q);
    CHECK_THROWS_WITH(integrate(c, positions_of, positions_of, 0.1), long_v);
    CHECK_THROWS_WITH(difference(c, rates, positions_of), short_q);
    CHECK_THROWS_WITH(difference(c, positions_of, more), long_q);
    CHECK_THROWS_WITH(set_positions(state, rates), short_q);
    CHECK_THROWS_WITH(set_velocities(state, positions_of), long_v);
    CHECK_THROWS_WITH(set_accelerations(state, positions_of),
                      "kte: a has 16 numbers, the chain has 14 degrees of freedom");
  };
  check(model, s, q, v);
  check(runtime, r, q, v);
  const double two[2]{};
  CHECK_THROWS_WITH(integrate(runtime, two, two, 1.0),
                    "kte: q has 2 numbers, the chain has 16 numbers of a configuration");
  // If the counts are equal, the message need not distinguish them.
  CHECK_THROWS_WITH(integrate(models::pendulum, std::vector{0.0, 0.0}, std::array{0.0}, 1.0),
                    "kte: q has 2 numbers, the chain has 1 degrees of freedom");
}

}  // namespace configuration_layout_test
