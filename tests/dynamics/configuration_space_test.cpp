#include <boost/multiprecision/cpp_bin_float.hpp>

#include <sstream>

#include "catch.hpp"
#include "chain/models.hpp"
#include "random.hpp"
#include "robots/solo12.hpp"

// Configurations with rotations and poses in them: where the numbers stand, and how to get from one to another.

using namespace kte;
using big = boost::multiprecision::cpp_bin_float_50;

namespace {

// clang-format off
inline constexpr struct elbow_  final : coord_key<"elbow">      {} elbow;
inline constexpr struct trunk_  final : pose_3D_key<"trunk">    {} trunk;
inline constexpr struct ball_   final : rotation_3D_key<"ball"> {} ball;
inline constexpr struct slide_  final : coord_key<"slide">      {} slide;
inline constexpr struct puck_   final : pose_2D_key<"puck">     {} puck;
inline constexpr struct ground_ final : frame_3D_key<"ground">  {} ground;
inline constexpr struct arm_    final : frame_3D_key<"arm">     {} arm;
inline constexpr struct body_   final : frame_3D_key<"body">    {} body;
inline constexpr struct hand_   final : frame_3D_key<"hand">    {} hand;
inline constexpr struct tip_    final : frame_3D_key<"tip">     {} tip;
inline constexpr struct table_  final : frame_2D_key<"table">   {} table;
inline constexpr struct disc_   final : frame_2D_key<"disc">    {} disc;
// clang-format on

/// Coordinates of all kinds, one moving on the other, and a puck on a table of its own.
constexpr auto model =
    chain(revolute_joint_3D(elbow, ground, arm, axis::x), inertia_3D(arm, point_mass(1.0, along_y(0.5))),
          free_joint_3D(trunk, arm, body), inertia_3D(body, rigid_body{2.0, along_x(0.1), diagonal(0.2, 0.3, 0.4)}),
          spherical_joint_3D(ball, body, hand),
          inertia_3D(hand, rigid_body{1.0, along_z(0.3), diagonal(0.1, 0.1, 0.1)}),
          prismatic_joint_3D(slide, hand, tip, axis::y), inertia_3D(tip, point_mass(0.5)), base_2D(table),
          free_joint_2D(puck, table, disc), inertia_2D(disc, planar_body(0.3, 0.02)))
        .gravity(along_z(-9.81));
constexpr int nq = decltype(model)::nq, nv = decltype(model)::dofs;

const double eps = std::numeric_limits<double>::epsilon();

template <class S, int N>
joint_vector<S, N> random_vector(random_numbers& random, double size) {
  joint_vector<S, N> x;
  for (auto& e : x) e = S(random(size));
  return x;
}
/// From where nothing is turned by constant v, so that its quaternions are of length 1.
template <class S>
joint_vector<S, nq> random_configuration(random_numbers& random) {
  return integrate(model, neutral_configuration<S>(model), random_vector<S, nv>(random, 2), S(1));
}
template <class V>
auto part(const V& x, int first, int n) {
  return x.segment(first, n).eval();
}

// ---- the layout, known at compile time
constexpr auto table_of_model = layout(model);
static_assert(nq == 16 && nv == 14);
static_assert(table_of_model.size() == 5);
static_assert(table_of_model[0] == layout_entry<>{"elbow", kind::gen, 0, 1, 0, 1});
static_assert(table_of_model[1] == layout_entry<>{"trunk", kind::pose_3D, 1, 7, 1, 6});
static_assert(table_of_model[2] == layout_entry<>{"ball", kind::rotation_3D, 8, 4, 7, 3});
static_assert(table_of_model[3] == layout_entry<>{"slide", kind::gen, 12, 1, 10, 1});
static_assert(table_of_model[4] == layout_entry<>{"puck", kind::pose_2D, 13, 3, 11, 3});
static_assert(layout(robots::solo12).size() == 13 && decltype(robots::solo12)::nq == 19);

}  // namespace

