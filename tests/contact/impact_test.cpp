#include <kte/contacts.hpp>
#include <kte/elements/rigid_contact.hpp>
#include <kte/kte.hpp>

#include "catch.hpp"
#include "closed_loops/mechanisms.hpp"
#include "random.hpp"

namespace impact_test {

using namespace kte;
using namespace kte::test;
using namespace kte::test::loops;

constexpr double g = 9.81;
double largest(const vector& x) { return x.cwiseAbs().maxCoeff(); }
vector zeros(int n) { return vector::Zero(n); }

/// A rod of 1 kg and 2 m whose tip touches the floor, at an angle above the horizontal; v in axes of the world.
struct rod {
  double angle;
  runtime_chain c;
  runtime_state s;
  rod(double angle_, const contact_law& law) : angle(angle_), c(chain_with(law)), s(c.make_state()) {}
  static runtime_chain chain_with(const contact_law& law) {
    runtime_chain c;
    c.gravity(along_y(-g)) << free_joint_2D("pose", "world", "rod") << inertia_2D("rod", planar_body(1.0, 1.0 / 3))
                           << rigid_link_2D("rod", "tip", along_x(-1.0))
                           << point_contact_2D("tip", "world", "tip", half_space{}, law);
    return c;
  }
  vector q() const { return numbers({std::cos(angle), std::sin(angle), angle}); }
  /// v where the tip moves by (x, y) and the rod turns by w.
  vector v(double x, double y, double w) const { return to_body(x - w * std::sin(angle), y + w * std::cos(angle), w); }
  vector to_body(double x, double y, double w) const {
    const double cs = std::cos(angle), sn = std::sin(angle);
    return numbers({cs * x + sn * y, -sn * x + cs * y, w});
  }
};
double energy(const runtime_chain& c, runtime_state& s, const vector& q, const vector& v) {
  const Eigen::MatrixXd m = mass_matrix(c, s, q);
  return v.dot(m * v) / 2;
}

TEST_CASE("Painleve's rod: no forces, and the tangential impact") {
  rod x(1, {2, 0});
  CHECK_THROWS_MATCHES(contact_dynamics(x.c, x.s, x.q(), x.v(-1, 0, 0), zeros(3)), no_solution,
                       says("contacts 'tip': a jam (Painleve): kte::impact"));
  const auto& r = impact(x.c, x.s, x.q(), x.v(-1, 0, 0));
  CHECK(r.impulse("tip").y == within(0.34098653505963, 1e-14));
  CHECK(r.impulse("tip").x == within(0.46894493629482, 1e-14));
  CHECK(largest(r.v - x.to_body(-0.53105506370518, 0.34098653505963, 0.63110323860592)) <= 2e-14);
  CHECK(r.energy < 0);
  // With omega = 5 there are two solutions
  const auto& two = contact_dynamics(x.c, x.s, x.q(), x.v(-1, 0, 5), zeros(3));
  CHECK(two.several);
}

TEST_CASE("Newton's restitution with friction would gain energy: all coefficients are reduced") {
  rod x(0.8, {0.5, 0.9});
  const vector v = x.v(0.5, -1, 0);
  const auto& r = impact(x.c, x.s, x.q(), v);
  CHECK(r.restitution == within(0.8971651092469972, 1e-12));
  CHECK(std::abs(r.energy) <= 1e-14);
  CHECK(energy(x.c, x.s, x.q(), r.v) == within(energy(x.c, x.s, x.q(), v), 1e-14));
}

TEST_CASE("a cradle of five: one after the other, and all at once") {
  runtime_chain c;
  for (int i = 0; i < 5; ++i) {
    const auto k = std::to_string(i);
    c << prismatic_joint_2D("x" + k, "world", "b" + k, axis::x) << inertia_2D("b" + k, point_mass(1.0));
  }
  for (int i = 0; i < 4; ++i)
    c << point_contact_2D("c" + std::to_string(i), "b" + std::to_string(i), "b" + std::to_string(i + 1),
                          half_space{axis::x}, {0, 1});
  auto s = c.make_state();
  const vector q = zeros(5), v = numbers({1, 0, 0, 0, 0});
  const auto& once = impact(c, s, q, v);
  CHECK(largest(once.v - numbers({-0.6, 0.4, 0.4, 0.4, 0.4})) <= 1e-15);
  const auto& after = impact(c, s, q, v, impact_law::sequential);
  CHECK(largest(after.v - numbers({0, 0, 0, 0, 1})) <= 1e-15);
  CHECK(after.impulse("c3").x == within(1, 1e-15));
  CHECK(std::abs(after.energy) <= 1e-15);
}

TEST_CASE("a rimless wheel keeps the factor eta of its rate at each spoke") {
  // 8 spokes of 1 m, 1 kg, 0.1 kg m^2: it turns about one foot until the next one strikes
  const double I = 0.1, half = std::numbers::pi / 8, eta = (I + std::cos(2 * half)) / (I + 1);
  CHECK(eta == within(0.7337334374423159, 1e-15));
  runtime_chain c;
  c << free_joint_2D("pose", "world", "hub") << inertia_2D("hub", planar_body(1.0, I));
  for (int i = 0; i < 2; ++i) {
    const auto k = std::to_string(i);
    c << rigid_link_2D("hub", "f" + k, vec2{(i == 0 ? -1 : 1) * std::sin(half), -std::cos(half)})
      << point_contact_2D("foot" + k, "world", "f" + k, half_space{}, {10, 0});
  }
  auto s = c.make_state();
  // Rolls to the right about foot 0, at (-sin, -cos) of the hub: v = w x (sin, cos)
  const double w = -1.5;
  const auto& r = impact(c, s, numbers({0, std::cos(half), 0}), numbers({-w * std::cos(half), w * std::sin(half), w}));
  CHECK(r.v[2] == within(eta * w, 2e-15));
  CHECK(largest(r.v - eta * w * numbers({-std::cos(half), -std::sin(half), 1})) <= 2e-15);
  CHECK(std::abs(r.impulse("foot0").y) <= 1e-15);
  CHECK(r.energy == within((eta * eta - 1) * (I + 1) * w * w / 2, 4e-15));
}

TEST_CASE("a sphere with spin bounces") {
  const double R = 0.1, m = 2, I = 0.008, mu = 0.2, e = 0.5;
  runtime_chain c;
  c << free_joint_3D("pose", "world", "body") << inertia_3D("body", rigid_body<>{m, vec3<>{}, sym3<>{I, 0, 0, I, 0, I}})
    << sphere_contact_3D("c", "world", "body", half_space{}, R, {mu, e});
  auto s = c.make_state();
  const vector q = numbers({0, 0, R, 1, 0, 0, 0});
  // Fast spin about y: it slips throughout, P_t = mu P_n; u = v - R w x n = (v_x - R w_y, v_y + R w_x, v_z)
  const double P = m * (1 + e) * 3;
  const auto& slips = impact(c, s, q, numbers({0, 0, -3, 0, 100, 5}));
  CHECK(largest(slips.v - numbers({mu * P / m, 0, e * 3, 0, 100 - R * mu * P / I, 5})) <= 1e-13);
  CHECK(slips.impulse("c").x == within(mu * P, 1e-14));
  // Slow spin: it sticks, u_t = 0 with W_t = 1/m + R^2/I
  const double halt = (0.3 - R * 5) / (1 / m + R * R / I);
  const auto& stopped = impact(c, s, q, numbers({0.3, 0, -3, 0, 5, 0}));
  CHECK(largest(stopped.v - numbers({0.3 - halt / m, 0, e * 3, 0, 5 + R * halt / I, 0})) <= 1e-13);
}

TEST_CASE("on a base that moves, velocities of the surface count") {
  runtime_chain c;
  c << base_2D("belt") << base_2D("world") << prismatic_joint_2D("x", "world", "a", axis::x)
    << prismatic_joint_2D("y", "a", "block", axis::y) << inertia_2D("block", point_mass(2.0))
    << point_contact_2D("c", "belt", "block", half_space{}, {0.5, 0.25});
  auto s = c.make_state();
  s.frame_2D("belt").velocity = {3, 1};
  // Relative to the belt: (-3, -2) before, (-3 + 0.5 2.5, 0.5) after
  const auto& r = impact(c, s, numbers({0, 0}), numbers({0, -1}));
  CHECK(largest(r.v - numbers({1.25, 1.5})) <= 1e-14);
}

TEST_CASE("in random impacts energy never grows, and momentum is balanced") {
  random_numbers draw(7);
  runtime_chain c;
  const double Ix = 0.02, Iy = 0.03, Iz = 0.04, m = 2;
  const auto corner = [](int i) { return vec3<>{i & 1 ? 0.2 : -0.2, i & 2 ? 0.1 : -0.1, -0.05}; };
  c << free_joint_3D("pose", "world", "box")
    << inertia_3D("box", rigid_body<>{m, vec3<>{}, sym3<>{Ix, 0, 0, Iy, 0, Iz}});
  for (int i = 0; i < 4; ++i)
    c << rigid_link_3D("box", "p" + std::to_string(i), corner(i))
      << point_contact_3D("c" + std::to_string(i), "world", "p" + std::to_string(i), half_space{},
                          {0.2 * (i + 1), 0.3 * i});
  auto s = c.make_state();
  const vector q = numbers({0, 0, 0.05, 1, 0, 0, 0});
  for (int n = 0; n < 1000; ++n) {
    const vector v = vector::NullaryExpr(6, [&] { return draw(); }) - numbers({0, 0, 1, 0, 0, 0});
    const double before = energy(c, s, q, v);
    for (const auto law : {impact_law::at_once, impact_law::sequential}) {
      const auto r = impact(c, s, q, v, law);
      INFO(n);
      REQUIRE(r.energy <= 1e-13);
      REQUIRE(energy(c, s, q, r.v) - before == within(r.energy, 1e-11 * (1 + before)));
      vec3<> sum{}, moment{};
      for (int i = 0; i < 4; ++i) {
        const vec3<> p = r.impulse("c" + std::to_string(i));
        sum = sum + p, moment = moment + cross(corner(i), p);
        REQUIRE(p.z >= 0);
        if (law == impact_law::at_once) REQUIRE(std::hypot(p.x, p.y) <= 0.2 * (i + 1) * p.z * (1 + 1e-9) + 1e-12);
      }
      const vector change = numbers({sum.x / m, sum.y / m, sum.z / m, moment.x / Ix, moment.y / Iy, moment.z / Iz});
      REQUIRE(largest(r.v - v - change) <= 1e-11 * (1 + largest(v)));
    }
  }
}

TEST_CASE("an impact of a linkage puts velocities off its loops onto them, and counts the energy of both") {
  auto c = four_bars(1);
  c << sphere_contact_2D("c", "base", "t1", half_space{}, 0.0, {0.3, 0.5});
  auto s = c.make_state();
  // Bars along x, all points on the floor; velocities off the loop
  const vector v = numbers({-1, -2, 0.5}), at = four_bar_numbers(1, std::numbers::pi / 2);
  const double before = energy(c, s, at, v);
  const auto& r = impact(c, s, at, v);
  CHECK(largest(loop_jacobian(c, s, at) * r.v) <= 1e-14);
  CHECK(energy(c, s, at, r.v) - before == within(r.energy, 1e-13));
}

TEST_CASE("a jam is a tangential impact, and static chains have the same impacts") {
  struct world_ final : frame_2D_key<"world"> {};
  struct body_ final : frame_2D_key<"rod"> {};
  struct tip_ final : frame_2D_key<"tip"> {};
  struct pose_ final : pose_2D_key<"pose"> {};
  struct foot_ final : contact_key<"tip"> {};
  constexpr world_ world{};
  constexpr body_ body{};
  constexpr tip_ tip{};
  constexpr foot_ foot{};
  for (const contact_law law : {contact_law{2, 0}, contact_law{0.5, 0.9}}) {
    const auto c = chain(free_joint_2D(pose_{}, world, body), inertia_2D(body, planar_body(1.0, 1.0 / 3)),
                         rigid_link_2D(body, tip, along_x(-1.0)), point_contact_2D(foot, world, tip, half_space{}, law))
                       .gravity(along_y(-g));
    rod x(law.friction > 1 ? 1.0 : 0.8, law);
    const vector v = law.friction > 1 ? x.v(-1, 0, 0) : x.v(0.5, -1, 0);
    const auto r = impact(c, x.q(), v);
    const auto& same = impact(x.c, x.s, x.q(), v);
    CHECK(largest(r.v - same.v) <= 1e-14);
    CHECK(r.impulse(foot).y == within(same.impulse("tip").y, 1e-14));
    CHECK(r.energy == within(same.energy, 1e-14));
    CHECK(r.restitution == within(same.restitution, 1e-12));
  }
}

TEST_CASE("contacts apart take no impulse") {
  rod x(1, {0.5, 0.5});
  vector q = x.q();
  q[1] += 1e-3;
  const vector v = x.v(-1, -2, 0.3);
  const auto& r = impact(x.c, x.s, q, v);
  CHECK(largest(r.v - v) == 0);
  CHECK((r.energy == 0 && r.impulse("tip") == vec3<>{}));
  CHECK_THROWS_MATCHES(r.impulse("foot"), unknown_name, says("no contact 'foot'"));
}

}  // namespace impact_test
