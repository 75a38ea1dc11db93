#include <kte/integrators/adams.hpp>
#include <kte/integrators/bdf.hpp>
#include <kte/integrators/dormand_prince45.hpp>
#include <kte/integrators/prince_dormand87.hpp>
#include <kte/integrators/rodas.hpp>
#include <kte/integrators/rosenbrock23.hpp>

#include "catch.hpp"
#include "events/sliding_block.hpp"

// What rounding costs, of states and of late times: long tests, as tolerances are tight.

namespace rounding_cost_test {

using namespace kte;
using namespace kte::test;

/// What tolerances of 1e-14 and 1e-15 may cost, times what 1e-12 does.
struct growth {
  double at_14, at_15;
};
/// Tolerances near or below what rounding allows cost no more than what the order asks, and are no worse. Late times
/// are rounded to t0 eps, and with them the force that shakes, by 250 N/s at most.
template <template <class, class> class Method>
void check_rounding(std::initializer_list<double> starts, growth most) {
  for (double t0 : starts) {
    CAPTURE(t0);
    const auto cost_and_error = [&](double tol) {
      block b{.now = block::shaken};
      Method<slides, state> solver(slides{&b}, t0, released, {.absolute = tol, .relative = tol});
      solver.integrate(t0 + 2);
      const double error = (solver.state() - shaking(t0, t0 + 2)).norm();
      return std::pair(static_cast<double>(solver.statistics().evaluations), error);
    };
    const auto [cost, error] = cost_and_error(1e-12);
    for (double tol : {1e-14, 1e-15}) {
      const auto [more, less] = cost_and_error(tol);
      CHECK(more < (tol == 1e-14 ? most.at_14 : most.at_15) * cost);
      CHECK(less < error + 250 * t0 * std::numeric_limits<double>::epsilon());
    }
  }
}
/// The force that shakes is as smooth at late times: tolerances far above rounding cost what they cost at time 0.
template <template <class, class> class Method>
void check_late() {
  const auto cost_and_error = [](double t0) {
    block b{.now = block::shaken};
    Method<slides, state> solver(slides{&b}, t0, released, {.absolute = 1e-9, .relative = 1e-9});
    solver.integrate(t0 + 2);
    const double error = (solver.state() - shaking(t0, t0 + 2)).norm();
    return std::pair(static_cast<double>(solver.statistics().evaluations), error);
  };
  const auto [cost, error] = cost_and_error(0);
  for (double t0 : {1000.0, 4000.0}) {
    CAPTURE(t0);
    const auto [late_cost, late_error] = cost_and_error(t0);
    CHECK(late_cost < 1.15 * cost);  // where rounding of t matters, one more evaluation a step
    CHECK(late_error < 2 * error);
  }
}

TEST_CASE("tolerances near rounding cost no more than their order asks", "[long]") {
  constexpr growth order_5{2.6, 4.1};  // 10^(2/5), 10^(3/5)
  SECTION("dormand_prince45") { check_rounding<dormand_prince45>({0, 1000, 4000}, order_5); }
  SECTION("prince_dormand87") { check_rounding<prince_dormand87>({0, 1000, 4000}, {1.9, 2.5}); }  // order 8
  SECTION("adams") { check_rounding<adams>({0, 1000, 4000}, {2.2, 2.8}); }  // rounding makes order 12 no use
  SECTION("bdf") { check_rounding<bdf>({0, 1000, 4000}, {2.3, 3.3}); }      // 10^(2/6), 10^(3/6)
  SECTION("rodas") { check_rounding<rodas>({0, 1000}, {3.5, 6.5}); }        // 10^(2/4), 10^(3/4)
}

TEST_CASE("late times cost methods that need df/dt no more than early ones", "[long]") {
  SECTION("rodas") { check_late<rodas>(); }
  SECTION("rosenbrock23") { check_late<rosenbrock23>(); }
}

TEST_CASE("differences by time never ask for what was before a start", "[long]") {
  double first = 1000;
  const auto shake = [&first](double t, const state& x) -> state {
    first = std::min(first, t);
    return {x[1], -100 * x[0] + 5 * std::sin(50 * t)};
  };
  rodas<decltype(shake), state> solver(shake, 1000.0, released, {.absolute = 1e-13, .relative = 1e-13});
  solver.integrate(1000.02);
  CHECK(first == 1000.0);
  first = 2000;
  solver.restart(1000.02, released);
  solver.integrate(1000.04);
  CHECK(first == 1000.02);
}

}  // namespace rounding_cost_test
