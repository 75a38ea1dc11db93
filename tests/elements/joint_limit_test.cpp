#include <kte/integrators/dormand_prince45.hpp>
#include <kte/io/model_reader.hpp>
#include <kte/models/element_events.hpp>
#include <kte/static.hpp>

#include <cmath>
#include <numbers>

#include "catch.hpp"
#include "chain/registered.hpp"
#include "elements/laws.hpp"

namespace joint_limit_test {

using namespace kte;
using namespace kte::test;

// clang-format off
inline constexpr struct q_    final : coord_key<"q">       {} q;
inline constexpr struct base_ final : frame_2D_key<"base"> {} base;
inline constexpr struct ball_ final : frame_2D_key<"ball"> {} ball;
// clang-format on

constexpr joint_stops both{.lower = -1, .upper = 0.5, .stiffness = 8, .damping = 2};

double force(const joint_stops& p, double x, double x_dot) {
  auto e = trial_of(joint_limit_gen("q", p), 1);
  e.at<0>() = {.q = x, .q_dot = x_dot};
  e.doForce();
  return e.at<0>().f;
}
template <class S>
void check_laws() {
  random_numbers draw(1);
  joint_stops p{.lower = 10, .upper = 20, .stiffness = 7};  // always beyond, as the law has a kink elsewhere
  const auto energy_of_one = [&p](const auto& c) { return joint_limit_gen("q", p).core.potential_energy(c); };
  CHECK(testing::force_is_gradient<S>(joint_limit_gen("q", p), draw, energy_of_one) <= 100 * by_differences<S>);
  p = {.lower = -0.5, .upper = 0.5, .stiffness = 0, .damping = 3};
  CHECK(testing::no_work_done<S>(joint_limit_gen("q", p), draw) == 0);
}

TEST_CASE("stops push back where they touch, and never pull") {
  check_laws<double>(), check_laws<digits50>();
  CHECK(force(both, 0.25, 5) == 0);  // within
  CHECK(force(both, -0.75, -5) == 0);
  CHECK(force(both, 1, 0) == -4);
  CHECK(force(both, -1.5, 0) == 4);
  CHECK(force(both, 1, 0.5) == -5);
  CHECK(force(both, -1.5, -0.5) == 5);
  CHECK(force(both, 1, -4) == 0);  // damping would pull
  CHECK(force(both, -1.5, 4) == 0);
  CHECK(std::isnan(force(both, not_a_number, 0)));
  CHECK(std::isnan(force(both, 1, not_a_number)));
  const joint_stops floor{.lower = 0, .stiffness = 8};
  CHECK(force(floor, -1, 0) == 8);
  CHECK(force(floor, 1e300, 0) == 0);
  const joint_stops ceiling{.upper = 0, .stiffness = 8};
  CHECK(force(ceiling, 1, 0) == -8);
  CHECK(force(ceiling, -1e300, 0) == 0);
}

TEST_CASE("the energy of stops, and where they touch") {
  const auto energy = [](double x) { return joint_limit_gen("q", both).core.potential_energy(gen_coord<>{.q = x}); };
  CHECK(energy(1.0) == 1.0);
  CHECK(energy(-2.0) == 4.0);
  CHECK(energy(0.25) == 0.0);
  const auto switching = [](const joint_stops& p, double x) {
    return joint_limit_gen("q", p).core.switching(gen_coord<>{.q = x});
  };
  CHECK(switching(both, -1.0) == 0.0);
  CHECK(switching(both, 0.5) == 0.0);
  CHECK(switching(both, 0.0) == 0.5);
  CHECK(switching(both, 0.75) == -0.25);
  CHECK(switching(both, -2.0) == -1.0);
  CHECK(switching({.lower = 1, .upper = 1, .stiffness = 8}, 3.0) == 2.0);
  CHECK(switching({.lower = 1, .upper = 1, .stiffness = 8}, 0.0) == -1.0);
  CHECK(switching({.lower = 0, .stiffness = 8}, 3.0) == 3.0);
  CHECK(switching({.upper = 0, .stiffness = 8}, 3.0) == -3.0);
}

TEST_CASE("a ball jumps on a stiff floor, and its touches are events") {
  // Thrown up at v = g/2 it falls back in 1 s. On the floor it swings about where it would lie, g/w^2 lower, by the arc
  // from one crossing of the floor to the next.
  constexpr double g = 9.81, v = g / 2, w = 100;
  const auto c = chain(prismatic_joint_2D(q, base, ball, axis::y), inertia_2D(ball, point_mass(1.0)),
                       joint_limit_gen(q, {.lower = 0, .stiffness = w * w}))
                     .gravity(along_y(-g));
  const manipulator_dynamics_model model(c);
  dormand_prince45 solver(std::cref(model), 0.0, model.make_x(std::array{0.0}, std::array{v}),
                          {.absolute = 1e-12, .relative = 1e-12});
  const auto report = integrate(solver, 3.2, element_events(model));
  const double touch = 2 * (std::numbers::pi - std::atan2(v / w, g / (w * w))) / w;
  REQUIRE(report.events.size() >= 5);
  double t = 1;
  for (std::size_t i = 0; i < 5; ++i) {
    CHECK(report.events[i].time == within(t, 1e-9));
    t += i % 2 == 0 ? touch : 1;
  }
}

TEST_CASE("limits are saved and loaded, and reject invalid input") {
  runtime_chain c;
  c << inertia_gen("q", 1.0) << joint_limit_gen("q", both) << joint_limit_gen("q", {.lower = 0, .stiffness = 1});
  CHECK(record_of(models::registered(record_of(c))) == record_of(c));
  const auto read = from_json(R"({"kte_model": {"version": 1, "gravity": [0, 0, 0], "elements": [
    {"type": "inertia_gen", "version": 1, "ports": {"coordinate": "q"}, "parameters": {"mass": 1}},
    {"type": "joint_limit_gen", "version": 1, "ports": {"coordinate": "q"},
     "parameters": {"lower": "-inf", "upper": 0.5, "stiffness": 8, "damping": 2}}]}})");
  CHECK(record_of(models::registered(read)).elements[1].parameters[0].values == std::vector{-infinity});
  const auto what = [](const joint_stops& p) { return complaint([&] { (void)joint_limit_gen("q", p); }); };
  const std::string where = "kte: joint_limit_gen (coordinate 'q'): ";
  CHECK(what({.lower = 1, .upper = 0, .stiffness = 1}) == where + "lower must not be above upper, got 1");
  CHECK(what({.lower = 1, .upper = 1, .stiffness = 1}) == "");
  CHECK(what({.lower = not_a_number, .stiffness = 1}).starts_with(where + "lower must not be above upper"));
  CHECK(what({.stiffness = 1}) == where + "one of lower and upper must be finite, got -inf");
  CHECK(what({.lower = 0, .stiffness = -1}) == where + "stiffness must be finite and not negative, got -1");
  CHECK(what({.lower = 0, .stiffness = 1, .damping = -1}) == where + "damping must be finite and not negative, got -1");
}

}  // namespace joint_limit_test
