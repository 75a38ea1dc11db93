#include <kte/recursions/articulated_body.hpp>
#include <kte/static.hpp>

#include "catch.hpp"
#include "math/draw.hpp"

// What joints leave of the articulated inertia of their body. Along unit axes it is exactly nothing, told by types;
// along other axes it is a difference that rounding makes almost nothing.

namespace eliminated_axes_test {

using namespace kte;
using test::draw;

/// A nut on a screw along a typed axis: p = h e q.
template <class Pitch, class Axis>
struct screw : transmission<screw<Pitch, Axis>> {
  static constexpr type_name type{"screw", kind::frame_3D};
  static constexpr std::array<port, 3> ports{{{kind::gen, access::angle, "coordinate"},
                                              {kind::frame_3D, access::in, "base"},
                                              {kind::frame_3D, access::out, "end"}}};
  Pitch pitch;
  Axis axis;
  constexpr screw(Pitch h, Axis e) : pitch(h), axis(e) {}
  template <class C>
  constexpr auto relative(const C& c) const {
    const auto p = pitch * axis;
    return motion{p * c.q,        rotation_about(axis, c.cos, c.sin), p * c.q_dot, axis * c.q_dot, p * c.q_ddot,
                  axis * c.q_ddot};
  }
};
/// A joint with a sensor that counts `Number` a radian: its axis is `Number` times z.
template <int Number>
struct geared : transmission<geared<Number>> {
  static constexpr std::array<port, 3> ports{{{kind::gen, access::angle, "coordinate"},
                                              {kind::frame_3D, access::in, "base"},
                                              {kind::frame_3D, access::out, "end"}}};
  template <class C>
  constexpr auto relative(const C& c) const {
    constexpr auto n = constant<Number>{} * axis::z;
    return motion{zero3{}, rotation_about(axis::z, c.cos, c.sin), zero3{}, n * c.q_dot, zero3{}, n * c.q_ddot};
  }
};
/// A pose in the plane whose first axis is not that of a coordinate: x also lifts by half.
struct ramp : transmission<ramp> {
  static constexpr std::array<port, 3> ports{{{kind::pose_2D, access::angle, "coordinate"},
                                              {kind::frame_3D, access::in, "base"},
                                              {kind::frame_3D, access::out, "end"}}};
  template <class C>
  constexpr auto relative(const C& c) const {
    const auto lifted = [](const auto& v) { return vec3{v.x, v.y, 0.5 * v.x}; };
    return motion{lifted(c.position), matrix(c.rotation),     lifted(c.velocity),
                  c.ang_velocity,     lifted(c.acceleration), c.ang_acceleration};
  }
};

using one_number = coordinate<double, skip, skip, double, double>;
template <class P, class R>
using place = motion<P, R, vec3<skip>, vec3<skip>, vec3<skip>, vec3<skip>>;
using ball = place<zero3, mat3<>>;
using pose_3 = place<vec3<>, mat3<>>;
using pose_2 = place<vec3<double, double, zero_t>, rotation_2D<double>>;

template <kind Dim, class Axis>
using revolute = core::revolute_joint<Dim, std::remove_const_t<Axis>>;
template <kind Dim, class Axis>
using prismatic = core::prismatic_joint<Dim, std::remove_const_t<Axis>>;
constexpr kind flat = kind::frame_2D, solid = kind::frame_3D;

/// A joint of a core at a coordinate, with a mass on it, as the recursions see it.
template <class Core, class C, class M = zero_t>
struct jointed {
  using scalar = double;
  const Core& core;
  const C& at;
  M m{};
  static constexpr bool always_free = true;
  static constexpr bool free() { return true; }
  static constexpr int first() { return 0; }
  static constexpr int axes = detail::joint_dofs<Core>;
  template <int K>
  constexpr auto axis() const {
    const auto s = detail::axis_of<K>(core, at);
    return engine::motion_vector{s.velocity, s.ang_velocity};
  }
  template <int>
  constexpr M mass() const {
    return m;
  }
  auto placed() const { return core.relative(detail::position_only(at)); }
  auto position() const { return placed().position; }
  template <class U>
  auto in(const U& u) const {
    return transpose(placed().rotation) * u;
  }
  template <class X, class Y, class Z>
  auto out(const vec3<X, Y, Z>& u) const {
    return placed().rotation * u;
  }
  template <class A>
  auto out(const A& a) const {
    return turned_by(matrix(placed().rotation), a);
  }
};

/// The components along eliminated axes: 0, 1, 2 linear, 3, 4, 5 angular; -1 for an axis that is not a unit
/// axis.
template <class Core, class C>
constexpr auto eliminated_components = []<int... K>(std::integer_sequence<int, K...>) {
  return std::array{engine::eliminated_component<jointed<Core, C>, K>...};
}
(std::make_integer_sequence<int, detail::joint_dofs<Core>>{});
template <class Core, class C>
constexpr bool takes(const std::array<int, std::size_t{detail::joint_dofs<Core>}>& components) {
  return eliminated_components<Core, C> == components;
}
/// Nothing of it is told by types.
template <class Core, class C>
constexpr bool is_general = takes<Core, C>({-1});

TEST_CASE("joints along unit axes take these exactly") {
  STATIC_REQUIRE(takes<revolute<solid, decltype(axis::z)>, one_number>({5}));
  STATIC_REQUIRE(takes<revolute<solid, decltype(axis::x)>, one_number>({3}));
  STATIC_REQUIRE(takes<revolute<solid, decltype(axis::minus_y)>, one_number>({4}));
  STATIC_REQUIRE(takes<revolute<flat, decltype(axis::z)>, one_number>({5}));
  STATIC_REQUIRE(takes<prismatic<solid, decltype(axis::x)>, one_number>({0}));
  STATIC_REQUIRE(takes<prismatic<solid, decltype(axis::minus_z)>, one_number>({2}));
  STATIC_REQUIRE(takes<prismatic<flat, decltype(axis::y)>, one_number>({1}));
  STATIC_REQUIRE(takes<core::spherical_joint, ball>({3, 4, 5}));
  STATIC_REQUIRE(takes<core::free_joint<flat>, pose_2>({0, 1, 5}));
  STATIC_REQUIRE(takes<core::free_joint<solid>, pose_3>({0, 1, 2, 3, 4, 5}));
}

TEST_CASE("other axes are not taken exactly") {
  STATIC_REQUIRE(is_general<revolute<solid, vec3<>>, one_number>);
  STATIC_REQUIRE(is_general<revolute<solid, vec3<double, zero_t, double>>, one_number>);
  STATIC_REQUIRE(is_general<revolute<solid, vec3<zero_t, zero_t, double>>, one_number>);  // 1.0, but who knows
  STATIC_REQUIRE(is_general<prismatic<solid, vec3<>>, one_number>);
  STATIC_REQUIRE(is_general<prismatic<flat, vec3<double, double, zero_t>>, one_number>);
}

TEST_CASE("axes of joints made by users") {
  using along_z = std::remove_const_t<decltype(axis::z)>;
  // A screw joint takes a combination of force and torque along its axis.
  STATIC_REQUIRE(is_general<screw<double, along_z>, one_number>);
  STATIC_REQUIRE(is_general<screw<one_t, along_z>, one_number>);
  STATIC_REQUIRE(is_general<screw<constant<-1>, along_z>, one_number>);
  STATIC_REQUIRE(is_general<screw<double, vec3<>>, one_number>);
  // Without a pitch it is a revolute joint.
  STATIC_REQUIRE(takes<screw<zero_t, along_z>, one_number>({5}));
  // The rate along an axis of length 2 is half the component.
  STATIC_REQUIRE(is_general<geared<2>, one_number>);
  STATIC_REQUIRE(takes<geared<-1>, one_number>({5}));
  // One axis among others is general.
  STATIC_REQUIRE(takes<ramp, place<vec3<double, double, zero_t>, rotation_2D<double>>>({-1, 1, 5}));
}

// ---- one joint by (2) and (3) of recursions/articulated_body.hpp with dense matrices of six

using wide = long double;
using table = Eigen::Matrix<wide, Eigen::Dynamic, Eigen::Dynamic>;
using column = Eigen::Matrix<wide, Eigen::Dynamic, 1>;
constexpr double eps = std::numeric_limits<double>::epsilon();

template <class A, class B>
column stacked(const A& a, const B& b) {
  column r(6);
  r << test::eigen(a).template cast<wide>(), test::eigen(b).template cast<wide>();
  return r;
}
template <class I>
table dense(const I& b) {
  table r(6, 6);
  const auto h = test::eigen(b.coupling).template cast<wide>().eval();
  r << test::eigen(b.linear).template cast<wide>(), h, h.transpose(), test::eigen(b.angular).template cast<wide>();
  return r;
}
/// From the acceleration of the base to that of the end.
template <class M>
table way(const M& m) {
  const auto p = as<double>(m.position);
  const Eigen::Matrix<wide, 3, 3> r = test::eigen(kte::matrix(m.rotation)).template cast<wide>().transpose();
  Eigen::Matrix<wide, 3, 3> cross;
  cross << 0, -p.z, p.y, p.z, 0, -p.x, -p.y, p.x, 0;
  table x(6, 6);
  x << r, -r * cross, Eigen::Matrix<wide, 3, 3>::Zero(), r;
  return x;
}
/// A body that is not all of one piece: linear inertias differ with the direction.
articulated<sym3<>, mat3<>, sym3<>> draw_body(draw& random) {
  Eigen::Matrix<double, 6, 6> a;
  for (auto& x : a.reshaped()) x = random.number();
  const Eigen::Matrix<double, 6, 6> i = a * a.transpose() + Eigen::Matrix<double, 6, 6>::Identity();
  const auto row = [&i](int r, int c) { return vec3{i(r, c), i(r, c + 1), i(r, c + 2)}; };
  return {{i(0, 0), i(0, 1), i(0, 2), i(1, 1), i(1, 2), i(2, 2)},
          {row(0, 3), row(1, 3), row(2, 3)},
          {i(3, 3), i(3, 4), i(3, 5), i(4, 4), i(4, 5), i(5, 5)}};
}

/// The largest error of a joint whose coordinate has a mass m. Its inertia is 1 at least, numbers are below 20.
template <class Core, class C, class M>
wide error_of_joint(const Core& core, const C& at, const M& m, draw& random) {
  constexpr int n = detail::joint_dofs<Core>;
  const auto body = draw_body(random);
  const wrench load{random.vector(), random.vector()};
  const engine::bias_motion c{skip{}, zero3{}, random.vector(), random.vector()};
  std::array<double, 6> f{};
  for (auto& x : f) x = random.number();
  std::array<engine::axis_factors<double>, std::size_t{n}> factors;
  int unmoved = -1;
  const jointed<Core, C, M> joint{core, at, m};
  const auto force = [&f](int k) { return f[static_cast<std::size_t>(k)]; };
  const engine::articulated_body carried{body, no_wrench - load};
  const auto met = engine::eliminated(joint, carried, force, factors.data(), unmoved);
  CHECK(unmoved == -1);
  const auto b = engine::seen_by_parent(joint, c, met, force);
  const vec3<> linear = random.vector(), angular = random.vector();
  const auto x = joint.placed();
  const auto t = transpose(x.rotation);
  column q_ddot(n);
  std::array<double, 6> change{};
  const auto a = engine::accelerated<0>(
      joint, factors.data(),
      engine::motion_vector{t * plus_cross(linear, angular, x.position) + c.linear, t * angular + c.angular},
      change.data());
  for (int k = 0; k < n; ++k) q_ddot[k] = change[static_cast<std::size_t>(k)];

  table s(6, n);
  const auto fill = [&]<int... K>(std::integer_sequence<int, K...>) {
    const auto one_axis = [&](int k, const auto& axis) { s.col(k) = stacked(axis.velocity, axis.ang_velocity); };
    (one_axis(K, detail::axis_of<K>(core, at)), ...);
  };
  fill(std::make_integer_sequence<int, n>{});
  const table I = dense(body), X = way(x), U = I * s;
  const table D = s.transpose() * U + as<double>(m) * table::Identity(n, n), gain = U * D.inverse();
  const column W = stacked(load.force, load.torque), bias = stacked(c.linear, c.angular);
  const column applied = Eigen::Matrix<double, 6, 1>(f.data()).head(n).template cast<wide>();
  const column rate = D.inverse() * (applied + s.transpose() * W);
  const table left = I - gain * U.transpose();
  const column passed = W - left * bias - U * rate;
  const column before = X * stacked(linear, angular) + bias;
  const column exact_q = rate - gain.transpose() * before;
  const auto gap = [](const auto& y, const auto& z) {
    return (y - z).cwiseAbs().template maxCoeff<Eigen::PropagateNaN>();
  };
  wide e = gap(dense(b.inertia), table(X.transpose() * left * X));
  e = test::worse(e, gap(stacked(b.bias.force, b.bias.torque), column(-(X.transpose() * passed))));
  e = test::worse(e, gap(q_ddot, exact_q));
  return test::worse(e, gap(stacked(a.linear, a.angular), column(before + s * exact_q)));
}

one_number draw_angle(draw& random) {
  const double q = 3 * random.number();
  return {q, {}, {}, std::cos(q), std::sin(q)};
}
constexpr vec3<skip> unknown{};
// D is 1 at least, I up to 20, so that a gain is up to 20 and I' a difference of products up to 400; six of these make
// a sum, accelerations and loads have numbers up to 2. That is 6 2 400 eps/2 times the some 10 roundings of each.
constexpr double by_rounding = 2.4e4 * eps;

TEST_CASE("one joint against dense matrices") {
  draw random(51);
  using along_y = std::remove_const_t<decltype(axis::y)>;
  using against_z = std::remove_const_t<decltype(axis::minus_z)>;
  const vec3<> general{2.0 / 3, -1.0 / 3, 2.0 / 3};
  for (int i = 0; i < 100; ++i) {
    const auto check = [&](const auto& core, const auto& at, const auto& m) {
      CHECK(error_of_joint(core, at, m, random) < by_rounding);
    };
    check(core::revolute_joint<solid, along_y>(along_y{}), draw_angle(random), zero);
    check(core::revolute_joint<solid, against_z>(against_z{}), draw_angle(random), zero);
    check(core::prismatic_joint<solid, along_y>(along_y{}), draw_angle(random), zero);
    check(core::prismatic_joint<solid, against_z>(against_z{}), draw_angle(random), 0.0);
    check(core::revolute_joint<solid, vec3<>>(general), draw_angle(random), 0.5);
    check(core::prismatic_joint<solid, vec3<>>(general), draw_angle(random), 0.5);
    check(screw<double, along_y>(0.3, {}), draw_angle(random), 0.5);
    check(screw<one_t, along_y>({}, {}), draw_angle(random), zero);
    check(screw<double, vec3<>>(-0.3, general), draw_angle(random), zero);
    check(geared<2>{}, draw_angle(random), zero);
    const auto r = matrix(random.rotation());
    check(core::spherical_joint{}, ball{{}, r, unknown, unknown, unknown, unknown}, zero);
    check(core::free_joint<solid>{}, pose_3{random.vector(), r, unknown, unknown, unknown, unknown}, zero);
    const vec3 p{random.number(), random.number(), zero};
    const auto turn = rotation_by(3 * random.number());
    check(core::free_joint<flat>{}, pose_2{p, turn, unknown, unknown, unknown, unknown}, zero);
    check(ramp{}, pose_2{p, turn, unknown, unknown, unknown, unknown}, zero);
  }
}

TEST_CASE("what a joint along a unit axis takes is exactly nothing") {
  draw random(52);
  const auto body = draw_body(random);
  const auto taken = engine::without<5>(body);
  STATIC_REQUIRE(std::is_same_v<decltype(taken.angular), sym3<double, double, zero_t, double, zero_t, zero_t>>);
  STATIC_REQUIRE(std::is_same_v<decltype(taken.coupling), mat3<vec3<double, double, zero_t>>>);
  STATIC_REQUIRE(std::is_same_v<decltype(taken.linear), sym3<>>);
  CHECK(taken.linear == body.linear);
  CHECK(taken.coupling.y.x == body.coupling.y.x);
  CHECK(taken.angular.xy == body.angular.xy);
  const wrench load{random.vector(), random.vector()};
  const auto some = engine::without<0>(load);
  STATIC_REQUIRE(std::is_same_v<decltype(some.force), vec3<zero_t, double, double>>);
  CHECK(some.torque == load.torque);
  const auto none = engine::without<0>(
      engine::without<1>(engine::without<2>(engine::without<3>(engine::without<4>(engine::without<5>(body))))));
  STATIC_REQUIRE(std::is_same_v<decltype(none), const std::remove_const_t<decltype(no_articulated)>>);
}

TEST_CASE("an axis that moves next to nothing") {
  // The rounding error of an eliminated inertia does not count as inertia.
  std::array<engine::axis_factors<double>, 1> factors;
  const one_number at{0.0, {}, {}, 1.0, 0.0};
  const core::revolute_joint<solid, vec3<>> core({0.0, 0.0, 1.0});
  const auto is_good = [&](double inertia, double m) {
    int unmoved = -1;
    const articulated<sym3<>, mat3<>, sym3<>> body{
        {1.0, 0.0, 0.0, 1.0, 0.0, 1.0}, {}, {1.0, 0.0, 0.0, 1.0, 0.0, inertia}};
    const jointed<core::revolute_joint<solid, vec3<>>, one_number, double> joint{core, at, m};
    (void)engine::eliminated(
        joint, engine::articulated_body{body, no_wrench}, [](int) { return 0.0; }, factors.data(), unmoved);
    return unmoved == -1;
  };
  CHECK(is_good(1e-10, 0.0));
  CHECK(is_good(0.0, 1e-10));
  CHECK_FALSE(is_good(1e-16, 0.0));
  CHECK_FALSE(is_good(0.0, 0.0));
  CHECK_FALSE(is_good(-1e-16, 0.0));
  CHECK_FALSE(is_good(std::numeric_limits<double>::quiet_NaN(), 0.0));
}

}  // namespace eliminated_axes_test
