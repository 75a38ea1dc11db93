#include <kte/elements/joint_backlash_mode.hpp>
#include <kte/integrators/dormand_prince45.hpp>
#include <kte/integrators/prince_dormand87.hpp>
#include <kte/models/element_events.hpp>
#include <kte/models/runtime_dynamics_model.hpp>
#include <kte/static.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "catch.hpp"
#include "chain/registered.hpp"
#include "elements/laws.hpp"

namespace joint_backlash_test {

using namespace kte;
using namespace kte::test;

// clang-format off
inline constexpr struct q_     final : coord_key<"q">       {} q;
inline constexpr struct wall_  final : coord_key<"wall">    {} wall;
inline constexpr struct teeth_ final : internal_key<"teeth"> {} teeth;
inline constexpr struct base_  final : frame_2D_key<"base"> {} base;
inline constexpr struct cart_  final : frame_2D_key<"cart"> {} cart;
// clang-format on

std::pair<double, double> push(double x, double x_dot) {
  auto e = trial_of(joint_backlash_gen("a", "b", 0.5, 8.0, 2.0), 1);
  e.at<0>() = {.q = 1, .q_dot = 1};
  e.at<1>() = {.q = 1 + x, .q_dot = 1 + x_dot};
  e.doForce();
  return {e.at<0>().f, e.at<1>().f};
}
template <class S>
void check_laws() {
  random_numbers draw(1);
  const auto element = joint_backlash_gen("a", "b", S(1) / 2, S(7), S(0));
  CHECK(testing::loads_are_opposite<S>(element, draw) == 0);
  CHECK(testing::no_work_done<S>(joint_backlash_gen("a", "b", S(0), S(0), S(3)), draw) <= rounding<S>);
}

TEST_CASE("teeth with play push where they touch, and never pull") {
  check_laws<double>(), check_laws<digits50>();
  CHECK(push(0.25, 5) == std::pair{0.0, 0.0});  // within
  CHECK(push(-0.125, -5) == std::pair{0.0, 0.0});
  CHECK(push(0.5, 0) == std::pair{2.0, -2.0});
  CHECK(push(-0.5, 0) == std::pair{-2.0, 2.0});
  CHECK(push(0.5, 0.5) == std::pair{3.0, -3.0});
  CHECK(push(-0.5, -0.5) == std::pair{-3.0, 3.0});
  CHECK(push(0.5, -4) == std::pair{0.0, 0.0});  // damping would pull
  CHECK(push(-0.5, 4) == std::pair{0.0, 0.0});
  CHECK(std::isnan(push(not_a_number, 0).first));
  CHECK(std::isnan(push(0.5, not_a_number).second));
}

TEST_CASE("the energy of teeth with play, and where they touch") {
  const gen_coord<> still{};
  const auto energy = [&](double x) {
    return joint_backlash_gen("a", "b", 0.5, 8.0, 2.0).core.potential_energy(still, gen_coord<>{.q = x});
  };
  CHECK(energy(0.75) == 1.0);
  CHECK(energy(-0.75) == 1.0);
  CHECK(energy(0.25) == 0.0);
  const auto switching = [&](double gap, double x) {
    return joint_backlash_gen("a", "b", gap, 8.0, 2.0).core.switching(still, gen_coord<>{.q = x});
  };
  CHECK(switching(0.5, 0.25) == 0.0);
  CHECK(switching(0.5, -0.25) == 0.0);
  CHECK(switching(0.5, 0.125) > 0);
  CHECK(switching(0.5, -0.5) < 0);
  CHECK(switching(0.0, 0.125) == 0.125);  // without play it goes through zero, where +-x^2 would only touch it
  CHECK(switching(0.0, -0.125) == -0.125);
}

TEST_CASE("a mass flies to and fro in the play of a joint, and its touches are events") {
  constexpr double gap = 0.5, k = 400, mass = 1, v = 2;
  const auto c = chain(base_gen(wall), prismatic_joint_2D(q, base, cart, axis::x), inertia_2D(cart, point_mass(mass)),
                       joint_backlash_gen(wall, q, gap, k, 0.0));
  const manipulator_dynamics_model model(c);
  dormand_prince45 solver(std::cref(model), 0.0, model.make_x(std::array{0.0}, std::array{v}),
                          {.absolute = 1e-12, .relative = 1e-12});
  const double flight = gap / v, touch = std::numbers::pi / std::sqrt(k / mass);
  const auto report = integrate(solver, 1.5, element_events(model));
  REQUIRE(report.events.size() >= 6);
  double t = flight / 2;
  for (std::size_t i = 0; i < 6; ++i) {
    CHECK(report.events[i].time == within_relative(t, 1e-10));
    t += i % 2 == 0 ? touch : flight;
  }
}

TEST_CASE("play is saved and loaded, and rejects invalid input") {
  runtime_chain c;
  c << base_gen("wall") << prismatic_joint_2D("q", "base", "cart", axis::x)
    << joint_backlash_gen("wall", "q", 0.01, 1e4, 3.0);
  CHECK(record_of(models::registered(record_of(c))) == record_of(c));
  const auto what = [](double g, double k, double d) {
    return complaint([&] { (void)joint_backlash_gen("a", "b", g, k, d); });
  };
  const std::string where = "kte: joint_backlash_gen (anchor1 'a', anchor2 'b'): ";
  CHECK(what(-1, 1, 1) == where + "gap must be finite and not negative, got -1");
  CHECK(what(1, -2, 1) == where + "stiffness must be finite and not negative, got -2");
  CHECK(what(1, 1, not_a_number).starts_with(where + "damping must be finite and not negative"));
}

TEST_CASE("teeth with damping touch and part at events, and never pull") {
  // 1 kg at 2 m/s in play of 0.5 m; teeth of k = 400 N/m, c = 10 Ns/m: d = v/w exp(-5 t) sin(w t) until d'' = 0
  constexpr double gap = 0.5, k = 400, gamma = 5;
  const double w = std::sqrt(k - gamma * gamma), phase = std::atan2(2 * gamma * w, gamma * gamma - w * w);
  const double press = phase / w, left = std::exp(-gamma * press);
  runtime_chain c;
  c << base_gen("wall") << inertia_gen("q", 1.0) << joint_backlash_mode_gen("wall", "q", "mode", gap, k, 2 * gamma);
  const auto check = [&](const auto& model) {
    using state = std::remove_cvref_t<decltype(model.make_x(std::array{0.0}, std::array{2.0}))>;
    prince_dormand87 solver(std::cref(model), 0.0, state(model.make_x(std::array{0.0}, std::array{2.0})),
                            {.absolute = 1e-13, .relative = 1e-13});
    double worst_pull = 0;
    const auto report = solver.integrate(1.2, element_events(model), [&](double t, const state& x) {
      const double force = model(t, x)[1];
      worst_pull = std::max(worst_pull, force * x[0]);  // the force on q is towards the middle
    });
    CHECK(worst_pull <= 1e-12);
    REQUIRE(report.events.size() >= 6);
    double t = gap / 2 / 2, v = 2, side = 1;
    for (std::size_t i = 0; i + 2 < report.events.size(); i += 3) {
      const auto &touch = report.events[i], &parts = report.events[i + 1], &leaves = report.events[i + 2];
      CHECK(touch.time == within(t, 2e-12));
      CHECK(touch.after[1] == within(side * v, 1e-11));
      CHECK(touch.after[2] == within(side, 0));
      const double deep = v / w * left * std::sin(phase);
      v *= -left * (std::cos(phase) - gamma / w * std::sin(phase));  // speed outward
      CHECK(parts.time == within(t + press, 2e-12));
      CHECK(parts.after[0] == within(side * (gap / 2 + deep), 1e-12));
      CHECK(parts.after[1] == within(-side * v, 1e-11));  // all that energy lost is damping's
      CHECK(parts.after[2] == within(2 * side, 0));
      CHECK(leaves.time == within(t + press + deep / v, 2e-12));
      CHECK(leaves.after[2] == within(0, 0));
      t += press + (deep + gap) / v, side = -side;
    }
  };
  check(manipulator_dynamics_model(c));
  const auto fixed =
      chain(base_gen(wall), inertia_gen(q, 1.0), joint_backlash_mode_gen(wall, q, teeth, gap, k, 2 * gamma));
  check(manipulator_dynamics_model(fixed));
  CHECK(record_of(models::registered(record_of(c))) == record_of(c));
}

TEST_CASE("teeth that lag are pressed again; without play the others touch at once") {
  const auto core = joint_backlash_mode_gen("a", "b", "mode", 0.5, 8.0, 2.0).core;
  const auto tight = joint_backlash_mode_gen("a", "b", "mode", 0.0, 8.0, 2.0).core;
  const gen_coord<> still{};
  const auto at = [](double x, double rate) { return gen_coord<>{.q = x, .q_dot = rate}; };
  CHECK(core.switched(still, at(0.5, -1.0), 2.0) == 1.0);  // 8 0.25 - 2 = 0
  CHECK(core.switched(still, at(0.25, -1.0), 2.0) == 0.0);
  CHECK(core.switched(still, at(-0.5, 1.5), -1.0) == -2.0);
  CHECK(core.switched(still, at(-0.25, -1.0), 0.0) == -1.0);
  CHECK(core.switched(still, at(0.25, -1.0), 0.0) == 0.0);
  CHECK(tight.switched(still, at(0.0, -1.0), 2.0) == -1.0);
  CHECK(tight.switched(still, at(0.0, 1.0), 0.0) == 1.0);
  CHECK(core.switching(still, at(0.5, -1.5), 2.0) == 0.25);
  CHECK(core.switching(still, at(0.5, -0.5), 1.0) == 1.0);
}

}  // namespace joint_backlash_test
