#include "contact/walkers.hpp"

#include <kte/integrators/prince_dormand87.hpp>
#include <kte/io/model_file.hpp>

#include "catch.hpp"

using namespace kte;
using namespace kte::test;
using namespace kte::test::walkers;

namespace {

const kte::tolerances<double> tight{.absolute = 1e-12, .relative = 1e-12};

/// The legs in the order stance, swing.
struct step_of_walker {
  double half, stance, swing;
  template <class X>
  explicit step_of_walker(const X& x) {
    const bool first_stands = x[8] == 1;
    REQUIRE(first_stands != (x[12] == 1));
    half = x[first_stands ? 2 : 3], stance = x[first_stands ? 6 : 7], swing = x[first_stands ? 7 : 6];
    CHECK(x[2] + x[3] == within(0.0, 1e-14));
  }
};
template <class Model>
auto walk(const Model& model, const start_of_step& start, double time, const kte::tolerances<double>& accuracy) {
  prince_dormand87 solver(std::cref(model), 0.0, settled(model, 0.0, model.make_x(start.q, start.v)), accuracy);
  auto report = solver.integrate(time, element_events(model));
  REQUIRE(report.reason == stop_reason::end_time);
  return report;
}
template <class Model>
void check_compass(const Model& model) {
  const auto report = walk(model, compass_cycle, 15.0, tight);
  const auto strikes = strikes_of(report);
  REQUIRE(strikes.size() >= 20);
  for (const std::size_t i : {0, 1, 9, 18, 19}) {
    const step_of_walker at(strikes[i].after);
    CHECK(at.half == within(0.27102868049882, 1e-13));
    CHECK(at.stance == within(-1.09238358988360, 2e-13));
    CHECK(at.swing == within(-0.37737394890719, 2e-13));
    CHECK(strikes[i].time == within(static_cast<double>(i + 1) * 0.73434639115872, 1e-12));
  }
  CHECK(report.events[0].what == "'second foot': passes");
  CHECK(report.events[1].what == "'first foot': lifts; 'second foot': impact, sticks");
}

}  // namespace

TEST_CASE("a compass walker keeps its cycle for 20 strides") {
  const auto c = chain_of(compass);
  check_compass(manipulator_dynamics_model(c));
  runtime_chain r;
  r << c;
  check_compass(manipulator_dynamics_model(r));
}

TEST_CASE("a compass walker beside its cycle goes back to it") {
  const auto c = chain_of(compass);
  const manipulator_dynamics_model model(c);
  auto start = compass_cycle;
  start.v[3] += 0.02;
  const auto strikes = strikes_of(walk(model, start, 40.0, tight));
  const step_of_walker last(strikes.back().after);
  CHECK(last.half == within(0.27102868049882, 1e-12));
  CHECK(last.stance == within(-1.09238358988360, 1e-12));
}

TEST_CASE("Garcia's walker has its published cycle") {
  const auto c = chain_of(garcia);
  const manipulator_dynamics_model model(c);
  // The cycle for feet without mass: its angle, and the rates theta, (1 - cos 2 theta) theta after a strike
  const double half = 0.200310900544, rate = -0.199832473005;
  const start_of_step start(half, rate, rate * std::cos(2 * half));
  const auto strikes = strikes_of(walk(model, start, 160.0, tight));
  REQUIRE(strikes.size() > 35);
  const step_of_walker last(strikes.back().after);
  CHECK(last.half == within(0.200310900394, 1e-12));
  CHECK(strikes.back().time - strikes[strikes.size() - 2].time == within(3.8824484596, 1e-10));
}
