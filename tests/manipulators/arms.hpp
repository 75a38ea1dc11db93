#pragma once

#include <kte/elements/prismatic_joint.hpp>
#include <kte/elements/revolute_joint.hpp>
#include <kte/elements/rigid_link.hpp>
#include <kte/manipulators/inverse_kinematics.hpp>
#include <kte/manipulators/runtime_manipulator.hpp>
#include <kte/math/dual.hpp>

#include <initializer_list>
#include <string>

#include "catch.hpp"
#include "random.hpp"

/// Arms as lists: joints about axes, and the way from each to the next where all are at zero.
namespace arms {

using kte::vec3;

struct joint {
  vec3<> axis, offset;
  bool slides = false;
};
inline kte::runtime_chain chain(const vec3<>& pedestal, std::initializer_list<joint> joints) {
  kte::runtime_chain c;
  std::string at = "base";
  int i = 0;
  const auto link = [&](const vec3<>& p) {
    const std::string next = "mount" + std::to_string(i + 1);
    c << kte::rigid_link_3D(at, next, p);
    at = next;
  };
  link(pedestal);
  for (const auto& j : joints) {
    const std::string n = std::to_string(++i);
    if (j.slides)
      c << kte::prismatic_joint_3D("q" + n, at, "link" + n, j.axis);
    else
      c << kte::revolute_joint_3D("q" + n, at, "link" + n, j.axis);
    at = "link" + n;
    if (i == static_cast<int>(joints.size()))
      c << kte::rigid_link_3D(at, "tool", j.offset);
    else
      link(j.offset);
  }
  return c;
}
inline constexpr vec3<> e_x{1, 0, 0}, e_y{0, 1, 0}, e_z{0, 0, 1}, minus_y{0, -1, 0}, minus_z{0, 0, -1}, none{0, 0, 0};

/// An industrial arm with no offsets; its wrist is right-angled.
inline auto plain_3R3R() {
  return chain(none, {{e_z, {0, 0, 1}},
                      {minus_y, {0, 0, 1}},
                      {minus_y, {0, 0, .5}},
                      {e_z, {0, 0, .5}},
                      {minus_y, {0, 0, .2}},
                      {e_z, none}});
}
/// ABB's IRB 2400, from Brandstoetter, Angerer and Hofbaur 2014.
inline auto irb2400() {
  return chain(none, {{e_z, {.1, 0, .615}},
                      {e_y, {0, 0, .705}},
                      {e_y, {-.135, 0, .755}},
                      {e_z, none},
                      {e_y, none},
                      {e_z, {0, 0, .085}}});
}
inline auto ur5() {
  return chain({0, 0, .089159}, {{e_z, {0, .13585, 0}},
                                 {e_y, {.425, -.1197, 0}},
                                 {e_y, {.39225, 0, 0}},
                                 {e_y, {0, .093, 0}},
                                 {minus_z, {0, 0, -.09465}},
                                 {e_y, {0, .0823, 0}}});
}
inline auto iiwa14() {
  return chain(none, {{e_z, {0, 0, .36}},
                      {e_y, none},
                      {e_z, {0, 0, .42}},
                      {minus_y, none},
                      {e_z, {0, 0, .4}},
                      {e_y, none},
                      {e_z, {0, 0, .126}}});
}
/// A vector and its rate.
inline vec3<kte::dual<double, 1>> moving(const vec3<>& a, const vec3<>& rate) {
  const auto one = [](double value, double by) {
    kte::dual<double, 1> n(value);
    n.derivative[0] = by;
    return n;
  };
  return {one(a.x, rate.x), one(a.y, rate.y), one(a.z, rate.z)};
}
inline auto planar_3R() { return chain(none, {{e_z, {1, 0, 0}}, {e_z, {.8, 0, 0}}, {e_z, {.3, 0, 0}}}); }
inline auto scara() {
  return chain({0, 0, .3}, {{e_z, {.4, 0, 0}}, {e_z, {.3, 0, 0}}, {e_z, {0, 0, -.1}, true}, {e_z, {.05, 0, 0}}});
}

/// A spherical wrist behind axes that are neither parallel nor meet.
inline auto bent() {
  return chain(none, {{e_z, {.2, .1, .6}},
                      {{0, .6, .8}, {.1, 0, .7}},
                      {e_x, {-.1, .2, .7}},
                      {e_z, none},
                      {e_y, none},
                      {e_z, {0, 0, .085}}});
}
/// A UR5 whose axes 5 and 6 do not intersect.
inline auto ur5_with_offset() {
  return chain({0, 0, .089159}, {{e_z, {0, .13585, 0}},
                                 {e_y, {.425, -.1197, 0}},
                                 {e_y, {.39225, 0, 0}},
                                 {e_y, {0, .093, 0}},
                                 {minus_z, {.07, 0, -.09465}},
                                 {e_y, {0, .0823, 0}}});
}
/// Franka Emika's Panda.
inline auto panda() {
  return chain({0, 0, .333}, {{e_z, none},
                              {e_y, {0, 0, .316}},
                              {e_z, {.0825, 0, 0}},
                              {minus_y, {-.0825, 0, .384}},
                              {e_z, none},
                              {minus_y, {.088, 0, 0}},
                              {minus_z, {0, 0, -.107}}});
}
/// The European Robotic Arm, and one like Canadarm2.
inline auto era() {
  return chain({0, 0, 1.228}, {{e_z, {0, 0, 1.228}},
                               {e_y, {0, 0, .34}},
                               {e_x, {0, 0, 4.072}},
                               {e_x, {0, 0, 4.072}},
                               {e_x, {0, 0, .34}},
                               {e_y, {0, 0, 1.228}},
                               {e_z, none}});
}
inline auto ssrms() {
  return chain(none, {{e_z, {.38, -.635, 0}},
                      {minus_y, {.38, 0, .504}},
                      {e_z, {6.85, 0, .504}},
                      {e_z, {6.85, 0, .504}},
                      {e_z, {.38, 0, 0}},
                      {minus_y, {0, -.635, 0}},
                      {e_z, none}});
}

using numbers = Eigen::VectorXd;
using tool = kte::pose<kte::mat3<vec3<>>, vec3<>>;

/// m and rad between two poses.
struct gap {
  double position, rotation;
};
inline gap between(const tool& a, const tool& b) {
  const auto d = a.position - b.position;
  const auto m = kte::as<double>(a.rotation - b.rotation);
  return {std::sqrt(dot(d, d)), std::sqrt((dot(m.x, m.x) + dot(m.y, m.y) + dot(m.z, m.z)) / 2)};
}
inline double turn_between(double a, double b) { return std::abs(std::remainder(a - b, 2 * M_PI)); }
inline double distance(const numbers& a, const numbers& b) {
  double most = 0;
  for (Eigen::Index i = 0; i < a.size(); ++i) most = std::max(most, turn_between(a[i], b[i]));
  return most;
}

/// What all answers to the pose of a posture are, by the chain's own forward kinematics.
struct outcome {
  double position = 0, rotation = 0;  ///< the worst of the exact answers
  int answers = 0, exact = 0;
  double found = 10;  ///< how far the posture is from the nearest answer
  bool finite = true;
  unsigned free = 0;
};
template <class... Request>
outcome check_answers(const kte::manipulator<kte::runtime_chain>& arm, const numbers& q, const Request&... request) {
  outcome r;
  const tool x = arm.getDependentPoses(q)[0];
  for (const auto& a : kte::inverse_kinematics(arm, x, request...)) {
    ++r.answers;
    r.finite &= a.q.allFinite();
    const auto g = between(arm.getDependentPoses(a.q)[0], x);
    CHECK(g.position == within(a.position, 1e-14 * arm.structure().reach));
    if (!a.exact) continue;
    ++r.exact, r.free |= a.free;
    r.position = kte::test::worse(r.position, g.position / arm.structure().reach);
    r.rotation = kte::test::worse(r.rotation, g.rotation);
    r.found = std::min(r.found, distance(a.q, q));
  }
  return r;
}
inline numbers random_posture(random_numbers& random, int n) {
  numbers q(n);
  for (int i = 0; i < n; ++i) q[i] = random(M_PI);
  return q;
}
/// 0, 1e-16 ... 1e-4
inline std::vector<double> steps() {
  std::vector<double> s{0};
  for (int k = 16; k >= 4; --k) s.push_back(std::pow(10.0, -k));
  return s;
}

}  // namespace arms
