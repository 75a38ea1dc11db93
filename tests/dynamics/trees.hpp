#pragma once

#include <limits>

#include "catch.hpp"
#include "chain/models.hpp"
#include "random.hpp"

/// Trees of joints with everything that articulated bodies can do, random states of them, and their motion by inverse
/// dynamics and elimination in long double: on x86 eleven bits more than double, a tenth of the time that 50 digits
/// take to compile.
namespace kte::test::trees {

using precise = long double;

// clang-format off
inline constexpr struct q1_     final : coord_key<"q1">           {} q1;
inline constexpr struct q2_     final : coord_key<"q2">           {} q2;
inline constexpr struct q3_     final : coord_key<"q3">           {} q3;
inline constexpr struct q4_     final : coord_key<"q4">           {} q4;
inline constexpr struct q5_     final : coord_key<"q5">           {} q5;
inline constexpr struct lone_   final : coord_key<"lone">         {} lone;
inline constexpr struct drive_  final : coord_key<"drive">        {} drive;
inline constexpr struct motor_  final : input_key<"motor">        {} motor;
inline constexpr struct pull_   final : input_key<"pull">         {} pull;
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
inline constexpr struct foot_   final : frame_3D_key<"foot">      {} foot;
// clang-format on

inline constexpr rigid_body body{1.5, vec3{0.125, -0.25, 0.0625},
                                 sym3{0.25, 0.03125, -0.0625, 0.1875, 0.015625, 0.1875}};
inline constexpr rigid_body light{0.25, vec3{0.03125, 0.125, -0.0625}, sym3{0.03, 0.001, -0.002, 0.025, 0.003, 0.02}};
inline constexpr vec3 oblique{2.0 / 3, -1.0 / 3, 2.0 / 3};
inline constexpr vec3 fall{0.5, -0.25, -9.81};

/// A coordinate, frame or input of a state of either sort.
template <class State, class Key>
auto& thing_of(State& s, const Key& key) {
  if constexpr (is_chain_state<State>) {
    return s[key];
  } else {
    return s.template get<Key::what>(s.made_for()->find(Key::name, Key::what));
  }
}
/// A base that is anywhere and moves in any way.
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
template <class S>
requires std::numeric_limits<S>::is_specialized void move(S& x, random_numbers& random) { x = S(random(5)); }

template <class X>
double largest(const X& x) {
  double most = 0;
  for (Eigen::Index i = 0; i < x.size(); ++i) {
    const auto y = std::fabs(static_cast<double>(x.data()[i]));
    most = y == y ? std::max(most, y) : HUGE_VAL;
  }
  return most;
}
/// The largest difference, relative to the largest number.
template <class X, class Y>
double gap(const X& x, const Y& exact) {
  REQUIRE(x.size() == exact.size());
  double most = 0;
  for (Eigen::Index i = 0; i < x.size(); ++i) {
    const auto y = std::fabs(static_cast<double>(x.data()[i] - exact.data()[i]));
    most = y == y ? std::max(most, y) : HUGE_VAL;
  }
  const double size = largest(exact);
  return most / (size == 0 ? 1 : size);
}
/// M^-1 x by elimination.
template <class S, int N>
joint_vector<S, N> solved(joint_matrix<S, N> mass, joint_vector<S, N> x) {
  for (int j = 0; j < N; ++j)
    for (int i = j + 1; i < N; ++i) {
      const S share = mass(i, j) / mass(j, j);
      for (int r = j; r < N; ++r) mass(i, r) -= share * mass(j, r);
      x[i] -= share * x[j];
    }
  for (int i = N; i-- > 0;) {
    for (int r = i + 1; r < N; ++r) x[i] -= mass(i, r) * x[r];
    x[i] /= mass(i, i);
  }
  return x;
}

template <class Chain>
struct trial {
  static constexpr int dofs = Chain::dofs;
  using vector = joint_vector<double, dofs>;
  joint_vector<double, Chain::nq> q;
  vector v, a, tau;
  explicit trial(random_numbers& random) {
    for (auto& x : q) x = random(3);
    for (auto& x : v) x = random(2);
    for (auto& x : a) x = random(5);
    for (auto& x : tau) x = random(9);
  }
};

/// Joints of all kinds in a tree on two bases, and the same with springs, dampers and a motor.
inline constexpr auto joints_3D = chain(
    rigid_link_3D(base, foot, along_z(0.5)), base_3D(cart), revolute_joint_3D(q1, foot, a), inertia_3D(a, body),
    rigid_link_3D(a, b, vec3{0.25, 0.5, -0.375}, quarter_turn_x), free_joint_3D(floating, b, c), inertia_3D(c, body),
    spherical_joint_3D(ball, c, d), inertia_3D(d, light), rigid_link_3D(d, e, vec3{0.0, 0.5, 0.25}),
    revolute_joint_3D(q2, e, f, oblique), inertia_3D(f, body), prismatic_joint_3D(q3, c, g, axis::minus_y),
    inertia_3D(g, light), revolute_joint_3D(q4, cart, h, axis::y), inertia_3D(h, body));
inline constexpr auto tree_3D =
    chain(joints_3D, spring_3D(f, h, 0.5, 40.0), damper_3D(g, base, 0.75), torsion_spring_3D(a, d, 3.0),
          torsion_damper_3D(c, h, 0.5), spring_gen(q1, q3, 0.25, 20.0), damper_gen(q2, q4, 0.25),
          driving_actuator_gen(q4, motor))
        .gravity(fall);

/// Given motion between a tree and its branches; general axes everywhere; and `more` elements.
template <class... More>
constexpr auto driven_3D(const More&... more) {
  return chain(base_gen(drive), prismatic_joint_3D(q1, base, a, oblique), inertia_3D(a, body),
               revolute_joint_3D(drive, a, b, vec3{0.0, 0.6, 0.8}), inertia_3D(b, body),
               rigid_link_3D(b, c, vec3{0.25, 0.5, -0.375}, quarter_turn_y), revolute_joint_3D(q2, c, d, oblique),
               inertia_3D(d, body), prismatic_joint_3D(q3, b, e, axis::x), inertia_3D(e, light),
               revolute_joint_3D(q4, e, f, axis::minus_z), inertia_3D(f, light), spring_gen(drive, q2, 0.5, 7.0),
               driving_actuator_gen(q1, motor), driving_actuator_gen(q3, pull), more...)
      .gravity(fall);
}

inline constexpr auto across = spring_3D(d, f, zero, 30.0, 12.0);
/// With rotors, and a coordinate that moves a mass alone, which pull on the tree; and a mass on what is given.
inline constexpr auto rotors = driven_3D(
    inertia_gen(q1, 0.5), inertia_gen(q2, 0.125), inertia_gen(q3, 0.25), inertia_gen(q4, 0.0625), inertia_gen(q4, 0.5),
    inertia_gen(lone, 0.5), inertia_gen(drive, 2.0), spring_gen(lone, q2, 0.25, 40.0), damper_gen(lone, q4, 0.125));

inline constexpr auto joints_2D =
    chain(revolute_joint_2D(q1, floor_2D, k), inertia_2D(k, planar_body(2.0, 0.25, along_x(0.25))),
          rigid_link_2D(k, l, vec2{0.5, 0.125}, quarter_turn), free_joint_2D(sliding, l, m),
          inertia_2D(m, planar_body(1.5, 0.125, along_y(0.25))), prismatic_joint_2D(q2, m, n, vec2{0.6, 0.8}),
          inertia_2D(n, planar_body(0.5, 0.0625)), base_2D(wall), prismatic_joint_2D(q3, wall, o, axis::y),
          inertia_2D(o, point_mass(0.75)), revolute_joint_2D(q4, n, p),
          inertia_2D(p, planar_body(0.75, 0.125, along_x(0.5))));
inline constexpr auto tree_2D =
    chain(joints_2D, spring_2D(p, o, 0.25, 30.0), damper_2D(k, wall, 2.0), torsion_spring_2D(k, p, 4.0, 3.0, 0.25),
          torsion_damper_2D(m, wall, 0.5), driving_actuator_gen(q2, motor), damper_gen(q1, q4, 0.5))
        .gravity(along_y(-9.81));

/// In the plane and in space at once.
inline constexpr auto both = chain(base_2D(wall), revolute_joint_3D(q1, base, a, axis::x), inertia_3D(a, body),
                                   prismatic_joint_2D(q2, wall, o, axis::x), inertia_2D(o, point_mass(0.75)),
                                   revolute_joint_2D(q3, o, p), inertia_2D(p, planar_body(0.75, 0.125, along_x(0.5))),
                                   spring_gen(q1, q3, 0.25, 9.0), damper_gen(q1, q2, 0.75));

template <class Chain>
constexpr bool by_articulated_bodies = kte::detail::is_tree_of_joints<std::remove_const_t<Chain>>;

}  // namespace kte::test::trees
