#include <kte/integrators/adams.hpp>
#include <kte/integrators/bdf.hpp>
#include <kte/integrators/dormand_prince45.hpp>
#include <kte/integrators/kennedy_carpenter34.hpp>
#include <kte/integrators/prince_dormand87.hpp>
#include <kte/integrators/rodas.hpp>
#include <kte/integrators/rosenbrock23.hpp>
#include <kte/integrators/solution.hpp>
#include <kte/integrators/tr_bdf2.hpp>
#include <kte/integrators/trapezoidal.hpp>

#include "catch.hpp"
#include "events/sliding_block.hpp"

// Properties of every solver that chooses its steps: after a failure it works again, and events start and end well.
// One right-hand side and one list of events for all, so that each solver is compiled once.

namespace every_solver_test {

using namespace kte;
using namespace kte::test;

auto turns_of(block& b) {
  return events(event([&b](double t, const state& x) {
                  return b.now == block::bad_event && t > 0.2 ? no_number : x[1];
                }).reset([&b](double t, state& x) {
    if (b.now == block::bad_reset) throw std::domain_error("no reset");
    x[1] = 0;
    b.direction = t < 1.5 * half_swing ? 1 : -1;
  }));
}
template <class Solver>
auto turns(Solver& solver, block& b) {
  b.direction = -1;
  return integrate(solver, 0.7, turns_of(b));
}
/// An error within a step of size tol of the weights 1 + 1.03 and 1 + 10 makes the turn less than tol / 5 late.
template <class Solver>
void check_turns(Solver& solver, block& b, double tol) {
  const auto report = turns(solver, b);
  const double margin = static_cast<double>(solver.statistics().steps) * tol;
  REQUIRE(report.events.size() == 2);
  for (std::size_t i = 0; i < report.events.size(); ++i)
    CHECK(report.events[i].time == within(static_cast<double>(i + 1) * half_swing, margin));
}

/// Zero at the start is no event, also not by the rounding of the dense output, nor after a reset to zero.
template <template <class, class> class Method>
void check_starts(double finest, bool by_sign = false) {
  for (int i = 0; i < 200; ++i) {
    const double tol = std::pow(10.0, -2 + (std::log10(finest) + 2) * i / 199);
    CAPTURE(tol);
    block b{.by_sign = by_sign};
    Method<slides, state> solver(slides{&b}, 0.0, released, {.absolute = tol, .relative = tol});
    check_turns(solver, b, tol);
  }
}

/// After a failure, repaired, a solver goes on as any other, from where it is and from elsewhere.
template <template <class, class> class Method>
void check_repair() {
  const double tol = 1e-6;
  block b;
  Method<slides, state> solver(slides{&b}, 0.0, released, {.absolute = tol, .relative = tol});
  auto whole = solver;
  whole.integrate(1);
  const auto steps = whole.statistics().steps;
  const auto error = [&] { return (solver.state() - sliding(solver.time())).norm(); };
  const auto fails = [&](block::trouble now, const std::string& why) {
    b.now = now;
    CHECK_THROWS_WITH(solver.integrate(1), contains_text("kte: integration stopped at t = 0.49999") &&
                                               contains_text("not a finite number") && contains_text(why));
    try {
      solver.integrate(1);
      CHECK(false);
    } catch (const integration_failure& e) {
      CHECK(e.reason == failure_reason::not_finite);
      CHECK(e.time == solver.time());
      CHECK((now == block::not_a_number) == e.cause.empty());
      CHECK_THAT(why, contains_text(e.cause));
    }
    b.now = block::none;
  };
  const auto works = [&](double t_end) {
    const auto before = solver.statistics().steps;
    solver.integrate(t_end);
    CHECK(solver.statistics().steps < before + 2 * steps);
    CHECK(error() < 100 * static_cast<double>(steps) * tol);  // positions to speeds: 10, weights up to 11
  };
  fails(block::not_a_number, "however short the step");
  CHECK(error() < 100 * static_cast<double>(steps) * tol);
  works(1);
  solver.restart(0, released);
  fails(block::refusal, "however short the step: quaternion 'body' has length 0");
  solver.restart(0, released);
  works(1);
  solver.restart(0, released);
  fails(block::singular, "however short the step: coordinate 'q2' moves no mass");
  solver.begin(1);
  solver.step(1);  // by single steps, also without `begin`
  while (solver.time() != 1) solver.step(1);
  CHECK(error() < 100 * static_cast<double>(steps) * tol);
  solver.restart(0, released);
  solver.integrate(1e-12);
  solver.restart(1e6, released);  // steps of 1e-12 are lost here
  solver.integrate(1e6 + 0.1);
  CHECK((solver.state() - sliding(0.1)).norm() < 100 * static_cast<double>(steps) * tol);
}

/// Where a function of an event throws, the solver stands before the event, and finds it again.
template <template <class, class> class Method>
void check_events_that_throw() {
  const double tol = 1e-6;
  block b;
  Method<slides, state> solver(slides{&b}, 0.0, released, {.absolute = tol, .relative = tol});
  b.now = block::bad_reset;
  CHECK_THROWS_AS(turns(solver, b), std::domain_error);
  CHECK(solver.time() < half_swing);
  CHECK((solver.state() - sliding(solver.time())).norm() < 100 * static_cast<double>(solver.statistics().steps) * tol);
  b.now = block::none;
  auto other = solver;
  check_turns(solver, b, tol);
  other.restart(0, released);
  b.now = block::bad_event;
  CHECK_THROWS_WITH(turns(other, b), contains_text("stopped before t = 0.") &&
                                         contains_text("the function of event 0 is not a finite number there"));
  CHECK(other.time() < 0.2);
  b.now = block::none;
  check_turns(other, b, tol);
}

/// A solution is the dense output of all steps, also with events, and of further calls.
template <template <class, class> class Method>
void check_solution() {
  block b;
  Method<slides, state> solver(slides{&b}, 0.0, released, {.absolute = 1e-7, .relative = 1e-7});
  auto sampled = solver;
  solution x(solver);
  double gap = 0;
  solver.integrate(0.1, x);
  solver.integrate(0.7, turns_of(b), x);
  CHECK(x(0) == released);
  CHECK(x(0.7) == solver.state());
  b.direction = -1;
  const auto compare = [&](double t, const state& at_t) { gap = kte::test::worse(gap, (x(t) - at_t).norm()); };
  sampled.integrate(0.1, every(0.003), compare);
  sampled.integrate(0.7, turns_of(b), every(0.003), compare);
  CHECK(gap < 1e-12);  // rounding of numbers up to 10
  CHECK_THROWS_WITH(x(0.8), contains_text("this solution goes from t = 0 to 0.69999999999999996, not to 0.8"));
  solver.restart(1, released);
  CHECK_THROWS_WITH(solver.integrate(2, x), contains_text("continues at t = 0.69999"));
}

/// Steps start with the given length, respect the largest length, and fail where they would have to be too short.
template <template <class, class> class Method>
void check_limits() {
  block b;
  const tolerances<double> limited{
      .absolute = 1e-4, .relative = 1e-4, .initial_step = 1e-4, .smallest_step = 1e-5, .largest_step = 0.01};
  Method<slides, state> solver(slides{&b}, 0.0, released, limited);
  double last = 0, first = 0, longest = 0;
  solver.integrate(0.3, [&](double t, const state&) {
    if (first == 0) first = t;
    longest = std::max(longest, t - last);
    last = t;
  });
  CHECK(first == 1e-4);
  CHECK(longest == within(0.01, 1e-15));
  CHECK(solver.statistics().steps < 60);
  Method<slides, state> coarse(slides{&b}, 0.0, released, {.absolute = 1e-9, .relative = 1e-9, .smallest_step = 0.2});
  try {
    coarse.integrate(0.7);
    CHECK(false);
  } catch (const integration_failure& e) {
    CHECK(e.reason == failure_reason::step_too_short);
    CHECK_THAT(e.what(), contains_text(", below the smallest step 0.2"));
  }
}

TEST_CASE("zero at the start is no event, for every solver and tolerance") {
  SECTION("dormand_prince45") { check_starts<dormand_prince45>(1e-9, true); }
  SECTION("prince_dormand87") { check_starts<prince_dormand87>(1e-9, true); }
  SECTION("adams") { check_starts<adams>(1e-12, true); }
  SECTION("bdf") { check_starts<bdf>(1e-8); }
  SECTION("rosenbrock23") { check_starts<rosenbrock23>(1e-5); }
  SECTION("rodas") { check_starts<rodas>(1e-7); }
  SECTION("tr_bdf2") { check_starts<tr_bdf2>(1e-5); }
  SECTION("trapezoidal") { check_starts<trapezoidal>(1e-5); }
  SECTION("kennedy_carpenter34") { check_starts<kennedy_carpenter34>(1e-7); }
}

TEST_CASE("after a failure every solver chooses its steps again, and says why it failed") {
  SECTION("dormand_prince45") { check_repair<dormand_prince45>(); }
  SECTION("prince_dormand87") { check_repair<prince_dormand87>(); }
  SECTION("adams") { check_repair<adams>(); }
  SECTION("bdf") { check_repair<bdf>(); }
  SECTION("rosenbrock23") { check_repair<rosenbrock23>(); }
  SECTION("rodas") { check_repair<rodas>(); }
  SECTION("tr_bdf2") { check_repair<tr_bdf2>(); }
  SECTION("trapezoidal") { check_repair<trapezoidal>(); }
  SECTION("kennedy_carpenter34") { check_repair<kennedy_carpenter34>(); }
}

TEST_CASE("where an event throws, every solver stands before it and finds it again") {
  SECTION("dormand_prince45") { check_events_that_throw<dormand_prince45>(); }
  SECTION("prince_dormand87") { check_events_that_throw<prince_dormand87>(); }
  SECTION("adams") { check_events_that_throw<adams>(); }
  SECTION("bdf") { check_events_that_throw<bdf>(); }
  SECTION("rosenbrock23") { check_events_that_throw<rosenbrock23>(); }
  SECTION("rodas") { check_events_that_throw<rodas>(); }
  SECTION("tr_bdf2") { check_events_that_throw<tr_bdf2>(); }
  SECTION("trapezoidal") { check_events_that_throw<trapezoidal>(); }
  SECTION("kennedy_carpenter34") { check_events_that_throw<kennedy_carpenter34>(); }
}

TEST_CASE("every solver keeps its steps within the limits given") {
  SECTION("dormand_prince45") { check_limits<dormand_prince45>(); }
  SECTION("prince_dormand87") { check_limits<prince_dormand87>(); }
  SECTION("adams") { check_limits<adams>(); }
  SECTION("bdf") { check_limits<bdf>(); }
  SECTION("rosenbrock23") { check_limits<rosenbrock23>(); }
  SECTION("rodas") { check_limits<rodas>(); }
  SECTION("tr_bdf2") { check_limits<tr_bdf2>(); }
  SECTION("trapezoidal") { check_limits<trapezoidal>(); }
  SECTION("kennedy_carpenter34") { check_limits<kennedy_carpenter34>(); }
}

TEST_CASE("a solution is the dense output of every solver, from its start to its end") {
  SECTION("dormand_prince45") { check_solution<dormand_prince45>(); }
  SECTION("prince_dormand87") { check_solution<prince_dormand87>(); }
  SECTION("adams") { check_solution<adams>(); }
  SECTION("bdf") { check_solution<bdf>(); }
  SECTION("rosenbrock23") { check_solution<rosenbrock23>(); }
  SECTION("rodas") { check_solution<rodas>(); }
  SECTION("tr_bdf2") { check_solution<tr_bdf2>(); }
  SECTION("trapezoidal") { check_solution<trapezoidal>(); }
  SECTION("kennedy_carpenter34") { check_solution<kennedy_carpenter34>(); }
}

}  // namespace every_solver_test
