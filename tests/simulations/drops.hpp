#pragma once

#include <kte/contact/height_grid.hpp>
#include <kte/contacts.hpp>
#include <kte/dynamics/energy.hpp>
#include <kte/elements/closures.hpp>
#include <kte/loops.hpp>
#include <kte/simulation.hpp>

#include <Eigen/Geometry>

#include <algorithm>
#include <string>
#include <vector>

#include "random.hpp"
#include "robots/solo12.hpp"

/// Bodies that fall on the ground at random, and what a simulation with events makes of them.
namespace kte::test::drops {

/// A scene: `chain` from q and v for `duration`, s.
struct scene {
  runtime_chain chain;
  Eigen::VectorXd q, v, inputs;
  double size = 1;      ///< of the body, m
  double duration = 3;  ///< s
  bool rests = false;   ///< whether it must be at rest at the end
};
/// What a simulation has made of it.
struct outcome {
  std::string failure;  ///< empty: it has reached its end
  std::string bridge;   ///< what the last bridge was, or empty
  long long steps = 0, evaluations = 0, events = 0, bridges = 0;
  double penetration = 0;  ///< the largest, of the size
  double gain = 0;         ///< the largest of the energy at an event, relative, without that of `energy_of_gaps`
  double speed = 0;        ///< the largest velocity at the end, of size sqrt(g/size)
  Eigen::VectorXd q;       ///< at the end
};

constexpr double g = 9.81;
enum class shape { sphere, capsule, tetrapod, cube, long_box, flat_box };
constexpr shape shapes[]{shape::sphere, shape::capsule, shape::tetrapod, shape::cube, shape::long_box, shape::flat_box};

/// The half lengths of a box of size 2, and of what fits in it.
inline Eigen::Vector3d half_of(shape s) {
  switch (s) {
    case shape::long_box:
      return {0.25, 0.25, 1};
    case shape::flat_box:
      return {1, 0.6, 0.2};
    case shape::capsule:
      return {0.3, 0.3, 1};
    default:
      return {1, 1, 1};
  }
}
/// Adds a body of half the size `half`, m, and its contacts with a surface of the ground. Returns the radius of a
/// sphere about its frame that holds it, m.
template <class Surface>
double add_body(runtime_chain& c, const std::string& name, shape s, double half, const Surface& ground,
                const contact_law& law) {
  const Eigen::Vector3d h = half * half_of(s);
  const double m = 500 * 8 * h.prod();
  const Eigen::Vector3d inertia =
      m / 3 * Eigen::Vector3d(h[1] * h[1] + h[2] * h[2], h[0] * h[0] + h[2] * h[2], h[0] * h[0] + h[1] * h[1]);
  c << inertia_3D(name, rigid_body{m, vec3{0.0, 0.0, 0.0}, sym3{inertia[0], 0.0, 0.0, inertia[1], 0.0, inertia[2]}});
  const auto ball = [&](const char* which, const vec3<>& at, double r) {
    c << sphere_contact_3D(name + which, "ground", name, ground, r, law, at);
  };
  const double a = 0.55 * half;
  switch (s) {
    case shape::sphere:
      return ball("", vec3<>{}, half), half;
    case shape::capsule:
      return ball(".a", {0, 0, 0.7 * half}, 0.3 * half), ball(".b", {0, 0, -0.7 * half}, 0.3 * half), half;
    case shape::tetrapod:
      ball(".a", {a, a, a}, 0.1 * half), ball(".b", {a, -a, -a}, 0.1 * half);
      ball(".c", {-a, a, -a}, 0.1 * half), ball(".d", {-a, -a, a}, 0.1 * half);
      return (0.55 * std::sqrt(3.0) + 0.1) * half;
    default:
      c << box_contact_3D(name, "ground", name, ground, vec3<>{h[0], h[1], h[2]}, law);
      return h.norm();
  }
}
inline Eigen::Quaterniond random_attitude(random_numbers& random) {
  Eigen::Vector4d x;
  do
    for (double& e : x) e = random();
  while (x.norm() > 1 || x.norm() < 0.1);
  return Eigen::Quaterniond(x.normalized());
}
/// Puts a floating body at a place, thrown or not, in units of its half length.
inline void throw_body(scene& s, const Eigen::Vector3d& at, bool thrown, double half, random_numbers& random) {
  const Eigen::Quaterniond attitude = random_attitude(random);
  s.q.head<7>() << at, attitude.w(), attitude.x(), attitude.y(), attitude.z();
  if (!thrown) return;
  const double w = std::sqrt(g * half);
  for (int i = 0; i < 3; ++i) s.v[i] = random(0.7 * w), s.v[3 + i] = random(2.5 * w / half);
}
/// A body of half the size `half`, m, that falls on a surface from the height h over it, in half lengths; `up`: the
/// normal of the surface under it.
template <class Surface>
scene drop_on(const Surface& ground, const Eigen::Vector3d& place, const Eigen::Vector3d& up, shape what, double half,
              const contact_law& law, bool thrown, random_numbers& random) {
  scene s;
  s.size = 2 * half;
  s.chain << base_3D("ground") << free_joint_3D("pose", "ground", "body");
  const double reach = add_body(s.chain, "body", what, half, ground, law);
  s.chain.gravity(vec3<>{0, 0, -g});
  s.q.setZero(7), s.v.setZero(6);
  throw_body(s, place + (reach + half) * up, thrown, half, random);
  s.duration = 60 * std::sqrt(half / g);
  return s;
}
/// A body on level ground.
inline scene drop(shape what, double half, const contact_law& law, bool thrown, random_numbers& random) {
  scene s = drop_on(half_space{}, {0, 0, 0}, {0, 0, 1}, what, half, law, thrown, random);
  s.rests = what >= shape::tetrapod && law.friction >= 0.3 && law.restitution <= 0.3;
  return s;
}
/// A body on a slope, on a ball or on waves.
inline scene drop_on_other_ground(int which, shape what, double half, const contact_law& law, bool thrown,
                                  random_numbers& random) {
  const Eigen::Vector3d n = Eigen::Vector3d(random(0.4), random(0.4), 1).normalized();
  if (which == 0) return drop_on(half_space{vec3<>{n[0], n[1], n[2]}}, {0, 0, 0}, n, what, half, law, thrown, random);
  if (which == 1) {
    const double radius = 4 * half;
    return drop_on(ball_surface(radius), radius * n, n, what, half, law, thrown, random);
  }
  const auto waves = [half](const auto& x, const auto& y) {
    using std::sin;
    return 0.3 * half * sin(x / (4 * half)) * sin(y / (5 * half));
  };
  return drop_on(height_field(waves), {random(10 * half), random(10 * half), 0.3 * half}, {0, 0, 1}, what, half, law,
                 thrown, random);
}
/// Two bodies that a hinge joins.
inline scene drop_pair(shape what, double half, const contact_law& law, bool thrown, random_numbers& random) {
  scene s;
  s.size = 2 * half;
  auto& c = s.chain;
  c << base_3D("ground") << free_joint_3D("pose", "ground", "one")
    << rigid_link_3D("one", "hinge", vec3<>{1.3 * half, 0, 0}) << revolute_joint_3D("angle", "hinge", "arm", axis::y)
    << rigid_link_3D("arm", "two", vec3<>{1.3 * half, 0, 0});
  add_body(c, "one", what, half, half_space{}, law), add_body(c, "two", shape::cube, 0.6 * half, half_space{}, law);
  c.gravity(vec3<>{0, 0, -g});
  s.q = neutral_configuration(c), s.v.setZero(7);
  throw_body(s, {0, 0, 5 * half}, thrown, half, random);
  s.duration = 30 * std::sqrt(half / g);
  return s;
}
/// Two bodies that a closure joins.
inline scene drop_joined(shape what, double half, const contact_law& law, bool thrown, random_numbers& random) {
  scene s;
  s.size = 2 * half;
  auto& c = s.chain;
  c << base_3D("ground") << free_joint_3D("pose one", "ground", "one") << free_joint_3D("pose two", "ground", "two")
    << rigid_link_3D("one", "pin one", vec3<>{1.3 * half, 0, 0})
    << rigid_link_3D("two", "pin two", vec3<>{-1.3 * half, 0, 0});
  if (thrown)
    c << coincident_points_3D("pin", "pin one", "pin two");
  else
    c << hinge_3D("pin", "pin one", "pin two", axis::y);
  add_body(c, "one", what, half, half_space{}, law), add_body(c, "two", shape::cube, 0.6 * half, half_space{}, law);
  c.gravity(vec3<>{0, 0, -g});
  s.q.setZero(14), s.v.setZero(12);
  throw_body(s, {0, 0, 5 * half}, false, half, random);
  const Eigen::Quaterniond attitude(s.q[3], s.q[4], s.q[5], s.q[6]);
  s.q.segment(7, 3) = s.q.head(3) + attitude * Eigen::Vector3d(2.6 * half, 0, 0), s.q.tail(4) = s.q.segment(3, 4);
  s.duration = 30 * std::sqrt(half / g);
  return s;
}
/// The Solo12 with servos, on its feet.
inline scene drop_robot(const contact_law& law, random_numbers& random) {
  scene s;
  auto& c = s.chain;
  c << robots::solo12;
  for (const std::string leg : {"FL", "FR", "HL", "HR"}) {
    c << sphere_contact_3D(leg, "ground", leg + "_FOOT", half_space{}, 0.016, law);
    for (const char* const joint : {"_HAA", "_HFE", "_KFE"})
      c << joint_motor_gen(leg + joint, leg + joint + ".servo", {.stiffness = 40, .damping = 1});
  }
  s.q = neutral_configuration(c), s.v.setZero(18);
  const Eigen::Quaterniond tilt(Eigen::AngleAxisd(random(0.15), Eigen::Vector3d::UnitY()) *
                                Eigen::AngleAxisd(random(0.15), Eigen::Vector3d::UnitX()));
  s.q.head<7>() << 0, 0, 0.35, tilt.w(), tilt.x(), tilt.y(), tilt.z();
  for (Eigen::Index leg = 0; leg < 4; ++leg) s.q.segment<3>(7 + 3 * leg) << 0, 0.8, -1.6;
  s.inputs.resize(12);
  const double hip = 0.8, knee = 2.5 * g / 4 * 0.16 * std::sin(hip);
  for (Eigen::Index leg = 0; leg < 4; ++leg) s.inputs.segment<3>(3 * leg) << 0, 40 * hip, knee - 80 * hip;
  s.size = 0.5, s.duration = 0.5;
  return s;
}

/// A drop by its number.
struct numbered_drop {
  scene what;
  double tolerance;     ///< relative to the size
  std::size_t surface;  ///< in `surfaces`
};
constexpr const char* surfaces[]{"level ground",
                                 "a slope",
                                 "a ball",
                                 "waves",
                                 "level ground, two bodies joined by a hinge",
                                 "level ground, a quadruped on its feet"};
/// Any shape on any surface, sizes of 1 mm to 10 m, any friction and restitution, tolerances of 1e-6 to 1e-12.
inline numbered_drop drop_of(unsigned number) {
  random_numbers random(number);
  const std::size_t surface = number % 6;
  const shape what = shapes[number / 6 % 6];
  const bool thrown = number / 36 % 2 == 1;
  const double half = std::pow(10.0, random(2.0) - 1.3);
  const contact_law law{.friction = std::abs(random(1.3)), .restitution = std::abs(random(0.85))};
  const double tolerance = std::pow(10.0, random(3.0) - 9);
  scene s = surface == 0   ? drop(what, half, law, thrown, random)
            : surface == 4 ? drop_pair(what, half, law, thrown, random)
            : surface == 5 ? drop_robot(law, random)
                           : drop_on_other_ground(static_cast<int>(surface) - 1, what, half, law, thrown, random);
  return {std::move(s), tolerance, surface};
}

/// Simulates a scene with a tolerance relative to its size.
inline outcome simulate(const scene& s, double tolerance, bridging bridge = bridging::when_needed) {
  outcome out;
  manipulator_dynamics_model model(s.chain);
  if (s.inputs.size() > 0) model.setInput(s.inputs);
  runtime_state at = make_state(s.chain);
  const auto energy_of = [&](const Eigen::VectorXd& x) {
    const auto e = energy(s.chain, at, Eigen::VectorXd(model.positions_of(x)), Eigen::VectorXd(model.velocities_of(x)));
    return e.kinetic + e.potential;
  };
  const auto names = s.chain.wiring().names[static_cast<std::size_t>(kind::contact)];
  const auto see = [&](double t, const Eigen::VectorXd& x) {
    model.setJointStates(t, x, at), s.chain.doMotion(at);
    for (const auto& name : names) out.penetration = (std::max)(out.penetration, -at.contact(name).gap / s.size);
  };
  // The state before an event is interpolated: contacts that touch are off their surface by gaps of the size of the
  // tolerance. An event closes them: potential and kinetic energy change by up to gap/size and 2 gap/size of them.
  const auto energy_of_gaps = [&](double t, const Eigen::VectorXd& x) {
    model.setJointStates(t, x, at), s.chain.doMotion(at);
    double most = 0;
    for (const auto& name : names)
      if (const double gap = std::abs(at.contact(name).gap) / s.size; gap < 1e-8) most = (std::max)(most, gap);
    return 3 * most;
  };
  try {
    const Eigen::VectorXd x0 = settled(model, 0.0, model.make_x(s.q, s.v));
    const double mass = centre_of_mass(s.chain, at, s.q).mass;
    const double scale = mass * g * s.size, absolute = tolerance * s.size;
    dormand_prince45 solver(std::cref(model), 0.0, x0, {.absolute = absolute, .relative = tolerance});
    const auto note = [&](const auto& e) {
      ++out.events;
      if (e.until > e.time) {
        ++out.bridges, out.bridge = e.what;
        return;
      }
      const double before = energy_of(e.before), gain = energy_of(e.after) - before;
      out.gain = (std::max)(out.gain, gain / (std::max)(scale, std::abs(before)) - energy_of_gaps(e.time, e.before));
    };
    const auto report = solver.integrate(s.duration, element_events(model).with({.bridge = bridge}).report_to(note),
                                         every(s.duration / 400), see);
    if (report.reason != stop_reason::end_time) out.failure = "ends early at " + std::to_string(solver.time());
    out.steps = solver.statistics().steps, out.evaluations = solver.statistics().evaluations;
    out.speed = model.velocities_of(solver.state()).cwiseAbs().maxCoeff() / std::sqrt(g * s.size);
    out.q = model.positions_of(solver.state());
  } catch (const std::exception& e) {
    out.failure = e.what();
  }
  return out;
}

}  // namespace kte::test::drops
