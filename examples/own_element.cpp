/// A custom element: the drag of the air on a frame, F = -c v. It is written once and used in the plane and in
/// space, in a static and in a runtime chain, and in files; its mechanics are tested by the laws of elements. Then a
/// pendulum falls through the air: what it loses in energy must be the work of the drag.
#include <kte/io.hpp>
#include <kte/kte.hpp>
#include <kte/testing/element_laws.hpp>

#include <cmath>
#include <cstdio>
#include <random>

// [element]
namespace air {

/// The core: arithmetic and parameters, no names. Dim: frames in the plane or in space.
template <kte::kind Dim>
struct drag_core {
  static constexpr kte::type_name type{"drag", Dim};  // "drag_2D", "drag_3D": for messages and files
  static constexpr std::array<kte::port, 1> ports{{{Dim, kte::access::on, "frame"}}};
  static constexpr bool reads_positions = true;  // the force depends on a linear velocity

  double damping;  // N s/m

  /// F = -c v at the origin of the frame, in its axes; no torque.
  template <class Frame>
  constexpr auto doForce(const Frame& x) const {
    return kte::make_loads(kte::wrench{-damping * x.velocity, kte::zero3{}});
  }
  constexpr void check(const kte::parameter_check& where) const {
    where.not_negative(damping, "damping must be finite and not negative");
  }
  template <class Self, class Visit>
  static constexpr void parameters(Self& self, Visit&& visit) {
    visit("damping", self.damping);
  }
};

/// The drag of the air on a frame: damping in N s/m. Keys make an element of a static chain, texts one of a runtime
/// chain.
template <class Frame>
constexpr auto drag_2D(const Frame& frame, double damping) {
  return kte::connect(drag_core<kte::kind::frame_2D>{damping}, frame);
}
template <class Frame>
constexpr auto drag_3D(const Frame& frame, double damping) {
  return kte::connect(drag_core<kte::kind::frame_3D>{damping}, frame);
}

/// The elements of the library and these, for files.
kte::element_registry registry() {
  auto r = kte::element_registry::standard();
  r.add<drag_core<kte::kind::frame_2D>, drag_core<kte::kind::frame_3D>>();
  return r;
}

}  // namespace air
// [element]

// clang-format off
inline constexpr struct q_     final : kte::coord_key<"q">        {} q;
inline constexpr struct base_  final : kte::frame_3D_key<"base">  {} base;
inline constexpr struct joint_ final : kte::frame_3D_key<"joint"> {} joint;
inline constexpr struct tip_   final : kte::frame_3D_key<"tip">   {} tip;
// clang-format on

constexpr double length = 0.5, mass = 1.0, gravity = 9.81, damping = 0.8;  // m, kg, m/s^2, N s/m

constexpr auto pendulum = kte::chain(kte::revolute_joint_3D(q, base, joint, kte::axis::y),
                                     kte::rigid_link_3D(joint, tip, kte::along_x(length)),
                                     kte::inertia_3D(tip, kte::point_mass(mass)), air::drag_3D(tip, damping))
                              .gravity(kte::along_z(-gravity));

int failures = 0;
void expect(bool ok, const char* what) {
  std::printf("  %-78s %s\n", what, ok ? "ok" : "WRONG");
  failures += !ok;
}

// [laws]
void check_laws() {
  std::mt19937 engine;
  const auto draw = [&engine] { return static_cast<double>(engine()) * 0x1p-31 - 1; };
  const double work = std::max(kte::testing::no_work_done<double>(air::drag_2D("frame", damping), draw),
                               kte::testing::no_work_done<double>(air::drag_3D("frame", damping), draw));
  expect(work == 0, "the drag never pushes");
}
// [laws]

/// The chain as a runtime chain, read from a file.
kte::runtime_chain by_file() {
  kte::save_model("own_element.json", pendulum);
  return kte::to_chain(kte::load_model("own_element.json"), air::registry());
}

