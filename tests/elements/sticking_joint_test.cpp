#include <kte/dynamics.hpp>
#include <kte/elements/sticking_joint.hpp>
#include <kte/simulation.hpp>
#include <kte/static.hpp>
#include <kte/testing/static_is_runtime.hpp>

#include <cmath>

#include "catch.hpp"
#include "chain/registered.hpp"
#include "elements/laws.hpp"

// Joints with dry friction by what they carry, which hold: forces and accelerations in each mode.

namespace sticking_joint_test {

using namespace kte;
using namespace kte::test;

// clang-format off
inline constexpr struct q_      final : coord_key<"q">         {} q;
inline constexpr struct s_      final : coord_key<"s">         {} s;
inline constexpr struct mode_q_ final : internal_key<"q.mode"> {} mode_q;
inline constexpr struct mode_s_ final : internal_key<"s.mode"> {} mode_s;
inline constexpr struct ground_ final : frame_3D_key<"ground"> {} ground;
inline constexpr struct arm_    final : frame_3D_key<"arm">    {} arm;
inline constexpr struct slide_  final : frame_3D_key<"slide">  {} slide;
inline constexpr struct wall_   final : frame_2D_key<"wall">   {} wall;
inline constexpr struct rod_    final : frame_2D_key<"rod">    {} rod;
inline constexpr struct tip_    final : frame_2D_key<"tip">    {} tip;
// clang-format on

constexpr double g = 9.81, L = 0.5, mass = 2.0;

/// A point at the end of a rod, on a bearing.
auto pendulum(double radius, const dry_friction_parameters& friction) {
  return chain(sticking_revolute_joint_2D(q, mode_q, wall, rod, radius, friction), rigid_link_2D(rod, tip, along_x(L)),
               inertia_2D(tip, point_mass(mass)))
      .gravity(along_y(-g));
}
/// A slide in space, its centre of mass beside its guide, on a bearing that turns.
auto slide_on_arm() {
  return chain(sticking_revolute_joint_3D(q, mode_q, ground, arm, vec3{0.6, 0.0, 0.8}, 0.03, {0.4, 0.5, 0.2})
                   .at(vec3{0.1, 0.2, 0.3}, quarter_turn_y),
               inertia_3D(arm, rigid_body{1.5, vec3{0.02, -0.03, 0.1}, sym3{0.3, 0.01, -0.02, 0.25, 0.03, 0.2}}),
               sticking_prismatic_joint_3D(s, mode_s, arm, slide, vec3{0.0, 0.6, 0.8}, {0.1, 0.2, 0.3})
                   .at(vec3{0.3, -0.1, 0.2}, quarter_turn_x),
               inertia_3D(slide, rigid_body{0.7, vec3{0.1, 0.05, -0.1}, sym3{0.1, 0.01, 0.02, 0.15, 0.01, 0.12}}))
      .gravity(vec3{1.0, -2.0, -9.0});
}
template <class Model>
double acceleration(const Model& model, double angle, double rate, double mode) {
  auto x = model.make_x(std::array{angle}, std::array{rate});
  x[2] = mode;
  return model.computeStateRate(0.0, x)[1];
}

TEST_CASE("laws of sticking joints") {
  random_numbers draw(1);
  const auto check = [&](const auto& joint, const auto& named) {
    CHECK(testing::motion_is_derivative<double>(joint, draw) <= by_differences<double>);
    CHECK(testing::power_is_kept<double>(joint, draw) <= rounding<double>);  // it has no friction
    CHECK(testing::static_is_runtime(named, draw) < 1e-12);
  };
  check(sticking_revolute_joint_2D("q", "m", "a", "b", 0.1, {0.0}),
        sticking_revolute_joint_2D("q", "m", "a", "b", 0.02, {0.3, 0.4}));
  check(
      sticking_revolute_joint_3D("q", "m", "a", "b", vec3{0.6, 0.0, 0.8}, 0.1, {0.0}),
      sticking_revolute_joint_3D("q", "m", "a", "b", axis::y, 0.02, {0.3, 0.4, 0.5}).at(along_x(0.3), quarter_turn_z));
  check(sticking_prismatic_joint_2D("q", "m", "a", "b", vec2{0.6, 0.8}, {0.0}),
        sticking_prismatic_joint_2D("q", "m", "a", "b", axis::x, {0.1, 0.1, 0.5}));
  check(sticking_prismatic_joint_3D("q", "m", "a", "b", vec3{0.6, 0.0, 0.8}, {0.0}),
        sticking_prismatic_joint_3D("q", "m", "a", "b", vec3{0.0, 0.6, 0.8}, {0.1, 0.2}).at(along_x(0.3)));
}

TEST_CASE("a pendulum on a bearing accelerates by its mode") {
  // as in rotor_test.cpp, with the friction of the mode instead of that of the rate
  constexpr double mu = 0.5, radius = 0.1, R = mu * radius;
  const auto c = pendulum(radius, {mu, 0.7});
  const manipulator_dynamics_model fixed(c);
  const runtime_chain r = models::registered(record_of(c));
  CHECK(record_of(r) == record_of(c));
  const manipulator_dynamics_model at_run_time(r);
  for (const double rate : {3.0, -1.0, 0.0})
    for (const int m : {mode::forward, mode::backward, mode::sliding, mode::held}) {
      const double angle = 0.4, d = m != mode::sliding ? m : rate > 0 ? 1 : rate < 0 ? -1 : 0;
      const double B = g * std::sin(angle) - L * rate * rate;
      const double A = -R * d * std::abs(B) / std::sqrt(L * L - R * R * d * d);
      const double expected = m == mode::held ? 0 : (A - g * std::cos(angle)) / L;
      CHECK(acceleration(fixed, angle, rate, m) == within(expected, 2e-14));
      CHECK(acceleration(at_run_time, angle, rate, m) == within(expected, 2e-14));
    }
}

TEST_CASE("what a bearing carries says how much it holds") {
  const auto c = pendulum(0.1, {0.5, 0.7});
  const manipulator_dynamics_model fixed(c);
  const runtime_chain r = models::registered(record_of(c));
  const manipulator_dynamics_model at_run_time(r);
  const auto check = [](const auto& model) {
    auto x = model.make_x(std::array{0.4}, std::array{0.0});
    x[2] = mode::held;
    CHECK(model.capacity(0.0, x, 0) == within(0.07 * mass * g, 1e-14));
    CHECK(model.needed_forces(0.0, x)[0] == within(mass * g * L * std::cos(0.4), 1e-14));
  };
  check(fixed), check(at_run_time);
}

TEST_CASE("moments press on two bearings") {
  // F across the guide and a moment M: F/2 +- M/L; if they differ in sign, the load is twice the larger.
  const double F = 3.0, M = GENERATE(0.0, 0.4, -0.4, 2.5, -2.5), span = 0.5, mu = 0.2;
  runtime_chain c;
  c << sticking_prismatic_joint_2D("s", "s.mode", "rail", "slide", axis::x, {.friction = mu, .span = span})
    << inertia_2D("slide", planar_body(1.0, 0.1)) << constant_force_2D("slide", vec2{5.0, F}, M) << base_3D("frame")
    << sticking_prismatic_joint_3D("p", "p.mode", "frame", "body", axis::y, {.friction = mu, .span = span})
    << inertia_3D("body", rigid_body{1.0, zero3{}, sym3{0.1, 0.0, 0.0, 0.1, 0.0, 0.1}})
    << constant_force_3D("body", vec3{F, 5.0, 0.0}, vec3{0.0, 7.0, M});
  manipulator_dynamics_model model(c);
  auto x = model.make_x(std::array{0.0, 0.0}, std::array{1.0, 1.0}, std::array{1.0, 1.0});
  const double expected = 5 - mu * std::max(F, 2 * std::abs(M) / span);
  CHECK(model(0.0, x)[2] == within(expected, 1e-14));
  CHECK(model(0.0, x)[3] == within(expected, 1e-14));
}

TEST_CASE("static and runtime chains of sticking joints") {
  const auto c = slide_on_arm();
  const runtime_chain r = models::registered(record_of(c));
  CHECK(record_of(r) == record_of(c));
  const manipulator_dynamics_model fixed(c);
  const manipulator_dynamics_model at_run_time(r);
  for (const double m : {-1.0, 0.0, 1.0, 2.0})
    for (const double n : {-1.0, 1.0, 2.0}) {
      const auto x = fixed.make_x(std::array{0.3, 0.2}, std::array{0.5, -0.7}, std::array{m, n});
      const Eigen::VectorXd rate = at_run_time(0.5, x);
      CHECK((fixed(0.5, x) - rate).norm() <= 1e-13 * (1 + rate.norm()));
      if (m == mode::held) CHECK(rate[2] == 0);
      if (n == mode::held) CHECK(rate[3] == 0);
      // inverse dynamics finds no force but what holds
      const Eigen::VectorXd needed = at_run_time.needed_forces(0.5, x);
      CHECK((fixed.needed_forces(0.5, x) - needed).norm() <= 1e-12);
      if (m != mode::held) CHECK(needed[0] == within(0, 1e-13));
      if (n != mode::held) CHECK(needed[1] == within(0, 1e-13));
      for (const std::size_t e : {std::size_t{0}, std::size_t{2}})
        CHECK(fixed.capacity(0.5, x, e) == within_relative(at_run_time.capacity(0.5, x, e), 1e-12));
    }
}

TEST_CASE("derivatives of models with sticking joints") {
  const auto c = slide_on_arm();
  const manipulator_dynamics_model fixed(c);
  const runtime_chain r = models::registered(record_of(c));
  const manipulator_dynamics_model at_run_time(r);
  for (const double m : {-1.0, 2.0})
    for (const double n : {1.0, 2.0}) {
      const auto x = fixed.make_x(std::array{0.3, 0.2}, std::array{0.5, -0.7}, std::array{m, n});
      const auto j = fixed.jacobian_with_inputs(0.0, x);
      const auto k = at_run_time.jacobian_with_inputs(0.0, x);
      CHECK((j.leftCols(4) - k.leftCols(4)).norm() <= 1e-11 * j.norm());
      for (int i = 0; i < 4; ++i) {  // by five points
        const double h = 1e-3;
        const auto at = [&](double shift) {
          auto y = x;
          y[i] += shift;
          return fixed(0.0, y);
        };
        const auto slope = ((8 * (at(h) - at(-h)) - (at(2 * h) - at(-2 * h))) / (12 * h)).eval();
        CHECK((slope - j.col(i)).norm() <= 1e-8 * (1 + slope.norm()));
      }
    }
}

TEST_CASE("a sticking joint that is locked is a link, and has a place") {
  const auto c = slide_on_arm();
  const runtime_chain r = models::registered(record_of(c));
  const auto less = reduced(c, std::array{0.3, 0.2}, q);
  const auto loose = reduced(r, std::array{0.3, 0.2}, {"q"});
  const manipulator_dynamics_model fixed(less);
  const manipulator_dynamics_model whole(c);
  const manipulator_dynamics_model of_loose(loose);
  const auto x = fixed.make_x(std::array{0.2}, std::array{-0.7}, std::array{-1.0});
  const auto held = whole.make_x(std::array{0.3, 0.2}, std::array{0.0, -0.7}, std::array{2.0, -1.0});
  const double expected = whole(0.0, held)[3];
  CHECK(fixed(0.0, x)[1] == within(expected, 1e-13));
  CHECK(of_loose(0.0, x)[1] == within(expected, 1e-13));
}

TEST_CASE("a bearing larger than its arm jams where it slides, and holds for ever") {
  for (const double R : {L * (1 - 1e-12), L, L * (1 + 1e-12), 0.6}) {
    const auto c = pendulum(1.0, {.friction = R, .static_friction = 0.7});
    const manipulator_dynamics_model fixed(c);
    const runtime_chain r = models::registered(record_of(c));
    const manipulator_dynamics_model at_run_time(r);
    CHECK_THROWS_MATCHES(acceleration(fixed, 0.4, 3.0, mode::forward), no_solution, says("jams at 'q': "));
    CHECK_THROWS_MATCHES(acceleration(at_run_time, 0.4, -3.0, mode::backward), no_solution, says("jams at 'q': "));
    const auto start = settled(at_run_time, 0.0, at_run_time.make_x(std::array{0.0}, std::array{0.0}));
    CHECK(start[2] == mode::held);  // 0.7 m g holds 0.5 m g
    auto thrown = at_run_time.make_x(std::array{0.4}, std::array{3.0});
    dormand_prince45 solver(std::cref(at_run_time), 0.0, settled(at_run_time, 0.0, thrown));
    CHECK_THROWS_MATCHES(solver.integrate(1.0, element_events(at_run_time)), error, says("jams at 'q': "));
  }
}

TEST_CASE("parameters of sticking joints") {
  const auto bearing = [](double radius, const dry_friction_parameters& p) {
    return complaint([&] { (void)sticking_revolute_joint_2D("q", "m", "a", "b", radius, p); });
  };
  const std::string who = "kte: sticking_revolute_joint_2D (coordinate 'q', mode 'm', base 'a', end 'b'): ";
  CHECK(bearing(0.125, {0.25}) == "");
  CHECK(dry_friction_parameters{0.2}.static_friction == 0.2);
  CHECK(bearing(-0.125, {0.25}) == who + "radius must be finite and not negative, got -0.125");
  CHECK(bearing(0.125, {-0.25}) == who + "friction must be finite and not negative, got -0.25");
  CHECK(bearing(0.125, {0.25, 0.125}) == who + "static_friction must be finite and not below friction, got 0.125");
  CHECK(bearing(0.125, {0.25, std::nan("")}) == who + "static_friction must be finite and not below friction, got nan");
  CHECK(bearing(0.125, {0.25, 0.5, 1.0}) == who + "span must be 0: in the plane a moment turns the joint, got 1");
  CHECK(complaint([] {
          (void)sticking_prismatic_joint_3D("q", "m", "a", "b", axis::x, {0.2, 0.3, -1.0});
        }) ==
        "kte: sticking_prismatic_joint_3D (coordinate 'q', mode 'm', base 'a', end 'b'): span must be finite and not "
        "negative, got -1");
  CHECK(complaint([] {
          (void)sticking_prismatic_joint_3D("q", "m", "a", "b", vec3{1.0, 1.0, 0.0}, {0.2});
        }).find("axis must have length 1") != std::string::npos);
  runtime_chain follows;
  follows << inertia_gen("x", 1.0) << mimic_gen("x", "y", 2.0)
          << sticking_revolute_joint_2D("y", "m", "a", "b", 0.1, {0.2}) << inertia_2D("b", point_mass(1.0));
  CHECK_THROWS_MATCHES(manipulator_dynamics_model(follows), bad_wiring,
                       says("sticking_revolute_joint_2D (coordinate 'y', mode 'm', base 'a', end 'b') holds a "
                            "coordinate that is not a degree of freedom"));
}

}  // namespace sticking_joint_test
