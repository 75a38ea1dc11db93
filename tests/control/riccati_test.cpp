#include <kte/control/discretize.hpp>
#include <kte/control/lqr.hpp>

#include <cmath>
#include <complex>

#include "catch.hpp"

// Riccati equations with solutions in closed form, residuals of others, and what has no solution.

namespace riccati_test {

using namespace kte;
using Eigen::MatrixXd;
using kte::test::says;

constexpr double eps = std::numeric_limits<double>::epsilon();

MatrixXd matrix(Eigen::Index rows, Eigen::Index cols, std::initializer_list<double> by_rows) {
  MatrixXd m(rows, cols);
  Eigen::Index i = 0;
  for (const double x : by_rows) m(i / cols, i % cols) = x, ++i;
  return m;
}
const MatrixXd unit = matrix(1, 1, {1}), two_ones = MatrixXd::Identity(2, 2), twice = matrix(2, 2, {0, 1, 0, 0}),
               push = matrix(2, 1, {0, 1});

/// Of (1) in control/riccati.hpp, with K, relative to its terms.
double residual(const MatrixXd& A, const MatrixXd& B, const MatrixXd& Q, const MatrixXd& N, const lqr_gain& g) {
  const MatrixXd xa = g.X * A, cost = (g.X * B + N) * g.K;
  return (xa.transpose() + xa - cost + Q).norm() / (2 * xa.norm() + cost.norm() + Q.norm());
}
/// A matrix with entries of an irregular sequence between -1 and 1.
MatrixXd irregular(Eigen::Index rows, Eigen::Index cols, double seed) {
  return MatrixXd::NullaryExpr(rows, cols, [&](Eigen::Index i, Eigen::Index j) {
    return std::sin(seed + 7.3 * static_cast<double>((i + 1) * (j + 1) * (j + 3)));
  });
}

TEST_CASE("the double integrator, in closed form at all scales") {
  // A cost s^2 of the position squared: X = (s sqrt(2 s), s; s, sqrt(2 s))
  for (const double s : {1e-8, 1e-3, 1.0, 1e4, 1e9}) {
    const MatrixXd x = care(twice, push, matrix(2, 2, {s * s, 0, 0, 0}), unit);
    CHECK(x(0, 1) == within_relative(s, 8 * eps));
    CHECK(x(1, 1) == within_relative(std::sqrt(2 * s), 8 * eps));
    CHECK(x(0, 0) == within_relative(s * std::sqrt(2 * s), 8 * eps));
    CHECK(x(1, 0) == x(0, 1));
  }
  const auto g = lqr(twice, push, two_ones, unit);
  CHECK(g.K(0, 0) == within(1, 4 * eps));
  CHECK(g.K(0, 1) == within(std::sqrt(3), 4 * eps));
  // poles of s^2 + sqrt(3) s + 1
  CHECK(std::abs(g.poles[0].real() + std::sqrt(3) / 2) < 8 * eps);
  CHECK(std::abs(std::abs(g.poles[0].imag()) - 0.5) < 8 * eps);
}

TEST_CASE("one number: the stabilising root, also of unstable and uncertain costs") {
  // 2 a x - (b x + n)^2/r + q = 0
  for (const double a : {-2.0, 0.0, 3.0})
    for (const double n : {0.0, 0.5}) {
      const double b = 2, q = 5, r = 0.25, p = a - b * n / r, c = q - n * n / r, h = b * b / r;
      const MatrixXd x = care(unit * a, unit * b, unit * q, unit * r, unit * n);
      CHECK(x(0, 0) == within_relative((p + std::sqrt(p * p + h * c)) / h, 8 * eps));
      const MatrixXd y = dare(unit * a, unit * b, unit * q, unit * r);
      // b^2 y^2 + (r - a^2 r - q b^2) y - q r = 0
      const double half = (r - a * a * r - q * b * b) / 2;
      CHECK(y(0, 0) == within_relative((-half + std::sqrt(half * half + b * b * q * r)) / (b * b), 16 * eps));
    }
  // An indefinite Q, as of games; least eigenvalue of the loop sqrt(a^2 + q) = 1
  CHECK(care(unit * 2, unit, unit * -3, unit)(0, 0) == within(3, 16 * eps));
  CHECK_THROWS_MATCHES(lqr(unit * 2, unit, unit * -3, unit), bad_argument, says("lqr: Q is not positive semidefinite"));
}

TEST_CASE("costs of states with inputs are those of a shifted problem") {
  const MatrixXd A = irregular(4, 4, 1), B = irregular(4, 2, 2), S = irregular(6, 6, 3), W = S * S.transpose();
  const MatrixXd Q = W.topLeftCorner(4, 4), R = W.bottomRightCorner(2, 2), N = W.topRightCorner(4, 2);
  const auto g = lqr(A, B, Q, R, N);
  CHECK(residual(A, B, Q, N, g) < 64 * eps);
  CHECK((R * g.K - B.transpose() * g.X - N.transpose()).norm() < 64 * eps * (R * g.K).norm());
  CHECK(g.poles.real().maxCoeff() < 0);
  const auto d = dlqr(A, B, Q, R, N);
  const MatrixXd twice_u = R + B.transpose() * d.X * B, once = B.transpose() * d.X * A + N.transpose();
  CHECK((A.transpose() * d.X * A - once.transpose() * d.K + Q - d.X).norm() < 256 * eps * d.X.norm());
  CHECK((twice_u * d.K - once).norm() < 64 * eps * once.norm());
  CHECK(d.poles.cwiseAbs().maxCoeff() < 1);
}

TEST_CASE("a chain of masses, of 12 states: residuals to rounding, in both kinds of time") {
  constexpr Eigen::Index n = 6;
  MatrixXd A = MatrixXd::Zero(2 * n, 2 * n), B = MatrixXd::Zero(2 * n, 1);
  A.topRightCorner(n, n).setIdentity();
  for (Eigen::Index i = 0; i < n; ++i) {
    A(n + i, i) = -2e4;
    if (i > 0) A(n + i, i - 1) = 1e4;
    if (i + 1 < n) A(n + i, i + 1) = 1e4;
  }
  B(2 * n - 1, 0) = 3;
  const MatrixXd Q = MatrixXd::Identity(2 * n, 2 * n), R = unit * 1e-4, N = MatrixXd::Zero(2 * n, 1);
  const auto g = lqr(A, B, Q, R);
  CHECK(residual(A, B, Q, N, g) < 256 * eps);
  linear_system<> s{A, B, Q, N, Eigen::VectorXd::Zero(2 * n), Eigen::VectorXd::Zero(2 * n)};
  const auto e = discretize(s, 1e-5);
  // Short intervals of inputs that stay: nearly as in continuous time, but for a cost a second.
  const auto d = lqr(e, Q * 1e-5, R * 1e-5);
  CHECK((d.K - g.K).norm() < 1e-2 * g.K.norm());
}

TEST_CASE("what has no solution says why") {
  const auto unreached = [](const char* z) {
    return says(std::string("not stabilisable: inputs do not reach the mode of A with the eigenvalue ") + z);
  };
  CHECK_THROWS_MATCHES(care(matrix(2, 2, {1, 0, 0, 2}), matrix(2, 1, {1, 0}), two_ones, unit), no_solution,
                       unreached("2 +0i"));
  CHECK_THROWS_MATCHES(dare(matrix(2, 2, {1, 0, 0, 2}), matrix(2, 1, {1, 0}), two_ones, unit), no_solution,
                       unreached("2 +0i"));
  CHECK_THROWS_MATCHES(care(twice, matrix(2, 1, {1, 0}), two_ones, unit), no_solution, unreached("0 +0i"));
  // In coordinates that hide the mode; modes that decay are no fault.
  const MatrixXd along = irregular(5, 1, 1);
  const MatrixXd turn = MatrixXd::Identity(5, 5) - 2 / along.squaredNorm() * along * along.transpose();
  MatrixXd A = MatrixXd::Zero(5, 5), B = irregular(5, 2, 2);
  A.diagonal() << -2, -1, 0.5, 1, 1.5;
  A.diagonal(1).setOnes();
  B.row(4).setZero();
  CHECK_THROWS_MATCHES(care(turn * A * turn.transpose(), turn * B, MatrixXd::Identity(5, 5), two_ones), no_solution,
                       unreached("1.5 "));
  A(4, 4) = -1.5;
  CHECK(lqr(turn * A * turn.transpose(), turn * B, MatrixXd::Identity(5, 5), two_ones).poles.real().maxCoeff() < 0);

  const auto axis = says("the Hamiltonian matrix has, up to rounding, an eigenvalue on the imaginary axis");
  const MatrixXd oscillator = matrix(2, 2, {0, 1, -1, 0});
  CHECK_THROWS_MATCHES(care(oscillator, push, MatrixXd::Zero(2, 2), unit), no_solution, axis);
  CHECK_THROWS_MATCHES(care(twice, push, matrix(2, 2, {0, 0, 0, 1}), unit), no_solution, axis);
  const auto circle = says("the symplectic pencil has, up to rounding, an eigenvalue on the unit circle");
  CHECK_THROWS_MATCHES(dare(oscillator, push, MatrixXd::Zero(2, 2), unit), no_solution, circle);

  CHECK_THROWS_MATCHES(care(twice, push, two_ones, unit * -1), bad_argument, says("R is not positive definite"));
  CHECK_THROWS_MATCHES(care(twice, push, two_ones, unit * 0), bad_argument, says("R is not positive definite"));
  CHECK_THROWS_MATCHES(care(twice, push, matrix(2, 2, {1, 1, 0, 1}), unit), bad_argument, says("Q is not symmetric"));
  CHECK_THROWS_MATCHES(care(twice, push, unit, unit), bad_argument, says("Q is 1 x 1, not 2 x 2"));
  CHECK_THROWS_MATCHES(care(twice, push * std::nan(""), two_ones, unit), bad_argument,
                       says("a number of B is not finite"));
  CHECK_THROWS_MATCHES(care({}, {}, {}, {}), bad_argument, says("there are no states, or no inputs"));
}

TEST_CASE("systems become discrete exactly, at what is no equilibrium too") {
  const linear_system<> s{
      twice, push, two_ones, matrix(2, 1, {0, 0}), Eigen::Vector2d(3, -9.81), Eigen::Vector2d(0, 0)};
  const auto d = discretize(s, 0.5);
  CHECK((d.A - matrix(2, 2, {1, 0.5, 0, 1})).norm() < 8 * eps);
  CHECK((d.B - matrix(2, 1, {0.125, 0.5})).norm() < 8 * eps);
  CHECK((d.step - Eigen::Vector2d(1.5 - 9.81 / 8, -9.81 / 2)).norm() < 64 * eps);
  CHECK(d.dt == 0.5);
  // A damped oscillator: x'' + 2 z w x' + w^2 x = w^2 u
  const double w = 40, z = 0.3, t = 0.2, v = w * std::sqrt(1 - z * z), e = std::exp(-z * w * t);
  const double c = e * std::cos(v * t), n = e * std::sin(v * t) / v;
  const auto o = discretize({matrix(2, 2, {0, 1, -w * w, -2 * z * w}), matrix(2, 1, {0, w * w}), two_ones,
                             matrix(2, 1, {0, 0}), Eigen::Vector2d::Zero(), Eigen::Vector2d::Zero()},
                            t);
  CHECK((o.A - matrix(2, 2, {c + z * w * n, n, -w * w * n, c - z * w * n})).norm() < 64 * eps * w);
  CHECK((o.B - matrix(2, 1, {1 - c - z * w * n, w * w * n})).norm() < 64 * eps * w);
  CHECK_THROWS_MATCHES(discretize(s, 0), bad_argument, says("dt must be finite and positive, got 0"));
  CHECK_THROWS_MATCHES(discretize({unit * 1e3, unit, unit, unit, unit, unit}, 1), bad_argument,
                       says("the result overflows"));
  CHECK_THROWS_AS(discretize({unit, push, unit, unit, unit, unit}, 1), bad_argument);
}

}  // namespace riccati_test
