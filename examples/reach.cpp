/// The tool of a KUKA iiwa14 goes around a square of 0.3 m, at a constant rotation with which its wrist is stretched in
/// the middle of a side (joints 5 and 7 in line), by differential inverse kinematics within limits of positions, rates
/// and accelerations. Prints the time of a step and the error of the path.
#include <kte/io/recorder.hpp>
#include <kte/manipulators/iiwa14.hpp>
#include <kte/manipulators/numerical_inverse_kinematics.hpp>
#include <kte/manipulators/path_profiles.hpp>
#include <kte/manipulators/rates_towards.hpp>
#include <kte/manipulators/straight_line.hpp>

#include <array>
#include <chrono>
#include <cstdio>

using namespace kte::arm_names;

int main() {
  constexpr kte::manipulator arm(kte::iiwa14_chain(), tool, [] {
    auto limits = kte::iiwa14_limits();
    limits.acceleration.fill(10);  // rad/s^2, which the data sheet does not have
    return limits;
  }());
  using joints = kte::joint_vector<double, 7>;

  const joints stretched{{0.2, 0.6, 0, -1.2, 0, 0, 0}};
  const auto [R, middle] = kte::forward_kinematics(arm, stretched, tool);
  const auto corner = [&, r = R, p = middle](double y, double z) { return kte::pose{r, p + kte::vec3{0.0, y, z}}; };
  const std::array corners{corner(-0.15, 0), corner(0.15, 0), corner(0.15, -0.3), corner(-0.15, -0.3),
                           corner(-0.15, 0)};

  const auto start = kte::numerical_inverse_kinematics(
      arm, kte::goals(kte::reach(tool, corners[0]), kte::posture(stretched)), stretched);
  joints q = start.q, v = joints::Zero();
  std::printf("Start: %d iterations, off by %.1e m, %.1e rad\n", start.iterations, start.position, start.rotation);

  const double dt = 1e-3, gain = 50;
  const kte::quintic_profile side({}, 3.0);  // s
  auto s = kte::make_state(arm.chain());
  kte::recorder out("reach.csv", arm.chain(), {"q1", "q2", "q3", "q4", "q5", "q6", "q7", "tool/position"});
  double worst = 0, worst_rotation = 0, nearest = 1, seconds = 0;
  int steps = 0, limited = 0;
  for (std::size_t i = 0; i < 4; ++i) {
    const kte::straight_line line(corners[i], corners[i + 1]);
    for (double t = 0; t < side.duration(); t += dt, ++steps) {
      const auto begin = std::chrono::steady_clock::now();
      const auto now = side(t), next = side(t + dt);
      const auto error = kte::pose_error(kte::forward_kinematics(arm, q, tool), line(now.s));
      const Eigen::Matrix<double, 6, 1> twist = (next.s - now.s) / dt * line.way() + gain * error;
      const auto r = kte::rates_towards(arm, q, v, twist, dt);
      v = r.v, q = kte::integrate(arm, q, v, dt);
      seconds += std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();

      limited += r.status != kte::rate_status::free;
      worst = std::max(worst, error.head<3>().norm()),
      worst_rotation = std::max(worst_rotation, error.tail<3>().norm());
      nearest = std::min(nearest, std::abs(q[5]));
      kte::set_positions(s, q), kte::set_velocities(s, v);
      arm.chain().doMotion(s);
      out.row(steps * dt, s);
    }
  }
  out.close();
  std::printf("Square: %d steps, %.2f us a step, at most %.1e m and %.1e rad off the path\n", steps,
              1e6 * seconds / steps, worst, worst_rotation);
  std::printf("Wrist: joint 6 down to %.1e rad; %d steps with a joint at a bound. Written: reach.csv\n", nearest,
              limited);
}
