#include <kte/adapters/sundials/arkode.hpp>

#include <arkode/arkode_butcher.h>

#include "catch.hpp"

namespace arkode_test {

using namespace kte;
using kte::test::contains_text;

using scalar_state = Eigen::Matrix<double, 1, 1>;
const scalar_state start(1.0);
/// x = exp(-t^2/2): f needs the time that is.
constexpr auto bell = [](double t, const scalar_state& x) { return scalar_state(-t * x[0]); };
const tolerances<double> tight{.absolute = 1e-10, .relative = 1e-10};

TEST_CASE("ARKODE: the table is that of the argument, explicit or implicit") {
  kte::sundials::explicit_runge_kutta verner(bell, 0.0, start, tight, ARKODE_VERNER_8_5_6);
  kte::sundials::implicit_runge_kutta trbdf2(bell, 0.0, start, {}, ARKODE_TRBDF2_3_3_2);
  verner.integrate(1), trbdf2.integrate(1);
  ARKodeButcherTable of_implicit = nullptr, of_explicit = nullptr;
  ARKStepGetCurrentButcherTables(verner.memory(), &of_implicit, &of_explicit);
  CHECK(of_implicit == nullptr);
  REQUIRE(of_explicit != nullptr);
  CHECK(of_explicit->stages == 8);
  CHECK(of_explicit->q == 6);
  ARKStepGetCurrentButcherTables(trbdf2.memory(), &of_implicit, &of_explicit);
  CHECK(of_explicit == nullptr);
  REQUIRE(of_implicit != nullptr);
  CHECK(of_implicit->stages == 3);
  CHECK(of_implicit->q == 2);
  CHECK_THROWS_AS(kte::sundials::implicit_runge_kutta(bell, 0.0, start, {}, ARKODE_DIRK_NONE), bad_argument);
}

TEST_CASE("ARKODE: backward, f is called at the times that are, and the statistics are its counts") {
  double least = 1e9, most = -1e9;
  const auto f = [&](double t, const scalar_state& x) {
    least = std::min(least, t), most = std::max(most, t);
    return bell(t, x);
  };
  const auto check = [&](auto& solver) {
    least = 1e9, most = -1e9;
    solver.integrate(-3, every(0.25), [](double t, const scalar_state& x) {
      CHECK(x[0] == within(std::exp((1 - t * t) / 2), 1e-7));  // some 100 steps within 1e-10 of 1.6, dense output
    });
    CHECK(solver.time() == -3);
    CHECK(least >= -3);
    CHECK(most <= 1);
    solver.integrate(2);
    CHECK(solver.state()[0] == within(std::exp((1 - 4.0) / 2), 1e-7));
    CHECK(most <= 2);
    CHECK(solver.interpolate(2) == solver.state());
  };
  kte::sundials::explicit_runge_kutta dormand_prince(f, 1.0, start, tight);
  kte::sundials::implicit_runge_kutta kvaerno(f, 1.0, start, tight);
  check(dormand_prince);
  CHECK(dormand_prince.statistics().jacobians == 0);
  CHECK(dormand_prince.statistics().factorizations == 0);
  check(kvaerno);
  CHECK(kvaerno.statistics().jacobians > 0);
  CHECK(kvaerno.statistics().factorizations >= kvaerno.statistics().jacobians);
  long by_error = 0, by_newton = 0;
  dormand_prince.restart(0, start);
  const auto before = dormand_prince.statistics().rejected;
  dormand_prince.integrate(8);
  ARKStepGetNumErrTestFails(dormand_prince.memory(), &by_error);
  ARKStepGetNumStepSolveFails(dormand_prince.memory(), &by_newton);
  CHECK(dormand_prince.statistics().rejected == before + by_error + by_newton);
  CHECK(by_error > 0);
}

}  // namespace arkode_test
