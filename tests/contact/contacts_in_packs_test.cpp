#include <kte/contacts.hpp>
#include <kte/dynamics/lanes.hpp>
#include <kte/elements/rigid_contact.hpp>
#include <kte/kte.hpp>
#include <kte/loops.hpp>
#include <kte/math/pack.hpp>

#include "catch.hpp"
#include "random.hpp"

namespace contacts_in_packs_test {

using namespace kte;
using namespace kte::test;

using vector = Eigen::VectorXd;
using P = pack<double, 8>;

// clang-format off
inline constexpr struct pose_ final : pose_3D_key<"pose"> {} pose_of_body;
inline constexpr struct knee_ final : coord_key<"knee"> {} knee;
inline constexpr struct world_ final : frame_3D_key<"world"> {} world;
inline constexpr struct body_ final : frame_3D_key<"body"> {} body;
inline constexpr struct hip_ final : frame_3D_key<"hip"> {} hip;
inline constexpr struct shank_ final : frame_3D_key<"shank"> {} shank;
inline constexpr struct foot_ final : frame_3D_key<"foot"> {} foot;
inline constexpr struct corner_ final : contact_key<"a"> {} on_corner;
inline constexpr struct on_foot_ final : contact_key<"c"> {} on_foot;
// clang-format on

/// A body on a corner and the foot of a leg: both touch the ground where the body is level at a height of 0.25.
constexpr auto standing_body(double friction) {
  return chain(free_joint_3D(pose_of_body, world, body),
               inertia_3D(body,
                          rigid_body<>{2.0, vec3<>{0.02, 0.01, 0.03}, sym3<>{0.05, 0.002, 0.001, 0.06, 0.003, 0.04}}),
               rigid_link_3D(body, hip, vec3<>{0.2, 0, 0}), revolute_joint_3D(knee, hip, shank, axis::y),
               inertia_3D(shank, rigid_body<>{0.4, vec3<>{0, 0, -0.1}, sym3<>{0.004, 0, 0, 0.003, 0, 0.002}}),
               rigid_link_3D(shank, foot, vec3<>{0, 0, -0.25}),
               sphere_contact_3D(on_corner, world, body, half_space{}, 0.05, {friction, 0}, vec3<>{-0.2, 0.1, -0.2}),
               point_contact_3D(on_foot, world, foot, half_space{}, {friction, 0}))
      .gravity(along_z(-9.81));
}

/// A box in the plane on two corners.
auto box_on_corners(double friction) {
  runtime_chain c;
  c << base_2D("ground") << free_joint_2D("pose", "ground", "box") << inertia_2D("box", planar_body(2.0, 0.02))
    << rigid_link_2D("box", "left", vec2{-0.1, -0.05}) << rigid_link_2D("box", "right", vec2{0.1, -0.05})
    << point_contact_2D("left foot", "ground", "left", half_space{}, {friction, 0})
    << point_contact_2D("right foot", "ground", "right", half_space{}, {friction, 0});
  c.gravity({0, -9.81, 0});
  return c;
}

/// A rod of 2 m and 1 kg that slides on a tip (Painleve).
runtime_chain rod() {
  runtime_chain c;
  c << prismatic_joint_2D("x", "ground", "a", axis::x) << prismatic_joint_2D("y", "a", "b", axis::y)
    << revolute_joint_2D("turn", "b", "rod") << inertia_2D("rod", planar_body(1.0, 1.0 / 3))
    << rigid_link_2D("rod", "tip", along_x(-1)) << point_contact_2D("touches", "ground", "tip", half_space{}, {2, 0});
  c.gravity({0, -9.81, 0});
  return c;
}

/// Eight states, by columns.
struct states {
  Eigen::MatrixXd q, v, tau;
  explicit states(const runtime_chain& c)
      : q(neutral_configuration(c).replicate(1, 8)), v(Eigen::MatrixXd::Zero(c.dofs(), 8)), tau(v) {}
};
runtime_vector<P> packs(const Eigen::MatrixXd& x) {
  runtime_vector<P> all(x.rows());
  for (Eigen::Index i = 0; i < x.rows(); ++i)
    for (std::size_t lane = 0; lane < 8; ++lane) all[i].set(lane, x(i, static_cast<Eigen::Index>(lane)));
  return all;
}
/// States of the standing_body on its feet, turned about the vertical, that stick with these torques of the knee.
states standing(const runtime_chain& c, random_numbers& draw) {
  states x(c);
  for (Eigen::Index k = 0; k < 8; ++k) {
    const double half = 3 * draw();
    x.q.col(k).head(7) << draw(), draw(), 0.25, std::cos(half), 0, 0, std::sin(half);
    x.tau(6, k) = 0.2 * draw();
  }
  return x;
}
/// States that differ in what contacts do.
states mixed(const runtime_chain& c, random_numbers& draw) {
  states x = standing(c, draw);
  x.v(0, 1) = 1.5;                    // slides
  x.v.col(2) << 0, 0, 0, 0, 0, 2, 0;  // turns: slides in three directions
  x.q(7, 3) = 0.3;                    // the foot is open
  x.tau(6, 4) = -3;                   // the foot begins to leave
  x.tau.col(5).head(2) << 30, 10;     // begins to slide
  x.tau(2, 6) = 60;                   // is lifted
  x.v(2, 7) = 1;                      // has left
  return x;
}

double difference(const vec3<P>& x, std::size_t lane, const vec3<>& y) {
  const vec3<> d{x.x[lane] - y.x, x.y[lane] - y.y, x.z[lane] - y.z};
  return std::sqrt(dot(d, d));
}
/// Compares a lane with a single state, to rounding of accelerations and forces.
template <class A, class X, class Y>
void check_lane(const A& a_of_packs, const X& contacts, std::size_t lane, const vector& a, const Y& expected) {
  INFO("lane " << lane);
  double most = a.cwiseAbs().maxCoeff();
  for (Eigen::Index i = 0; i < a.size(); ++i) CHECK(std::abs(a_of_packs[i][lane] - a[i]) <= 1e-12 * (1 + most));
  for (std::size_t i = 0; i < expected.size(); ++i) {
    const auto& x = contacts[i];
    const auto& y = expected[i];
    CHECK(mode_of(x, lane) == mode_of(y));
    CHECK(std::abs(x.gap[lane] - y.gap) <= 1e-15);
    CHECK(difference(x.slip, lane, y.slip) <= 1e-14);
    CHECK(difference(x.point, lane, y.point) <= 1e-15);
    CHECK(difference(x.direction, lane, y.direction) <= 1e-11);
    CHECK(difference(x.force, lane, y.force) <= 1e-12 * (1 + std::sqrt(dot(y.force, y.force))));
  }
}
/// Packs of a chain, static and at run time, against single states.
template <class Chain>
std::array<int, 3> check_packs(const Chain& fixed, const runtime_chain& c, const states& x) {
  auto many = c.make_state<P>();
  auto single = c.make_state();
  const auto q = packs(x.q), v = packs(x.v), tau = packs(x.tau);
  const auto& r = contact_dynamics(c, many, q, v, tau);
  const auto f = contact_dynamics(fixed, q, v, tau);
  std::array<int, 3> modes{};
  for (std::size_t lane = 0; lane < 8; ++lane) {
    const auto k = static_cast<Eigen::Index>(lane);
    const auto& y = contact_dynamics(c, single, vector(x.q.col(k)), vector(x.v.col(k)), vector(x.tau.col(k)));
    check_lane(r.a, r.contacts, lane, y.a, y.contacts);
    check_lane(f.a, f.contacts, lane, y.a, y.contacts);
    CHECK((!r.several[lane] && !f.several[lane]));
    for (const auto& contact : y.contacts) ++modes[static_cast<std::size_t>(contact.mode)];
  }
  return modes;
}
static_assert(detail::unrolls_contacts<decltype(standing_body(0)), P>);

TEST_CASE("contact dynamics in packs is that of single states") {
  const auto fixed = standing_body(0.6);
  runtime_chain c;
  c << fixed;
  random_numbers draw(5);
  for (int trial = 0; trial < 4; ++trial) CHECK(check_packs(fixed, c, standing(c, draw))[1] == 16);  // all stick
  for (int trial = 0; trial < 4; ++trial)
    for (const int n : check_packs(fixed, c, mixed(c, draw))) CHECK(n >= 3);  // open, sticks, slides
  const auto smooth = standing_body(0);
  runtime_chain on_ice;
  on_ice << smooth;
  CHECK(check_packs(smooth, on_ice, standing(on_ice, draw))[2] == 16);
}

TEST_CASE("accelerations and contact forces in packs satisfy the equations of motion, with the Jacobian in packs") {
  const auto fixed = standing_body(0.6);
  runtime_chain c, bare;
  c << fixed;
  bare << free_joint_3D("pose", "world", "body")
       << inertia_3D("body", rigid_body<>{2.0, vec3<>{0.02, 0.01, 0.03}, sym3<>{0.05, 0.002, 0.001, 0.06, 0.003, 0.04}})
       << rigid_link_3D("body", "hip", vec3<>{0.2, 0, 0}) << revolute_joint_3D("knee", "hip", "shank", axis::y)
       << inertia_3D("shank", rigid_body<>{0.4, vec3<>{0, 0, -0.1}, sym3<>{0.004, 0, 0, 0.003, 0, 0.002}});
  bare.gravity(along_z(-9.81));
  random_numbers draw(11);
  const states x = mixed(c, draw);
  auto many = c.make_state<P>();
  auto single = bare.make_state(), touching = c.make_state();
  const auto q = packs(x.q), v = packs(x.v), tau = packs(x.tau);
  const auto names = at_contacts("a", "c");
  const auto j = contact_jacobian(c, many, q, names), j_static = contact_jacobian(fixed, q, names);
  const auto r = contact_dynamics(c, many, q, v, tau);
  REQUIRE((j.rows() == 6 && j.cols() == 7));
  for (std::size_t lane = 0; lane < 8; ++lane) {
    const auto k = static_cast<Eigen::Index>(lane);
    const vector at = x.q.col(k);
    const Eigen::MatrixXd expected = contact_jacobian(c, touching, at, names);
    vector load = x.tau.col(k), a(7);
    for (Eigen::Index i = 0; i < 7; ++i) a[i] = r.a[i][lane];
    for (Eigen::Index row = 0; row < 6; ++row)
      for (Eigen::Index i = 0; i < 7; ++i) {
        CHECK(std::abs(j(row, i)[lane] - expected(row, i)) <= 1e-15);
        CHECK(j_static(row, i)[lane] == j(row, i)[lane]);
        const auto& f = r.contacts[static_cast<std::size_t>(row / 3)].force;
        load[i] += j(row, i)[lane] * (row % 3 == 0 ? f.x : row % 3 == 1 ? f.y : f.z)[lane];
      }
    const vector left = inverse_dynamics(bare, single, at, vector(x.v.col(k)), a) - load;
    CHECK(left.cwiseAbs().maxCoeff() <= 1e-12);
  }
  CHECK_THROWS_MATCHES(contact_jacobian(c, many, q, at_contacts()), bad_argument,
                       says("kte: contact 'c' touches in some lanes and not in others"));
  CHECK_THROWS_AS(contact_jacobian(c, many, q, "d"), unknown_name);
  states up(c);
  up.q.row(2).setConstant(0.25);
  CHECK(contact_jacobian(c, many, packs(up.q), at_contacts()).rows() == 6);
}

TEST_CASE("lanes with redundant contacts have the forces of least norm of single states") {
  runtime_chain c;
  c << base_3D("ground") << free_joint_3D("pose", "ground", "crate")
    << inertia_3D("crate", rigid_body<>{2.0, vec3<>{0, 0, 0}, sym3<>{0.03, 0, 0, 0.06, 0, 0.08}})
    << box_contact_3D("crate", "ground", "crate", half_space{}, vec3{0.3, 0.2, 0.1}, {.friction = 0.4});
  c.gravity(along_z(-9.81));
  auto many = c.make_state<P>();
  auto single = c.make_state();
  states x(c);
  x.q.row(2).setConstant(0.1);
  for (Eigen::Index k = 0; k < 8; ++k) x.tau(0, k) = 0.5 * static_cast<double>(k), x.v(1, k) = k > 5 ? 1.0 : 0.0;
  const auto& r = contact_dynamics(c, many, packs(x.q), packs(x.v), packs(x.tau));
  for (std::size_t lane = 0; lane < 8; ++lane) {
    const auto k = static_cast<Eigen::Index>(lane);
    const auto& y = contact_dynamics(c, single, vector(x.q.col(k)), vector(x.v.col(k)), vector(x.tau.col(k)));
    for (Eigen::Index i = 0; i < 6; ++i) CHECK(std::abs(r.a[i][lane] - y.a[i]) <= 1e-11);
    for (std::size_t i = 0; i < 8; ++i) {
      CHECK(mode_of(r.contacts[i], lane) == mode_of(y.contacts[i]));
      CHECK(difference(r.contacts[i].force, lane, y.contacts[i].force) <= 1e-9);  // W is singular
    }
  }
}

TEST_CASE("lanes may have other friction, and other masses") {
  const auto fixed = standing_body(0.6);
  runtime_chain c;
  c << fixed;
  const double friction[]{0.05, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7}, mass[]{1, 2, 3, 4, 5, 6, 7, 8};
  random_numbers draw(3);
  states x = standing(c, draw);
  x.tau.row(0).setConstant(6.0);  // lanes with little friction begin to slide
  std::array<parameter<P>, 3> of_lanes{
      {{"a/friction", P::load(friction)}, {"c/friction", P::load(friction)}, {"body/mass", P::load(mass)}}};
  const auto many = kte::lanes(c, std::span<const parameter<P>>(of_lanes));
  auto s = make_state<P>(many);
  const auto& r = contact_dynamics(many, s, packs(x.q), packs(x.v), packs(x.tau));
  int sliding = 0;
  for (std::size_t lane = 0; lane < 8; ++lane) {
    const auto k = static_cast<Eigen::Index>(lane);
    const auto own = kte::lanes(c, parameter{"a/friction", friction[lane]}, parameter{"c/friction", friction[lane]},
                                parameter{"body/mass", mass[lane]});
    auto single = own.make_state();
    const auto& y = contact_dynamics(own, single, vector(x.q.col(k)), vector(x.v.col(k)), vector(x.tau.col(k)));
    check_lane(r.a, r.contacts, lane, y.a, y.contacts);
    sliding += mode_of(r.contact("a"), lane) == contact_mode::slides;
  }
  CHECK((sliding > 0 && sliding < 8));
}

TEST_CASE("a static chain that is computed at run time may have other parameters in each lane") {
  static constexpr struct cart_ final : coord_key<"cart"> {
  } cart;
  static constexpr struct top_ final : frame_3D_key<"top"> {
  } top;
  const double weights[]{1, 2, 3, 4, 5, 6, 7, 8}, loads[]{0.5, 1, 1.5, 2, 2.5, 3, 3.5, 4};
  const auto with = [](const auto& mass, const auto& load) {  // a box on a cart: a surface that moves
    return chain(prismatic_joint_3D(cart, world, top, axis::x), inertia_3D(top, point_mass(mass)),
                 free_joint_3D(pose_of_body, top, body),
                 inertia_3D(body, rigid_body{load, zero3{}, diagonal(0.1, 0.1, 0.1)}),
                 sphere_contact_3D(on_corner, top, body, half_space{}, 0.2, {0.4, 0}))
        .gravity(along_z(-9.81));
  };
  const auto all = with(P::load(weights), P::load(loads));
  static_assert(!detail::unrolls_contacts<std::remove_const_t<decltype(all)>, P>);
  Eigen::Matrix<P, 8, 1> q = Eigen::Matrix<P, 8, 1>::Zero();
  q[3] = P(0.2), q[4] = P(1);
  Eigen::Matrix<P, 7, 1> v = Eigen::Matrix<P, 7, 1>::Zero(), tau = v;
  tau[0] = P(10.0);
  const auto r = contact_dynamics(all, q, v, tau);
  for (std::size_t lane = 0; lane < 8; ++lane) {
    const auto one = with(weights[lane], loads[lane]);
    const vector at = (vector(8) << 0, 0, 0, 0.2, 1, 0, 0, 0).finished(), force = 10 * vector::Unit(7, 0);
    const auto y = contact_dynamics(one, at, vector(vector::Zero(7)), force);
    check_lane(r.a, r.contacts, lane, y.a, y.contacts);
  }
}

TEST_CASE("plane problems in packs tell the lanes with several solutions, and those that are jammed") {
  const auto check = [](const runtime_chain& c, const states& x, int several) {
    auto many = c.make_state<P>();
    auto single = c.make_state();
    const auto& r = contact_dynamics(c, many, packs(x.q), packs(x.v), packs(x.tau));
    for (std::size_t lane = 0; lane < 8; ++lane) {
      const auto k = static_cast<Eigen::Index>(lane);
      const auto& y = contact_dynamics(c, single, vector(x.q.col(k)), vector(x.v.col(k)), vector(x.tau.col(k)));
      check_lane(r.a, r.contacts, lane, y.a, y.contacts);
      CHECK(r.several[lane] == y.several);
      several -= y.several;
    }
    CHECK(several == 0);
  };
  const auto c = box_on_corners(0.3);
  states x(c);
  x.q.row(1).setConstant(0.05);
  for (Eigen::Index k = 0; k < 8; ++k) x.v(0, k) = k % 2 == 0 ? 0.0 : 2.0, x.tau(2, k) = 0.1 * static_cast<double>(k);
  check(c, x, 0);
  const auto painleve = rod();
  states y(painleve);
  const double up = std::sin(1.0), w = 5;
  for (Eigen::Index k = 0; k < 8; ++k) {
    y.q.col(k) << 0.1 * static_cast<double>(k), k == 3 ? 2.0 : up, 1;
    y.v.col(k) << -1 - w * up, w * std::cos(1.0), w;
  }
  check(painleve, y, 7);
  auto s = painleve.make_state<P>();
  y.v.col(2) << -1, 0, 0;
  CHECK_THROWS_MATCHES(
      contact_dynamics(painleve, s, packs(y.q), packs(y.v), packs(y.tau)), no_solution,
      says("kte: lane 2: no contact forces satisfy the laws of friction at contacts 'touches': a jam"));
}

TEST_CASE("a lane without a result refuses the pack, by its number, and leaves the state") {
  const auto fixed = standing_body(0.6);
  runtime_chain c;
  c << fixed;
  auto s = c.make_state<P>();
  random_numbers draw(2);
  const states good = standing(c, draw);
  states x = good;
  const auto refuses = [&](const auto& is) {
    s.coordinate("knee").q = P(0.125);
    CHECK_THROWS_MATCHES(contact_dynamics(c, s, packs(x.q), packs(x.v), packs(x.tau)), bad_argument, is);
    CHECK(s.coordinate("knee").q[5] == 0.125);
    CHECK_THROWS_MATCHES(contact_dynamics(fixed, packs(x.q), packs(x.v), packs(x.tau)), bad_argument, is);
    x = good;
  };
  x.v(2, 3) = -1;
  refuses(says("kte: lane 3: contact 'a' approaches at "));
  for (auto* const m : {&x.q, &x.v, &x.tau}) {
    (*m)(0, 6) = std::numeric_limits<double>::quiet_NaN();
    refuses(says("finite"));
    (*m)(1, 2) = std::numeric_limits<double>::infinity();
    refuses(says("finite"));
  }
  runtime_chain looped = box_on_corners(0.3);
  looped << coincident_points_2D("pin", "left", "ground");
  auto of_loop = looped.make_state<P>();
  const states on_loop(looped);
  CHECK_THROWS_MATCHES(contact_dynamics(looped, of_loop, packs(on_loop.q), packs(on_loop.v), packs(on_loop.tau)),
                       bad_argument, says("kte: contact dynamics in packs: chains with closures of loops"));
}

}  // namespace contacts_in_packs_test
