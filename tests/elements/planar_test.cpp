#include <kte/static.hpp>

#include "catch.hpp"
#include "elements/laws.hpp"

namespace planar_test {

using namespace kte;
using namespace kte::test;

// clang-format off
inline constexpr struct slide_ final : coord_key<"slide"> {} slide;
inline constexpr struct turn_  final : coord_key<"turn">  {} turn;
inline constexpr struct bend_  final : coord_key<"bend">  {} bend;
template <fixed_string Text> struct flat  final : frame_2D_key<Text> {};
template <fixed_string Text> struct solid final : frame_3D_key<Text> {};
// clang-format on

/// One mechanism in the plane and in space about z: a cart on an oblique rail with two links.
constexpr auto in_plane =
    chain(prismatic_joint_2D(slide, flat<"base">{}, flat<"cart">{}, vec2{0.6, 0.8}),
          inertia_2D(flat<"cart">{}, planar_body(2.0, 0.3, vec2{0.1, -0.2})),
          rigid_link_2D(flat<"cart">{}, flat<"mount">{}, vec2{0.3, -0.1}, rotation_2D{0.28, 0.96}),
          revolute_joint_2D(turn, flat<"mount">{}, flat<"arm">{}),
          inertia_2D(flat<"arm">{}, planar_body(1.5, 0.05, along_x(0.25))),
          rigid_link_2D(flat<"arm">{}, flat<"elbow">{}, along_x(0.5), quarter_turn),
          revolute_joint_2D(bend, flat<"elbow">{}, flat<"hand">{}),
          inertia_2D(flat<"hand">{}, point_mass(0.7, along_y(0.4))), spring_gen(turn, bend, 0.2, 4.0))
        .gravity(along_y(-9.81));
constexpr auto in_space =
    chain(prismatic_joint_3D(slide, solid<"base">{}, solid<"cart">{}, vec3{0.6, 0.8, 0.0}),
          inertia_3D(solid<"cart">{}, rigid_body{2.0, vec3{0.1, -0.2, 0.0}, diagonal(0.2, 0.1, 0.3)}),
          rigid_link_3D(solid<"cart">{}, solid<"mount">{}, vec3{0.3, -0.1, 0.0},
                        mat3<>{{0.28, -0.96, 0.0}, {0.96, 0.28, 0.0}, {0.0, 0.0, 1.0}}),
          revolute_joint_3D(turn, solid<"mount">{}, solid<"arm">{}, vec3{0.0, 0.0, 1.0}),
          inertia_3D(solid<"arm">{}, rigid_body{1.5, vec3{0.25, 0.0, 0.0}, diagonal(0.03, 0.04, 0.05)}),
          rigid_link_3D(solid<"arm">{}, solid<"elbow">{}, vec3{0.5, 0.0, 0.0}, as<double>(quarter_turn_z)),
          revolute_joint_3D(bend, solid<"elbow">{}, solid<"hand">{}),
          inertia_3D(solid<"hand">{}, point_mass(0.7, along_y(0.4))), spring_gen(turn, bend, 0.2, 4.0))
        .gravity(along_y(-9.81));

// Equal numbers, up to terms that are 0 and ulps of contracted products: forces reach some 200 N and moments
// 100 Nm, in sums of some 30 terms.
constexpr double tolerance = 3000 * std::numeric_limits<double>::epsilon();

bool same(const frame_2D<>& x, const frame_3D<>& y) {
  const auto m = spatial(x);
  const auto R = matrix(m.rotation);
  return near(m.position, y.position, tolerance) && near(R.x, y.rotation.x, tolerance) &&
         near(R.y, y.rotation.y, tolerance) && near(R.z, y.rotation.z, tolerance) &&
         near(m.velocity, y.velocity, tolerance) && near(m.ang_velocity, y.ang_velocity, tolerance) &&
         near(m.acceleration, y.acceleration, tolerance) && near(m.ang_acceleration, y.ang_acceleration, tolerance) &&
         near(load_of(x).force, y.force, tolerance) && near(load_of(x).torque, y.torque, tolerance);
}

TEST_CASE("a chain in the plane is the chain in space about z") {
  random_numbers draw(1);
  auto s = make_state(in_plane);
  auto t = make_state(in_space);
  for (int i = 0; i < 50; ++i) {
    Eigen::Vector3d q, v, a;
    for (auto* x : {&q, &v, &a}) *x << draw(3), draw(3), draw(3);
    for (int j = 0; j < 3; ++j)
      s.coordinate(j) = {.q = q[j], .q_dot = v[j], .q_ddot = a[j]}, t.coordinate(j) = s.coordinate(j);
    // The base moves too.
    auto& b = s[flat<"base">{}];
    b.position = {draw(), draw()}, b.rotation = rotation_by(draw(3));
    b.velocity = {draw(), draw()}, b.ang_velocity = draw();
    b.acceleration = {draw(), draw()}, b.ang_acceleration = draw();
    set_motion(t[solid<"base">{}], spatial(b));
    const auto pass = [](const auto& c, auto& state) {
      c.doMotion(state);
      c.clearForce(state);
      c.doForce(state);
    };
    pass(in_plane, s), pass(in_space, t);
    CHECK(same(s[flat<"base">{}], t[solid<"base">{}]));
    CHECK(same(s[flat<"cart">{}], t[solid<"cart">{}]));
    CHECK(same(s[flat<"arm">{}], t[solid<"arm">{}]));
    CHECK(same(s[flat<"hand">{}], t[solid<"hand">{}]));
    for (int j = 0; j < 3; ++j) CHECK(s.coordinate(j).f == within(t.coordinate(j).f, tolerance));

    CHECK((inverse_dynamics(in_plane, q, v, a) - inverse_dynamics(in_space, q, v, a)).norm() <= tolerance);
    CHECK((mass_matrix(in_plane, q) - mass_matrix(in_space, q)).norm() <= tolerance);
  }
}

TEST_CASE("a joint in the plane is exactly the joint in space about the typed z") {
  for (unsigned seed = 1; seed <= 20; ++seed) {
    auto x = trial_of(revolute_joint_2D("q", "b", "e"), seed);
    auto y = trial_of(revolute_joint_3D("q", "b", "e"), seed);
    set_motion(y.at<1>(), spatial(x.at<1>()));
    y.at<0>() = x.at<0>();
    y.doMotion();
    CHECK(same(x.output(), y.output()));
  }
}

}  // namespace planar_test
