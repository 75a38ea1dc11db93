#include <kte/contacts.hpp>
#include <kte/elements/closures.hpp>
#include <kte/elements/rigid_contact.hpp>
#include <kte/loops.hpp>
#include <kte/simulation.hpp>
#include <kte/static.hpp>

#include "catch.hpp"

using namespace kte;
using namespace kte::test;

namespace {

inline constexpr struct world_ final : frame_2D_key<"world"> {
} world;
inline constexpr struct box_ final : frame_2D_key<"box"> {
} box;
inline constexpr struct left_ final : frame_2D_key<"left"> {
} left_corner;
inline constexpr struct right_ final : frame_2D_key<"right"> {
} right_corner;
inline constexpr struct pose_ final : pose_2D_key<"pose"> {
} pose_of_box;
inline constexpr struct left_contact_ final : contact_key<"left foot"> {
} left_foot;
inline constexpr struct right_contact_ final : contact_key<"right foot"> {
} right_foot;

constexpr double g = 9.81;

/// A box on two corners, on a slope of 0.3 in whose axes it moves.
auto box_on_slope(double mu) {
  const contact_law law{.friction = mu};
  return chain(base_2D(world), free_joint_2D(pose_of_box, world, box),
               rigid_link_2D(box, left_corner, vec2{-0.1, -0.05}), rigid_link_2D(box, right_corner, vec2{0.1, -0.05}),
               inertia_2D(box, planar_body(1.0, 0.01)),
               point_contact_2D(left_foot, world, left_corner, half_space{}, law),
               point_contact_2D(right_foot, world, right_corner, half_space{}, law))
      .gravity(vec3{-g * std::sin(0.3), -g * std::cos(0.3), zero});
}
runtime_chain in_runtime(const auto& c) {
  runtime_chain r;
  r << c;
  return r;
}
Eigen::VectorXd numbers(std::initializer_list<double> x) {
  return Eigen::Map<const Eigen::VectorXd>(x.begin(), static_cast<Eigen::Index>(x.size()));
}
/// A ball of radius 0.1 in space.
runtime_chain rolling_ball(double mu, double restitution = 0) {
  runtime_chain c;
  c << base_3D("world") << free_joint_3D("pose", "world", "ball")
    << inertia_3D("ball", rigid_body{1.0, vec3{0.0, 0.0, 0.0}, sym3{0.004, 0.0, 0.0, 0.004, 0.0, 0.004}})
    << sphere_contact_3D("floor", "world", "ball", half_space{}, 0.1, {.friction = mu, .restitution = restitution});
  c.gravity({0, 0, -g});
  return c;
}

}  // namespace

TEST_CASE("a box slides up a slope, and back or to rest") {
  const auto c = box_on_slope(0.2);
  const auto rough = box_on_slope(0.4);
  const auto place_after_two_seconds = [](const auto& chain, double h) {
    manipulator_dynamics_model model(chain);
    moreau_jean solver(std::cref(model), 0.0, model.make_x(numbers({0, 0.05, 0}), numbers({2, 0, 0})), h);
    solver.integrate(2.0);
    return solver.state()[0];
  };
  // The time of the turn is met to h^2; the error of first order there is h times the change of a.
  CHECK(std::abs(place_after_two_seconds(c, 1e-3) + 0.86166423136809) < 4e-5);
  CHECK(std::abs(place_after_two_seconds(rough, 1e-3) - 0.30085169864298) < 5e-6);
  CHECK(std::abs(place_after_two_seconds(rough, 5e-4) - 0.30085169864298) < 1.25e-6);
  CHECK(place_after_two_seconds(in_runtime(c), 1e-3) == place_after_two_seconds(c, 1e-3));
}

TEST_CASE("a body at rest stays at rest in all digits") {
  const auto c = box_on_slope(0.4);
  manipulator_dynamics_model model(c);
  moreau_jean solver(std::cref(model), 0.0, model.make_x(numbers({0, 0.05, 0}), numbers({0, 0, 0})), 1e-2);
  solver.integrate(100.0);
  CHECK(std::abs(solver.state()[0]) < 1e-12);
  CHECK(std::abs(solver.state()[1] - 0.05) < 1e-12);
  const auto &a = solver.contact(left_foot), &b = solver.contact(right_foot);
  CHECK(mode_of(a) == contact_mode::sticks);
  CHECK(std::abs(a.force.y + b.force.y - g * std::cos(0.3)) < 1e-12);
  CHECK(std::abs(a.force.x + b.force.x - g * std::sin(0.3)) < 1e-12);
}

