#include "scenes.hpp"

#include <kte/contacts.hpp>
#include <kte/elements/joint_motor.hpp>
#include <kte/elements/rigid_contact.hpp>
#include <kte/kte.hpp>

#include <cmath>
#include <numbers>

#include "robots/solo12.hpp"

namespace contact_bench {

namespace {

using kte::vec2;

Eigen::VectorXd numbers(std::initializer_list<double> x) {
  return Eigen::Map<const Eigen::VectorXd>(x.begin(), static_cast<Eigen::Index>(x.size()));
}
/// A body in the plane, with gravity of a slope in whose axes it moves.
kte::runtime_chain planar(double inertia, double slope) {
  kte::runtime_chain c;
  c << kte::base_2D("ground") << kte::free_joint_2D("pose", "ground", "body")
    << kte::inertia_2D("body", kte::planar_body(1.0, inertia));
  c.gravity({g * std::sin(slope), -g * std::cos(slope), 0});
  return c;
}
kte::runtime_chain ball(double friction, double restitution) {
  auto c = planar(0.004, 0);
  c << kte::sphere_contact_2D("contact", "ground", "body", kte::half_space{}, 0.1,
                              {.friction = friction, .restitution = restitution});
  return c;
}
kte::runtime_chain box(double friction) {
  auto c = planar(0.01, -0.3);
  for (const auto& [name, x] : {std::pair("left", -0.1), std::pair("right", 0.1)})
    c << kte::rigid_link_2D("body", name, vec2<>{x, -0.05})
      << kte::point_contact_2D(std::string(name) + " corner", "ground", name, kte::half_space{},
                               {.friction = friction});
  return c;
}
auto at_x(double x) {
  return [x](const Eigen::VectorXd& q) { return std::abs(q[0] - x); };
}
/// The height of a ball that bounces with e, from 1 m.
double height_at(double t, double e) {
  double v = std::sqrt(2 * g), flight = v / g;
  if (t < flight) return 1 - g * t * t / 2;
  for (t -= flight, v *= e; t > 2 * v / g; v *= e) t -= 2 * v / g;
  return v * t - g * t * t / 2;
}

}  // namespace

scene bouncing_ball() {
  const double end = 1;
  return {"ball bounces", ball(0, 0.5), numbers({0, 1.1, 0}), numbers({0, 0, 0}), end, [end](const Eigen::VectorXd& q) {
            return std::abs(q[1] - 0.1 - height_at(end, 0.5));
          }};
}
scene sliding_box() {
  return {"box slides up and back", box(0.2), numbers({0, 0.05, 0}), numbers({2, 0, 0}), 2, at_x(-0.86166423136809)};
}
scene resting_box() {
  return {"box comes to rest", box(0.4), numbers({0, 0.05, 0}), numbers({2, 0, 0}), 10, at_x(0.30085169864298)};
}
scene slipping_ball() {
  return {"ball slips, then rolls", ball(0.2, 0), numbers({0, 0.1, 0}), numbers({1, 0, 0}), 2, at_x(1.44937485697643)};
}
scene rimless_wheel() {
  constexpr double slope = 0.15, inertia = 0.1, half = std::numbers::pi / 8, strikes = 10;
  auto c = planar(inertia, slope);
  for (int i = 0; i < 8; ++i) {
    const double angle = (2 * i + 1) * half;
    const auto n = std::to_string(i);
    c << kte::rigid_link_2D("body", "tip" + n, vec2<>{std::cos(angle), std::sin(angle)})
      << kte::point_contact_2D("spoke" + n, "ground", "tip" + n, kte::half_space{}, {.friction = 2.0});
  }
  const double of_tip = inertia + 1, eta = (inertia + std::cos(2 * half)) / of_tip;
  const double gain = 4 * g * std::sin(slope) * std::sin(half) / of_tip;
  const double first = std::sqrt(eta * eta / (1 - eta * eta) * gain);  // after a strike
  const auto speed = [&](double from_vertical) {
    return std::sqrt(first * first + 2 * g / of_tip * (std::cos(slope - half) - std::cos(from_vertical)));
  };
  double time = 0;  // between strikes, by Simpson's rule
  constexpr int parts = 2000;
  for (int i = 0; i <= parts; ++i)
    time += (i == 0 || i == parts ? 1 : i % 2 == 1 ? 4 : 2) / speed(slope - half + 2 * half * i / parts);
  time *= 2 * half / parts / 3;
  const double mean = 2 * half / time, end = strikes * time;
  return {"rimless wheel",
          c,
          numbers({0, std::cos(half), 0}),
          numbers({first * std::cos(half), first * std::sin(half), -first}),
          end,
          [=](const Eigen::VectorXd& q) { return std::abs(-q[2] / end - mean); }};
}
std::array<servo, 12> servos() {
  std::array<servo, 12> all;
  std::size_t i = 0;
  for (const char* const leg : {"FL", "FR", "HL", "HR"})
    for (const auto& [joint, target] : {std::pair("_HAA", 0.0), std::pair("_HFE", 0.8), std::pair("_KFE", -1.6)})
      all[i++] = {std::string(leg) + joint, target};
  return all;
}
scene falling_quadruped() {
  kte::runtime_chain c;
  c << robots::solo12;
  for (const std::string leg : {"FL", "FR", "HL", "HR"})
    c << kte::sphere_contact_3D(leg, "ground", leg + "_FOOT", kte::half_space{}, 0.016, {.friction = 0.7});
  for (const auto& [joint, target] : servos())
    c << kte::joint_motor_gen(joint, joint + ".servo", {.offset = 10 * target, .stiffness = 10, .damping = 0.3});
  Eigen::VectorXd q = Eigen::VectorXd::Zero(c.nq());
  const Eigen::Quaterniond tilt =
      Eigen::AngleAxisd(0.03, Eigen::Vector3d::UnitY()) * Eigen::AngleAxisd(0.05, Eigen::Vector3d::UnitX());
  q.head<7>() << 0, 0, 0.28, tilt.w(), tilt.x(), tilt.y(), tilt.z();
  for (Eigen::Index i = 0; i < 12; ++i) q[7 + i] = servos()[static_cast<std::size_t>(i)].target;
  return {"quadruped falls",
          c,
          q,
          Eigen::VectorXd::Zero(18),
          0.2,
          [](const Eigen::VectorXd& x) { return (x.head<3>() - place_of_quadruped).norm(); }};
}

std::vector<scene> scenes() {
  return {bouncing_ball(), sliding_box(), resting_box(), slipping_ball(), rimless_wheel(), falling_quadruped()};
}

}  // namespace contact_bench
