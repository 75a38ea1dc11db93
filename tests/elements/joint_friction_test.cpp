#include <kte/dynamics/derivatives.hpp>
#include <kte/integrators/dormand_prince45.hpp>
#include <kte/models/manipulator_dynamics_model.hpp>
#include <kte/static.hpp>

#include <cmath>

#include "catch.hpp"
#include "chain/registered.hpp"
#include "elements/laws.hpp"

namespace joint_friction_test {

using namespace kte;
using namespace kte::test;

// clang-format off
inline constexpr struct q_ final : coord_key<"q"> {} q;
// clang-format on

constexpr friction_parameters dry{
    .viscous = 0.25, .coulomb = 1, .stiction = 1.5, .stribeck_velocity = 0.01, .smoothing_velocity = 0.001};

template <class S>
S force(const friction_parameters& p, const S& v) {
  auto x = trial_of<S>(joint_friction_gen("q", p), 1);
  x.template at<0>() = {.q_dot = v};
  x.doForce();
  return x.template at<0>().f;
}
template <class S>
S by_formula(const friction_parameters& p, const S& v) {
  using std::exp, std::tanh;
  const S r = v / S(p.stribeck_velocity), g = p.coulomb + (S(p.stiction) - p.coulomb) * exp(S(-r * r));
  return -(g * tanh(S(v / S(p.smoothing_velocity))) + p.viscous * v);
}

TEST_CASE("smooth friction is as its formula says") {
  random_numbers draw(1);
  CHECK(testing::no_work_done<double>(joint_friction_gen("q", dry), draw) == 0);
  for (int i = 0; i < 20; ++i) {
    const double v = draw(i < 10 ? 0.003 : 3);
    CHECK(force(dry, v) == within_relative(double(by_formula<digits50>(dry, v)), 16 * eps<double>));
    CHECK(abs(force<digits50>(dry, v) - by_formula<digits50>(dry, v)) <= 4 * eps<digits50>);
    CHECK(force(dry, -v) == -force(dry, v));
  }
  CHECK(force(dry, 0.0) == 0);
  CHECK(force(dry, 0.1) == within(-1.025, 1e-14));  // Coulomb and viscous
  CHECK(force({.coulomb = 2, .smoothing_velocity = 0.001}, 1e-4) == within(-2 * std::tanh(0.1), 1e-15));  // no stiction
  CHECK(force(dry, 1e300) == -2.5e299);
  CHECK(force({.viscous = 3}, 2.0) == -6);  // without a smoothing velocity
  CHECK(std::isnan(force({.viscous = 3}, not_a_number)));
  CHECK(std::isnan(force(dry, not_a_number)));
}

TEST_CASE("smooth friction has its derivative at rest too") {
  const auto c = chain(inertia_gen(q, 2.0), joint_friction_gen(q, dry));
  const auto slope = [&](double v) {
    return inverse_dynamics_derivatives(c, std::array{0.0}, std::array{v}, std::array{0.0}).by_v(0, 0);
  };
  CHECK(slope(0.0) == within(1.5 / 0.001 + 0.25, 1e-12));
  CHECK(slope(0.1) == within(0.25, 1e-14));
  const double h = 1e-6;
  CHECK(slope(0.002) == within_relative((force(dry, 0.002 - h) - force(dry, 0.002 + h)) / (2 * h), 1e-5));
}

TEST_CASE("damping and a spring of one coordinate need no base") {
  random_numbers draw(2);
  CHECK(testing::no_work_done<double>(joint_damping_gen("q", 0.5), draw) == 0);
  auto x = trial_of(joint_stiffness_gen("q", 8.0, 0.25), 1);
  x.at<0>() = {.q = 1.25};
  x.doForce();
  CHECK(x.at<0>().f == -8);
  constexpr auto c = chain(inertia_gen(q, 2.0), joint_damping_gen(q, 0.5), joint_stiffness_gen(q, 8.0, 0.25),
                           joint_friction_gen(q, {.viscous = 0.25}));
  constexpr std::array at{1.25}, rate{4.0}, acceleration{0.0};
  CHECK(inverse_dynamics(c, at, rate, acceleration)[0] == 11);
  const auto d = inverse_dynamics_derivatives(c, at, rate, acceleration);
  CHECK((d.by_q(0, 0) == 8 && d.by_v(0, 0) == 0.75));
  CHECK(potential_energy(c, at) == 4);
}

TEST_CASE("dry friction stops a sliding mass where it should") {
  // v = v_0 - F t/m until it stands, after m v_0^2/(2 F); the smooth law slides on by up to v0 m/F ln(v_0/v0).
  constexpr double m = 2, F = 1, v_0 = 0.5, soft = 1e-4;
  const auto c = chain(inertia_gen(q, m), joint_friction_gen(q, {.coulomb = F, .smoothing_velocity = soft}));
  const manipulator_dynamics_model model(c);
  dormand_prince45 solver(std::cref(model), 0.0, model.make_x(std::array{0.0}, std::array{v_0}),
                          {.absolute = 1e-10, .relative = 1e-10});
  solver.integrate(0.5);
  CHECK(solver.state()[1] == within(v_0 - F * 0.5 / m, 1e-9));
  solver.integrate(1.5);
  CHECK(solver.state()[0] == within(m * v_0 * v_0 / (2 * F), 2 * soft * m / F));
  CHECK(std::abs(solver.state()[1]) < 1e-8);
}

TEST_CASE("smooth friction is saved and loaded, and rejects invalid input") {
  runtime_chain c;
  c << inertia_gen("q", 1.0) << joint_friction_gen("q", dry) << joint_damping_gen("q", 0.5)
    << joint_stiffness_gen("q", 8.0, 0.25) << joint_friction_gen("q", {.viscous = 0.1});
  CHECK(record_of(models::registered(record_of(c))) == record_of(c));
  const auto what = [](auto member, double x) {
    auto p = dry;
    p.*member = x;
    return complaint([&] { (void)joint_friction_gen("q", p); });
  };
  const std::string where = "kte: joint_friction_gen (coordinate 'q'): ";
  using p = friction_parameters;
  CHECK(what(&p::viscous, -1) == where + "viscous must be finite and not negative, got -1");
  CHECK(what(&p::coulomb, -1) == where + "coulomb must be finite and not negative, got -1");
  CHECK(what(&p::stiction, 0.5) == where + "stiction must be 0 or not below coulomb, got 0.5");
  CHECK(what(&p::stiction, 0) == "");
  CHECK(what(&p::stribeck_velocity, 0) == where + "stribeck_velocity must be finite and positive, got 0");
  CHECK(what(&p::smoothing_velocity, -1) ==
        where + "smoothing_velocity must be finite and positive with dry friction, got -1");
  CHECK(what(&p::smoothing_velocity, 0) ==
        where + "smoothing_velocity must be finite and positive with dry friction, got 0");
  CHECK(complaint([] { (void)joint_friction_gen("q", {.viscous = 1, .smoothing_velocity = -1}); }) ==
        where + "smoothing_velocity must be finite and not negative, got -1");
  CHECK(complaint([] { (void)joint_damping_gen("q", -1.0); }) ==
        "kte: joint_damping_gen (coordinate 'q'): damping must be finite and not negative, got -1");
  CHECK(complaint([] { (void)joint_stiffness_gen("q", -1.0); }) ==
        "kte: joint_stiffness_gen (coordinate 'q'): stiffness must be finite and not negative, got -1");
  CHECK(complaint([] { (void)joint_stiffness_gen("q", 1.0, infinity); }) ==
        "kte: joint_stiffness_gen (coordinate 'q'): rest must be finite, got inf");
}

}  // namespace joint_friction_test
