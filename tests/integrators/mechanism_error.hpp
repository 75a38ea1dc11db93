#pragma once

#include <kte/integrators/dormand_prince45.hpp>

#include <vector>

#include "catch.hpp"
#include "data/problems/mechanism.hpp"
#include "integrators/any_system.hpp"

namespace kte::test {

/// Dormand and Prince with the tolerance 1e-12, for states of dynamic size: of one type for all problems.
template <class Problem>
auto solver_of() {
  return dormand_prince45(system_of<Problem>(), 0.0, Eigen::VectorXd(Problem::start()),
                          {.absolute = 1e-12, .relative = 1e-12});
}

/// Integrates a mechanism by Dormand and Prince in double with the tolerance 1e-12, and checks the errors at its
/// references and the change of its energy.
///
/// A step errs by less than 1e-12 (1 + |x|), and such a disturbance grows until a reference by G at most, as measured
/// by disturbing states on the way: after n steps the error is below n G 1e-12. In truth errors cancel in part, and
/// grow little where most steps are. Bounds are three to six times the measured error and below that limit; with each
/// are in brackets n, G and the error. Rounding, of g = 9.81 too, is 1e-16 a step, a part of 1e-4 of all that.
template <class Mechanism>
void check_references(double drift, const std::vector<double>& bounds) {
  using problem = problems::equation_of_motion<Mechanism>;
  auto solver = solver_of<problem>();
  const double energy = problem::energy(problem::start());
  REQUIRE(bounds.size() == std::size(Mechanism::references));
  for (std::size_t i = 0; i < bounds.size(); ++i) {
    const auto& r = Mechanism::references[i];
    solver.integrate(static_cast<double>(r.time));
    const typename problem::state x = solver.state();
    UNSCOPED_INFO(Mechanism::name << " at " << solver.time());
    CHECK(static_cast<double>(problems::largest_error(problem::output(x), r.values)) < bounds[i]);
    CHECK(problem::energy(x) == within(energy, drift));
  }
}

}  // namespace kte::test
