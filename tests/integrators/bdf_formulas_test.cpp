#include <kte/integrators/detail/backward_differences.hpp>
#include <kte/integrators/detail/bdf_coefficients.hpp>
#include <kte/integrators/detail/bdf_order.hpp>
#include <kte/integrators/detail/newton_progress.hpp>

#include <boost/multiprecision/cpp_int.hpp>
#include <boost/multiprecision/eigen.hpp>

#include <algorithm>
#include <cmath>
#include <complex>

#include "catch.hpp"

namespace bdf_formulas_test {

using namespace kte;
using detail::backward_differences;
using detail::bdf_coefficients;
using detail::newton;

using rational = boost::multiprecision::cpp_rational;
using vector1 = Eigen::Matrix<rational, 1, 1>;
constexpr bdf_formula ndf = bdf_formula::numerical_differentiation, plain = bdf_formula::backward_differentiation;

rational power(const rational& x, int n) { return n == 0 ? rational(1) : rational(x * power(x, n - 1)); }

/// Differences of p(t), p(t - h), ..., seen from t.
template <class P>
auto differences_of(const P& p, const rational& t, const rational& h, int k) {
  backward_differences<rational, 1> d;
  d.start(vector1(p(t - k * h)), vector1(rational(0)));
  for (int i = k - 1; i >= 0; --i) {
    vector1 expected;
    d.predict(k, expected);
    d.add(k, vector1(p(t - i * h) - expected[0]));
  }
  return d;
}

TEST_CASE("the formulas of order k are exact for polynomials up to degree k, then wrong by their constant") {
  const rational t(7, 5), h(2, 3);
  for (const bdf_formula formula : {ndf, plain}) {
    const bdf_coefficients<rational> c(formula);
    for (int k = 1; k <= 5; ++k) {
      for (int n = 0; n <= k + 1; ++n) {
        const auto p = [&](const rational& x) { return power(x, n); };
        vector1 predicted, history;
        const auto d = differences_of(p, t, h, k);
        d.predict(k, predicted);
        d.combine(
            k, [&](int j) { return c.history(k, j); }, history);
        const rational slope = n == 0 ? rational(0) : rational(n * power(t + h, n - 1));
        const rational exact = p(t + h) - predicted[0];  // d of (2)
        const rational defect = exact - (c.slope(k) * h * slope - history[0]);
        rational derivative = power(h, k + 1);  // h^{k+1} x^{(k+1)} = D^{k+1} x
        for (int i = 2; i <= k + 1; ++i) derivative *= i;
        CHECK(defect == (n <= k ? rational(0) : rational(-c.error(k) * c.slope(k) * derivative)));
      }
    }
  }
}

TEST_CASE("the NDF take longer steps than the BDF for the same error, as published") {
  const bdf_coefficients<double> a(ndf), b(plain);
  const double percent[]{26, 26, 26, 12, 0};
  for (int k = 1; k <= 5; ++k)
    CHECK(100 * (std::pow(b.error(k) / a.error(k), 1.0 / (k + 1)) - 1) == within(percent[k - 1], 0.5));
}

/// The angle around the negative real axis within which all z = h lambda are stable, from the boundary of the region:
/// for x_n = zeta^n, D = 1 - 1/zeta, (1) of `bdf_coefficients` gives z = sum_j 1/j D^j - kappa g_k D^{k+1}.
double stability_angle(const bdf_coefficients<double>& c, int k) {
  const double pi = std::acos(-1.0), kappa_g = c.error(k) - 1.0 / (k + 1);
  double least = pi / 2;
  for (int i = 1; i < 100000; ++i) {
    const std::complex<double> d = 1.0 - std::polar(1.0, -pi * i / 100000);
    std::complex<double> z = -kappa_g * std::pow(d, k + 1), power = 1;
    for (int j = 1; j <= k; ++j) z += (power *= d) / static_cast<double>(j);
    if (std::abs(z) > 1e-4 && z.real() < 0) least = std::min(least, pi - std::abs(std::arg(z)));
  }
  return least * 180 / pi;
}

TEST_CASE("the formulas are as stable as published") {
  const double of_ndf[]{90, 90, 80, 66, 51}, of_bdf[]{90, 90, 86, 73, 51};
  for (int k = 1; k <= 5; ++k) {
    CHECK(stability_angle(bdf_coefficients<double>(ndf), k) == within(of_ndf[k - 1], 1));
    CHECK(stability_angle(bdf_coefficients<double>(plain), k) == within(of_bdf[k - 1], 1));
  }
}

TEST_CASE("backward differences for another step are those of the same polynomial") {
  const rational t(3, 7), h(5, 4);
  for (int k = 1; k <= 5; ++k) {
    const auto p = [&](const rational& x) { return rational(power(x, k) - 3 * power(x, k - 1) + x / 2 - 11); };
    for (const rational& r : {rational(1, 3), rational(1), rational(9, 5), rational(10)}) {
      auto d = differences_of(p, t, h, k);
      d.rescale(k, r);
      const auto expected = differences_of(p, t, h * r, k);
      for (int j = 0; j <= k; ++j) CHECK(d[j][0] == expected[j][0]);
      vector1 x;
      for (const rational& s : {rational(-5, 2), rational(-1), rational(-1, 3), rational(0), rational(1)}) {
        d.interpolate(k, rational(s + 1), vector1(d[0] - d[1]), x);
        CHECK(x[0] == p(t + s * h * r));
      }
      d.predict(k, x);
      CHECK(x[0] == p(t + h * r));
    }
  }
}

TEST_CASE("BDF: the next order is that of the longest step") {
  double stable = 10;
  const auto next = [&stable](int k, double lower, double same, double higher) {
    return detail::choose_order<double>(
        k, 5, [&](int q) { return q < k    ? lower
                                  : q == k ? same
                                           : higher; },
        [&](int q) { return q > 2 ? stable : 10.0; });
  };
  CHECK(next(3, 1e-6, 1e-1, 1e-1).order == 2);
  CHECK(next(3, 1e-1, 1e-6, 1e-1).order == 3);
  CHECK(next(3, 1e-1, 1e-1, 1e-8).order == 4);
  CHECK(next(5, 1.0, 0.1, 0.0).order == 5);  // there is none above
  CHECK(next(1, 0.0, 0.1, 1.0).order == 1);
  stable = 0.5;  // of orders above 2
  CHECK(next(5, 1e-4, 1e-4, 1e-4).order == 2);
  CHECK(next(4, 1e-1, 1e-8, 1e-1).factor <= 1);
}

TEST_CASE("Newton iterations end when little enough is left, or when that is hopeless") {
  detail::newton_progress<double> progress;
  progress.begin(0.01, 1e-15);
  CHECK(progress.judge(1) == newton::go_on);
  CHECK(progress.judge(0.2) == newton::go_on);        // 0.2 / 0.8 * 0.2 = 0.05 left
  CHECK(progress.judge(0.036) == newton::converged);  // 0.0079 left
  progress.begin(0.01, 1e-15);
  CHECK(progress.judge(0.03) == newton::converged);  // by the rate of the steps before
  progress.forget();
  progress.begin(0.01, 1e-15);
  CHECK(progress.judge(0.03) == newton::go_on);
  CHECK(progress.judge(0.029) == newton::hopeless);  // as good as no convergence
  progress.begin(0.01, 1e-15);
  CHECK(progress.judge(1) == newton::go_on);
  CHECK(progress.judge(0.5) == newton::hopeless);  // 0.125 left after four
  progress.begin(0.01, 1e-15);
  CHECK(progress.judge(1e-16) == newton::converged);  // no better in this arithmetic
  progress.begin(0.01, 1e-15);
  CHECK(progress.judge(std::nan("")) == newton::hopeless);
}

}  // namespace bdf_formulas_test
