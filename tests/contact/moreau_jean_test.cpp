#include <kte/contacts.hpp>
#include <kte/elements/closures.hpp>
#include <kte/elements/damper.hpp>
#include <kte/elements/driving_actuator.hpp>
#include <kte/elements/rigid_contact.hpp>
#include <kte/loops.hpp>
#include <kte/simulation.hpp>
#include <kte/static.hpp>

#include "allocations.hpp"
#include "catch.hpp"
#include "contact/box_on_slope.hpp"

namespace moreau_jean_test {

using namespace kte;
using namespace kte::test;

constexpr double g = 9.81;

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

TEST_CASE("the forces of steps add up to the change of momentum, where bounces are shorter than steps too") {
  for (const double h : {1e-2, 2e-3, 1e-3}) {
    const double height = 0.55, ends = 3 * std::sqrt(2 * height / g);  // of the bounces, for e = 1/2
    const manipulator_dynamics_model model(rolling_ball(0.5, 0.5));
    moreau_jean solver(std::cref(model), 0.0,
                       model.make_x(numbers({0, 0, height + 0.1, 1, 0, 0, 0}), numbers({0, 0, 0, 0, 0, 0})), h);
    double impulse = 0, before = 0, least = g;
    solver.integrate(3.0, every(h), [&](double t, const auto& x) {
      const double force = t > before ? solver.contact("floor").force.z : 0.0;
      impulse += force * (t - before), before = t;
      CHECK(std::abs(impulse - (g * t + x[9])) < 1e-11);  // 3000 roundings of 1e-15, and of t
      if (force > 0) least = (std::min)(least, force);
      if (t > ends + 6.5 * h) CHECK(std::abs(force - g) < 1e-9);
    });
    CHECK(least < 0.9 * g);  // in a step that began with the velocity of a bounce
  }
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
}

TEST_CASE("chains with loops and contacts") {
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
  moreau_jean solver(std::cref(model), 0.0, x, 1e-3);
  CHECK_NOTHROW(solver.integrate(0.01));
}

/// Two carts on a slope, above the ground.
runtime_chain two_carts(bool contact = true) {
  runtime_chain c;
  c << base_2D("ground") << prismatic_joint_2D("x", "ground", "cart", axis::x)
    << inertia_2D("cart", planar_body(2.0, 0.1)) << prismatic_joint_2D("y", "ground", "other", axis::x)
    << inertia_2D("other", planar_body(3.0, 0.1));
  if (contact)
    c << rigid_link_2D("cart", "above", vec2{0.0, 1.0})
      << point_contact_2D("foot", "ground", "above", half_space{}, {});
  c.gravity({2, -g, 0});
  return c;
}

TEST_CASE("dampers, springs and motors may be stiff") {
  const double h = 1e-2;
  const auto after = [&](const runtime_chain& c, const Eigen::VectorXd& q, const Eigen::VectorXd& v, int steps) {
    manipulator_dynamics_model model(c);
    moreau_jean solver(std::cref(model), 0.0, model.make_x(q, v), h);
    solver.integrate(steps * h);
    return Eigen::VectorXd(solver.state());
  };
  SECTION("a damper: v^+ = (v + h g)/(1 + h c/m)") {
    auto c = two_carts();
    c << joint_damping_gen("x", 2e6);
    CHECK(std::abs(after(c, numbers({0, 0}), numbers({1, 0}), 1)[2] - (1 + h * 2) / (1 + h * 1e6)) < 1e-15);
  }
  SECTION("a spring swings for ever, within its energy") {
    auto c = two_carts();
    c.gravity({0, -g, 0});
    c << joint_stiffness_gen("x", 2e8);
    const auto x = after(c, numbers({1e-3, 0}), numbers({0, 0}), 9999);
    CHECK(std::abs(x[0]) < 1.001e-3);
    CHECK(std::abs(x[0]) + std::abs(x[2]) * h > 1e-4);
  }
  SECTION("a servo holds its load") {
    auto c = two_carts();
    c << joint_motor_gen("x", "wanted", {.stiffness = 1e6, .damping = 1e6});
    CHECK(std::abs(after(c, numbers({0, 0}), numbers({0, 0}), 3000)[0] - 4e-6) < 1e-12);
  }
  SECTION("a spring between two coordinates leaves their common motion free") {
    auto c = two_carts();
    c << spring_gen("x", "y", 0.0, 1e9) << damper_gen("x", "y", 1e6);
    const auto x = after(c, numbers({0, 0}), numbers({0, 0}), 100);
    CHECK(std::abs(x[0] - 1.0) < 1e-9);
    CHECK(std::abs(x[1] - x[0]) < 1e-9);
  }
}

/// x'' = 2 + u/2 with u = -8 x - 4 x' + 6 sin(3 t), by a law that counts its calls.
struct swinging {
  runtime_chain chain = [] {
    auto c = two_carts();
    c << driving_actuator_gen("x", "motor");
    return c;
  }();
  manipulator_dynamics_model<runtime_chain> model{chain};
  int calls = 0;

