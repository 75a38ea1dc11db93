#include <kte/integrators/bdf.hpp>

#include <cmath>
#include <vector>

#include "catch.hpp"
#include "digits50.hpp"
#include "integrators/any_system.hpp"

namespace bdf_test {

using namespace kte;
using kte::test::any_system, kte::test::numbers;
using real50 = kte::test::digits50;
using state = Eigen::VectorXd;
using solver_type = bdf<any_system<>, state>;
template <class S>
using scalar_system = any_system<S, 1>;
template <class S>
using scalar_solver = bdf<scalar_system<S>, typename scalar_system<S>::state>;
constexpr bdf_formula ndf = bdf_formula::numerical_differentiation, plain = bdf_formula::backward_differentiation;

/// Prothero and Robinson: x = cos t whatever lambda is, if it starts there.
template <class System = any_system<>, class S>
System towards_cosine(const S& lambda) {
  return {[lambda](const S& t, const auto& x) {
    using std::cos;
    using std::sin;
    return numbers<S>(-lambda * (x[0] - cos(t)) - sin(t));
  }};
}

/// The slope of y over x by least squares.
double slope(const std::vector<double>& x, const std::vector<double>& y) {
  const auto n = static_cast<Eigen::Index>(x.size());
  const Eigen::Map<const Eigen::ArrayXd> a(x.data(), n), b(y.data(), n);
  return ((a - a.mean()) * (b - b.mean())).sum() / (a - a.mean()).square().sum();
}

TEST_CASE("BDF: with order k, errors are as steps^-k, steps as tolerance^(-1/(k + 1))", "[long]") {
  const auto g = [](long double t) { return std::exp(-t / 2); };  // all derivatives alike, so steps are, too
  const scalar_system<long double> f([&](long double t, const auto& x) {
    return numbers<long double>(-g(t) / 2 - (x[0] - g(t)) * (1 + x[0] / g(t)));
  });
  const double loosest[]{3, 4, 6, 8, 10};  // powers of 1/10; four powers
  for (const bdf_formula formula : {ndf, plain}) {
    for (int k = 1; k <= 5; ++k) {
      std::vector<double> tolerance, steps, errors, between;
      for (int i = 0; i <= 12; i += 2) {
        const long double tol = std::pow(10.0L, -loosest[k - 1] - i / 3.0L);
        scalar_solver<long double> solver(f, 0.0L, numbers<long double>(1), {.absolute = 1e-6L * tol, .relative = tol},
                                          {k, formula});
        solver.integrate(6);
        const auto before = solver.statistics().steps;
        auto sampled = solver;
        long double most = 0, most_between = 0;
        solver.integrate(12,
                         [&](long double t, const auto& x) { most = test::worse(most, std::fabs(x[0] / g(t) - 1)); });
        sampled.integrate(12, every(0.0137L), [&](long double t, const auto& x) {
          most_between = test::worse(most_between, std::fabs(x[0] / g(t) - 1));
        });
        tolerance.push_back(std::log(static_cast<double>(tol)));
        steps.push_back(std::log(static_cast<double>(solver.statistics().steps - before)));
        errors.push_back(std::log(static_cast<double>(most)));
        between.push_back(std::log(static_cast<double>(most_between)));
      }
      UNSCOPED_INFO("order " << k);
      CHECK(slope(steps, errors) == within(-k, 0.1));
      CHECK(slope(steps, between) == within(-k, 0.1));
      CHECK(slope(tolerance, steps) == within(-1.0 / (k + 1), 0.03));  // steps may stay 1.3 times too short
    }
  }
}

TEST_CASE("BDF: the NDF need fewer steps at orders 1 to 3, as their error constants say") {
  const auto steps = [](int order, bdf_formula formula) {
    solver_type solver(towards_cosine(1.0), 0.0, numbers(1), {.absolute = 1e-7, .relative = 1e-7}, {order, formula});
    solver.integrate(10);
    return static_cast<double>(solver.statistics().steps);
  };
  for (int k = 1; k <= 3; ++k) CHECK(steps(k, plain) / steps(k, ndf) == within(1.26, 0.05));
}

TEST_CASE("BDF: stiffness is free") {
  const auto solve = [](double lambda) {
    solver_type solver(towards_cosine(lambda), 0.0, numbers(1.5), {.absolute = 1e-8, .relative = 1e-8});
    solver.integrate(10);
    CHECK(solver.state()[0] == within(std::cos(10.0), 1e-8));
    CHECK(solver.statistics().jacobians == 1);  // linear
    CHECK(solver.statistics().factorizations < solver.statistics().steps / 5);
    return solver.statistics().evaluations;
  };
  CHECK(solve(1e3) < 1500);
  for (double lambda : {1e6, 1e9, 1e12}) CHECK(solve(lambda) < 1500);
}

TEST_CASE("BDF: fast oscillations that decay slowly are followed or damped, not blown up") {
  int lowered = 0;
  for (double w : {10.0, 100.0, 1000.0, 1e4}) {
    for (double damping : {0.0, 0.01, 0.1, 0.5}) {  // outside of the stability of order 5, until 0.5
      const any_system<> f([=](double t, const state& x) {
        const double a = x[0] - std::cos(t), b = x[1] - std::cos(t);
        return numbers(-std::sin(t) + w * (b - damping * a), -std::sin(t) - w * (a + damping * b));
      });
      solver_type solver(f, 0.0, numbers(1, 1));
      int order = 1;
      solver.integrate(20, [&](double, const auto&) {
        if (solver.order() < order) ++lowered;
        order = solver.order();
      });
      UNSCOPED_INFO(w << ' ' << damping);
      CHECK(solver.state()[0] == within(std::cos(20.0), 1e-4));
      CHECK(solver.statistics().steps < 6000);  // 320 periods of w = 100 are seen
    }
  }
  CHECK(lowered > 10);  // where high orders are unstable
}

TEST_CASE("BDF: the dense output interpolates step ends, with their accuracy") {
  solver_type solver(towards_cosine(50.0), 0.0, numbers(1), {.absolute = 1e-9, .relative = 1e-9});
  double before = 0, x_before = 1;
  solver.integrate(10, [&](double t, const auto& x) {
    if (t == before) return;
    const double d = 1e-9 * (t - before);
    CHECK(solver.interpolate(before + d)[0] == within(x_before, 2 * d));
    CHECK(solver.interpolate(t - d)[0] == within(x[0], 2 * d));
    for (int i = 1; i < 8; ++i) {
      const double s = before + (t - before) * i / 8;
      CHECK(solver.interpolate(s)[0] == within(std::cos(s), 1e-9));
    }
    before = t, x_before = x[0];
  });
  CHECK(solver.order() == 5);
}

TEST_CASE("BDF: no tiny last step, and the step before goes on") {
  const auto f = towards_cosine(1e4);
  solver_type solver(f, 0.0, numbers(1));
  for (int i = 1; i <= 100; ++i) {
    std::vector<double> times;
    const double start = i / 90.0, end = 3 + i * 0.137;
    solver.restart(start, numbers(std::cos(start)));
    solver.integrate(end, [&](double t, const auto&) { times.push_back(t); });
    CHECK(solver.time() == end);
    const std::size_t n = times.size();
    CHECK(times[n - 1] - times[n - 2] > 0.4 * (times[n - 2] - times[n - 3]));
  }
  const double end = solver.time();
  solver.integrate(end + 1e-3);  // cut to less than a tenth: its differences say little about much longer steps
  solver.begin(end + 1);
  solver.step(end + 1);
  CHECK(solver.time() - end - 1e-3 == within(2e-3, 1e-14));  // times near 17 round by 1.8e-15
  solver.integrate(end + 1);
  CHECK(solver.state()[0] == within(std::cos(end + 1), 1e-7));
  solver_type at_once(f, 0.0, numbers(1)), in_pieces = at_once, in_small_pieces = at_once;
  at_once.integrate(10);
  for (int i = 1; i <= 10; ++i) in_pieces.integrate(i);
  CHECK(in_pieces.statistics().steps < at_once.statistics().steps + 3 * 10);
  for (int i = 1; i <= 1000; ++i) in_small_pieces.integrate(i * 0.01);  // one step each, but for those of the start
  CHECK(in_small_pieces.statistics().steps < 1000 + 50);
  CHECK(in_small_pieces.statistics().factorizations < 30);
  CHECK(in_small_pieces.state()[0] == within(std::cos(10.0), 1e-9));
}

TEST_CASE("BDF: the history goes on where nothing has changed, else it starts again") {
  double input = 1;
  solver_type solver({[&](double, const state& x) { return numbers(-x[0] + input); }}, 0.0, numbers(3));
  const auto order_of_next_step = [&](double t_end) {
    solver.begin(t_end);
    solver.step(t_end);
    const int order = solver.order();
    while (solver.time() != t_end) solver.step(t_end);
    return order;
  };
  solver.integrate(1);
  const int order = solver.order();
  CHECK(order > 3);
  CHECK(order_of_next_step(1.1) >= order - 1);
  const double x = solver.state()[0];
  solver.restart(1.1, numbers(x));  // equal state
  CHECK(order_of_next_step(2) > 2);
  input = 2;
  solver.begin(3);
  CHECK_THROWS_AS(solver.interpolate(1.9999), bad_argument);  // with the history went the last step
  CHECK(solver.interpolate(2) == solver.state());
  CHECK(order_of_next_step(3) == 1);
  CHECK(solver.state()[0] == within(2 + (1 + 2 * std::exp(-2) - 2) * std::exp(-1), 1e-6));
  solver.restart(3, numbers(5));
  CHECK(order_of_next_step(4) == 1);
  solver.restart(5, solver.state());
  CHECK(order_of_next_step(6) == 1);
  CHECK(order_of_next_step(5) == 1);  // backward
}

TEST_CASE("BDF: discontinuities of the right-hand side") {
  long long calls = 0;
  const any_system<> f([&](double t, const state& x) {
    ++calls;
    return numbers(-x[0] + (t < 1 ? 1 : t < 2 ? -1 : 3));
  });
  solver_type solver(f, 0.0, numbers(0.5), {.absolute = 1e-8, .relative = 1e-8});
  const double x1 = 1 + (0.5 - 1) * std::exp(-1), x2 = -1 + (x1 + 1) * std::exp(-1), x3 = 3 + (x2 - 3) * std::exp(-1);
  solver.integrate(1.5);
  CHECK(solver.state()[0] == within(-1 + (x1 + 1) * std::exp(-0.5), 2e-8));
  solver.integrate(3);
  CHECK(solver.state()[0] == within(x3, 2e-8));
  CHECK(solver.statistics().rejected < 40);
  CHECK(solver.statistics().evaluations == calls);
}

TEST_CASE("BDF: backward in time") {
  solver_type solver(towards_cosine(-1e5), 2.0, numbers(0), {.absolute = 1e-9, .relative = 1e-9});
  double last = 3;
  solver.integrate(-8, every(0.25), [&](double t, const auto& x) {
    CHECK(t < last);
    if (t < 1.9) CHECK(x[0] == within(std::cos(t), 1e-9));
    last = t;
  });
  CHECK(solver.time() == -8);
  CHECK(solver.statistics().steps < 1000);
}

TEST_CASE("BDF: in every scalar") {
  scalar_solver<float> f(towards_cosine<scalar_system<float>>(1e3f), 0.0f, numbers<float>(1),
                         {.absolute = 1e-5f, .relative = 1e-5f});
  scalar_solver<long double> l(towards_cosine<scalar_system<long double>>(1e3L), 0.0L, numbers<long double>(1),
                               {.absolute = 1e-16L, .relative = 1e-16L});
  scalar_solver<real50> m(towards_cosine<scalar_system<real50>>(real50(1000)), real50(0), numbers<real50>(1),
                          {.absolute = 1e-16, .relative = 1e-16});
  f.integrate(1), l.integrate(1), m.integrate(1);
  CHECK(f.state()[0] == within(std::cos(1.0f), 1e-5));
  CHECK(std::fabs(l.state()[0] - std::cos(1.0L)) < 1e-16L);
  CHECK(abs(m.state()[0] - cos(real50(1))) < 1e-16);
  CHECK(std::abs(l.statistics().steps - m.statistics().steps) < 20);
}

TEST_CASE("BDF: dynamic states, and a custom Jacobian") {
  const auto rod = [](double, const state& x) {  // heat along a rod
    state f = -2 * x;
    f.head(x.size() - 1) += x.tail(x.size() - 1);
    f.tail(x.size() - 1) += x.head(x.size() - 1);
    return state(1000 * f);
  };
  const auto jacobian = [](double, const state& x, Eigen::MatrixXd& J) {
    J.setZero();
    J.diagonal().setConstant(-2000);
    J.diagonal(1).setConstant(1000);
    J.diagonal(-1).setConstant(1000);
    CHECK(J.rows() == x.size());
  };
  state x0(20);
  const double pi = std::acos(-1.0);
  for (int i = 0; i < 20; ++i) x0[i] = std::sin(3 * pi * (i + 1) / 21);  // an eigenvector
  const double rate = 2000 * (std::cos(3 * pi / 21) - 1);
  const tolerances<double> tol{.absolute = 1e-10, .relative = 1e-8};
  solver_type a({rod}, 0.0, x0, tol), b({rod, jacobian}, 0.0, x0, tol);
  a.integrate(0.01), b.integrate(0.01);
  CHECK((a.state() - std::exp(0.01 * rate) * x0).norm() < 1e-8);
  CHECK((b.state() - std::exp(0.01 * rate) * x0).norm() < 1e-8);
  CHECK(std::abs(a.statistics().evaluations - b.statistics().evaluations - 20 * a.statistics().jacobians) <= 10);
}

}  // namespace bdf_test