void check_chains() {
  kte::runtime_chain built;
  built.gravity(kte::along_z(-gravity)) << kte::revolute_joint_3D("q", "base", "joint", kte::axis::y)
                                        << kte::rigid_link_3D("joint", "tip", kte::along_x(length))
                                        << kte::inertia_3D("tip", kte::point_mass(mass))
                                        << air::drag_3D("tip", damping);
  const auto loaded = by_file();
  expect(kte::record_of(built) == kte::record_of(pendulum), "built at run time: equal models");
  expect(kte::record_of(loaded) == kte::record_of(pendulum), "written to a file and read: equal models");

  auto s = built.make_state(), t = loaded.make_state();
  const std::array x{0.7}, v{-1.3}, tau{0.0};
  const double a = kte::forward_dynamics(pendulum, x, v, tau)[0];
  const double exact = gravity / length * std::cos(x[0]) - damping / mass * v[0];  // q from the horizontal, downwards
  expect(std::abs(a - exact) < 1e-14 * gravity / length, "acceleration: g/L cos q - c/m q_dot");
  expect(std::abs(kte::forward_dynamics(built, s, x, v, tau)[0] - a) < 1e-14 * std::abs(a),
         "at run time: equal acceleration");
  expect(std::abs(kte::forward_dynamics(loaded, t, x, v, tau)[0] - a) < 1e-14 * std::abs(a),
         "from the file: equal acceleration");

  kte::runtime_chain flat;  // the pendulum in the plane, q upwards
  flat.gravity(kte::along_y(-gravity)) << kte::revolute_joint_2D("q", "base", "joint")
                                       << kte::rigid_link_2D("joint", "tip", kte::along_x(length))
                                       << kte::inertia_2D("tip", kte::point_mass(mass)) << air::drag_2D("tip", damping);
  auto u = flat.make_state();
  const std::array minus_x{-x[0]}, minus_v{-v[0]};
  expect(std::abs(kte::forward_dynamics(flat, u, minus_x, minus_v, tau)[0] + a) < 1e-14 * std::abs(a),
         "in the plane: opposite acceleration");

  try {
    air::drag_3D("wing", -1.0);
    expect(false, "a negative damping is refused");
  } catch (const kte::bad_parameter& e) {
    expect(e.what() == std::string("kte: drag_3D (frame 'wing'): damping must be finite and not negative, got -1"),
           e.what());
  }
}

/// Falls from the horizontal for 5 s. The state: angle, rate, work of the drag.
void simulate() {
  auto s = kte::make_state(pendulum);
  const auto rhs = [&s](double, const Eigen::Vector3d& x) {
    s[q].q = x[0], s[q].q_dot = x[1];
    s[q].q_ddot = kte::forward_dynamics(pendulum, s)[0];
    pendulum.doMotion(s);
    const auto& v = s[tip].velocity;
    return Eigen::Vector3d(x[1], s[q].q_ddot, -damping * kte::dot(v, v));
  };
  const auto energy = [](const Eigen::Vector3d& x) {
    const double v = length * x[1], height = -length * std::sin(x[0]);
    return mass * v * v / 2 + mass * gravity * height;
  };
  const Eigen::Vector3d start(0, 0, 0);
  const double at_start = energy(start);
  double largest = 0;
  std::printf("\n  %4s %10s %12s %14s %12s\n", "t, s", "q, rad", "energy, J", "work of drag", "balance");
  kte::dormand_prince45 solver(rhs, 0.0, start, {.absolute = 1e-11, .relative = 1e-11});
  solver.integrate(5.0, kte::every(0.5), [&](double t, const Eigen::Vector3d& x) {
    const double balance = energy(x) - at_start - x[2];
    largest = std::max(largest, std::abs(balance));
    std::printf("  %4.1f %10.6f %12.8f %14.8f %12.1e\n", t, x[0], energy(x), x[2], balance);
  });
  std::printf("\n");
  expect(largest < 1e-8, "the energy lost is the work of the drag");  // J; 4.9 J are there to lose
}

int main() {
  check_laws();
  check_chains();
  simulate();
  return failures;
}
