#pragma once

#include <kte/dynamics/configuration_space.hpp>
#include <kte/runtime_chain/runtime_chain.hpp>

#include "catch.hpp"
#include "chain/gear.hpp"
#include "chain/models.hpp"
#include "digits50.hpp"
#include "random.hpp"

/// Small mechanisms with axes that are exact, so that laws hold to all digits of any scalar; and motions of them.
namespace kte::test::small_chains {

using big = digits50;

// clang-format off
inline constexpr struct trunk_  final : pose_3D_key<"trunk">    {} trunk;
inline constexpr struct puck_   final : pose_2D_key<"puck">     {} puck;
inline constexpr struct ball_   final : rotation_3D_key<"ball"> {} ball;
inline constexpr struct q1_     final : coord_key<"q1">         {} q1;
inline constexpr struct q2_     final : coord_key<"q2">         {} q2;
inline constexpr struct f1_     final : coord_key<"f1">         {} f1;
inline constexpr struct f2_     final : coord_key<"f2">         {} f2;
inline constexpr struct ground_ final : frame_3D_key<"ground">  {} ground;
inline constexpr struct body_   final : frame_3D_key<"body">    {} body;
inline constexpr struct socket_ final : frame_3D_key<"socket">  {} socket;
inline constexpr struct hand_   final : frame_3D_key<"hand">    {} hand;
inline constexpr struct tip_    final : frame_3D_key<"tip">     {} tip;
inline constexpr struct aside_  final : frame_3D_key<"aside">   {} aside;
inline constexpr struct palm_   final : frame_3D_key<"palm">    {} palm;
inline constexpr struct table_  final : frame_2D_key<"table">   {} table;
inline constexpr struct cart_   final : frame_2D_key<"cart">    {} cart;
inline constexpr struct rail_   final : frame_2D_key<"rail">    {} rail;
inline constexpr struct disc_   final : frame_2D_key<"disc">    {} disc;
// clang-format on

inline constexpr vec3 weight{0.5, -1.5, -9.81};  // m/s^2, in no axis of anything
inline constexpr rigid_body brick{2.5, vec3{0.1, -0.2, 0.15}, sym3{0.3, 0.02, -0.03, 0.4, 0.05, 0.35}};
inline constexpr rigid_body stick{1.2, vec3{-0.05, 0.1, 0.3}, sym3{0.12, -0.01, 0.02, 0.1, 0.03, 0.06}};

/// A body that floats, a second one on a ball joint, and a slide; a branch aside.
inline constexpr auto floating =
    chain(free_joint_3D(trunk, ground, body), inertia_3D(body, brick),
          rigid_link_3D(body, socket, vec3{0.3, 0.1, -0.2}, quarter_turn_y), spherical_joint_3D(ball, socket, hand),
          inertia_3D(hand, stick), prismatic_joint_3D(q1, hand, tip, axis::y), inertia_3D(tip, point_mass(0.4)),
          revolute_joint_3D(q2, body, aside, axis::x), inertia_3D(aside, point_mass(0.7, along_y(0.3))))
        .gravity(weight);
/// The floating chain with springs inside.
inline constexpr auto floating_with_springs =
    chain(
        chain(free_joint_3D(trunk, ground, body), inertia_3D(body, brick),
              rigid_link_3D(body, socket, vec3{0.3, 0.1, -0.2}, quarter_turn_y), spherical_joint_3D(ball, socket, hand),
              inertia_3D(hand, stick), prismatic_joint_3D(q1, hand, tip, axis::y), inertia_3D(tip, point_mass(0.4)),
              revolute_joint_3D(q2, body, aside, axis::x), inertia_3D(aside, point_mass(0.7, along_y(0.3)))),
        spring_3D(body, tip, 0.2, 30.0), spring_gen(q1, q2, 0.1, 20.0), torsion_spring_3D(body, hand, 5.0))
        .gravity(weight);
/// The floating chain with dampers.
inline constexpr auto floating_with_dampers =
    chain(
        chain(free_joint_3D(trunk, ground, body), inertia_3D(body, brick),
              rigid_link_3D(body, socket, vec3{0.3, 0.1, -0.2}, quarter_turn_y), spherical_joint_3D(ball, socket, hand),
              inertia_3D(hand, stick), prismatic_joint_3D(q1, hand, tip, axis::y), inertia_3D(tip, point_mass(0.4)),
              revolute_joint_3D(q2, body, aside, axis::x), inertia_3D(aside, point_mass(0.7, along_y(0.3)))),
        damper_3D(ground, tip, 3.0), damper_gen(q1, q2, 2.0), torsion_damper_3D(body, hand, 0.5))
        .gravity(weight);
/// In the plane.
inline constexpr auto planar =
    chain(free_joint_2D(puck, table, cart), inertia_2D(cart, planar_body(2.0, 0.3, vec3{0.1, -0.2, zero})),
          rigid_link_2D(cart, rail, vec2{0.3, 0.4}, quarter_turn), revolute_joint_2D(q1, rail, disc),
          inertia_2D(disc, planar_body(0.8, 0.05, along_x(0.25))), inertia_gen(q1, 0.02),
          spring_2D(table, disc, 0.3, 40.0))
        .gravity(vec3{0.7, -9.81, zero});
/// Coordinates that follow others, followers of followers, and coordinates that two joints share, in one branch.
inline constexpr auto geared =
    chain(revolute_joint_3D(q1, ground, body, axis::x), inertia_3D(body, brick), connect(gear{-2.5}, q1, f1),
          rigid_link_gen(f1, f2, -0.2), rigid_link_3D(body, socket, vec3{0.3, 0.1, -0.2}, quarter_turn_y),
          revolute_joint_3D(f1, socket, hand, axis::y), inertia_3D(hand, stick),
          prismatic_joint_3D(f2, hand, tip, axis::z), revolute_joint_3D(q2, tip, aside, axis::x),
          prismatic_joint_3D(q1, aside, palm, axis::y), inertia_3D(palm, point_mass(0.4)))
        .gravity(weight);

template <class S, int N>
joint_vector<S, N> random_vector(random_numbers& random, double size) {
  joint_vector<S, N> x;
  for (auto& e : x) e = S(random(size));
  return x;
}
template <class S, class Chain>
auto random_configuration(const Chain& c, random_numbers& random) {
  const auto q = integrate(c, neutral_configuration(c), random_vector<double, Chain::dofs>(random, 2), 1.0);
  return joint_vector<S, Chain::nq>(q.template cast<S>());
}
/// A configuration, velocities and accelerations.
template <class S, class Chain>
struct random_motion_of {
  joint_vector<S, Chain::nq> q;
  joint_vector<S, Chain::dofs> v, a;