TEST_CASE("a ball slips, then rolls") {
  const auto c = rolling_ball(0.2);
  manipulator_dynamics_model model(c);
  Eigen::VectorXd q = neutral_configuration(c);
  q[2] = 0.1;
  moreau_jean solver(std::cref(model), 0.0, model.make_x(q, numbers({1, 0, 0, 0, 0, 0})), 1e-4);
  solver.integrate(2.0);
  CHECK(std::abs(solver.state()[0] - 1.44937485697643) < 1e-5);
  const Eigen::VectorXd v = model.velocities_of(solver.state());
  // Velocities are in axes of the ball, which turn by 7e-4 in a step: errors are of the square of this.
  CHECK(std::abs(v.head<3>().norm() - 5.0 / 7) < 5e-7);
  CHECK(mode_of(solver.contact("floor")) == contact_mode::sticks);
  CHECK(std::abs(solver.contact("floor").slip.x) < 5e-7);
}

TEST_CASE("a ball bounces with its restitution") {
  const auto c = rolling_ball(0.0, 0.5);
  manipulator_dynamics_model model(c);
  Eigen::VectorXd q = neutral_configuration(c);
  q[2] = 1.1;
  moreau_jean solver(std::cref(model), 0.0, model.make_x(q, Eigen::VectorXd::Zero(6)), 1e-4);
  const double down = std::sqrt(2 / g);
  double highest = 0;
  solver.integrate(2 * down, [&](double t, const Eigen::VectorXd& x) {
    if (t > down) highest = std::max(highest, x[2] - 0.1);
  });
  CHECK(std::abs(highest - 0.25) < 1e-3);
  solver.integrate(3.0);  // bounces without end until 3 down
  CHECK(std::abs(solver.state()[2] - 0.1) < 1e-3);
  CHECK(model.velocities_of(solver.state()).norm() < 1e-3);
}

TEST_CASE("a control law acts within steps") {
  const auto c = in_runtime(box_on_slope(0.4));
  manipulator_dynamics_model model(c);
  moreau_jean alone(std::cref(model), 0.0, model.make_x(numbers({0, 0.05, 0}), numbers({2, 0, 0})), 1e-3);
  controlled under(std::ref(model), [](double, const Eigen::VectorXd&) { return Eigen::VectorXd(0); });
  moreau_jean solver(std::ref(under), 0.0, alone.state(), 1e-3);
  alone.integrate(1.0), solver.integrate(1.0);
  CHECK(solver.state() == alone.state());
}

TEST_CASE("steps that cannot be taken are refused") {
  const auto c = rolling_ball(0.2);
  manipulator_dynamics_model model(c);
  const auto x = model.make_x(neutral_configuration(c), Eigen::VectorXd::Zero(6));
  CHECK_THROWS_AS((moreau_jean(std::cref(model), 0.0, x, 0.0)), bad_argument);
  CHECK_THROWS_MATCHES(rolling_ball(-0.1), bad_parameter, says("friction must be finite"));
  CHECK_THROWS_MATCHES(rolling_ball(0.1, 1.5), bad_parameter, says("restitution must be between"));
  CHECK_THROWS_MATCHES(model(0.0, x), bad_argument, says("contact 'floor'"));
}

TEST_CASE("chains with loops and contacts are simulated by time stepping only") {
  runtime_chain c;
  c << base_2D("ground") << revolute_joint_2D("q", "ground", "a") << inertia_2D("a", planar_body(1.0, 0.1))
    << rigid_link_2D("a", "tip", vec2{1.0, 0.0}) << revolute_joint_2D("p", "tip", "b")
    << inertia_2D("b", planar_body(1.0, 0.1)) << point_on_line_2D("slot", "ground", "b", vec2{1.0, 0.0})
    << point_contact_2D("foot", "ground", "b", half_space{}, {});
  auto s = c.make_state();
  const Eigen::Vector2d none(0, 0);
  CHECK_THROWS_MATCHES(constrained_dynamics_derivatives(c, s, none, none, none), bad_argument, says("contact 'foot'"));
  manipulator_dynamics_model model(c);
  const auto x = model.make_x(none, none);
  CHECK_THROWS_MATCHES(model(0.0, x), bad_argument, says("contact 'foot'"));
  moreau_jean solver(std::cref(model), 0.0, x, 1e-3);
  CHECK_NOTHROW(solver.integrate(0.01));
}
