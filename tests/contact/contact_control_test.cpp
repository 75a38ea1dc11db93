#include <kte/dynamics/configuration_space.hpp>
#include <kte/dynamics/mass_matrix_inverse.hpp>

#include <Eigen/Cholesky>

#include "allocation_count.hpp"
#include "catch.hpp"
#include "closed_loops/tangle.hpp"
#include "contact/legged.hpp"
#include "random.hpp"

namespace contact_control_test {

using namespace kte;
using namespace kte::test;
using namespace kte::test::legged;
using kte::test::loops::vector;

vector some(random_numbers& draw, int n) {
  return vector::NullaryExpr(n, [&] { return draw(); });
}
double off(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b) {
  return (a - b).cwiseAbs().maxCoeff() / (1 + b.cwiseAbs().maxCoeff());
}
Eigen::Vector3d slip_at(const runtime_chain& c, runtime_state& s, const vector& q, const vector& v, const char* name) {
  return detail::take(c, s, q, v).call([&] {
    c.doMotion(s);
    const vec3<>& u = s.contact(name).slip;
    return Eigen::Vector3d(u.x, u.y, u.z);
  });
}
/// A table of 4 kg, 0.6 m by 0.4 m, on its corners, with a fifth foot inside and one in the air.
runtime_chain table() {
  runtime_chain c;
  c.gravity(along_z(-10.0)) << free_joint_3D("pose", "ground", "table")
                            << inertia_3D("table", rigid_body<>{4.0, vec3<>{}, sym3<>{0.1, 0, 0, 0.1, 0, 0.1}});
  const auto leg = [&c](const std::string& name, double x, double y, double z) {
    c << rigid_link_3D("table", "end of " + name, vec3<>{x, y, z})
      << point_contact_3D(name, "ground", "end of " + name, half_space{}, {0.5, 0});
  };
  leg("1", 0.3, 0.2, -0.5), leg("2", -0.3, 0.2, -0.5), leg("3", -0.3, -0.2, -0.5), leg("4", 0.3, -0.2, -0.5);
  leg("5", 0.1, 0.05, -0.5), leg("air", 0.6, 0.0, -0.4);
  return c;
}
vector numbers_of(std::initializer_list<double> x) {
  return Eigen::Map<const vector>(std::data(x), static_cast<int>(x.size()));
}

TEST_CASE("Jacobians of contacts give their velocities, and rates the derivatives of these") {
  random_numbers draw(8);
  scene at;
  at.height = -0.4;
  const auto fixed = at.touching();
  runtime_chain c;
  c << fixed;
  auto s = c.make_state();
  const vector q = integrate(c, neutral_configuration(c), vector(0.5 * some(draw, scene_dofs)), 1.0),
               v = some(draw, scene_dofs);
  for (const char* name : {"on floor", "on hill"}) {
    INFO(name);
    const Eigen::MatrixXd j = contact_jacobian(c, s, q, name), rate = contact_jacobian_rate(c, s, q, v, name);
    CHECK(off(j * v, slip_at(c, s, q, v, name)) <= 1e-14);
    const auto along = [&](double t) { return contact_jacobian(c, s, integrate(c, q, v, t), name); };
    const double h = 1e-3;
    CHECK(off(rate, (8 * (along(h) - along(-h)) - (along(2 * h) - along(-2 * h))) / (12 * h)) <= 1e-10);
  }
  const Eigen::MatrixXd both = contact_jacobian(c, s, q, at_contacts("on hill", "on floor"));
  CHECK(both.topRows(3) == contact_jacobian(c, s, q, "on hill"));
  CHECK(both.bottomRows(3) == contact_jacobian(c, s, q, "on floor"));
  CHECK(contact_jacobian(fixed, q, on_hill) == both.topRows(3));
  CHECK(contact_jacobian(fixed, q, at_contacts(on_hill, on_floor)) == both);
  CHECK(contact_jacobian_rate(fixed, q, v, on_hill) == contact_jacobian_rate(c, s, q, v, "on hill"));
  const auto touches = [&](const char* name) {
    set_positions(s, q), c.doMotion(s);
    return s.contact(name).gap <= 0 ? 3 : 0;
  };
  CHECK(contact_jacobian(c, s, q, at_contacts()).rows() == touches("on floor") + touches("on hill"));
  CHECK_THROWS_MATCHES(contact_jacobian(c, s, q, "hand"), unknown_name, says("no contact 'hand'"));
  for (const auto& twice : {at_contacts("on hill", "on floor", "on hill"), at_contacts("on hill", "on hill")})
    CHECK_THROWS_MATCHES(contact_jacobian(c, s, q, twice), bad_argument, says("at_contacts: 'on hill' is named twice"));
  CHECK_THROWS_AS(contact_jacobian(fixed, q, at_contacts(on_hill, on_hill)), bad_argument);
  runtime_chain none;
  none << at.tree();
  auto t = none.make_state();
  CHECK_THROWS_MATCHES(contact_jacobian(none, t, q, at_contacts()), bad_argument, says("no contacts"));
}

TEST_CASE("Jacobians of contacts in the plane have two rows") {
  runtime_chain c;
  c << prismatic_joint_2D("x", "world", "a", axis::x) << inertia_2D("a", point_mass(1.0))
    << revolute_joint_2D("turn", "a", "arm") << rigid_link_2D("arm", "tip", vec2{0.5, 0.1})
    << inertia_2D("tip", point_mass(1.0)) << sphere_contact_2D("c", "world", "tip", ball_surface(0.7), 0.1, {0.3, 0});
  auto s = c.make_state();
  const vector q = numbers_of({0.3, 0.8}), v = numbers_of({1.0, -2.0});
  const Eigen::MatrixXd j = contact_jacobian(c, s, q, "c"), rate = contact_jacobian_rate(c, s, q, v, "c");
  REQUIRE(j.rows() == 2);
  CHECK(off(j * v, slip_at(c, s, q, v, "c").head(2)) <= 1e-15);
  const auto along = [&](double t) { return contact_jacobian(c, s, vector(q + t * v), "c"); };
  const double h = 1e-3;
  CHECK(off(rate, (8 * (along(h) - along(-h)) - (along(2 * h) - along(-2 * h))) / (12 * h)) <= 1e-10);
}

TEST_CASE("operational-space inertia is the inverse of J M^-1 J^T") {
  random_numbers draw(9);
  const auto fixed = scene{}.touching();
  runtime_chain c;
  c << fixed;
  auto s = c.make_state();
  const vector q = integrate(c, neutral_configuration(c), vector(0.5 * some(draw, scene_dofs)), 1.0);
  const auto both = at_contacts("on floor", "on hill");
  const Eigen::MatrixXd j = contact_jacobian(c, s, q, both), mass = mass_matrix(c, s, q);
  const Eigen::MatrixXd w = j * mass.llt().solve(j.transpose());
  CHECK(off(delassus_matrix(c, s, q, both), w) <= 1e-13);
  CHECK(off(operational_inertia(c, s, q, both) * w, Eigen::MatrixXd::Identity(6, 6)) <= 1e-12);
  CHECK(off(operational_inertia(fixed, q, at_contacts(on_floor, on_hill)), operational_inertia(c, s, q, both)) <=
        1e-12);
  CHECK(off(delassus_matrix(fixed, q, at_contacts(on_floor, on_hill)), w) <= 1e-13);
  const Eigen::MatrixXd k = jacobian(c, s, q, "body", in_world_axes), own = jacobian(c, s, q, "body");
  CHECK(off(operational_inertia(c, s, q, "body", in_world_axes) * (k * mass.llt().solve(k.transpose())),
            Eigen::MatrixXd::Identity(6, 6)) <= 1e-12);
  CHECK(off(operational_inertia(c, s, q, "body") * (own * mass.llt().solve(own.transpose())),
            Eigen::MatrixXd::Identity(6, 6)) <= 1e-12);
  CHECK(off(operational_inertia(fixed, q, body), operational_inertia(c, s, q, "body")) <= 1e-12);
  CHECK(off(operational_inertia(fixed, q, body, in_world_axes), operational_inertia(c, s, q, "body", in_world_axes)) <=
        1e-12);
  // A carriage moves along one axis only
  CHECK_THROWS_MATCHES(operational_inertia(c, s, q, "carriage"), no_solution, says("cannot accelerate"));
  auto flat = table();
  auto t = flat.make_state();
  CHECK_THROWS_MATCHES(operational_inertia(flat, t, numbers_of({0, 0, 0.5, 1, 0, 0, 0}), at_contacts()), no_solution,
                       says("cannot accelerate in all directions"));
}

TEST_CASE("the support polygon is the convex hull of points that touch") {
  auto c = table();
  auto s = c.make_state();
  const vector q = numbers_of({1, 2, 0.5, 1, 0, 0, 0});
  const auto r = support_polygon(c, s, q);
  CHECK(r.contacts == std::vector<std::string>{"1", "2", "3", "4", "5"});
  REQUIRE(r.corners.size() == 4);
  CHECK(r.area() == within(0.24, 1e-15));
  CHECK(r.margin({1, 2, 0.3}) == within(0.2, 1e-15));
  CHECK(r.margin({1.25, 2, 0}) == within(0.05, 1e-15));
  CHECK(r.margin({1.6, 2.6, 0}) == within(-0.5, 1e-15));
  const auto triangle = support_polygon(c, s, q, at_contacts("1", "2", "5"));
  CHECK(triangle.corners.size() == 3);
  CHECK(triangle.area() == within(0.5 * 0.6 * 0.15, 1e-15));
  const auto line = support_polygon(c, s, q, at_contacts("1", "3"));
  CHECK((line.corners.size() == 2 && line.area() == 0));
  CHECK(line.margin({1.3, 2.3, 0}) == within(-0.1, 1e-15));
  CHECK(support_polygon(c, s, q, at_contacts("2")).corners.size() == 1);
  CHECK_THROWS_MATCHES(support_polygon(c, s, numbers_of({1, 2, 0.9, 1, 0, 0, 0})), no_solution,
                       says("no contact touches"));
  // A named contact counts even if it is open: its point is that below it
  CHECK(support_polygon(c, s, q, at_contacts("1", "2", "3", "4", "air")).corners.size() == 5);
  c << point_contact_3D("wall", "ground", "table", half_space{vec3<>{1, 0, 0}}, {0.5, 0})
    << point_contact_3D("below", "end of 1", "ground", half_space{}, {0.5, 0});
  s = c.make_state();
  CHECK_THROWS_MATCHES(support_polygon(c, s, q, at_contacts("1", "wall")), bad_argument,
                       says("'1' and 'wall' are not on one plane"));
  CHECK_THROWS_MATCHES(support_polygon(c, s, q, at_contacts("1", "below")), bad_argument,
                       says("'1' and 'below' are on different frames"));
}

TEST_CASE("the centre of pressure is where forces have no moment along the plane") {
  auto c = table();
  auto s = c.make_state();
  const vector q = numbers_of({1, 2, 0.5, 1, 0, 0, 0}), still = vector::Zero(6);
  // Force 40 N; torques 2 Nm about x, 4 Nm about y: y N + 2 = 0, -x N + 4 = 0
  contact_dynamics(c, s, q, still, numbers_of({0, 0, 0, 2, 4, 0}));
  const vec3<> p = centre_of_pressure(c, s);
  CHECK(p.x == within(1 + 0.1, 1e-10));
  CHECK(p.y == within(2 - 0.05, 1e-10));
  CHECK(p.z == within(0, 1e-15));
  const vec3<> line = centre_of_pressure(c, s, at_contacts("1", "4"));
  CHECK(line.x == within(1.3, 1e-12));
  contact_dynamics(c, s, q, still, numbers_of({0, 0, 50, 0, 0, 0}));
  CHECK_THROWS_MATCHES(centre_of_pressure(c, s), no_solution, says("no contact has a normal force"));
}

TEST_CASE("support polygon and centre of pressure of static chains") {
  scene at;
  at.friction_of_floor = 1, at.size = 0.01;  // the foot is in the air
  const auto level = at.tree();
  const vector q = neutral_configuration(level), still = vector::Zero(scene_dofs);
  at.height = heel.z - radius;
  const auto c = at.touching();
  const auto r = support_polygon(c, q);
  CHECK(r.contacts == std::vector<std::string>{"on floor"});
  CHECK(r.corners.size() == 1);
  const vec3<> p = centre_of_pressure(c, q, still, still), d = p - vec3<>{heel.x, heel.y, 0};
  CHECK(dot(d, d) <= 1e-30);
}

TEST_CASE("contact dynamics allocates nothing after the first call") {
  scene at;
  at.friction_of_floor = 3, at.size = 0.01;
  const auto level = at.tree();
  vector q = neutral_configuration(level);
  at.height = heel.z - radius;
  const auto fixed = at.touching();
  runtime_chain c;
  c << fixed;
  auto s = c.make_state();
  const vector v = vector::Zero(scene_dofs), tau = vector::Zero(scene_dofs);
  contact_dynamics(c, s, q, v, tau), impact(c, s, q, v);
  CHECK(allocations::during([&] { contact_dynamics(c, s, q, v, tau); }) == 0);
  CHECK(mode_of(s.contact("on floor")) == contact_mode::sticks);
  (void)contact_dynamics(fixed, q, v, tau);
  CHECK(allocations::during([&] { (void)contact_dynamics(fixed, q, v, tau); }) == 0);
  auto flat = table();
  auto t = flat.make_state();
  const vector stands = numbers_of({1, 2, 0.5, 1, 0, 0, 0}), none = vector::Zero(6);
  contact_dynamics(flat, t, stands, none, none);
  CHECK(allocations::during([&] { contact_dynamics(flat, t, stands, none, none); }) == 0);
}

}  // namespace contact_control_test