  random_motion_of(const Chain& c, random_numbers& random)
      : q(random_configuration<S>(c, random)),
        v(random_vector<S, Chain::dofs>(random, 2)),
        a(random_vector<S, Chain::dofs>(random, 5)) {}
};
/// Where a motion with these v and a at time 0 is at time t, to second order in t.
template <class Chain, class Motion, class S>
auto position_at(const Chain& c, const Motion& m, const S& t) {
  using vector = std::remove_const_t<decltype(m.v)>;
  return integrate(c, m.q, vector(m.v + m.a * (t / 2)), t);
}
/// Central differences with h = 1e-12 at 50 digits: for values and derivatives below 1e3 they err by h^2 f'''/6 < 1e-21
/// at most, and lose 1e3 1e-50/h = 1e-35; second differences lose 1e3 1e-50/h^2 = 1e-23.
inline const big step = 1e-12;
inline constexpr double by_differences = 1e-20;

template <class F>
auto derivative(const F& f) {
  using result = decltype(f(big()));
  return result((f(step) - f(big(-step))) / big(2 * step));
}

template <class X>
double largest(const X& x) {
  return static_cast<double>(big(x.cwiseAbs().maxCoeff()));
}
/// max |a - b| / (1 + max |b|); infinite if there is a NaN.
template <class A, class B>
double gap(const A& a, const B& b) {
  double most = 0, size = 1;
  for (Eigen::Index i = 0; i < b.rows(); ++i)
    for (Eigen::Index j = 0; j < b.cols(); ++j) {
      const double d = std::fabs(static_cast<double>(big(a(i, j)) - big(b(i, j))));
      if (!(d <= most)) most = d == d ? d : HUGE_VAL;
      size = std::max(size, std::fabs(static_cast<double>(b(i, j))));
    }
  return most / size;
}
template <class S>
Eigen::Matrix<S, 3, 1> eigen(const vec3<S>& v) {
  return to_eigen<S>(v);
}
template <class S>
Eigen::Matrix<S, 6, 1> eigen(const linear_angular<S>& x) {
  Eigen::Matrix<S, 6, 1> r;
  r << eigen(x.linear), eigen(x.angular);
  return r;
}
/// Position and rotation in space, of frames in the plane too.
template <class R, class P>
auto in_space(const pose<R, P>& x) {
  using S = std::remove_cvref_t<decltype(x.position.x)>;
  pose<Eigen::Matrix<S, 3, 3>, Eigen::Matrix<S, 3, 1>> r;
  r.rotation = to_eigen<S>(matrix(x.rotation));
  if constexpr (requires { x.position.z; }) {
    r.position = to_eigen<S>(x.position);
  } else {
    r.position << x.position.x, x.position.y, S(0);
  }
  return r;
}
/// The vector of the skew part.
template <class M>
auto vector_of_skew(const M& m) {
  using S = typename M::Scalar;
  return Eigen::Matrix<S, 3, 1>((m(2, 1) - m(1, 2)) / 2, (m(0, 2) - m(2, 0)) / 2, (m(1, 0) - m(0, 1)) / 2);
}

/// max |x - reference| / max |reference|
template <class X>
long double off(const X& x, const long double* reference, std::size_t n) {
  long double difference = 0, size = 0;
  for (std::size_t i = 0; i < n; ++i) {
    const long double d = std::fabs(static_cast<long double>(x[static_cast<int>(i)]) - reference[i]);
    if (!(d <= difference)) difference = d == d ? d : HUGE_VALL;
    size = std::max(size, std::fabs(reference[i]));
  }
  return difference / size;
}

}  // namespace kte::test::small_chains
