#include <kte/adapters/sundials/arkode.hpp>
#include <kte/adapters/sundials/cvode.hpp>

#include <functional>

#include "catch.hpp"

// How CVODE and ARKODE call f and its Jacobian.

namespace explicit_form_test {

using namespace kte;

/// x' = A x with A far from symmetric: eigenvalues -1, -10, -1000.
const Eigen::Matrix3d slopes{{-1.0, 5.0, -20.0}, {0.0, -10.0, 300.0}, {0.0, 0.0, -1000.0}};
const Eigen::Vector3d start(1, 1, 1);
const tolerances<double> tight{.absolute = 1e-8, .relative = 1e-8};

template <class X>
struct linear {
  long long evaluations = 0;
  X operator()(double, const X& x) { return ++evaluations, slopes * x; }
};
/// With a Jacobian of A, or of its transpose.
template <class X>
struct linear_with_jacobian : linear<X> {
  bool transposed = false;
  long long jacobians = 0;
  bool right = true;  ///< all arguments
  template <class M>
  void jacobian(double t, const X& x, M& j) {
    ++jacobians;
    right = right && t >= 0 && t <= 1 && x.size() == 3 && j.rows() == 3 && j.cols() == 3;
    j = transposed ? Eigen::Matrix3d(slopes.transpose()) : slopes;
  }
};
/// As other libraries have it: returned. That is none for SUNDIALS.
struct linear_that_returns : linear<Eigen::Vector3d> {
  Eigen::Matrix3d jacobian(double, const Eigen::Vector3d&, Eigen::Matrix3d&) { throw bad_argument("called"); }
};

template <template <class, class> class Solver, class X, class F>
step_statistics solve(F& f) {
  Solver<std::reference_wrapper<F>, X> solver(std::ref(f), 0.0, X(start), tight);
  solver.integrate(1);
  return solver.statistics();
}
template <template <class, class> class Solver, class X>
void check() {
  linear<X> without;
  const auto differences = solve<Solver, X>(without);
  CHECK(differences.evaluations == without.evaluations);  // those for differences, too
  CHECK(differences.jacobians > 0);
  linear_with_jacobian<X> with;
  const auto given = solve<Solver, X>(with);
  CHECK(given.evaluations == with.evaluations);
  CHECK(given.jacobians == with.jacobians);
  CHECK(with.right);
  // Without one, differences cost three evaluations for each Jacobian; the steps are the same.
  CHECK(given.steps == differences.steps);
  CHECK(differences.evaluations == given.evaluations + 3 * given.jacobians);
  linear_with_jacobian<X> mistaken;
  mistaken.transposed = true;
  CHECK(solve<Solver, X>(mistaken).evaluations > 2 * given.evaluations);
  linear_that_returns returns;
  CHECK(solve<Solver, Eigen::Vector3d>(returns).evaluations == differences.evaluations);
}

TEST_CASE("SUNDIALS: Jacobians are (1), called where f has one, of sizes that are fixed or not") {
  check<kte::sundials::bdf, Eigen::Vector3d>();
  check<kte::sundials::bdf, Eigen::VectorXd>();
  check<kte::sundials::implicit_runge_kutta, Eigen::Vector3d>();
  check<kte::sundials::implicit_runge_kutta, Eigen::VectorXd>();
}

}  // namespace explicit_form_test
