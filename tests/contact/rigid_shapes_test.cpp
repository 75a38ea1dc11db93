#include <kte/contacts.hpp>
#include <kte/elements/registry.hpp>
#include <kte/elements/rigid_shapes.hpp>
#include <kte/io/recording.hpp>
#include <kte/simulation.hpp>
#include <kte/static.hpp>

#include "catch.hpp"
#include "elements/laws.hpp"

namespace rigid_shapes_test {

using namespace kte;
using namespace kte::test;

inline constexpr struct ground_ final : frame_3D_key<"ground"> {
} ground;
inline constexpr struct body_ final : frame_3D_key<"body"> {
} body;
inline constexpr struct pose_ final : pose_3D_key<"pose"> {
} pose_of_body;
inline constexpr struct crate_ final : contact_key<"crate"> {
} crate;
inline constexpr struct floor_ final : frame_2D_key<"floor"> {
} floor_frame;
inline constexpr struct card_ final : frame_2D_key<"card"> {
} card;
inline constexpr struct place_ final : pose_2D_key<"place"> {
} place;
inline constexpr struct rod_ final : contact_key<"rod"> {
} rod;

constexpr vec3<> half{0.3, 0.2, 0.1};
constexpr double g = 9.81, mass = 2;
constexpr rigid_body crate_body{mass, vec3{0.0, 0.0, 0.0}, sym3{0.03, 0.0, 0.0, 0.06, 0.0, 0.08}};

runtime_chain runtime_crate(double mu) {
  runtime_chain c;
  c << base_3D("ground") << free_joint_3D("pose", "ground", "body") << inertia_3D("body", crate_body)
    << box_contact_3D("crate", "ground", "body", half_space{}, half, {.friction = mu});
  c.gravity({0, 0, -g});
  return c;
}

TEST_CASE("a box that slides has four pressed corners, in static and runtime chains") {
  constexpr auto c = chain(base_3D(ground), free_joint_3D(pose_of_body, ground, body), inertia_3D(body, crate_body),
                           box_contact_3D(crate, ground, body, half_space{}, half, {.friction = 0.3}))
                         .gravity(vec3{0.0, 0.0, -g});
  const auto r = runtime_crate(0.3);
  auto s = make_state(r);
  Eigen::VectorXd q(7), v = Eigen::VectorXd::Zero(6);
  q << 0, 0, 0.1, 1, 0, 0, 0;
  v[0] = 1;
  const Eigen::VectorXd tau = Eigen::VectorXd::Zero(6);
  const auto& in_runtime = contact_dynamics(r, s, q, v, tau);
  const auto in_static = contact_dynamics(c, q, v, tau);
  CHECK((in_runtime.a - in_static.a).norm() < 1e-12);
  CHECK(in_runtime.a[0] == within(-0.3 * g, 1e-12));
  double weight = 0;
  for (int k = 1; k <= 8; ++k) {
    const auto f = in_runtime.force("crate/corner " + std::to_string(k));
    INFO(k);
    CHECK((f.z > 0) == (k <= 4));  // the lower side
    CHECK(f.x == within(-0.3 * f.z, 1e-13));
    weight += f.z;
  }
  CHECK(weight == within(mass * g, 1e-12));
  CHECK(corner_of<3>(crate).name == "crate/corner 3");
  CHECK(near(in_static.force(corner_of<3>(crate)), in_runtime.force(corner_of<3>("crate")), 1e-12));
  const auto& at = s.contact("crate/corner 7");  // -x, +y, +z
  CHECK(near(at.point, vec3<>{-0.3, 0.2, 0.2}, 1e-15));
  CHECK(at.gap == within(0.2, 1e-15));
}

TEST_CASE("a capsule in the plane rests on its two ends, and leans on one") {
  constexpr auto c =
      chain(base_2D(floor_frame), free_joint_2D(place, floor_frame, card), inertia_2D(card, planar_body(mass, 0.01)),
            capsule_contact_2D(rod, floor_frame, card, half_space{}, vec2{0.4, 0.0}, 0.05, {.friction = 1}))
          .gravity(vec3{zero, -g, zero});
  runtime_chain r;
  r << base_2D("floor") << free_joint_2D("place", "floor", "card") << inertia_2D("card", planar_body(mass, 0.01))
    << capsule_contact_2D("rod", "floor", "card", half_space{}, vec2{0.4, 0.0}, 0.05, {.friction = 1});
  r.gravity({0, -g, 0});
  auto s = make_state(r);
  const Eigen::Vector3d lying(0, 0.05, 0), leaning(0, 0.05 + 0.4 * std::sin(0.5), -0.5), rest = Eigen::Vector3d::Zero();
  const auto both = contact_dynamics(c, lying, rest, rest);
  CHECK(both.force(end_of<1>(rod)).y == within(mass * g / 2, 1e-8));
  CHECK(both.force(end_of<2>(rod)).y == within(mass * g / 2, 1e-8));
  const auto& same = contact_dynamics(r, s, lying, rest, rest);
  CHECK(same.force("rod/end 2").y == within(mass * g / 2, 1e-8));
  const auto one = contact_dynamics(c, leaning, rest, rest);
  CHECK(one.force(end_of<1>(rod)).y > 1);
  CHECK(one.force(end_of<2>(rod)).y == 0);
}

TEST_CASE("a dropped box comes to rest on a side") {
  const auto c = runtime_crate(0.8);
  const manipulator_dynamics_model model(c);
  Eigen::VectorXd q(7);
  q << 0, 0, 0.25, 0.98, 0.1, 0.15, 0.05;
  q.tail(4).normalize();
  moreau_jean solver(std::cref(model), 0.0, model.make_x(q, Eigen::VectorXd::Zero(6)), 2e-3);
  solver.integrate(2.0);
  const auto x = solver.state();
  CHECK(model.velocities_of(x).norm() < 1e-10);
  CHECK(x[2] == within(0.1, 5e-3));
}

TEST_CASE("parts of contacts go through records and recordings by their names") {
  runtime_chain c;
  c << base_3D("ground") << free_joint_3D("pose", "ground", "body") << base_2D("floor")
    << free_joint_2D("place", "floor", "card")
    << box_contact_3D("crate", "ground", "body", half_space{}, half, {.friction = 0.5, .restitution = 0.1})
    << capsule_contact_3D("leg", "ground", "body", ball_surface(0.5), along_z(0.2), 0.02, {.friction = 0.5})
    << box_contact_2D("card", "floor", "card", half_space{}, vec2{0.3, 0.2}, {});
  CHECK(record_of(to_chain(record_of(c))).elements == record_of(c).elements);
  auto s = c.make_state();
  const detail::recording of(detail::slots_of(*s.made_for()),
                             {"crate/corner 3/force/z", "leg/end 2/gap", "card/corner 4/mode"});
  CHECK(of.columns == std::vector<std::string>{"t", "crate/corner 3/force/z", "leg/end 2/gap", "card/corner 4/mode"});
  c.doMotion(s);
  CHECK(near(s.contact("card/corner 2").point, vec3<>{-0.3, 0.2, 0}, 1e-15));
  CHECK(s.contact("leg/end 2").gap == within(-0.5 + 0.2 - 0.02, 1e-15));

  CHECK_THROWS_AS(c << box_contact_3D("crate", "ground", "body", half_space{}, half, {}), bad_wiring);
  CHECK_THROWS_MATCHES(box_contact_3D("box", "ground", "body", half_space{}, half, {.friction = -1}), bad_parameter,
                       says("'box/corner "));
}

}  // namespace rigid_shapes_test
