#include "data/hard_chains.hpp"

#include <kte/dynamics/derivatives.hpp>
#include <kte/dynamics/forward_dynamics.hpp>
#include <kte/dynamics/mass_matrix_inverse.hpp>
#include <kte/runtime_chain/runtime_chain.hpp>

#include "catch.hpp"

// Chains that are hard by their length or their masses, against 21 digits (data/hard_chains.hpp). Factorising the mass
// matrix would cost its condition: 5e-7 of the accelerations of 1000 rods, 1.5e-7 of those under a heavy tip. The
// errors of articulated bodies do not add up along a chain: every joint lets go of what it does not pass on. Bounds:
// some three times the largest error measured at -O1 and -O3 -march=native, which is in brackets.

namespace hard_chains_test {

using namespace kte;
using namespace kte::reference;

long double error_in(const hard_chain& c) {
  auto s = c.chain.make_state();
  return error_of(forward_dynamics(c.chain, s, c.q, c.v, c.tau), c);
}

TEST_CASE("long rows of rods") {
  CHECK(error_in(uniform_rods(10)) < 1.5e-15L);  // [5e-16]
  CHECK(error_in(uniform_rods(100)) < 3e-15L);   // [9e-16]
  CHECK(error_in(uniform_rods(1000)) < 3e-15L);  // [8e-16]
}

TEST_CASE("light and heavy rods") {
  // The inertias of the light ones are what is left of numbers 1e6 times as large: a rounding of these, eps/2, may
  // count 1e6 times, which is 1e-10.
  CHECK(error_in(heavy_tip_rods()) < 2e-11L);      // [7e-12]
  CHECK(error_in(alternating_rods()) < 1.5e-15L);  // [4e-16]
  CHECK(error_in(shrinking_rods()) < 1.5e-15L);    // [5e-16]
}

TEST_CASE("long chains in space") {
  for (const int n : {6, 30, 100, 300}) {
    CAPTURE(n);
    CHECK(error_in(spatial_chain(n)) < 7e-15L);  // [3e-16, 6e-16, 2.3e-15, 1.7e-15]
  }
  CHECK(error_in(heavy_tip_spatial_chain()) < 5e-14L);  // [1.5e-14]
}

TEST_CASE("the inverse of the mass matrix of long chains, also as a derivative of forward dynamics") {
  // Against forward dynamics of chains at rest, which the above checks: column j is what a unit force on j does.
  const auto check = [](hard_chain x) {
    auto& c = x.chain;
    auto s = c.make_state();
    const Eigen::MatrixXd by_tau = forward_dynamics_derivatives(c, s, x.q, x.v, x.tau).by_tau;
    c.gravity(zero3{});
    s = c.make_state();  // without gravity
    Eigen::MatrixXd exact(c.dofs(), c.dofs());
    const Eigen::VectorXd rest = Eigen::VectorXd::Zero(c.dofs());
    for (int j = 0; j < c.dofs(); ++j)
      exact.col(j) = forward_dynamics(c, s, x.q, rest, Eigen::VectorXd(Eigen::VectorXd::Unit(c.dofs(), j)));
    const double largest = exact.cwiseAbs().maxCoeff();
    CHECK((by_tau - exact).cwiseAbs().maxCoeff() < 7e-15 * largest);
    CHECK((mass_matrix_inverse(c, s, x.q) - exact).cwiseAbs().maxCoeff() < 7e-15 * largest);
    CHECK((by_tau - by_tau.transpose()).cwiseAbs().maxCoeff() == 0);
  };
  check(uniform_rods(128));
  check(spatial_chain(100));
}

}  // namespace hard_chains_test