TEST_CASE("the layout says where coordinates stand, the same at run time", "[configuration]") {
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

TEST_CASE("coordinates given from outside or written are not in the layout", "[configuration]") {
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

TEST_CASE("numbers go to a state and back in the order of the layout", "[configuration]") {
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

TEST_CASE("vectors of the wrong size say so", "[configuration]") {
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
  // Where they are as many, the message need not tell them apart.
  CHECK_THROWS_WITH(integrate(models::pendulum, std::vector{0.0, 0.0}, std::array{0.0}, 1.0),
                    "kte: q has 2 numbers, the chain has 1 degrees of freedom");
}

TEST_CASE("static and runtime chains integrate to the same numbers", "[configuration]") {
  const auto runtime = models::element_by_element(model);
  random_numbers random(1);
  CHECK(neutral_configuration(runtime) == neutral_configuration(model));
  for (int round = 0; round < 50; ++round) {
    const auto q = random_configuration<double>(random), p = random_configuration<double>(random);
    const auto v = random_vector<double, nv>(random, 5);
    const double dt = random();
    CHECK(integrate(runtime, q, v, dt) == integrate(model, q, v, dt));
    CHECK(difference(runtime, q, p) == difference(model, q, p));
  }
}

TEST_CASE("in the neutral configuration nothing is moved or turned", "[configuration]") {
  const auto q = neutral_configuration(model);
  for (int i = 0; i < nq; ++i) CHECK(q[i] == (i == 4 || i == 8 ? 1.0 : 0.0));
  const auto x = forward_kinematics(model, q, tip);
  CHECK(x.position == vec3{0.0, 0.0, 0.0});
  CHECK(x.rotation == mat3<>{{1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}});
  CHECK(difference(model, q, q) == joint_vector<double, nv>::Zero());
  CHECK(integrate(model, q, joint_vector<double, nv>(joint_vector<double, nv>::Zero()), 1.0) == q);
  auto s = make_state(model);  // a new state is in it
  CHECK(positions(s) == q);
  CHECK(neutral_configuration<big>(model)[4] == 1);
}

TEST_CASE("the difference is what integrate needs", "[configuration]") {
  random_numbers random(2);
  for (int round = 0; round < 200; ++round) {
    const auto q = random_configuration<double>(random);
    auto v = random_vector<double, nv>(random, 1.7);  // rotations by less than pi
    // A product of quaternions, an exponential and a logarithm: some 30 roundings of numbers up to 20.
    CHECK((difference(model, q, integrate(model, q, v, 1.0)) - v).cwiseAbs().maxCoeff() < 30 * eps * 20);
    const auto p = random_configuration<double>(random);
    const auto there = integrate(model, q, difference(model, q, p), 1.0);
    CHECK(part(there, 0, 4).isApprox(part(p, 0, 4), 100 * eps));
    CHECK(1 - std::abs(part(there, 4, 4).dot(part(p, 4, 4))) < 30 * eps);  // q and -q are the same
    CHECK(1 - std::abs(part(there, 8, 4).dot(part(p, 8, 4))) < 30 * eps);
    CHECK(part(there, 12, 3).isApprox(part(p, 12, 3), 100 * eps));
    const double pi = std::atan2(0.0, -1.0);
    CHECK(std::abs(std::remainder(there[15] - p[15], 2 * pi)) < 30 * eps);
    CHECK(std::abs(difference(model, q, p)[13]) <= pi);
    // Constant v: the way from time s to t is (t - s) v.
    const double s = random(), t = s + 0.3;
    const auto way = difference(model, integrate(model, q, v, s), integrate(model, q, v, t));
    CHECK((way - 0.3 * v).cwiseAbs().maxCoeff() < 60 * eps * 20);
  }
}

TEST_CASE("numbers are just added, angles without end", "[configuration]") {
  auto q = neutral_configuration(model);
  joint_vector<double, nv> v = joint_vector<double, nv>::Zero();
  q[0] = 0.5, q[12] = -1.0, q[15] = 100.0, v[0] = 3.0, v[10] = 4.0, v[13] = 8.0;
  const auto p = integrate(model, q, v, 0.25);
  CHECK(p[0] == 1.25);
  CHECK(p[12] == 0.0);
  CHECK(p[15] == 102.0);
  CHECK(difference(model, q, p)[0] == 0.75);
  CHECK(difference(model, q, p)[13] == within(2.0, 200 * eps));
  v[13] = 4 * 5.0;  // more than half a turn: the shorter way
  CHECK(difference(model, q, integrate(model, q, v, 0.25))[13] == within(5.0 - 2 * std::atan2(0.0, -1.0), 200 * eps));
}

TEST_CASE("the plane is space about z", "[configuration]") {
  constexpr auto in_plane = chain(free_joint_2D(puck, table, disc), inertia_2D(disc, planar_body(1.0, 1.0)));
  constexpr auto solid = chain(free_joint_3D(trunk, ground, body), inertia_3D(body, point_mass(1.0)));
  random_numbers random(3);
  for (int round = 0; round < 100; ++round) {
    const double x = random(), y = random(), t = random(3), vx = random(), vy = random(), w = random(), dt = random(2);
    const auto flat = integrate(in_plane, std::array{x, y, t}, std::array{vx, vy, w}, dt);
    const auto p = integrate(solid, std::array{x, y, 0.0, std::cos(t / 2), 0.0, 0.0, std::sin(t / 2)},
                             std::array{vx, vy, 0.0, 0.0, 0.0, w}, dt);
    CHECK(flat[0] == within(p[0], 20 * eps));
    CHECK(flat[1] == within(p[1], 20 * eps));
    CHECK(p[2] == 0.0);
    CHECK(std::remainder(flat[2] - 2 * std::atan2(p[6], p[3]), 2 * std::atan2(0.0, -1.0)) == within(0.0, 20 * eps));
    const auto back = difference(in_plane, std::array{x, y, t}, std::array{flat[0], flat[1], flat[2]});
    CHECK(back[0] == within(vx * dt, 40 * eps));
    CHECK(back[2] == within(w * dt, 40 * eps));
  }
}

TEST_CASE("the time derivative of integrate is v", "[configuration]") {
  // By central differences at 50 digits, with errors of h^2 = 1e-34 and 1e-50/h.
  const big h("1e-17");
  random_numbers random(4);
  for (int round = 0; round < 10; ++round) {
    const auto q = random_configuration<big>(random);
    const auto v = random_vector<big, nv>(random, 2);
    const joint_vector<big, nq> rate = (integrate(model, q, v, h) - integrate(model, q, v, big(-h))) / (2 * h);
    const auto close = [](const big& x, const big& y) { return abs(x - y) < 1e-30; };
    const auto known = configuration_rate(model, q, v);
    for (int i = 0; i < nq; ++i) CHECK(close(rate[i], known[i]));
    CHECK(close(rate[0], v[0]));
    CHECK(close(rate[12], v[10]));
    const auto quaternion_rate = [&](int i, int j) {  // q' = q (0, w)/2
      const big w = q[i], x = q[i + 1], y = q[i + 2], z = q[i + 3], a = v[j], b = v[j + 1], c = v[j + 2];
      CHECK(close(rate[i], (-x * a - y * b - z * c) / 2));
      CHECK(close(rate[i + 1], (w * a + y * c - z * b) / 2));
      CHECK(close(rate[i + 2], (w * b + z * a - x * c) / 2));
      CHECK(close(rate[i + 3], (w * c + x * b - y * a) / 2));
    };
    quaternion_rate(4, 4), quaternion_rate(8, 7);
    const auto p = unit_quaternion<big>{q[4], q[5], q[6], q[7]} * vec3<big>{v[1], v[2], v[3]};  // p' = R v
    CHECK(close(rate[1], p.x));
    CHECK(close(rate[2], p.y));
    CHECK(close(rate[3], p.z));
    CHECK(close(rate[13], cos(q[15]) * v[11] - sin(q[15]) * v[12]));
    CHECK(close(rate[14], sin(q[15]) * v[11] + cos(q[15]) * v[12]));
    CHECK(close(rate[15], v[13]));
  }
}

TEST_CASE("frames move as the configuration does", "[configuration]") {
  // Along q(t) = integrate(q, t v + t^2/2 a, 1) the rates are v + t a but for t^2: velocity and acceleration of a frame
  // are derivatives of where it stands.
  const big h("1e-12");  // errors: h^2 = 1e-24, and 1e-50/h^2 = 1e-26
  random_numbers random(5);
  auto s = make_state<big>(model.gravity(zero3{}));
  for (int round = 0; round < 10; ++round) {
    const auto q = random_configuration<big>(random);
    const auto v = random_vector<big, nv>(random, 2), a = random_vector<big, nv>(random, 3);
    set_positions(s, q), set_velocities(s, v), set_accelerations(s, a);
    model.doMotion(s);
    const auto at = [&](const big& t) {
      const joint_vector<big, nv> way = t * v + (t * t / 2) * a;
      return integrate(model, q, way, big(1));
    };
    const auto check = [&](const auto& frame, const auto& where) {
      const auto before = where(at(-h)), now = where(at(big(0))), after = where(at(h));
      const auto back = transpose(frame.rotation);
      const auto velocity = back * ((1 / (2 * h)) * (after - before));
      const auto acceleration = back * ((1 / (h * h)) * ((after - now) - (now - before)));
      const auto gap = [](const auto& x, const auto& y) {
        const auto d = x - y;
        return big(dot(d, d));
      };
      CHECK(gap(velocity, frame.velocity) < 1e-40);
      CHECK(gap(acceleration, frame.acceleration) < 1e-40);
    };
    check(s[tip], [](const auto& p) { return forward_kinematics(model, p, tip).position; });
    check(s[body], [](const auto& p) { return forward_kinematics(model, p, body).position; });
    check(s[disc], [](const auto& p) { return forward_kinematics(model, p, disc).position; });
  }
}

TEST_CASE("quaternions keep length 1 for ever", "[configuration]") {
  constexpr auto c = chain(free_joint_3D(trunk, ground, body), inertia_3D(body, point_mass(1.0)));
  joint_vector<double, 7> q = neutral_configuration(c);
  joint_vector<double, 6> v;
  v << 0.1, -0.2, 0.3, 1.0, -2.0, 0.5;
  double worst = 0;
  for (int i = 0; i < 1'000'000; ++i) {
    q = integrate(c, q, v, 1e-3);
    worst = test::worse(worst, std::abs(q.tail(4).squaredNorm() - 1));
  }
  CHECK(worst < 4 * eps);  // of the division by the length, twice in the square
  // One step of the same time: its angle of 2291 rad is wrong by 2291 eps, and each of the steps by a few eps.
  const auto one = integrate(c, neutral_configuration(c), v, 1e3);
  CHECK(1 - std::abs(one.tail(4).dot(q.tail(4))) < 1e-15);
  CHECK((one.head(3) - q.head(3)).norm() < 1e-9);
}

TEST_CASE("quaternions of any length are taken, of length 0 and NaN refused", "[configuration]") {
  random_numbers random(6);
  const auto runtime = models::element_by_element(model);
  const auto q = random_configuration<double>(random), p = random_configuration<double>(random);
  const auto v = random_vector<double, nv>(random, 1);
  for (const double size : {1.5, 1e-200, 1e200}) {
    auto scaled = q;
    scaled.segment(4, 4) *= size, scaled.segment(8, 4) *= size;
    CHECK((integrate(model, scaled, v, 0.1) - integrate(model, q, v, 0.1)).cwiseAbs().maxCoeff() < 20 * eps);
    CHECK((difference(model, scaled, p) - difference(model, q, p)).cwiseAbs().maxCoeff() < 100 * eps);
  }
  const std::string what = "kte: a quaternion of length 0, or one that is not finite, is no rotation";
  const auto check = [&](const auto& c) {
    for (const int first : {4, 8}) {
      auto bad = q;
      bad.segment(first, 4).setZero();
      CHECK_THROWS_AS(integrate(c, bad, v, 0.1), bad_argument);
      CHECK_THROWS_WITH(integrate(c, bad, v, 0.1), what);
      CHECK_THROWS_WITH(difference(c, bad, q), what);
      CHECK_THROWS_WITH(difference(c, q, bad), what);
      for (const double x : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
        bad = q;
        bad[first + 1] = x;
        CHECK_THROWS_WITH(integrate(c, bad, v, 0.1), what);
        CHECK_THROWS_WITH(difference(c, q, bad), what);
      }
    }
  };
  check(model);
  check(runtime);
}
