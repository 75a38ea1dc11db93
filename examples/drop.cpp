/// A quadruped, the Solo12, falls from a small height, stands, and walks in place for two seconds, by servos at its
/// joints. Writes drop.csv (for PlotJuggler), drop_forces.svg, the forces of the feet over time, and drop.html, which
/// shows the robot moving in any browser. Prints the errors of the fall by the length of the steps.
#include <kte/contacts.hpp>
#include <kte/elements/joint_motor.hpp>
#include <kte/elements/rigid_contact.hpp>
#include <kte/io/recorder.hpp>
#include <kte/kte.hpp>
#include <kte/models/runtime_dynamics_model.hpp>
#include <kte/view.hpp>
#include <kte/view/pictures.hpp>

#include <Eigen/Geometry>

#include <chrono>
#include <cmath>
#include <cstdio>
#include <numbers>

#include "robots/solo12.hpp"

namespace {

const std::array<std::string, 4> legs{"FL", "FR", "HL", "HR"};
constexpr double thigh = 0.16;          ///< m, and the length from the knee to the foot
constexpr double stiffness = 40;        ///< of the servos, Nm/rad
constexpr double damping = 1;           ///< Nms/rad
constexpr double standing_angle = 0.8;  ///< of hips; that of knees is twice its negative, so that feet are below hips

/// The robot on the ground. Its inputs are the torques of the servos at rest in the neutral configuration.
kte::runtime_chain robot() {
  kte::runtime_chain c;
  c << robots::solo12;
  for (const auto& leg : legs) {
    c << kte::sphere_contact_3D(leg, "ground", leg + "_FOOT", kte::half_space{}, 0.016, {.friction = 0.7});
    for (const char* const joint : {"_HAA", "_HFE", "_KFE"})
      c << kte::joint_motor_gen(leg + joint, leg + joint + ".servo", {.stiffness = stiffness, .damping = damping});
  }
  return c;
}

/// The length of legs over time, and its rate: from 3 s on, diagonal pairs of feet are lifted by turns.
struct leg_length {
  double length, rate;
  double load;  ///< the share of the weight, relative to a quarter
};
leg_length length_at(double t, std::size_t leg) {
  constexpr double begin = 3, period = 0.3, lift = 0.04;  // s, m
  const double standing = 2 * thigh * std::cos(standing_angle);
  const bool first_pair = leg == 0 || leg == 3;
  const double phase = (t - begin) / period + (first_pair ? 0 : 0.5), part = phase - std::floor(phase);
  if (t < begin) return {standing, 0, 1};
  if (t < begin + (first_pair ? 0 : period / 2) || part > 0.5) return {standing, 0, 2};
  const double angle = 2 * std::numbers::pi * part;
  return {standing - lift * std::pow(std::sin(angle), 2), -lift * std::sin(2 * angle) * 2 * std::numbers::pi / period,
          0};
}

/// The torques by which the servos keep their joints on the way to these lengths, and knees carry the weight.
Eigen::VectorXd commands(double t) {
  Eigen::VectorXd u(12);
  for (std::size_t leg = 0; leg < legs.size(); ++leg) {
    const auto [length, rate, load] = length_at(t, leg);
    const double hip = std::acos(length / (2 * thigh)), hip_rate = -rate / (2 * thigh * std::sin(hip));
    const double knee_torque = 2.5 * 9.81 / 4 * thigh * std::sin(hip);  // Nm, of a quarter of the weight
    const double command = stiffness * hip + damping * hip_rate;
    u.segment<3>(static_cast<Eigen::Index>(3 * leg)) << 0, command, load * knee_torque - 2 * command;
  }
  return u;
}

kte::table table_of(const kte::scene::recording& r) {
  kte::table t{{"t"}, {r.t}};
  for (const auto& c : r.columns) t.names.push_back(c.name), t.columns.emplace_back(c.data.begin(), c.data.end());
  return t;
}

}  // namespace

int main() {
  const auto chain = robot();
  kte::manipulator_dynamics_model model(chain);
  kte::controlled walking(std::ref(model), [](double t, const auto&) { return commands(t); });

  Eigen::VectorXd q = kte::neutral_configuration(chain);
  const Eigen::Quaterniond tilt = Eigen::AngleAxisd(0.03, Eigen::Vector3d::UnitY()) *  // pitch
                                  Eigen::AngleAxisd(0.05, Eigen::Vector3d::UnitX());   // roll
  q.head<7>() << 0, 0, 0.28, tilt.w(), tilt.x(), tilt.y(), tilt.z();
  for (Eigen::Index leg = 0; leg < 4; ++leg) q.segment<3>(7 + 3 * leg) << 0, standing_angle, -2 * standing_angle;
  const auto x0 = model.make_x(q, Eigen::VectorXd::Zero(18));

  const auto fallen = [&](double step) {
    kte::moreau_jean solver(std::ref(walking), 0.0, x0, step);
    solver.integrate(0.2);
    return Eigen::Vector3d(solver.state().head<3>());
  };
  const auto exact = fallen(2e-6);
  std::printf("Errors of the trunk 0.2 s after its fall began, in which the feet strike the ground:\n");
  for (const double step : {2e-3, 1e-3, 1e-4, 2e-5})
    std::printf("  step %.0e s: %.1e m\n", step, (fallen(step) - exact).norm());

  std::vector<std::string> forces, vertical;
  for (const auto& leg : legs) forces.push_back(leg + "/force"), vertical.push_back(leg + "/force/z");
  auto columns = forces;
  columns.push_back("trunk/position"), columns.push_back("trunk/rotation");
  kte::recorder out("drop.csv", chain, columns);
  kte::scene_recording scene(chain, {.columns = forces});

  const double step = 1e-3, duration = 5;
  kte::moreau_jean solver(std::ref(walking), 0.0, x0, step);
  const auto begin = std::chrono::steady_clock::now();
  solver.integrate(duration, kte::every(0.01), [&](double t, const auto& x) {
    const auto& s = solver.state_at(t, x);
    out.row(t, s), scene.row(t, s);
  });
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  out.close();
  kte::write_plot("drop_forces.svg", table_of(scene.contents().recordings[0]), vertical,
                  {.units = kte::units_of(scene.contents())});
  kte::write_page("drop.html", scene);

  const auto& x = solver.state();
  std::printf("Fall, stand, walk in place: %.0f s in %.2f s, %lld steps of %.0e s\n", duration, seconds,
              solver.statistics().steps, step);
  std::printf("Trunk at the end: (%.4f, %.4f, %.4f) m, tilted by %.3f rad\n", x[0], x[1], x[2],
              2 * std::asin(std::hypot(x[4], x[5])));
  std::printf("Written: drop.csv, drop_forces.svg, drop.html\n");
}
