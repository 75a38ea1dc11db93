#include <kte/integrators/adams_BM.hpp>

#include <boost/multiprecision/cpp_int.hpp>

#include <cmath>
#include <limits>
#include <vector>

#include "catch.hpp"

namespace adams_BM_test {

using namespace kte;
using kte::test::contains_text;

using rational = boost::multiprecision::cpp_rational;
template <class S>
using scalar_state = Eigen::Matrix<S, 1, 1>;
constexpr double nan = std::numeric_limits<double>::quiet_NaN();

rational exact(const ratio& r) { return rational(r.num) / rational(r.den); }
rational power(const rational& x, int n) { return n == 0 ? rational(1) : rational(x * power(x, n - 1)); }

/// Whether weights of slopes at the nodes 1, 0, -1, ... integrate s^m from 0 to theta.
template <std::size_t N>
bool integrates(const std::array<rational, N>& w, int m, const rational& theta) {
  rational sum = 0;
  for (std::size_t i = 0; i < N; ++i) sum += w[i] * power(rational(1 - static_cast<int>(i)), m);
  return sum == power(theta, m + 1) / (m + 1);
}
template <std::size_t N>
std::array<rational, N> exact(const tableau_row<N>& row) {
  std::array<rational, N> w;
  for (std::size_t i = 0; i < N; ++i) w[i] = exact(row[i]);
  return w;
}

template <class Formula>
void check_formula() {
  const int k = static_cast<int>(Formula::order);
  for (int m = 0; m < k; ++m) {
    CHECK(integrates(exact(Formula::predictor), m, 1));
    CHECK(integrates(exact(Formula::corrector), m, 1));
  }
  CHECK(!integrates(exact(Formula::predictor), k, 1));
  CHECK(!integrates(exact(Formula::corrector), k, 1));
  CHECK(Formula::predictor[0].num == 0);               // explicit
  CHECK(Formula::corrector[Formula::order].num == 0);  // k slopes
  for (int i = 1; i < 8; ++i) {
    const rational theta(i, 8);
    auto w = exact(tableau_row<Formula::order + 1>{});
    for (std::size_t p = 0; p < Formula::order; ++p)
      for (std::size_t j = 0; j < w.size(); ++j)
        w[j] += power(theta, static_cast<int>(p) + 1) * exact(Formula::interpolant[p][j]);
    for (int m = 0; m < k; ++m) CHECK(integrates(w, m, theta));
  }
}

TEST_CASE("Adams-Bashforth-Moulton: predictor, corrector and interpolant have their order") {
  SECTION("order 3") { check_formula<adams_BM3_formula>(); }
  SECTION("order 5") { check_formula<adams_BM5_formula>(); }
}

const auto rational_decay = [](long double t, const scalar_state<long double>& x) {
  return scalar_state<long double>(-2 * t * x[0] * x[0]);
};
long double rational_solution(long double t) { return 1 / (1 + t * t); }

/// The largest errors at the end and at times between the steps; h does not divide the time.
template <template <class, class> class Method>
std::pair<long double, long double> errors_with(long double h) {
  Method<decltype(rational_decay), scalar_state<long double>> solver(rational_decay, 0.0L,
                                                                     scalar_state<long double>(1.0L), h);
  long double most = 0;
  solver.integrate(2.0L + h / 3, every(h / 4), [&](long double t, const auto& x) {
    most = test::worse(most, std::fabs(x[0] - rational_solution(t)));
  });
  return {std::fabs(solver.state()[0] - rational_solution(2.0L + h / 3)), most};
}
template <template <class, class> class Method>
void check_order(int order) {
  const long double h = 1 / 512.0L;  // errors of 1e-15, far above the rounding of a long double
  const auto coarse = errors_with<Method>(h), fine = errors_with<Method>(h / 2);
  CHECK(static_cast<double>(std::log2(coarse.first / fine.first)) == within(order, 0.1));
  CHECK(static_cast<double>(std::log2(coarse.second / fine.second)) == within(order, 0.1));
}

TEST_CASE("Adams-Bashforth-Moulton: the order holds with the start and a short last step, also between the steps") {
  SECTION("order 3") { check_order<adams_BM3>(3); }
  SECTION("order 5") { check_order<adams_BM5>(5); }
}

/// Slopes of x' = f that may change, with a count of evaluations and their latest time.
struct oscillator {
  double omega = 1;
  long long calls = 0;
  double latest = -1e300;
  Eigen::Vector2d operator()(double t, const Eigen::Vector2d& x) {
    ++calls;
    latest = std::max(latest, t);
    return {x[1], -omega * omega * x[0]};
  }
};

TEST_CASE("Adams-Bashforth-Moulton: two evaluations a step, and none beyond the end") {
  oscillator f;
  adams_BM5 solver(std::ref(f), 0.0, Eigen::Vector2d(1, 0), 0.01);
  solver.integrate(1);
  CHECK(f.calls == 1 + 4 * 6 + 96 * 2);  // the first slope; Runge-Kutta with six, one of them known; the rest
  CHECK(solver.statistics().evaluations == f.calls);
  CHECK(solver.statistics().steps == 100);
  solver.integrate(2);
  CHECK(f.calls == 1 + 4 * 6 + 96 * 2 + 1 + 100 * 2);  // goes on: one to see that nothing has changed
  solver.integrate(2.995);
  CHECK(f.calls == 1 + 4 * 6 + 96 * 2 + 1 + 100 * 2 + 1 + 99 * 2 + 6);  // the last one of 0.005 by Runge-Kutta
  CHECK(f.latest == 2.995);
  CHECK(solver.time() == 2.995);
  CHECK(solver.state()[0] == within(std::cos(2.995), 1e-10));
}

TEST_CASE("Adams-Bashforth-Moulton: nothing old is used after a restart, a turn, or a change of f") {
  const auto error = [](const auto& solver, double q, double p) {
    return (solver.state() - Eigen::Vector2d(q, p)).norm();
  };
  oscillator f;
  adams_BM3 solver(std::ref(f), 0.0, Eigen::Vector2d(1, 0), 0.001);
  solver.integrate(1);
  solver.integrate(0);
  CHECK(error(solver, 1, 0) < 1e-8);
  f.omega = 3;
  solver.integrate(1);
  CHECK(error(solver, std::cos(3), -3 * std::sin(3)) < 1e-7);  // with slopes of omega 1: 1e-2
  solver.restart(1, Eigen::Vector2d(0, 3));
  solver.integrate(2);
  CHECK(error(solver, std::sin(3), 3 * std::cos(3)) < 1e-7);
  adams_BM3 square([](double t, const scalar_state<double>&) { return scalar_state<double>(t * t); }, 0.0,
                   scalar_state<double>(0.0), 0.1);
  square.integrate(1);
  square.restart(-1, scalar_state<double>(0.0));  // equal slope
  square.integrate(0);
  CHECK(square.state()[0] ==
        within(1 / 3.0, 1.5e-15));  // order 3 is exact; 4 roundings of weights up to 23/12, 10 of sums
}

TEST_CASE("Adams-Bashforth-Moulton: state and slope are continuous between steps") {
  oscillator f;
  adams_BM5 solver(std::ref(f), 0.0, Eigen::Vector2d(1, 0), 0.1);
  double before = 0;
  Eigen::Vector2d x_before(1, 0);
  solver.integrate(1.97, [&](double t, const Eigen::Vector2d& x) {
    if (t == before) return;
    const double d = (t - before) * 1e-6;           // squares of it are 1e-14
    const bool runge_kutta = t < 0.45 || t > 1.95;  // its interpolant has the slope k_6 at the end, off by h^5 = 1e-5
    CHECK((solver.interpolate(before + d) - x_before - d * f(before, x_before)).norm() < 1e-13);
    CHECK((solver.interpolate(t - d) - x + d * f(t, x)).norm() < (runge_kutta ? 1e-11 : 1e-13));
    before = t, x_before = x;
  });
}

TEST_CASE("Adams-Bashforth-Moulton: every scalar, and states of dynamic size") {
  const auto decay = []<class X>(const typename X::Scalar&, const X& x) { return X(-x); };
  adams_BM5 f(decay, 0.0f, scalar_state<float>(1.0f), 0.01f);
  f.integrate(1.0f);
  CHECK(f.state()[0] == within_relative(std::exp(-1.0), 1e-5));
  adams_BM5 l(decay, 0.0L, scalar_state<long double>(1.0L), 0.0005L);
  l.integrate(1.0L);
  CHECK(std::fabs(l.state()[0] - std::exp(-1.0L)) < 1e-17L);  // 19/720 h^5 / e = 3e-19, and rounding
  adams_BM3 d(decay, 0.0, Eigen::VectorXd(Eigen::VectorXd::Ones(5)), 0.001);
  d.integrate(1);
  CHECK((d.state().array() - std::exp(-1.0)).abs().maxCoeff() < 1e-9);
}

TEST_CASE("Adams-Bashforth-Moulton: failures stop with the last good state") {
  const auto f = [](double t, const scalar_state<double>&) { return scalar_state<double>(t < 0.5 ? 1.0 : nan); };
  adams_BM3 solver(f, 0.0, scalar_state<double>(0.0), 0.1);
  CHECK_THROWS_WITH(solver.integrate(1), contains_text("stopped at t = 0.4") && contains_text("not a finite number"));
  CHECK(solver.time() == 4 * 0.1);
  CHECK(solver.state()[0] == within(0.4, 4e-16));  // four sums, each of a rounded slope times 0.1
  CHECK(solver.interpolate(solver.time()) == solver.state());
  CHECK_THROWS_AS(solver.integrate(1), integration_failure);
  solver.integrate(0);
  CHECK(solver.state()[0] == within(0.0, 1e-15));
  for (double bad : {0.0, -0.1, nan})
    CHECK_THROWS_WITH(adams_BM5(f, 0.0, scalar_state<double>(0.0), bad), contains_text("step"));
}

}  // namespace adams_BM_test
