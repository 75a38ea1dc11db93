#pragma once

#include <kte/dynamics/coriolis_matrix.hpp>
#include <kte/dynamics/derivatives.hpp>
#include <kte/dynamics/forward_dynamics.hpp>
#include <kte/dynamics/forward_kinematics.hpp>
#include <kte/dynamics/hybrid_dynamics.hpp>
#include <kte/dynamics/inverse_dynamics.hpp>
#include <kte/dynamics/jacobian_rate.hpp>
#include <kte/dynamics/mass_matrix.hpp>
#include <kte/dynamics/mass_matrix_inverse.hpp>
#include <kte/dynamics/momentum_rate.hpp>
#include <kte/dynamics/relative_motion.hpp>
#include <kte/dynamics/subtree_inertia.hpp>
#include <kte/elements/line_point_mindist.hpp>
#include <kte/elements/position_measure.hpp>
#include <kte/math/dual.hpp>
#include <kte/math/pack.hpp>
#include <kte/runtime_chain/runtime_chain.hpp>

#include "catch.hpp"
#include "chain/models.hpp"
#include "digits50.hpp"
#include "random.hpp"

/// All algorithms of runtime chains in scalars other than double: loops over body nodes, each against 50 digits.
namespace kte::test::runtime_scalars {

inline constexpr struct trunk_pose_ final : pose_3D_key<"trunk pose"> {
} trunk_pose;
inline constexpr struct ball_ final : rotation_3D_key<"ball"> {
} ball;

/// A trunk that is free; a leg of a general axis and a slide; an arm of a ball and a hinge, with a rotor.
inline runtime_chain creature() {
  using namespace ::models;
  constexpr rigid_body body{1.5, vec3{0.02, -0.03, 0.1}, sym3{0.03, 0.001, -0.002, 0.025, 0.003, 0.02}};
  static constexpr auto c = chain(free_joint_3D(trunk_pose, ground, trunk), inertia_3D(trunk, body),
                                  rigid_link_3D(trunk, left, vec3{0.1, 0.2, -0.3}, quarter_turn_x),
                                  revolute_joint_3D(hip, left, thigh, vec3{0.6, 0.0, 0.8}), inertia_3D(thigh, body),
                                  prismatic_joint_3D(slide, thigh, shank, axis::minus_y), inertia_3D(shank, body),
                                  spherical_joint_3D(ball, trunk, right), inertia_3D(right, body),
                                  inertia_3D(right, point_mass(0.5)), revolute_joint_3D(knee, right, hand, axis::x),
                                  inertia_3D(hand, point_mass(0.7, along_z(-0.4))), inertia_gen(knee, 0.05))
                                .gravity(vec3{0.3, -0.4, -9.81});
  return element_by_element(c);
}

/// The results of all algorithms, each in a row.
template <class S>
using results = std::vector<std::vector<S>>;
template <class S>
results<S> all_results(const runtime_chain& c, basic_runtime_state<S>& s, const runtime_vector<S>& q,
                       const runtime_vector<S>& v, const runtime_vector<S>& a) {
  results<S> all;
  const auto add = [&all](const auto& x) { all.emplace_back(x.data(), x.data() + x.size()); };
  const auto add_vector = [&all](const auto& x) { all.push_back({x.x, x.y, x.z}); };
  add(inverse_dynamics(c, s, q, v, a)), add(mass_matrix(c, s, q)), add(forward_dynamics(c, s, q, v, a));
  add(mass_matrix_inverse(c, s, q));
  const auto& id = inverse_dynamics_derivatives(c, s, q, v, a);
  add(id.by_q), add(id.by_v), add(id.by_a);
  const auto& fd = forward_dynamics_derivatives(c, s, q, v, a);
  add(fd.by_q), add(fd.by_v), add(fd.by_tau);
  const auto hybrid = hybrid_dynamics(c, s, q, v, a, {"knee", "ball"});
  add(hybrid.a), add(hybrid.tau);
  add(nonlinear_effects(c, s, q, v)), add(coriolis_forces(c, s, q, v)), add(gravity_forces(c, s, q));
  add(jacobian(c, s, q, "hand")), add(jacobian(c, s, q, "shank", in_world_axes));
  const auto hand = forward_kinematics(c, s, q, "hand");
  add_vector(hand.position), add_vector(hand.rotation.x), add_vector(hand.rotation.y);
  add(centroidal_momentum_matrix(c, s, q));
  add_vector(centre_of_mass(c, s, q).position), add_vector(centre_of_mass_velocity(c, s, q, v));
  add_vector(centroidal_momentum(c, s, q, v).angular);
  const auto rate = centroidal_momentum_rate(c, s, q, v, a);  // whose moments nearly cancel here
  all.push_back({rate.linear.x, rate.linear.y, rate.linear.z, rate.angular.x, rate.angular.y, rate.angular.z});
  add(centre_of_mass_jacobian(c, s, q));
  add(coriolis_matrix(c, s, q, v)), add(jacobian_rate(c, s, q, v, "hand", at_world_origin));
  add(relative_jacobian(c, s, q, "hand", "shank")), add_vector(relative_pose(c, s, q, "hand", "shank").position);
  add_vector(subtree_inertia(c, s, q, "trunk").moment);
  return all;
}

/// Numbers that are exact in float.
struct sample {
  Eigen::VectorXd q, v, a;
  sample(const runtime_chain& c, random_numbers& r) : q(c.nq()), v(c.dofs()), a(c.dofs()) {
    for (auto* x : {&q, &v, &a})
      for (auto& y : *x) y = std::round(r(384.0)) / 256;
  }
};
template <class S>
results<S> results_in(const runtime_chain& c, const sample& x) {
  auto s = c.make_state<S>();
  return all_results<S>(c, s, x.q.cast<S>(), x.v.cast<S>(), x.a.cast<S>());
}
/// The largest difference, of one algorithm relative to its largest number.
template <class S, class Number>
double gap(const results<S>& x, const results<digits50>& exact, const Number& number) {
  REQUIRE(x.size() == exact.size());
  double worst = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    REQUIRE(x[i].size() == exact[i].size());
    digits50 size = 0, off = 0;
    for (std::size_t k = 0; k < x[i].size(); ++k) {
      size = std::max(size, digits50(abs(exact[i][k])));
      off = worse(off, digits50(abs(digits50(number(x[i][k])) - exact[i][k])));
    }
    worst = worse(worst, static_cast<double>(digits50(off / size)));
  }
  return worst;
}
/// Units of the last place, in float, double and long double alike. Solving with M may lose its condition number, which
/// is 470 here; accelerations' derivatives lose up to 57.
constexpr double roundings = 64;
template <class S>
void check(const runtime_chain& c, const sample& x, const results<digits50>& exact) {
  const auto itself = [](const S& y) { return y; };
  CHECK(gap(results_in<S>(c, x), exact, itself) < roundings * static_cast<double>(std::numeric_limits<S>::epsilon()));
}

