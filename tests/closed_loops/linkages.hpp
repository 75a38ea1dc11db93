#pragma once

#include "closed_loops/mechanisms.hpp"

/// Linkages from the literature.
namespace kte::test::loops {

/// Andrews' squeezer as a tree of seven bodies with three pins (Hairer and Wanner, Solving Ordinary Differential
/// Equations II, section VII.7): a torque of 0.033 Nm on the crank q1.
inline runtime_chain andrews() {
  const auto body = [](double m, double i, double x, double y) { return planar_body(m, i, vec3{x, y, zero}); };
  runtime_chain k;
  k << base_2D("O") << rigid_link_2D("O", "A", vec2<>{-0.06934, -0.00227})
    << rigid_link_2D("O", "B", vec2<>{-0.03635, 0.03273}) << rigid_link_2D("O", "C", vec2<>{0.014, 0.072})
    << revolute_joint_2D("q1", "O", "K1") << inertia_2D("K1", body(0.04325, 2.194e-6, 0.00092, 0))
    << rigid_link_2D("K1", "P", along_x(0.007)) << revolute_joint_2D("q2", "P", "K2")
    << inertia_2D("K2", body(0.00365, 4.410e-7, 0.0115, 0)) << rigid_link_2D("K2", "E2", along_x(0.028))
    << revolute_joint_2D("q3", "B", "K3") << inertia_2D("K3", body(0.02373, 5.255e-6, 0.01874, 0.01043))
    << rigid_link_2D("K3", "E", along_x(0.035)) << rigid_link_2D("K3", "D", vec2<>{0.018, 0.02})
    << spring_2D("D", "C", 0.07785, 4530.0) << revolute_joint_2D("q4", "E", "K4")
    << inertia_2D("K4", body(0.00706, 5.667e-7, 0.01421, 0)) << rigid_link_2D("K4", "F4", along_x(0.02))
    << revolute_joint_2D("q5", "A", "K5") << inertia_2D("K5", body(0.07050, 1.169e-5, 0.02308, 0.00916))
    << rigid_link_2D("K5", "F5", along_x(0.04)) << revolute_joint_2D("q6", "E", "K6")
    << inertia_2D("K6", body(0.00706, 5.667e-7, 0.01421, 0)) << rigid_link_2D("K6", "F6", along_x(0.02))
    << revolute_joint_2D("q7", "A", "K7") << inertia_2D("K7", body(0.05498, 1.912e-5, 0.01228, -0.00449))
    << rigid_link_2D("K7", "F7", along_x(0.04)) << constant_force_2D("K1", vec2<>{0, 0}, 0.033)
    << coincident_points_2D("e", "E2", "E") << coincident_points_2D("f", "F4", "F5")
    << coincident_points_2D("g", "F6", "F7");
  return k;
}
/// Its start in the test set for initial value problems, of crank, K3, K5, K7 to 17 digits.
inline vector andrews_start() {
  const double q1 = -0.0617138900142764496, q3 = 0.45527981916307038 - pi / 2, q5 = 0.48736497954384255,
               q7 = 1.23054744454982119 - pi / 2;
  struct point {
    double x, y;
  };
  const auto tip = [](point p, double r, double q) { return point{p.x + r * std::cos(q), p.y + r * std::sin(q)}; };
  const auto way = [](point a, point b) { return std::atan2(b.y - a.y, b.x - a.x); };
  const point a{-0.06934, -0.00227}, b{-0.03635, 0.03273}, e = tip(b, 0.035, q3);
  return numbers({q1, way(tip({0, 0}, 0.007, q1), e) - q1, q3, way(e, tip(a, 0.04, q5)) - q3, q5,
                  way(e, tip(a, 0.04, q7)) - q3, q7});
}

/// Three parallel bars of 1 m on pivots (0, 0), (1/2, 0), (1, 0), and a coupler of 1 m between their ends, which the
/// third bar makes redundant. Of mass 1 kg each:
///
///   q'' = -5/4 g cos q          (1)
inline runtime_chain three_parallel_bars() {
  runtime_chain c;
  c.gravity(along_y(-9.81));
  for (int i = 0; i < 3; ++i) {
    const auto s = std::to_string(i);
    c << revolute_joint_2D("q" + s, "base", "b" + s).at(vec2<>{i / 2.0, 0}) << inertia_2D("b" + s, bar)
      << rigid_link_2D("b" + s, "t" + s, along_x(1.0));
  }
  c << revolute_joint_2D("k", "t0", "coupler") << inertia_2D("coupler", bar)
    << rigid_link_2D("coupler", "middle", along_x(0.5)) << rigid_link_2D("coupler", "end", along_x(1.0))
    << coincident_points_2D("third", "middle", "t1") << coincident_points_2D("pin", "end", "t2");
  return c;
}

/// Sarrus' linkage: a platform on two legs of two links of 1 m, whose hinges are along y in one and along x in the
/// other, so that it moves along z alone: with q1 the angle of the links from z,
///
///   q = (q1, -2 q1, q1, q1, -2 q1),   h = 2 cos q1          (2)
///
/// The closing hinge has 5 rows of rank 4.
inline runtime_chain sarrus() {
  const rigid_body<> up{1.0, vec3<>{0, 0, 0.5}, sym3<>{1.0 / 12, 0, 0, 1.0 / 12, 0, 1e-3}};
  const rigid_body<> down{1.0, vec3<>{0, 0, -0.5}, sym3<>{1.0 / 12, 0, 0, 1.0 / 12, 0, 1e-3}};
  runtime_chain c;
  c.gravity(along_z(-9.81)) << revolute_joint_3D("q1", "base", "a1", axis::y).at(vec3<>{0.5, 0, 0})
                            << inertia_3D("a1", up) << rigid_link_3D("a1", "knee1", along_z(1.0))
                            << revolute_joint_3D("q2", "knee1", "a2", axis::y) << inertia_3D("a2", up)
                            << rigid_link_3D("a2", "top1", along_z(1.0))
                            << revolute_joint_3D("q3", "top1", "platform", axis::y)
                            << inertia_3D("platform",
                                          rigid_body<>{2.0, vec3<>{-0.5, 0, 0}, sym3<>{0.3, 0, 0, 0.3, 0, 0.5}})
                            << rigid_link_3D("platform", "top2", vec3<>{-0.5, 0.5, 0})
                            << revolute_joint_3D("q4", "top2", "b1", axis::x) << inertia_3D("b1", down)
                            << rigid_link_3D("b1", "knee2", along_z(-1.0))
                            << revolute_joint_3D("q5", "knee2", "b2", axis::x) << inertia_3D("b2", down)
                            << rigid_link_3D("b2", "foot2", along_z(-1.0))
                            << rigid_link_3D("base", "ground2", vec3<>{0, 0.5, 0})
                            << hinge_3D("hinge", "ground2", "foot2", axis::x);
  return c;
}
/// The angle q1 at time t, by its one equation: with links of 1 kg and a platform of 2 kg,
///
///   T = m(q) q'^2 / 2,   m = 2 (1/4 + 1/6 + cos^2 q / 4 + 9/4 sin^2 q) + 8 sin^2 q,   V = 8 g cos q          (3)
inline double sarrus_angle(double q, double rate, double t) {
  const auto f = [](double, const Eigen::Vector2d& x) {
    const double s = std::sin(x[0]), c = std::cos(x[0]);
    const double m = 2 * (1.0 / 4 + 1.0 / 6 + c * c / 4 + 9.0 / 4 * s * s) + 8 * s * s;
    return Eigen::Vector2d(x[1], (8 * 9.81 * s - 12 * s * c * x[1] * x[1]) / m);
  };
  prince_dormand87 solver(f, 0.0, Eigen::Vector2d(q, rate), {.absolute = 1e-14, .relative = 1e-14});
  solver.integrate(t);
  return solver.state()[0];
}

/// A parallelogram whose coupler has the given mass, and whose bars have 1 kg each: (1) of mechanisms.hpp with
/// k = g (1 + mass) / (2/3 + mass).
inline runtime_chain parallelogram(double mass) {
  runtime_chain c;
  c.gravity(along_y(-9.81));
  for (const char* s : {"0", "1"})
    c << revolute_joint_2D(std::string("q") + s, "base", std::string("b") + s).at(vec2<>{s[0] == '1' ? 1.0 : 0.0, 0})
      << inertia_2D(std::string("b") + s, bar)
      << rigid_link_2D(std::string("b") + s, std::string("t") + s, along_x(1.0));
  c << revolute_joint_2D("c0", "t0", "k") << inertia_2D("k", planar_body(mass, mass / 12, along_x(0.5)))
    << rigid_link_2D("k", "e", along_x(1.0)) << coincident_points_2D("pin", "t1", "e");
  return c;
}

/// The flyball governor of tests/data/problems with its two hinges cut: rods move freely, and hinges close them.
inline runtime_chain cut_governor() {
  constexpr double along = 0.3 * (0.01 * 0.01 + 0.01 * 0.01) / 12, across = 0.3 * (1 + 0.01 * 0.01) / 12;
  const rigid_body<> rod{0.3, vec3<>{0.5, 0, 0}, sym3<>{along, 0, 0, across, 0, across}};
  runtime_chain c;
  c.gravity(along_z(-9.81)) << revolute_joint_3D("turn", "base", "shaft", axis::z)
                            << inertia_3D("shaft", rigid_body<>{0.3, vec3<>{}, sym3<>{across, 0, 0, across, 0, along}})
                            << prismatic_joint_3D("height", "shaft", "slider", axis::z)
                            << inertia_3D("slider", rigid_body<>{3.0, vec3<>{}, sym3<>{0.005, 0, 0, 0.005, 0, 0.005}})
                            << rigid_link_3D("shaft", "hinge1", vec3<>{0.05, 0, 1.0})
                            << rigid_link_3D("shaft", "hinge2", vec3<>{-0.05, 0, 1.0}, half_turn_z);
  for (const std::string s : {"1", "2"})
    c << free_joint_3D("free" + s, "base", "rod" + s) << inertia_3D("rod" + s, rod)
      << rigid_link_3D("rod" + s, "middle" + s, along_x(0.5)) << rigid_link_3D("rod" + s, "end" + s, along_x(1.0))
      << inertia_3D("end" + s, point_mass(5.0)) << rigid_link_3D("slider", "side" + s, along_x(s == "1" ? 0.05 : -0.05))
      << spring_3D("middle" + s, "side" + s, 0.5, 8e5) << damper_3D("middle" + s, "side" + s, 4e4)
      << hinge_3D("cut" + s, "hinge" + s, "rod" + s, axis::y);
  return c;
}
/// Its start: rods 30 degrees below the horizontal, turning at 2 pi rad/s. q: turn, height, and of each rod its
/// position and quaternion w, x, y, z.
inline vector cut_governor_q() {
  const double c = std::cos(pi / 12), s = std::sin(pi / 12);
  return numbers({0, 0.5, 0.05, 0, 1, c, 0, s, 0, -0.05, 0, 1, 0, -s, 0, c});
}

/// Its velocities: rods turn with the shaft, w = 2 pi z in their own axes, and their hinges move.
inline vector cut_governor_v() {
  const double w = 2 * pi;
  vector v = vector::Unit(14, 0) * w;
  for (int rod = 0; rod < 2; ++rod)
    v.segment(2 + 6 * rod, 6) = numbers({0, w * 0.05, 0, -w * 0.5, 0, w * std::cos(pi / 6)});
  return v;
}

/// A Stewart platform: six legs of a universal joint and a slide with a spring of 2e4 N/m, from a base of radius 1 m to
/// a platform of radius 0.5 m and 20 kg. The first leg carries the platform by a ball, five are closed by points.
inline runtime_chain stewart() {
  runtime_chain c;
  c.gravity(along_z(-9.81));
  const auto on_circle = [](double radius, double degrees) {
    return vec3<>{radius * std::cos(degrees * pi / 180), radius * std::sin(degrees * pi / 180), 0};
  };
  const double base[]{-10, 10, 110, 130, 230, 250}, top[]{-50, 50, 70, 170, 190, 290};
  const rigid_body<> rod{1.0, vec3<>{0, 0, -0.4}, sym3<>{0.05, 0, 0, 0.05, 0, 1e-3}};
  for (int i = 0; i < 6; ++i) {
    const auto s = std::to_string(i);
    c << revolute_joint_3D("x" + s, "base", "u" + s, axis::x).at(on_circle(1.0, base[i]))
      << revolute_joint_3D("y" + s, "u" + s, "v" + s, axis::y) << prismatic_joint_3D("l" + s, "v" + s, "e" + s, axis::z)
      << inertia_3D("e" + s, rod) << joint_stiffness_gen("l" + s, 2e4, 1.2);
  }
  c << spherical_joint_3D("ball", "e0", "joint")
    << rigid_link_3D("joint", "platform", vec3<>{} - on_circle(0.5, top[0]))
    << inertia_3D("platform", rigid_body<>{20, vec3<>{0, 0, 0.1}, sym3<>{1, 0, 0, 1, 0, 2}});
  for (int i = 1; i < 6; ++i) {
    const auto s = std::to_string(i);
    c << rigid_link_3D("platform", "p" + s, on_circle(0.5, top[i]))
      << coincident_points_3D("leg" + s, "e" + s, "p" + s);
  }
  return c;
}
/// A guess of its configuration: legs upright, and 1.1 m long.
inline vector stewart_guess(const runtime_chain& c) {
  vector q = neutral_configuration(c);
  for (const auto& e : layout(c))
    if (e.name[0] == 'l') q[e.q] = 1.1;
  return q;
}

/// A Delta robot: three arms of 0.3 m on hinges, and two massless rods of 0.8 m from each to a platform of 1 kg.
inline runtime_chain delta() {
  runtime_chain c;
  c.gravity(along_z(-9.81)) << free_joint_3D("free", "base", "platform")
                            << inertia_3D("platform", rigid_body<>{1, vec3<>{}, sym3<>{1e-3, 0, 0, 1e-3, 0, 2e-3}});
  for (int i = 0; i < 3; ++i) {
    const auto s = std::to_string(i);
    const auto turn = as<double>(matrix(rotation_about(axis::z, 2 * pi / 3 * i)));
    c << rigid_link_3D("base", "side" + s, turn * vec3<>{0.2, 0, 0}, turn)
      << revolute_joint_3D("q" + s, "side" + s, "arm" + s, axis::y)
      << inertia_3D("arm" + s, rigid_body<>{0.5, vec3<>{0.15, 0, 0}, sym3<>{1e-3, 0, 0, 5e-3, 0, 5e-3}})
      << rigid_link_3D("platform", "rim" + s, turn * vec3<>{0.05, 0, 0}, turn);
    for (const double side : {-0.06, 0.06}) {
      const auto n = s + (side < 0 ? "l" : "r");
      c << rigid_link_3D("arm" + s, "elbow" + n, vec3<>{0.3, side, 0})
        << rigid_link_3D("rim" + s, "wrist" + n, vec3<>{0, side, 0})
        << distance_3D("rod" + n, "elbow" + n, "wrist" + n, 0.8);
    }
  }
  return c;
}
/// A guess of its configuration: arms level, the platform 0.6 m below.
inline vector delta_guess() { return numbers({0, 0, -0.6, 1, 0, 0, 0, 0.1, -0.1, 0.2}); }

/// An ankle: a foot on a universal joint, moved by two motors on the shank, each with a crank and a massless rod to the
/// heel.
inline runtime_chain ankle() {
  runtime_chain c;
  c.gravity(along_z(-9.81)) << revolute_joint_3D("pitch", "shank", "cross", axis::y)
                            << revolute_joint_3D("roll", "cross", "foot", axis::x)
                            << inertia_3D("foot",
                                          rigid_body<>{1.2, vec3<>{0.04, 0, -0.05}, sym3<>{2e-3, 0, 0, 6e-3, 0, 6e-3}});
  for (const double side : {-1.0, 1.0}) {
    const std::string n = side < 0 ? "r" : "l";
    const double height = side < 0 ? 0.16 : 0.26;
    c << revolute_joint_3D("motor_" + n, "shank", "crank_" + n, axis::y).at(vec3<>{0, 0.04 * side, height})
      << inertia_3D("crank_" + n, rigid_body<>{0.1, vec3<>{-0.02, 0, 0}, sym3<>{1e-5, 0, 0, 3e-5, 0, 3e-5}})
      << inertia_gen("motor_" + n, 5e-3) << joint_stiffness_gen("motor_" + n, 2.0, 0.0)
      << rigid_link_3D("crank_" + n, "pin_" + n, along_x(-0.05))
      << rigid_link_3D("foot", "heel_" + n, vec3<>{-0.05, 0.04 * side, 0})
      << distance_3D("rod_" + n, "pin_" + n, "heel_" + n, height);
  }
  return c;
}

}  // namespace kte::test::loops
