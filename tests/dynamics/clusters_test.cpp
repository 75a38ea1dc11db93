#include <kte/dynamics.hpp>
#include <kte/elements/differential.hpp>
#include <kte/elements/dyad.hpp>
#include <kte/elements/four_bar.hpp>
#include <kte/elements/slider_crank.hpp>

#include <Eigen/Cholesky>

#include <string>

#include "catch.hpp"
#include "digits50.hpp"
#include "random.hpp"

namespace clusters_test {

using namespace kte;
using namespace kte::test;

inline constexpr struct crank_ final : coord_key<"q"> {
} crank;
inline constexpr struct coupler_ final : coord_key<"c"> {
} coupler;
inline constexpr struct rocker_ final : coord_key<"r"> {
} rocker;
inline constexpr struct ground_ final : frame_2D_key<"ground"> {
} ground;
inline constexpr struct crank_frame_ final : frame_2D_key<"crank"> {
} crank_frame;
inline constexpr struct tip_ final : frame_2D_key<"tip"> {
} tip;
inline constexpr struct coupler_frame_ final : frame_2D_key<"coupler"> {
} coupler_frame;
inline constexpr struct rocker_frame_ final : frame_2D_key<"rocker"> {
} rocker_frame;

/// The largest errors of forward dynamics: of its inverse, and against M a = tau - bias with M factorised; relative.
struct errors {
  double inverse = 0, dense = 0;
};
errors errors_of(const runtime_chain& c, double from, double to) {
  auto s = c.make_state();
  random_numbers draw(7);
  const int n = s.dofs();
  errors x;
  for (int k = 0; k < 10; ++k) {
    Eigen::VectorXd step(n), v(n), tau(n);
    for (int i = 0; i < n; ++i) step[i] = from + (to - from) * (draw() + 1) / 2, v[i] = draw(), tau[i] = draw();
    const Eigen::VectorXd q = integrate(c, neutral_configuration(c), step, 1.0);
    const Eigen::VectorXd a = forward_dynamics(c, s, q, v, tau), bias = nonlinear_effects(c, s, q, v);
    const Eigen::VectorXd dense = mass_matrix(c, s, q).ldlt().solve(tau - bias);
    x.inverse = std::max(x.inverse, (inverse_dynamics(c, s, q, v, a) - tau).norm() / (tau.norm() + bias.norm()));
    x.dense = std::max(x.dense, (a - dense).norm() / dense.norm());
  }
  return x;
}
rigid_body<> body(double mass) {
  return {mass, vec3<>{0.05, 0.02, -0.1}, sym3<>{0.02, 0.001, 0.002, 0.03, 0.001, 0.025}};
}
/// Four-bars in a row, each on the coupler of the one before.
runtime_chain four_bars(int n) {
  runtime_chain c;
  c.gravity(along_y(-9.81));
  const four_bar_lengths bars{.pivot = {0.35, 0.05}, .crank = 0.12, .coupler = 0.33, .rocker = 0.24};
  std::string base = "ground";
  for (int i = 0; i < n; ++i) {
    const std::string k = std::to_string(i);
    c << four_bar_2D("q" + k, "c" + k, "r" + k, bars) << revolute_joint_2D("q" + k, base, "crank" + k)
      << inertia_2D("crank" + k, planar_body(0.3, 0.001, along_x(0.06)))
      << rigid_link_2D("crank" + k, "tip" + k, along_x(bars.crank))
      << revolute_joint_2D("c" + k, "tip" + k, "coupler" + k)
      << inertia_2D("coupler" + k, planar_body(0.5, 0.004, along_x(0.15)))
      << revolute_joint_2D("r" + k, base, "rocker" + k).at(bars.pivot)
      << inertia_2D("rocker" + k, planar_body(0.4, 0.002, along_x(0.1)))
      << rigid_link_2D("coupler" + k, "next" + k, vec2<>{0.1, 0.2});
    base = "next" + k;
  }
  return c;
}
/// A free body on two legs: a rotor on the trunk that follows a hip fifty times as fast, a knee that follows a motor
/// without a joint, an ankle of two coordinates moved by two motors.
runtime_chain walker() {
  runtime_chain c;
  c.gravity(along_z(-9.81)) << base_3D("world") << free_joint_3D("float", "world", "trunk")
                            << inertia_3D("trunk", body(5));
  for (const std::string l : {"l", "r"})
    c << mimic_gen("hip" + l, "spin" + l, 50.0)
      << revolute_joint_3D("hip" + l, "trunk", "thigh" + l, along_y(1.0)).at(vec3<>{0, l == "l" ? 0.1 : -0.1, 0})
      << inertia_3D("thigh" + l, body(2)) << revolute_joint_3D("spin" + l, "trunk", "rotor" + l, along_x(1.0))
      << inertia_3D("rotor" + l, body(0.01)) << rigid_link_3D("thigh" + l, "knee" + l, along_z(-0.3))
      << mimic_gen("motor" + l, "bend" + l, 0.1) << inertia_gen("motor" + l, 1e-3)
      << revolute_joint_3D("bend" + l, "knee" + l, "shank" + l, along_y(1.0)) << inertia_3D("shank" + l, body(1))
      << joint_stiffness_gen("bend" + l, 20.0) << joint_damping_gen("bend" + l, 0.4)
      << rigid_link_3D("shank" + l, "ankle" + l, along_z(-0.3))
      << differential_gen("m1" + l, "m2" + l, "pitch" + l, 0.5, 0.5)
      << differential_gen("m1" + l, "m2" + l, "roll" + l, 0.5, -0.5) << inertia_gen("m1" + l, 0.01)
      << inertia_gen("m2" + l, 0.01) << inertia_gen("pitch" + l, 0.003)
      << revolute_joint_3D("pitch" + l, "ankle" + l, "cross" + l, along_y(1.0)) << inertia_3D("cross" + l, body(0.1))
      << revolute_joint_3D("roll" + l, "cross" + l, "foot" + l, along_x(1.0)) << inertia_3D("foot" + l, body(0.7))
      << fluid_drag_3D("foot" + l, 0.3);
  return c;
}

TEST_CASE("forward dynamics with clusters inverts inverse dynamics, and is that of a factorised M") {
  const auto holds = [](const runtime_chain& c, std::size_t clusters, double from, double to, double rounding) {
    CHECK(c.make_state().tree().clusters.clusters.size() == clusters);
    CHECK(c.make_state().tree().clusters.complete);
    const errors x = errors_of(c, from, to);
    CHECK(x.inverse < rounding);
    CHECK(x.dense < 100 * rounding);
  };
  holds(four_bars(1), 1, 0.5, 1.2, 1e-14);
  holds(four_bars(6), 6, 0.5, 1.2, 5e-14);
  holds(walker(), 6, -0.5, 0.5, 1e-15);

  runtime_chain arm;  // the first joint leads the last, so those between are in the cluster too
  arm.gravity(along_z(-9.81)) << mimic_gen("a", "d", -0.7) << revolute_joint_3D("a", "w", "A", along_y(1.0))
                              << inertia_3D("A", body(1)) << spherical_joint_3D("b", "A", "B")
                              << inertia_3D("B", body(1)) << rigid_link_3D("B", "tip", along_z(0.2))
                              << prismatic_joint_3D("c", "tip", "C", along_z(1.0)) << inertia_3D("C", body(1))
                              << revolute_joint_3D("d", "C", "D", along_y(1.0)) << inertia_3D("D", body(1))
                              << joint_damping_gen("d", 0.3) << revolute_joint_3D("e", "D", "E", along_z(1.0))
                              << inertia_3D("E", body(1));
  holds(arm, 1, -0.5, 0.5, 1e-15);

  runtime_chain shared;  // a coordinate of two joints; two coordinates with masses and no joint
  shared.gravity(along_z(-9.81)) << mimic_gen("m", "n", 3.0) << inertia_gen("n", 0.2) << inertia_gen("m", 0.1)
                                 << inertia_gen("lone", 0.4) << revolute_joint_3D("a", "w", "A", along_y(1.0))
                                 << inertia_3D("A", body(1)) << revolute_joint_3D("a", "A", "B", along_x(1.0))
                                 << inertia_3D("B", body(1));
  shared << joint_stiffness_gen("lone", 3.0);
  holds(shared, 2, -0.5, 0.5, 1e-15);

  runtime_chain slider;
  slider.gravity(along_y(-9.81)) << slider_crank_2D("q", "r", "x", {.crank = 0.1, .rod = 0.3})
                                 << revolute_joint_2D("q", "w", "crank")
                                 << inertia_2D("crank", planar_body(0.3, 0.001, along_x(0.06)))
                                 << rigid_link_2D("crank", "pin", along_x(0.1)) << revolute_joint_2D("r", "pin", "rod")
                                 << inertia_2D("rod", planar_body(0.3, 0.002, along_x(0.1)))
                                 << prismatic_joint_2D("x", "w", "slider", along_x(1.0))
                                 << inertia_2D("slider", point_mass(0.5));
  holds(slider, 1, -3.0, 3.0, 1e-15);
}

TEST_CASE("clusters in numbers of 50 digits") {
  const four_bar_lengths bars{.pivot = {0.35, 0.05}, .crank = 0.12, .coupler = 0.33, .rocker = 0.24};
  const auto fixed =
      chain(four_bar_2D(crank, coupler, rocker, bars), revolute_joint_2D(crank, ground, crank_frame),
            inertia_2D(crank_frame, planar_body(0.3, 0.001, along_x(0.06))),
            rigid_link_2D(crank_frame, tip, along_x(bars.crank)), revolute_joint_2D(coupler, tip, coupler_frame),
            inertia_2D(coupler_frame, planar_body(0.5, 0.004, along_x(0.15))),
            revolute_joint_2D(rocker, ground, rocker_frame).at(bars.pivot),
            inertia_2D(rocker_frame, planar_body(0.4, 0.002, along_x(0.1))))
          .gravity(along_y(-9.81));
  const auto c = four_bars(1);
  auto s = c.make_state();
  using exact = std::array<digits50, 1>;
  for (const double q : {0.5, 0.8, 1.1}) {
    const double v = 1.3, tau = 0.2;
    const auto reference = forward_dynamics(fixed, exact{q}, exact{v}, exact{tau});
    const auto back = inverse_dynamics(fixed, exact{q}, exact{v}, exact{reference[0]});
    CHECK(std::abs(static_cast<double>(back[0] - digits50(tau))) < 1e-47);
    const double a = forward_dynamics(c, s, std::array{q}, std::array{v}, std::array{tau})[0];
    CHECK(static_cast<double>(reference[0] - digits50(a)) / a == within(0, 1e-14));
  }
}

TEST_CASE("a cluster that moves no mass is refused by name") {
  runtime_chain c;
  c << mimic_gen("a", "b", 2.0) << revolute_joint_2D("a", "w", "A") << rigid_link_2D("A", "tip", along_x(0.5))
    << revolute_joint_2D("b", "tip", "B");
  auto s = c.make_state();
  const std::array zero{0.0};
  CHECK_THROWS_AS(forward_dynamics(c, s, zero, zero, zero), singular_mass_matrix);
  CHECK_THROWS_MATCHES(forward_dynamics(c, s, zero, zero, zero), singular_mass_matrix, test::says("'a'"));
}

}  // namespace clusters_test