  double end(double h, const time_stepping_options& options) {
    calls = 0;
    controlled under(std::ref(model), [this](double t, const Eigen::VectorXd& x) {
      ++calls;
      return Eigen::VectorXd(Eigen::VectorXd::Constant(1, -8 * x[0] - 4 * x[2] + 6 * std::sin(3 * t)));
    });
    moreau_jean solver(std::ref(under), 0.0, model.make_x(numbers({0.3, 0}), numbers({0.1, 0})), h, options);
    solver.integrate(1.0, every(0.25), [&](double t, const auto& x) { (void)solver.state_at(t, x); });
    return solver.state()[0];
  }
};

TEST_CASE("a law is called once a step by default, and the order is 1 either way") {
  swinging s;
  controlled under(std::ref(s.model), [](double t, const Eigen::VectorXd& x) {
    return Eigen::VectorXd(Eigen::VectorXd::Constant(1, -8 * x[0] - 4 * x[2] + 6 * std::sin(3 * t)));
  });
  dormand_prince45 exact(std::ref(under), 0.0, s.model.make_x(numbers({0.3, 0}), numbers({0.1, 0})),
                         {.absolute = 1e-12, .relative = 1e-12});
  exact.integrate(1.0);
  const auto error = [&](double h, bool implicit) {
    return std::abs(s.end(h, {.implicit_control = implicit}) - exact.state()[0]);
  };
  CHECK(error(0.01, false) < 0.02);
  CHECK(s.calls == 101);  // and for the recorder before the first step
  CHECK(std::abs(error(0.01, false) / error(0.005, false) - 2) < 0.1);
  CHECK(error(0.01, true) < 0.005);
  CHECK(s.calls > 4 * 100);
  CHECK(error(0.01, true) / error(0.005, true) > 1.9);
}

TEST_CASE("a stiff control law on coordinates is implicit with implicit_control") {
  auto c = two_carts();
  c << driving_actuator_gen("x", "motor");
  manipulator_dynamics_model model(c);
  int calls = 0;
  controlled under(model, [&calls](double, const Eigen::VectorXd& x) {
    ++calls;
    return Eigen::VectorXd(Eigen::VectorXd::Constant(1, -1e6 * x[0] - 1e6 * x[2]));
  });
  const auto x0 = model.make_x(numbers({0, 0}), numbers({0, 0}));
  moreau_jean solver(std::ref(under), 0.0, x0, 1e-2, {.implicit_control = true});
  solver.integrate(30.0);
  CHECK(std::abs(solver.state()[0] - 4e-6) < 1e-9);
  CHECK(calls < 10 * 3000);
  moreau_jean held(std::ref(under), 0.0, x0, 1e-2);
  CHECK_THROWS_AS(held.integrate(30.0), integration_failure);
}

TEST_CASE("internal states of elements and of laws") {
  const auto with_states = [](runtime_chain c) {
    c << joint_lugre_gen("x", "bristles",
                         {.sigma0 = 1e4,
                          .sigma1 = 200.0,
                          .sigma2 = 0.4,
                          .coulomb = 3.0,
                          .stiction = 3.0,
                          .stribeck_velocity = 0.01})
      << driving_actuator_gen("y", "motor");
    manipulator_dynamics_model model(c);
    const auto torque = [](double, const Eigen::VectorXd& x, const Eigen::Matrix<double, 1, 1>& z) {
      return std::array{-40 * x[1] - 20 * x[3] - 30 * z[0]};
    };
    const auto integral = [](double, const Eigen::VectorXd& x, const Eigen::Matrix<double, 1, 1>&) {
      return std::array{x[1] - 0.1};
    };
    return controlled(model, torque, integral, std::array{0.0});
  };
  auto free = with_states(two_carts(false));
  const auto x0 = free.make_x(numbers({0, 0}), numbers({0.5, 0}));
  dormand_prince45 exact(std::ref(free), 0.0, x0, {.absolute = 1e-9, .relative = 1e-9});
  exact.integrate(1.0);
  auto under = with_states(two_carts());
  const auto start = under.make_x(numbers({0, 0}), numbers({0.5, 0}));
  const auto error = [&](double h) {
    moreau_jean solver(std::ref(under), 0.0, start, h);
    solver.integrate(1.0);
    const auto &x = solver.state(), &y = exact.state();
    return std::hypot((x.head<5>() - y.head<5>()).norm(), under.law_states_of(x)[0] - free.law_states_of(y)[0]);
  };
  CHECK(error(1e-3) < 1.2e-2);  // in the first millisecond bristles brake by 200 N s/m
  CHECK(error(1e-4) < 1.5e-3);
}

TEST_CASE("a start inside a surface is refused with the name of the contact") {
  const auto c = box_on_slope(0.2);
  manipulator_dynamics_model model(c);
  const auto inside = model.make_x(numbers({0, 0.045, 0}), numbers({0, 0, 0}));
  CHECK_THROWS_MATCHES((moreau_jean(std::cref(model), 0.0, inside, 1e-3)), bad_argument,
                       says("contact 'left foot' starts 0.005"));
  CHECK_NOTHROW(moreau_jean(std::cref(model), 0.0, inside, 1e-3, {.depth = 0.1}));
  CHECK_THROWS_MATCHES((moreau_jean(std::cref(model), 0.0, inside, 1e-3, {.depth = std::nan("")})), bad_argument,
                       says("the depth of a start must not be negative, got nan"));
  const auto r = in_runtime(c);
  manipulator_dynamics_model same(r);
  CHECK_THROWS_MATCHES(
      (moreau_jean(std::cref(same), 0.0, same.make_x(numbers({0, 0.045, 0}), numbers({0, 0, 0})), 1e-3)), bad_argument,
      says("contact 'left foot' starts 0.005"));
  moreau_jean solver(std::cref(same), 0.0, same.make_x(numbers({0, 0.05, 0}), numbers({0, 0, 0})), 1e-3);
  solver.integrate(0.1);
  CHECK_THROWS_MATCHES(solver.integrate(0.0), integration_failure, says("backwards"));
}

TEST_CASE("steps do not allocate") {
  const auto c = box_on_slope(0.4);
  const auto r = in_runtime(c);
  manipulator_dynamics_model model(c);
  manipulator_dynamics_model same(r);
  moreau_jean a(std::cref(model), 0.0, model.make_x(numbers({0, 0.05, 0}), numbers({2, 0, 0})), 1e-3);
  moreau_jean b(std::cref(same), 0.0, same.make_x(numbers({0, 0.05, 0}), numbers({2, 0, 0})), 1e-3);
  a.integrate(0.4), b.integrate(0.4);  // it slides, then sticks
  CHECK(allocations::during([&] { a.integrate(0.5); }) == 0);
  CHECK(allocations::during([&] { b.integrate(0.5); }) == 0);
}

TEST_CASE("states for recorders have the accelerations and contact forces of the last step") {
  const auto c = box_on_slope(0.4);
  const auto r = in_runtime(c);
  manipulator_dynamics_model model(c);
  manipulator_dynamics_model same(r);
  const auto of_static = [&] {
    moreau_jean solver(std::cref(model), 0.0, model.make_x(numbers({0, 0.05, 0}), numbers({2, 0, 0})), 1e-3);
    solver.integrate(0.1);
    return solver.state_at(0.1, solver.state());
  }();
  moreau_jean solver(std::cref(same), 0.0, same.make_x(numbers({0, 0.05, 0}), numbers({2, 0, 0})), 1e-3);
  solver.integrate(0.1);
  const auto& s = solver.state_at(0.1, solver.state());
  const double force = g * std::cos(0.3);
  CHECK(std::abs(s.contact("left foot").force.y + s.contact("right foot").force.y - force) < 1e-9);
  CHECK(std::abs(s.contact("left foot").force.x + s.contact("right foot").force.x + 0.4 * force) < 1e-9);
  CHECK(std::abs(s.frame_2D("box").acceleration.x + 0.4 * force) < 1e-9);  // minus gravity, as of all frames
  CHECK(std::abs(s.frame_2D("left").position.x - solver.state()[0] + 0.1) < 1e-12);
  CHECK(of_static[left_foot].force.y == s.contact("left foot").force.y);
  CHECK(of_static[box].acceleration.x == s.frame_2D("box").acceleration.x);
}

}  // namespace moreau_jean_test
