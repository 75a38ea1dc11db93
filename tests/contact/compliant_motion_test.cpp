#include <kte/dynamics/centroidal.hpp>
#include <kte/dynamics/energy.hpp>
#include <kte/elements/bristle_contact.hpp>
#include <kte/elements/compliant_contact.hpp>
#include <kte/elements/compliant_shapes.hpp>
#include <kte/integrators/rodas.hpp>
#include <kte/kte.hpp>
#include <kte/models/element_events.hpp>
#include <kte/models/manipulator_dynamics_model.hpp>
#include <kte/models/runtime_dynamics_model.hpp>

#include "catch.hpp"

// Motions with compliant contacts, against closed forms.

namespace compliant_motion_test {

using namespace kte;
using kte::test::within;

// clang-format off
inline constexpr struct x_      final : coord_key<"x">        {} x;
inline constexpr struct y_      final : coord_key<"y">        {} y;
inline constexpr struct phi_    final : coord_key<"phi">      {} phi;
inline constexpr struct hairs_  final : internal_key<"hairs"> {} hairs;
inline constexpr struct ground_ final : frame_2D_key<"ground"> {} ground;
inline constexpr struct slide_  final : frame_2D_key<"slide"> {} slide;
inline constexpr struct lift_   final : frame_2D_key<"lift">  {} lift;
inline constexpr struct wheel_  final : frame_2D_key<"wheel"> {} wheel;
// clang-format on

using vector = Eigen::VectorXd;
constexpr double g = 9.81, r = 0.1, stiffness = 1e6;
/// The depth at which a contact of exponent 3/2 carries 1 kg.
const double depth = std::pow(g / stiffness, 2.0 / 3);

/// A sphere of 1 kg in the plane, with what touches the ground.
template <class... Contact>
constexpr auto rolling(const Contact&... contact) {
  return chain(base_2D(ground), prismatic_joint_2D(x, ground, slide, axis::x),
               prismatic_joint_2D(y, slide, lift, axis::y), revolute_joint_2D(phi, lift, wheel),
               inertia_2D(wheel, planar_body(1.0, 0.4 * r * r)), contact...)
      .gravity(-g * axis::y);
}
constexpr compliant_contact_parameters smooth{
    .stiffness = stiffness, .dissipation = 0.5, .friction = 0.2, .slip_speed = 1e-4};
constexpr bristle_contact_parameters brush{.stiffness = stiffness,
                                           .dissipation = 0.5,
                                           .friction = 0.2,
                                           .slip_speed = 1e-2,
                                           .bristle_stiffness = 1e5,
                                           .bristle_damping = 100};

/// The ratio of the speeds after and before an impact at v, m/s.
double restitution(double v) {
  const auto c =
      chain(base_2D(ground), prismatic_joint_2D(y, ground, lift, axis::y), inertia_2D(lift, planar_body(1.0, 0.0)),
            compliant_contact_2D(ground, lift, half_space{}, 0, {.stiffness = 1e4, .dissipation = 1.4327505332714}));
  const manipulator_dynamics_model m(c);
  rodas solver(std::cref(m), 0.0, Eigen::Vector2d(1e-3, -v), {.absolute = 1e-11, .relative = 1e-11});
  solver.integrate(1.0, element_events(m));
  return solver.state()[1] / v;
}
/// Where a sphere is after 2 s that starts to slide at 1 m/s.
template <class Model>
double rolled(const Model& m, double tolerance) {
  rodas solver(std::cref(m), 0.0, m.make_x(vector(Eigen::Vector3d(0, r - depth, 0)), vector(Eigen::Vector3d(1, 0, 0))),
               {.absolute = tolerance, .relative = tolerance});
  solver.integrate(2.0, element_events(m));
  return solver.state()[0];
}

/// Two spheres of 1 and 2 kg in space with contact between them.
runtime_chain two_spheres() {
  runtime_chain c;
  const auto sphere = [](double mass) {
    const double i = 0.4 * mass * r * r;
    return rigid_body{mass, zero3{}, diagonal(i, i, i)};
  };
  c << base_3D("world") << free_joint_3D("pose1", "world", "ball1") << inertia_3D("ball1", sphere(1))
    << free_joint_3D("pose2", "world", "ball2") << inertia_3D("ball2", sphere(2))
    << bristle_contact_3D("ball1", "ball2", "zx", "zy", "zz", ball_surface(r), r, brush);
  return c;
}

TEST_CASE("the restitution of Hunt and Crossley's law depends on the speed") {
  CHECK(restitution(1) == within(0.5, 1e-10));
  CHECK(restitution(0.1) == within(0.91274496758, 1e-10));
}

TEST_CASE("a sphere slides, then rolls") {
  constexpr double rigid = 1.44937485697643;
  const auto regularized = rolling(compliant_contact_2D(ground, wheel, half_space{}, r, smooth));
  const auto bristles = rolling(bristle_contact_2D(ground, wheel, hairs, half_space{}, r, brush));
  CHECK(rolled(manipulator_dynamics_model(regularized), 1e-8) == within(rigid, 3e-9));
  CHECK(rolled(manipulator_dynamics_model(bristles), 1e-8) == within(rigid, 2e-7));
  runtime_chain same;
  same << regularized;
  CHECK(rolled(manipulator_dynamics_model<runtime_chain>(same), 1e-8) ==
        within(rolled(manipulator_dynamics_model(regularized), 1e-8), 1e-12));
}

TEST_CASE("on a slope that holds, bristles rest and regularized friction creeps", "[long]") {
  constexpr double slope = 0.3, friction = 0.4;
  auto p = smooth;
  p.friction = friction, p.slip_speed = 1e-3;
  auto b = brush;
  b.friction = friction;
  const auto speed = [&](const auto& contact, double t) {
    const auto c = chain(base_2D(ground), prismatic_joint_2D(x, ground, slide, axis::x),
                         prismatic_joint_2D(y, slide, lift, axis::y), inertia_2D(lift, planar_body(1.0, 0.0)), contact)
                       .gravity(vec3{g * std::sin(slope), -g * std::cos(slope), zero});
    const manipulator_dynamics_model m(c);
    rodas solver(std::cref(m), 0.0, m.make_x(vector(Eigen::Vector2d(0, -depth)), vector(Eigen::Vector2d(-0.5, 0))),
                 {.absolute = 1e-10, .relative = 1e-10});
    solver.integrate(t, element_events(m));
    return solver.state()[2];
  };
  const double creep =
      1e-3 * std::sin(slope) / std::sqrt(std::pow(friction * std::cos(slope), 2) - std::pow(std::sin(slope), 2));
  CHECK(speed(compliant_contact_2D(ground, lift, half_space{}, 0, p), 5) == within(creep, 1e-8));
  CHECK(speed(bristle_contact_2D(ground, lift, hairs, half_space{}, 0, b), 5) == within(0, 1e-9));
}

TEST_CASE("two free spheres collide: momentum is kept, energy never grows") {
  const auto c = two_spheres();
  const manipulator_dynamics_model<runtime_chain> m(c);
  auto s = c.make_state();
  s.pose_3D("pose2").position = {0.5, 0.1, 0.05};
  s.pose_3D("pose1").velocity = {2, 0, 0}, s.pose_3D("pose1").ang_velocity = {1, 20, -3};
  rodas solver(std::cref(m), 0.0, m.getJointStates(s), {.absolute = 1e-10, .relative = 1e-10});
  const auto momentum = [&] {
    const vector at = solver.state();
    const auto h = centroidal_momentum(c, s, vector(m.positions_of(at)), vector(m.velocities_of(at)));
    return (vector(6) << h.linear.x, h.linear.y, h.linear.z, h.angular.x, h.angular.y, h.angular.z).finished();
  };
  const auto energy_now = [&] {
    const vector at = solver.state();
    const auto e = energy(c, s, vector(m.positions_of(at)), vector(m.velocities_of(at)));
    return e.kinetic + e.potential;
  };
  const vector at_start = momentum();
  double last = energy_now();
  const double start = last;
  for (double t = 0.01; t < 0.5; t += 0.01) {
    solver.integrate(t, element_events(m));
    const double now = energy_now();
    CHECK(now < last + 1e-8 * start);
    last = now;
  }
  CHECK(last < 0.95 * start);
  CHECK((momentum() - at_start).norm() < 1e-8);
}

}  // namespace compliant_motion_test
