#include <kte/contact/height_field.hpp>
#include <kte/contact/surface.hpp>
#include <kte/contacts.hpp>
#include <kte/elements/rigid_contact.hpp>

#include <Eigen/QR>

#include "catch.hpp"
#include "closed_loops/static_four_bar.hpp"
#include "closed_loops/tangle.hpp"
#include "random.hpp"

namespace contact_dynamics_test {

using namespace kte;
using namespace kte::test;
using namespace kte::test::loops;

constexpr double g = 9.81;
/// Results of size 10 after some 50 roundings.
constexpr double rounded = 1e-14 * 10;

vector zeros(int n) { return vector::Zero(n); }
double largest(const vector& x) { return x.size() > 0 ? x.cwiseAbs().maxCoeff() : 0.0; }

/// A box of 2 kg on two corners (+-0.1, -0.05) in gravity (along, -g).
runtime_chain box(double along, const contact_law& law) {
  runtime_chain c;
  c.gravity(vec3<>{along, -g, 0}) << base_2D("world") << free_joint_2D("pose", "world", "box")
                                  << rigid_link_2D("box", "left", vec2{-0.1, -0.05})
                                  << rigid_link_2D("box", "right", vec2{0.1, -0.05})
                                  << inertia_2D("box", planar_body(2.0, 0.02))
                                  << point_contact_2D("l", "world", "left", half_space{}, law)
                                  << point_contact_2D("r", "world", "right", half_space{}, law);
  return c;
}
/// A body of 2 kg and 0.02 kg m^2 in the plane with a contact.
template <class Contact>
runtime_chain disc(const Contact& contact, const vec3<>& gravity = {0, -g, 0}) {
  runtime_chain c;
  c.gravity(gravity) << base_2D("world") << free_joint_2D("pose", "world", "body")
                     << inertia_2D("body", planar_body(2.0, 0.02)) << contact;
  return c;
}
/// A sphere of 2 kg and radius 0.1 m in space with a contact; 0.008 kg m^2.
template <class Contact>
runtime_chain sphere(const Contact& contact, const vec3<>& gravity = {0, 0, -g}) {
  runtime_chain c;
  c.gravity(gravity) << free_joint_3D("pose", "world", "body")
                     << inertia_3D("body", rigid_body<>{2.0, vec3<>{}, sym3<>{0.008, 0, 0, 0.008, 0, 0.008}})
                     << contact;
  return c;
}

TEST_CASE("a box on a slope slides, sticks, and begins to slide") {
  const double mu = 0.2;
  const vector q = numbers({0, 0.05, 0});
  const auto find = [&](double along, double speed) {
    auto c = box(along, {mu, 0});
    auto s = c.make_state();
    return contact_dynamics(c, s, q, numbers({speed, 0, 0}), zeros(3));
  };
  // Forces by moments about the mass: (r_y - l_y) 0.1 + 0.05 f_x = 0
  // of forces that are not unique, where both corners stick, those of least norm, to 1e-12 of them
  const auto check = [](const contact_dynamics_result& r, double a, double friction, contact_mode mode) {
    CHECK(largest(r.a - numbers({a, 0, 0})) <= (mode == contact_mode::sticks ? 1e-11 : rounded));
    const vec3<> l = r.force("l"), right = r.force("r");
    CHECK(l.x + right.x == within(friction, 10 * rounded));
    CHECK(l.y == within(g + 0.25 * friction, 1e-11));
    CHECK(right.y == within(g - 0.25 * friction, 1e-11));
    CHECK((mode_of(r.contact("l")) == mode && mode_of(r.contact("r")) == mode));
    CHECK(!r.several);
  };
  check(find(3, 2), 3 - mu * g, -2 * mu * g, contact_mode::slides);
  check(find(3, -2), 3 + mu * g, 2 * mu * g, contact_mode::slides);
  check(find(1.5, 0), 0, -3, contact_mode::sticks);
  check(find(3, 0), 3 - mu * g, -2 * mu * g, contact_mode::slides);
  CHECK(find(3, 0).contact("l").direction.x == within(1, 1e-15));
  CHECK(find(3, -2).contact("r").direction.x == within(-1, 1e-15));
  CHECK(find(3, 2).contact("l").slip.x == within(2, 1e-15));
}

TEST_CASE("a box that lifts off or turns over its corner has open contacts") {
  auto c = box(0, {0.5, 0});
  auto s = c.make_state();
  const auto& r = contact_dynamics(c, s, numbers({0, 0.05, 0}), zeros(3), numbers({0, 30, 0}));
  CHECK(largest(r.a - numbers({0, 15 - g, 0})) <= rounded);
  CHECK((mode_of(r.contact("l")) == contact_mode::open && r.force("l") == vec3<>{}));
  // A torque about the right corner, which sticks: (0.02 + 2 (0.1^2 + 0.05^2)) w' = -(5 - 2 g 0.1)
  const double turn = -(5 - 2 * g * 0.1) / 0.045;
  const auto& t = contact_dynamics(c, s, numbers({0, 0.05, 0}), zeros(3), numbers({0, 0, -5}));
  if (std::abs(t.force("r").x) <= 0.5 * t.force("r").y) CHECK(t.a[2] == within(turn, 100 * rounded));
  CHECK(mode_of(t.contact("l")) == contact_mode::open);
  CHECK(mode_of(t.contact("r")) != contact_mode::open);
  // No velocity apart: contacts that separate are open
  CHECK(contact_dynamics(c, s, numbers({0, 0.05, 0}), numbers({0, 1e-3, 0}), zeros(3)).a[1] == within(-g, rounded));
}

TEST_CASE("a sphere slips, then rolls") {
  const double mu = 0.2, r = 0.1;
  auto c = disc(sphere_contact_2D("c", "world", "body", half_space{}, r, {mu, 0}));
  auto s = c.make_state();
  const vector q = numbers({0.3, r, 0});
  const auto& slips = contact_dynamics(c, s, q, numbers({1, 0, 0}), zeros(3));
  CHECK(largest(slips.a - numbers({-mu * g, 0, -mu * g * 2 * r / 0.02})) <= 10 * rounded);
  // Rolls on a slope: (m + I/r^2) a = m g_x
  c.gravity(vec3<>{0.3, -g, 0});
  s = c.make_state();
  const double a = 2 * 0.3 / (2 + 0.02 / (r * r));
  const auto& rolls = contact_dynamics(c, s, q, numbers({1, 0, -1 / r}), zeros(3));
  CHECK(largest(rolls.a - numbers({a, 1 / r, -a / r})) <= 10 * rounded);  // in axes of the body: - w x v
  CHECK(mode_of(rolls.contact("c")) == contact_mode::sticks);
  CHECK(rolls.contact("c").point.x == within(0.3, 1e-16));
}

TEST_CASE("friction in space is opposite to the velocity of sliding") {
  const double mu = 0.3, r = 0.1;
  auto c = sphere(sphere_contact_3D("c", "world", "body", half_space{}, r, {mu, 0}));
  auto s = c.make_state();
  const vector q = numbers({0, 0, r, 1, 0, 0, 0});
  // u = v - r w x n
  const auto& x = contact_dynamics(c, s, q, numbers({0.3, 0.4, 0, 0, 0, 7}), zeros(6));
  const double alpha = mu * 2 * g * r / 0.008;
  CHECK(largest(x.a - numbers({-mu * g * 0.6, -mu * g * 0.8, 0, 0.8 * -alpha, 0.6 * alpha, 0}) -
                numbers({7 * 0.4, -7 * 0.3, 0, 0, 0, 0})) <= 10 * rounded);  // v in axes of the body: - w x v
  CHECK(x.contact("c").direction.x == within(0.6, 1e-15));
  // From rest under a force: sliding starts along the acceleration of the point
  const auto& y = contact_dynamics(c, s, q, zeros(6), numbers({30, 40, 0, 0, 0, 0}));
  CHECK(y.contact("c").direction.x == within(0.6, 1e-12));
  CHECK(y.contact("c").direction.y == within(0.8, 1e-12));
  CHECK(y.force("c").x == within(-mu * 2 * g * 0.6, 1e-10));
  CHECK(y.a[0] == within((30 - mu * 2 * g * 0.6) / 2, 1e-10));
}

TEST_CASE("a rod whose tip stands on the floor falls") {
  const double l = 1, I = 1.0 / 3, angle = 1.1, w = 0.7;
  const auto rod = [&](double mu) {
    runtime_chain c;
    c.gravity(along_y(-g)) << free_joint_2D("pose", "world", "rod") << inertia_2D("rod", planar_body(1.0, I))
                           << rigid_link_2D("rod", "tip", along_x(-l))
                           << point_contact_2D("tip", "world", "tip", half_space{}, {mu, 0});
    return c;
  };
  const double cs = std::cos(angle), sn = std::sin(angle);
  const vector q = numbers({l * cs, l * sn, angle});
  {  // Without friction the mass falls along y: y' = l cos w; N (1 + l^2 cos^2/I) = g - l sin w^2
    auto c = rod(0);
    auto s = c.make_state();
    const double fall = l * cs * w, n = (g - l * sn * w * w) / (1 + l * l * cs * cs / I);
    const auto& r = contact_dynamics(c, s, q, numbers({fall * sn, fall * cs, w}), zeros(3));
    CHECK(r.force("tip").y == within(n, 10 * rounded));
    CHECK(r.a[2] == within(-n * l * cs / I, 10 * rounded));
    CHECK(mode_of(r.contact("tip")) == contact_mode::slides);
  }
  {  // A tip that sticks is a hinge
    auto c = rod(5);
    auto s = c.make_state();
    const auto& r = contact_dynamics(c, s, q, numbers({0, l * w, w}), zeros(3));
    CHECK(r.a[2] == within(-g * l * cs / (I + l * l), 10 * rounded));
    CHECK(r.force("tip").x == within(-l * cs * w * w - l * sn * r.a[2], 10 * rounded));
    CHECK(mode_of(r.contact("tip")) == contact_mode::sticks);
  }
}

TEST_CASE("both frames of a contact move: a block on a carriage") {
  const double mu = 0.3, carriage = 3, block = 2;
  runtime_chain c;
  c.gravity(along_y(-g)) << prismatic_joint_2D("x", "world", "a", axis::x) << inertia_2D("a", point_mass(carriage))
                         << prismatic_joint_2D("y", "world", "b", axis::y)
                         << prismatic_joint_2D("z", "b", "block", axis::x) << inertia_2D("block", point_mass(block))
                         << point_contact_2D("c", "a", "block", half_space{}, {mu, 0});
  auto s = c.make_state();
  const auto& together = contact_dynamics(c, s, numbers({0.2, 0, 0.1}), numbers({1, 0, 1}), numbers({10, 0, 0}));
  CHECK(largest(together.a - numbers({2, 0, 2})) <= rounded);
  CHECK(mode_of(together.contact("c")) == contact_mode::sticks);
  const auto& apart = contact_dynamics(c, s, numbers({0.2, 0, 0.1}), numbers({1, 0, 1}), numbers({30, 0, 0}));
  CHECK(largest(apart.a - numbers({(30 - mu * block * g) / carriage, 0, mu * g})) <= rounded);
  CHECK(apart.contact("c").direction.x == within(-1, 1e-15));
}

TEST_CASE("surfaces of bases that move: a block on a belt") {
  runtime_chain c;
  c.gravity(along_y(-g)) << base_2D("belt") << base_2D("world") << prismatic_joint_2D("x", "world", "a", axis::x)
                         << prismatic_joint_2D("y", "a", "block", axis::y) << inertia_2D("block", point_mass(2.0))
                         << point_contact_2D("c", "belt", "block", half_space{}, {0.3, 0});
  auto s = c.make_state();
  s.frame_2D("belt").velocity = {2, 0};
  const auto& r = contact_dynamics(c, s, numbers({0, 0}), numbers({0.5, 0}), zeros(2));
  CHECK(largest(r.a - numbers({0.3 * g, 0})) <= rounded);
  CHECK(r.contact("c").slip.x == within(-1.5, 1e-15));
}

TEST_CASE("in a bowl, on a ball and on a cylinder the curvature bends the path") {
  const double r = 0.1, R = 0.7, angle = 0.4, speed = 1.3;
  const double cs = std::cos(angle), sn = std::sin(angle);
  // Frictionless: along the circle -g sin, towards its centre speed^2/radius
  const auto check = [&](auto&& c, double radius, double inwards) {
    auto s = c.make_state();
    const vec3<> out{sn, -inwards * cs, 0}, along{cs, inwards * sn, 0};
    const auto& x = contact_dynamics(c, s, numbers({radius * out.x, radius * out.y, 0}),
                                     numbers({speed * along.x, speed * along.y, 0}), zeros(3));
    const vec3<> a = -g * along.y * along - speed * speed / radius * out;
    CHECK(largest(x.a - numbers({a.x, a.y, 0})) <= 2 * rounded);
    CHECK(mode_of(x.contact("c")) == contact_mode::slides);
  };
  check(disc(sphere_contact_2D("c", "world", "body", bowl_surface(R), r, {})), R - r, 1);
  check(disc(sphere_contact_2D("c", "world", "body", ball_surface(R), r, {})), R + r, -1);
  check(disc(point_contact_2D("c", "world", "body", ball_surface(R), {})), R, -1);
  check(disc(point_contact_2D("c", "world", "body",
                              surface([R](const auto& p) { return p.x * p.x + p.y * p.y - R * R; }), {})),
        R, -1);
  // Fast enough, a sphere leaves the ball: v^2 > g R cos
  auto c = disc(sphere_contact_2D("c", "world", "body", ball_surface(R), r, {}));
  auto s = c.make_state();
  const auto& off = contact_dynamics(c, s, numbers({0, R + r, 0}), numbers({3, 0, 0}), zeros(3));
  CHECK(largest(off.a - numbers({0, -g, 0})) == 0);
  CHECK(mode_of(off.contact("c")) == contact_mode::open);
  // Along the axis of a cylinder nothing bends
  auto k = sphere(sphere_contact_3D("c", "world", "body", cylinder_surface(R, axis::y), r, {}));
  auto t = k.make_state();
  const auto& on = contact_dynamics(k, t, numbers({0, 0, R + r, 1, 0, 0, 0}), numbers({1, 2, 0, 0, 0, 0}), zeros(6));
  CHECK(largest(on.a - numbers({0, 0, -1 / (R + r), 0, 0, 0})) <= rounded);
}

/// Velocities of a contact for v, in axes of its surface.
vec3<> slip_at(const runtime_chain& c, runtime_state& s, const vector& q, const vector& v, const std::string& name) {
  return detail::take(c, s, q, v).call([&] {
    c.doMotion(s);
    return s.contact(name).slip;
  });
}
Eigen::MatrixXd slip_jacobian(const runtime_chain& c, runtime_state& s, const vector& q, const std::string& name) {
  Eigen::MatrixXd j(3, c.dofs());
  for (int i = 0; i < c.dofs(); ++i) {
    const vec3<> u = slip_at(c, s, q, vector::Unit(c.dofs(), i), name);
    j.col(i) << u.x, u.y, u.z;
  }
  return j;
}
Eigen::Vector3d three(const vec3<>& v) { return {v.x, v.y, v.z}; }
/// A tree on a floating base with feet on both legs and under its hull; each touches its own floor at `heights`, whose
/// normal n leans. `closed`: the legs are closed by a rod.
const vec3<> n{0.48, 0.6, 0.64};
constexpr double radius = 0.05;
runtime_chain standing(const std::array<double, 3>& heights, double mu, bool closed, bool follows) {
  tangle x(follows);
  auto& c = closed ? x.closed : x.open;
  const char* bodies[]{"le", "re", "hull"};
  for (std::size_t i = 0; i < 3; ++i) {
    const auto k = std::to_string(i);
    c << rigid_link_3D("world", "floor" + k, heights[i] * n)
      << sphere_contact_3D("foot" + k, "floor" + k, bodies[i], half_space{n}, radius, {mu, 0});
  }
  if (closed) c << distance_3D("rod", "lb", "rb", 0.5);
  return c;
}
/// Equations of motion and laws of contact at a random state where all feet touch: `sliding` of them slide.
void check_laws(double mu, bool closed, bool follows, int sliding, random_numbers& draw) {
  const auto flat = standing({}, mu, closed, follows);
  const int dofs = flat.dofs();
  const auto some = [&] { return vector(vector::NullaryExpr(dofs, [&] { return draw(); })); };
  const vector q = integrate(flat, neutral_configuration(flat), some(), 1.0);
  auto s = flat.make_state();
  slip_at(flat, s, q, zeros(dofs), "foot0");
  std::array<double, 3> heights{};
  detail::take(flat, s, q, zeros(dofs)).call([&] {
    flat.doMotion(s);
    for (std::size_t i = 0; i < 3; ++i) heights[i] = s.contact("foot" + std::to_string(i)).gap;
  });
  const auto c = standing(heights, mu, closed, follows);
  s = c.make_state();
  tangle without(follows);
  auto tree = without.open.make_state();

  std::array<Eigen::MatrixXd, 3> j;
  Eigen::MatrixXd rows(0, dofs);
  const auto put = [&](const Eigen::MatrixXd& more) {
    rows.conservativeResize(rows.rows() + more.rows(), dofs);
    rows.bottomRows(more.rows()) = more;
  };
  for (std::size_t i = 0; i < 3; ++i) {
    j[i] = slip_jacobian(c, s, q, "foot" + std::to_string(i));
    if (static_cast<int>(i) < sliding)
      put(three(n).transpose() * j[i]);
    else
      put(j[i]);
  }
  vector v = some();
  v -= rows.completeOrthogonalDecomposition().solve(rows * v);
  const vector tau = 20 * some();
  const auto r = contact_dynamics(c, s, q, v, tau);

  // M a = tau - bias + J^T lambda
  vector force = tau - kte::inverse_dynamics(without.open, tree, q, v, zeros(dofs));
  for (std::size_t i = 0; i < 3; ++i) force += j[i].transpose() * three(r.contacts[i].force);
  if (closed) force += loop_jacobian(c, s, q).transpose() * vector::Constant(1, s.loop("rod").force.x);
  const double size = 1 + largest(force);
  CHECK(largest(mass_matrix(without.open, tree, q) * r.a - force) <= 1e-11 * size);

  // u' by differences along q + v t + a t^2/2, h = 1e-3 by four points: 1e-12 of the fifth derivative, 1e-13/h
  for (std::size_t i = 0; i < 3; ++i) {
    const std::string name = "foot" + std::to_string(i);
    const auto at = [&](double t) {
      return three(slip_at(c, s, integrate(c, q, vector(v + t / 2 * r.a), t), v + t * r.a, name));
    };
    const double h = 1e-3;
    const Eigen::Vector3d rate = (8 * (at(h) - at(-h)) - (at(2 * h) - at(-2 * h))) / (12 * h);
    const Eigen::Vector3d u = at(0), f = three(r.contacts[i].force);
    const double apart = rate.dot(three(n)), press = f.dot(three(n));
    const Eigen::Vector3d t = f - press * three(n), turn = rate - apart * three(n);
    const double near = 1e-7 * (1 + largest(r.a));
    INFO(name << ", mode " << r.contacts[i].mode << ", sliding " << sliding);
    CHECK(press >= 0);
    CHECK(apart >= -near);
    CHECK(t.norm() <= mu * press * (1 + 1e-9) + 1e-9);
    switch (mode_of(r.contacts[i])) {
      case contact_mode::open:
        CHECK(press == 0);
        break;
      case contact_mode::sticks:
        CHECK(rate.norm() <= near);
        break;
      case contact_mode::slides:
        CHECK(std::abs(apart) <= near);
        const Eigen::Vector3d d = u.norm() > 1e-6 ? u.normalized() : turn.normalized();
        if (press > 1e-6) CHECK((t + mu * press * d).norm() <= 1e-6 * (1 + press));
        CHECK((three(r.contacts[i].direction) - d).norm() <= 1e-5);
    }
  }
  if (closed) {
    const auto along = [&](double t) -> double {
      return (loop_jacobian(c, s, integrate(c, q, vector(v + t / 2 * r.a), t)) * (v + t * r.a))[0];
    };
    const double h = 1e-3;
    CHECK(std::abs((8 * (along(h) - along(-h)) - (along(2 * h) - along(-2 * h))) / (12 * h)) <=
          1e-7 * (1 + largest(r.a)));
  }
}

TEST_CASE("contacts of trees, of loops and of coordinates that follow others satisfy equations of motion and laws") {
  random_numbers draw(5);
  for (const bool closed : {false, true})
    for (const bool follows : {false, true})
      for (int sliding = 0; sliding < 4; ++sliding) {
        INFO("closed " << closed << ", follows " << follows);
        check_laws(0.4, closed, follows, sliding, draw);
      }
}

TEST_CASE("without contacts that touch, accelerations are those of the chain") {
  random_numbers draw(2);
  auto c = standing({-50, -50, -50}, 0.5, true, false);
  tangle x;
  x.closed << distance_3D("rod", "lb", "rb", 0.5);
  auto s = c.make_state(), free = x.closed.make_state();
  const auto some = [&] { return vector(vector::NullaryExpr(c.dofs(), [&] { return draw(); })); };
  const vector q = integrate(c, neutral_configuration(c), some(), 1.0), v = some(), tau = some();
  const auto& r = contact_dynamics(c, s, q, v, tau);
  const auto& expected = constrained_dynamics(x.closed, free, q, v, tau);
  CHECK(largest(r.a - expected.a) <= 1e-12 * (1 + largest(r.a)));
  CHECK(mode_of(r.contact("foot0")) == contact_mode::open);
  CHECK(r.contact("foot1").gap > 10);
}

inline constexpr struct foot_ final : contact_key<"foot"> {
} foot;

TEST_CASE("a static four-bar that touches a wall has the accelerations and forces of the same at run time") {
  using namespace kte::test::loops::with_keys;
  const auto touching = [&](const auto& radius_of_ball) {
    return chain(four_bar, sphere_contact_2D(foot, base, B2, ball_surface(radius_of_ball), 0.1, {0.3, 0.5}))
        .gravity(along_y(-g));
  };
  const auto measured = touching(0.5);
  const auto q = assemble(measured, guess, held(crank));
  runtime_chain free;
  free << measured;
  auto s = free.make_state();
  detail::take(free, s, q, Eigen::Vector3d(0, 0, 0)).call([&] { free.doMotion(s); });
  const auto c = touching(0.5 + s.contact("foot").gap);
  runtime_chain same;
  same << c;
  s = same.make_state();
  // The rocker's tip moves on a circle about (1, 0), which crosses the ball
  int touches = 0;
  for (const double torque : {0.0, 200.0, -200.0}) {
    const Eigen::Vector3d tau(0, 0, torque), still(0, 0, 0);
    const auto x = contact_dynamics(c, q, still, tau);
    const auto& y = contact_dynamics(same, s, q, still, tau);
    CHECK(largest(x.a - y.a) <= 1e-13 * (1 + largest(y.a)));
    CHECK(three(x.force(foot) - y.force("foot")).norm() <= 1e-12 * (1 + three(y.force("foot")).norm()));
    CHECK(x.contact(foot).mode == y.contact("foot").mode);
    touches += mode_of(x.contact(foot)) != contact_mode::open;
    CHECK(largest(loop_jacobian(same, s, q) * y.a) <= 1e-12 * (1 + largest(y.a)));
    const vector v = consistent_velocities(same, s, q, Eigen::Vector3d(0, 0, torque / 100));
    const auto struck = impact(c, q, v);
    const auto& other = impact(same, s, q, v);
    CHECK(largest(struck.v - other.v) <= 1e-13 * (1 + largest(other.v)));
    CHECK(three(struck.impulse(foot) - other.impulse("foot")).norm() <=
          1e-13 * (1 + three(other.impulse("foot")).norm()));
    CHECK(struck.energy == within(other.energy, 1e-13));
    CHECK(largest(loop_jacobian(same, s, q) * other.v) <= 1e-13 * (1 + largest(other.v)));
  }
  CHECK((touches > 0 && touches < 3));
}

TEST_CASE("errors of contacts name them") {
  const contact_law law{0.5, 0.2};
  auto c = box(0, law);
  auto s = c.make_state();
  const vector q = numbers({0, 0.05, 0}), down = numbers({0, -1, 0});
  CHECK_THROWS_MATCHES(contact_dynamics(c, s, q, down, zeros(3)), bad_argument,
                       says("kte: contact 'l' approaches at 1 m/s: kte::impact"));
  CHECK_THROWS_MATCHES(contact_dynamics(c, s, q, zeros(3), zeros(3)).force("foot"), unknown_name,
                       says("no contact 'foot'"));
  CHECK_THROWS_MATCHES(kte::forward_dynamics(c, s, q, zeros(3), zeros(3)), bad_argument, says("contacts"));
  CHECK_THROWS_MATCHES(kte::inverse_dynamics(c, s, q, zeros(3), zeros(3)), bad_argument, says("contacts"));
  CHECK_THROWS_MATCHES(constrained_dynamics(c, s, q, zeros(3), zeros(3)), bad_argument, says("contacts"));
  CHECK_THROWS_MATCHES(hybrid_dynamics(c, s, q, zeros(3), zeros(3), {"pose"}), bad_argument, says("contacts"));
  const auto refuses = [](const contact_law& bad, const char* why) {
    CHECK_THROWS_MATCHES(box(0, bad), bad_parameter, says(why));
  };
  refuses({-0.1, 0}, "friction must be finite and not negative");
  refuses({std::nan(""), 0}, "friction must be finite");
  refuses({0.5, -0.1}, "restitution must be between 0 and 1");
  refuses({0.5, 1.1}, "restitution must be between 0 and 1");
  CHECK_THROWS_AS(disc(sphere_contact_2D("c", "world", "body", half_space{}, -1.0, law)), bad_parameter);
  auto coin = sphere(disc_contact_3D("c", "world", "body", half_space{}, axis::z, 0.1, law));
  auto t = coin.make_state();
  CHECK_THROWS_MATCHES(contact_dynamics(coin, t, numbers({0, 0, 0, 1, 0, 0, 0}), zeros(6), zeros(6)), bad_argument,
                       says("kte: contact 'c': a disc lies flat"));
  auto centre = sphere(sphere_contact_3D("c", "world", "body", ball_surface(0.5), 0.1, law));
  auto u = centre.make_state();
  CHECK_THROWS_MATCHES(contact_dynamics(centre, u, numbers({0, 0, 0, 1, 0, 0, 0}), zeros(6), zeros(6)), bad_argument,
                       says("kte: contact 'c': its surface has no normal here"));
  CHECK_THROWS_MATCHES(disc(sphere_contact_2D("c", "body", "body", half_space{}, 0.1, law)), bad_wiring,
                       says("both its ends are 'body'"));
  CHECK_THROWS_MATCHES(box_contact_3D("c", "world", "body", half_space{}, vec3{0.1, -0.1, 0.1}, law), bad_parameter,
                       says("half the lengths of a box must be finite and positive, got -0.1"));
  // The state is as before
  CHECK(s.pose_2D("pose").velocity.y == 0);
}

}  // namespace contact_dynamics_test
