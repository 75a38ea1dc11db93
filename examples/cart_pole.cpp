/// A pole balanced on a cart: linearised where it stands upright, held there by the linear feedback of least cost
/// (LQR), in continuous time and by a computer that looks 50 times a second; as a static and as a runtime chain. Then
/// how far it may lean at first for either to catch it.
#include <kte/control.hpp>
#include <kte/elements/registry.hpp>
#include <kte/integrators/dormand_prince45.hpp>
#include <kte/models/runtime_dynamics_model.hpp>
#include <kte/static.hpp>

#include <cmath>
#include <cstdio>

// clang-format off
inline constexpr struct slide_  final : kte::coord_key<"slide">     {} slide;
inline constexpr struct angle_  final : kte::coord_key<"angle">     {} angle;
inline constexpr struct motor_  final : kte::input_key<"motor">     {} motor;
inline constexpr struct ground_ final : kte::frame_2D_key<"ground"> {} ground;
inline constexpr struct cart_   final : kte::frame_2D_key<"cart">   {} cart;
inline constexpr struct pole_   final : kte::frame_2D_key<"pole">   {} pole;
// clang-format on

constexpr auto cart_pole =
    kte::chain(kte::prismatic_joint_2D(slide, ground, cart, kte::axis::x), kte::inertia_2D(cart, kte::point_mass(1.0)),
               kte::revolute_joint_2D(angle, cart, pole),
               kte::inertia_2D(pole, kte::planar_body(0.1, 0.002, kte::vec2{0.0, 0.5})),
               kte::driving_actuator_gen(slide, motor))
        .gravity(kte::along_y(-9.81));

constexpr double period = 0.02, duration = 10;
const Eigen::Vector4d upright = Eigen::Vector4d::Zero(), weights(10, 10, 1, 1);  // slide, angle and their rates
const Eigen::Matrix4d Q = weights.asDiagonal();
const Eigen::MatrixXd R = Eigen::MatrixXd::Constant(1, 1, 0.1);

template <class Model>
auto leaning(const Model& model, double by) {
  return model.make_x(std::array{0.0, by}, std::array{0.0, 0.0});
}
/// An observer that has seen enough when the pole lies.
const auto until_it_lies = [](double, const auto& s) { return std::abs(s[1]) > 1.6 ? kte::stop : kte::go_on; };
/// How far from upright it is after 10 s, or when the pole lies.
template <class Model>
double held(const Model& model, const kte::lqr_gain& gain, double lean) {
  kte::controlled loop(model, [&](double, const auto& s) { return (-gain.K * (s - upright)).eval(); });
  kte::dormand_prince45 solver(std::ref(loop), 0.0, leaning(model, lean));
  solver.integrate(duration, until_it_lies);
  return (solver.state() - upright).norm();
}
/// Simulates the cart-pole with a force that is constant between samples.
template <class Model>
double held_by_computer(Model model, const kte::lqr_gain& gain, double lean) {
  kte::dormand_prince45 solver(std::ref(model), 0.0, leaning(model, lean));
  for (int i = 1; i <= std::lround(duration / period); ++i) {
    model.setInput((-gain.K * (solver.state() - upright)).eval());
    if (solver.integrate(i * period, until_it_lies) == kte::stop_reason::observer) break;
  }
  return (solver.state() - upright).norm();
}
/// The largest lean, rad, from which it comes back, by halving.
template <class Held>
double largest(const Held& held_from) {
  double caught = 0, fell = 1.6;
  while (fell - caught > 1e-3) {
    const double lean = (caught + fell) / 2;
    (held_from(lean) < 0.1 ? caught : fell) = lean;
  }
  return caught;
}

template <class Model>
int balance(const char* name, const Model& model) {
  const auto linear = kte::linearize(model, upright, std::array{0.0});
  const auto gain = kte::lqr(linear, Q, R);
  const auto sampled = kte::lqr(kte::discretize(linear, period), Q * period, R * period);
  std::printf("%s chain\n  K              %8.3f %8.3f %8.3f %8.3f\n", name, gain.K(0, 0), gain.K(0, 1), gain.K(0, 2),
              gain.K(0, 3));
  std::printf("  K at 50 Hz     %8.3f %8.3f %8.3f %8.3f\n  poles, 1/s     ", sampled.K(0, 0), sampled.K(0, 1),
              sampled.K(0, 2), sampled.K(0, 3));
  for (const auto& z : gain.poles) std::printf("%8.3f %+.3fi", z.real(), z.imag());
  const double after = held(model, gain, 0.4), after_by_computer = held_by_computer(model, sampled, 0.4);
  std::printf("\n  from 0.4 rad, after %.0f s off by %.1e, at 50 Hz %.1e\n", duration, after, after_by_computer);
  std::printf("  caught up to %.2f rad, at 50 Hz %.2f rad\n",
              largest([&](double lean) { return held(model, gain, lean); }),
              largest([&](double lean) { return held_by_computer(model, sampled, lean); }));
  return after < 1e-3 && after_by_computer < 1e-3 ? 0 : 1;
}

int main() {
  const kte::manipulator_dynamics_model fixed(cart_pole);
  const kte::manipulator_dynamics_model runtime(kte::to_chain(kte::record_of(cart_pole)));
  return balance("static", fixed) + balance("runtime", runtime);
}
