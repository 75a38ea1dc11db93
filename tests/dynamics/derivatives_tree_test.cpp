#include <kte/dynamics/derivatives.hpp>
#include <kte/kte.hpp>

#include <boost/multiprecision/cpp_bin_float.hpp>

#include "catch.hpp"
#include "random.hpp"

// Derivatives of the dynamics of trees with everything whose derivatives are known element by element, with moving
// bases, inputs and given coordinates, against central differences at 50 digits.

using namespace kte;
using big = boost::multiprecision::cpp_bin_float_50;

namespace {

namespace keys {
// clang-format off
inline constexpr struct q1_     final : coord_key<"q1">           {} q1;
inline constexpr struct q2_     final : coord_key<"q2">           {} q2;
inline constexpr struct q3_     final : coord_key<"q3">           {} q3;
inline constexpr struct q4_     final : coord_key<"q4">           {} q4;
inline constexpr struct lone_   final : coord_key<"lone">         {} lone;
inline constexpr struct drive_  final : coord_key<"drive">        {} drive;
inline constexpr struct motor_  final : input_key<"motor">        {} motor;
inline constexpr struct ball_   final : rotation_3D_key<"ball">   {} ball;
inline constexpr struct float_  final : pose_3D_key<"float">      {} floating;
inline constexpr struct slide_  final : pose_2D_key<"slide">      {} sliding;
inline constexpr struct base_   final : frame_3D_key<"base">      {} base;
inline constexpr struct cart_   final : frame_3D_key<"cart">      {} cart;
inline constexpr struct a_      final : frame_3D_key<"a">         {} a;
inline constexpr struct b_      final : frame_3D_key<"b">         {} b;
inline constexpr struct c_      final : frame_3D_key<"c">         {} c;
inline constexpr struct d_      final : frame_3D_key<"d">         {} d;
inline constexpr struct e_      final : frame_3D_key<"e">         {} e;
inline constexpr struct f_      final : frame_3D_key<"f">         {} f;
inline constexpr struct g_      final : frame_3D_key<"g">         {} g;
inline constexpr struct h_      final : frame_3D_key<"h">         {} h;
inline constexpr struct floor_  final : frame_2D_key<"floor">     {} floor_2D;
inline constexpr struct wall_   final : frame_2D_key<"wall">      {} wall;
inline constexpr struct k_      final : frame_2D_key<"k">         {} k;
inline constexpr struct l_      final : frame_2D_key<"l">         {} l;
inline constexpr struct m_      final : frame_2D_key<"m">         {} m;
inline constexpr struct n_      final : frame_2D_key<"n">         {} n;
inline constexpr struct o_      final : frame_2D_key<"o">         {} o;
inline constexpr struct p_      final : frame_2D_key<"p">         {} p;
// clang-format on
}  // namespace keys

constexpr rigid_body body{1.5, vec3{0.125, -0.25, 0.0625}, sym3{0.25, 0.03125, -0.0625, 0.1875, 0.015625, 0.1875}};
constexpr rigid_body light{0.25, vec3{0.03125, 0.125, -0.0625}, sym3{0.03, 0.001, -0.002, 0.025, 0.003, 0.02}};
constexpr vec3 fall{0.5, -0.25, -9.81};

/// A base that is anywhere and moves in any way; a coordinate or input that is given.
template <class S>
void move(frame_3D<S>& x, random_numbers& random) {
  const auto vector = [&random] { return vec3<>{random(), random(), random()}; };
  x.position = as<S>(vector());
  x.rotation = as<S>(matrix(normalized(random(), random(), random(), 2 + random())));
  x.velocity = as<S>(vector()), x.ang_velocity = as<S>(vector());
  x.acceleration = as<S>(9.0 * vector()), x.ang_acceleration = as<S>(3.0 * vector());
}
template <class S>
void move(frame_2D<S>& x, random_numbers& random) {
  const double angle = random(3);
  x.position = {S(random()), S(random())};
  x.rotation = {S(std::cos(angle)), S(std::sin(angle))};
  x.velocity = {S(random()), S(random())}, x.ang_velocity = S(random());
  x.acceleration = {S(random(9)), S(random(9))}, x.ang_acceleration = S(random(3));
}
template <class S>
void move(gen_coord<S>& x, random_numbers& random) {
  x.q = S(random(3)), x.q_dot = S(random(2)), x.q_ddot = S(random(5));
}
void move(double& x, random_numbers& random) { x = random(5); }
void move(big& x, random_numbers& random) { x = random(5); }

/// max |x - exact| / max |exact|; infinite if an x is no number.
template <class X, class Y>
double gap(const X& x, const Y& exact) {
  big difference = 0, size = 0;
  for (Eigen::Index i = 0; i < exact.rows(); ++i)
    for (Eigen::Index j = 0; j < exact.cols(); ++j) {
      const big d = abs(big(x(i, j)) - big(exact(i, j)));
      if (d == d) difference = std::max(difference, d);
      if (!(d == d)) difference = HUGE_VAL;
      size = std::max(size, big(abs(big(exact(i, j)))));
    }
  return static_cast<double>(size == 0 ? difference : difference / size);
}
void note(double& worst, double d) {
  if (!(d <= worst)) worst = d;
}

/// Central differences of f(state) by q, v or a, along each velocity; steps of 1e-16 err by 1e-32 times a third
/// derivative and lose 1e-34.
enum class by { q, v, a };
template <class Chain, class State, class F>
auto differences(const Chain& c, const State& s, by what, const F& f) {
  constexpr int n = Chain::dofs;
  using vector = joint_vector<big, n>;
  const big step("1e-16");
  joint_matrix<big, n> m;
  for (int j = 0; j < n; ++j) {
    const auto at = [&](const big& h) {
      auto t = s;
      const vector e = vector::Unit(j);
      if (what == by::q) set_positions(t, integrate(c, positions(s), e, h));
      if (what == by::v) set_velocities(t, vector(velocities(s) + h * e));
      if (what == by::a) set_accelerations(t, vector(accelerations(s) + h * e));
      return vector(f(t));
    };
    m.col(j) = (at(step) - at(-step)) / (2 * step);
  }
  return m;
}

/// Two trees, on bases that move: branches, all joints in the middle, a joint that is driven by a given coordinate, a
/// coordinate without a joint, and all elements on coordinates.
constexpr auto tree_3D = [] {
  using namespace keys;
  return chain(base_gen(drive), base_3D(cart), revolute_joint_3D(q1, base, a, axis::minus_y), inertia_3D(a, body),
               rigid_link_3D(a, b, vec3{0.25, 0.5, -0.375}, quarter_turn_x), free_joint_3D(floating, b, c),
               inertia_3D(c, body), spherical_joint_3D(ball, c, d), inertia_3D(d, light),
               prismatic_joint_3D(q2, d, e, axis::x), inertia_3D(e, light),
               revolute_joint_3D(drive, c, f, vec3{0.0, 0.6, 0.8}), inertia_3D(f, body),
               revolute_joint_3D(q3, f, g, vec3{2.0 / 3, -1.0 / 3, 2.0 / 3}), inertia_3D(g, body),
               prismatic_joint_3D(q4, cart, h, axis::z), inertia_3D(h, body), inertia_gen(lone, 2.0),
               inertia_gen(q3, 0.5), spring_gen(q1, q2, 0.25, 20.0), spring_gen(drive, q3, 0.5, 7.0),
               spring_gen(lone, q4, zero, 3.0), damper_gen(q2, q3, 0.25), damper_gen(lone, drive, 0.5),
               driving_actuator_gen(q3, motor))
      .gravity(fall);
}();

constexpr auto tree_2D = [] {
  using namespace keys;
  return chain(revolute_joint_2D(q1, floor_2D, k), inertia_2D(k, planar_body(2.0, 0.25, along_x(0.25))),
               rigid_link_2D(k, l, vec2{0.5, 0.125}, quarter_turn), free_joint_2D(sliding, l, m),
               inertia_2D(m, planar_body(1.5, 0.125, along_y(0.25))), prismatic_joint_2D(q2, m, n, vec2{0.6, 0.8}),
               inertia_2D(n, planar_body(0.5, 0.0625)), base_2D(wall), prismatic_joint_2D(q3, wall, o, axis::y),
               inertia_2D(o, point_mass(0.75)), revolute_joint_2D(q4, n, p),
               inertia_2D(p, planar_body(0.75, 0.125, along_x(0.5))), spring_gen(q2, q3, 0.25, 9.0),
               damper_gen(q1, q4, 0.5), driving_actuator_gen(q2, motor))
      .gravity(along_y(-9.81));
}();

/// Sums along up to six bodies, of numbers up to some times as large as the largest result: measured 1.0e-15.
/// General axes are of length 1 to 1e-16 only, which 50 digits show.
constexpr double most = 3e-15;
/// Some of the condition of M on top: measured 2.5e-14 where all axes are typed.
constexpr double most_of_forward = 1e-13;

template <class Chain, class... Outside>
void check(const Chain& chain, unsigned seed, const Outside&... outside) {
  STATIC_REQUIRE(detail::is_analytical<Chain>);
  constexpr int n = Chain::dofs;
  using vector = joint_vector<double, n>;
  random_numbers random(seed);
  struct {
    double by_q = 0, by_v = 0, by_a = 0, tau = 0;
  } worst;
  for (int round = 0; round < 3; ++round) {
    joint_vector<double, Chain::nq> q;
    vector v, a;
    for (auto& x : q) x = random(3);  // quaternions of any length
    for (auto& x : v) x = random(2);
    for (auto& x : a) x = random(5);
    auto s = make_state(chain);
    auto exact = make_state<big>(chain);
    const auto set = [&](auto& state) {
      set_positions(state, q), set_velocities(state, v), set_accelerations(state, a);
      random_numbers draw(1000 * seed + static_cast<unsigned>(round));
      (move(state[outside], draw), ...);
    };
    set(s), set(exact);

    const auto forces = [&](const auto& t) { return inverse_dynamics(chain, t); };
    const auto by_q = differences(chain, exact, by::q, forces), by_v = differences(chain, exact, by::v, forces),
               by_a = differences(chain, exact, by::a, forces);
    const auto r = inverse_dynamics_derivatives(chain, s);
    note(worst.by_q, gap(r.by_q, by_q)), note(worst.by_v, gap(r.by_v, by_v)), note(worst.by_a, gap(r.by_a, by_a));
    note(worst.tau, gap(r.tau, forces(exact)));
    // As by the algorithms on their own, up to their roundings.
    CHECK(gap(r.tau, forces(s)) < most);
    CHECK(gap(r.by_a, mass_matrix(chain, s)) < most);

    if constexpr (n < 10) {  // takes long to compile
      const auto rates = [&](const auto& t) { return forward_dynamics(chain, t); };
      const auto y = forward_dynamics_derivatives(chain, s);
      CHECK(y.a == rates(s));
      CHECK(gap(y.by_q, differences(chain, exact, by::q, rates)) < most_of_forward);
      CHECK(gap(y.by_v, differences(chain, exact, by::v, rates)) < most_of_forward);
      const joint_matrix<big, n> unity = y.by_tau.template cast<big>() * by_a;
      CHECK(gap(unity, joint_matrix<big, n>(joint_matrix<big, n>::Identity())) < most_of_forward);
    }
  }
#ifdef KTE_PRINT
  std::printf("%d dofs: by_q %.1e by_v %.1e by_a %.1e tau %.1e\n", n, worst.by_q, worst.by_v, worst.by_a, worst.tau);
#endif
  CHECK(worst.by_q < most);
  CHECK(worst.by_v < most);
  CHECK(worst.by_a < most);
  CHECK(worst.tau < most);
}

}  // namespace

TEST_CASE("derivatives of a tree in space", "[derivatives]") {
  check(tree_3D, 1, keys::base, keys::cart, keys::drive, keys::motor);
}
TEST_CASE("derivatives of a tree in the plane", "[derivatives]") {
  check(tree_2D, 2, keys::floor_2D, keys::wall, keys::motor);
}