/// Two hinges and a slide on each other, and what stands beside: a frame that follows, and a measure.
inline runtime_chain tandem(const char* first, const char* second, const char* third) {
  runtime_chain c;
  c.gravity(vec3{0.3, -0.4, -9.81})
      << revolute_joint_3D(first, "base", "a", axis::y) << inertia_3D("a", point_mass(1.5, vec3{0.5, 0.125, -0.25}))
      << revolute_joint_3D(second, "a", "b", vec3{0.6, 0.0, 0.8}).at(vec3{0.5, 0.25, 0.0}, quarter_turn_x)
      << inertia_3D("b", point_mass(0.75, vec3{0.25, -0.5, 0.125})) << prismatic_joint_3D(third, "b", "c", axis::x)
      << inertia_3D("c", point_mass(0.5, vec3{0.0, 0.25, 0.5}))
      << line_point_mindist_3D("c", "nearest", axis::x, vec3{0.0, 0.5, 0.0}) << position_measure_3D("b", "where");
  return c;
}
/// Sums of rows and columns 0, 2: of a matrix over three coordinates where the first and third are one.
template <class M>
M merged(const M& x) {
  M two(2, 2);
  two << x(0, 0) + x(0, 2) + x(2, 0) + x(2, 2), x(0, 1) + x(2, 1), x(1, 0) + x(1, 2), x(1, 1);
  return two;
}
/// Derivatives of dynamics where two joints share a coordinate are sums of those where each has its own.
template <class S>
void check_shared() {
  const auto c = tandem("q", "p", "q"), apart = tandem("q", "p", "r");
  auto s = c.make_state<S>(), t = apart.make_state<S>();
  runtime_vector<S> q(2), v(2), a(2), q3(3), v3(3), a3(3);
  q << S(0.375), S(-0.75), v << S(1.25), S(-0.5), a << S(-2), S(1.5);
  q3 << q, q[0], v3 << v, v[0], a3 << a, a[0];
  const double tolerance = roundings * static_cast<double>(std::numeric_limits<S>::epsilon());
  const auto close = [&](const auto& x, const auto& exact) {
    return static_cast<double>((x - exact).norm() / exact.norm()) < tolerance;
  };
  const auto& split = inverse_dynamics_derivatives(apart, t, q3, v3, a3);
  // twice: the second time into matrices that hold the first
  for (int i = 0; i < 2; ++i) (void)inverse_dynamics_derivatives(c, s, q, v, a);
  const auto r = inverse_dynamics_derivatives(c, s, q, v, a);
  CHECK(close(r.by_q, merged(split.by_q)));
  CHECK(close(r.by_v, merged(split.by_v)));
  CHECK(close(r.by_a, merged(split.by_a)));
  const auto& f = forward_dynamics_derivatives(c, s, q, v, r.tau);
  CHECK(close(f.a, a));
  CHECK(close(r.by_a * f.by_q, -r.by_q));
  CHECK(close(r.by_a * f.by_v, -r.by_v));
}

}  // namespace kte::test::runtime_scalars
