#include <kte/integrators/dormand_prince45.hpp>
#include <kte/models/element_events.hpp>
#include <kte/static.hpp>

#include <cmath>
#include <numbers>

#include "catch.hpp"
#include "chain/registered.hpp"
#include "elements/laws.hpp"

using namespace kte;
using namespace kte::test;

namespace {
// clang-format off
inline constexpr struct q_     final : coord_key<"q">       {} q;
inline constexpr struct wall_  final : coord_key<"wall">    {} wall;
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
}  // namespace

TEST_CASE("teeth with play push where they touch, and never pull", "[elements][joint_backlash]") {
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

TEST_CASE("the energy of teeth with play, and where they touch", "[elements][joint_backlash]") {
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

TEST_CASE("a mass flies to and fro in the play of a joint, and its touches are events", "[elements][joint_backlash]") {
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

TEST_CASE("play is saved and loaded, and rejects what makes no sense", "[elements][joint_backlash]") {
  kte_map_chain c;
  c << base_gen("wall") << prismatic_joint_2D("q", "base", "cart", axis::x)
    << joint_backlash_gen("wall", "q", 0.01, 1e4, 3.0);
  CHECK(record_of(models::registered(record_of(c))) == record_of(c));
  const auto what = [](double g, double k, double d) {
    return complaint([&] { joint_backlash_gen("a", "b", g, k, d); });
  };
  const std::string where = "kte: joint_backlash_gen (anchor1 'a', anchor2 'b'): ";
  CHECK(what(-1, 1, 1) == where + "gap must be finite and not negative, got -1");
  CHECK(what(1, -2, 1) == where + "stiffness must be finite and not negative, got -2");
  CHECK(what(1, 1, not_a_number).starts_with(where + "damping must be finite and not negative"));
}
