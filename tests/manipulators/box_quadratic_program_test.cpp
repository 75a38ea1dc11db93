#include <kte/manipulators/box_quadratic_program.hpp>

#include <Eigen/LU>

#include "catch.hpp"
#include "random.hpp"

// Quadratic functions in boxes: against the best of all 3^n choices of what is held where, and against the conditions
// of an optimum.

namespace box_quadratic_program_test {

using namespace kte;

using vector = Eigen::VectorXd;
using matrix = Eigen::MatrixXd;

struct problem {
  matrix h;
  vector g, lower, upper;
};
/// H = A^T A + eps 1 of rows x n numbers, boxes about a point near the free minimum.
problem random_problem(random_numbers& random, int n, int rows, double eps) {
  matrix a(rows, n);
  vector b(rows);
  for (int i = 0; i < rows; ++i) {
    b[i] = random(2);
    for (int j = 0; j < n; ++j) a(i, j) = random();
  }
  problem p{a.transpose() * a + eps * matrix::Identity(n, n), a.transpose() * b, vector(n), vector(n)};
  for (int i = 0; i < n; ++i) {
    const double m = random(), half = 0.5 * (1 + random());
    p.lower[i] = m - half, p.upper[i] = m + half;
  }
  return p;
}
double value(const problem& p, const vector& x) { return x.dot(p.h * x) / 2 - p.g.dot(x); }

/// The least value of all choices whose solution is in the box.
double by_enumeration(const problem& p) {
  const int n = static_cast<int>(p.g.size());
  double least = std::numeric_limits<double>::infinity();
  int choices = 1;
  for (int i = 0; i < n; ++i) choices *= 3;
  for (int c = 0; c < choices; ++c) {
    vector x = vector::Zero(n);
    std::vector<int> free;
    for (int i = 0, k = c; i < n; ++i, k /= 3) {
      if (k % 3 == 0) free.push_back(i);
      if (k % 3 == 1) x[i] = p.lower[i];
      if (k % 3 == 2) x[i] = p.upper[i];
    }
    const auto m = static_cast<Eigen::Index>(free.size());
    if (m > 0) {
      matrix h(m, m);
      vector r(m);
      for (Eigen::Index i = 0; i < m; ++i) {
        const int fi = free[static_cast<std::size_t>(i)];
        r[i] = p.g[fi] - p.h.row(fi).dot(x);
        for (Eigen::Index j = 0; j < m; ++j) h(i, j) = p.h(fi, free[static_cast<std::size_t>(j)]);
      }
      const vector y = h.partialPivLu().solve(r);
      for (Eigen::Index i = 0; i < m; ++i) x[free[static_cast<std::size_t>(i)]] = y[i];
    }
    if (((x - p.lower).array() >= -1e-12).all() && ((p.upper - x).array() >= -1e-12).all())
      least = std::min(least, value(p, x));
  }
  return least;
}

TEST_CASE("the minimum in a box is the least of all choices of bounds") {
  random_numbers random(1);
  double worst = 0;
  for (int i = 0; i < 150; ++i) {
    const auto p = random_problem(random, 1 + i % 6, 6, 1e-3);
    const auto m = minimise_in_box(p.h, p.g, p.lower, p.upper);
    REQUIRE(m.optimal);
    const double least = by_enumeration(p);
    worst = test::worse(worst, std::abs(value(p, m.x) - least) / (1 + std::abs(least)));
  }
  CHECK(worst < 2e-14);
}

TEST_CASE("conditions of an optimum hold to rounding, of good and of singular functions") {
  random_numbers random(2);
  int most = 0;
  for (int i = 0; i < 600; ++i) {
    const int n = i % 2 ? 7 : 20;
    const auto p = random_problem(random, n, i % 3 ? n + 1 : n - 2, i % 3 ? 0 : 1e-8);
    const auto m = minimise_in_box(p.h, p.g, p.lower, p.upper);
    REQUIRE(m.optimal);
    most = std::max(most, m.pivots);
    const vector r = p.h * m.x - p.g;
    const double rounding = 4e-14 * p.g.cwiseAbs().maxCoeff();
    for (int k = 0; k < n; ++k) {
      REQUIRE(p.lower[k] <= m.x[k]);
      REQUIRE(m.x[k] <= p.upper[k]);
      if (m.at[k] <= 0) REQUIRE(r[k] >= -rounding);
      if (m.at[k] >= 0) REQUIRE(r[k] <= rounding);
      if (m.at[k] != 0) REQUIRE(m.x[k] == (m.at[k] < 0 ? p.lower[k] : p.upper[k]));
    }
  }
  CHECK(most < 60);
}

TEST_CASE("boxes of a point, without bounds, and functions without curvature") {
  using two = joint_vector<double, 2>;
  const double none = std::numeric_limits<double>::infinity();
  const joint_matrix<double, 2> h{{2.0, 1.0}, {1.0, 2.0}};
  const auto free = minimise_in_box(h, two(3, 0), two(-none, -none), two(none, none));
  CHECK(free.x[0] == within(2, 4e-16));
  CHECK(free.x[1] == within(-1, 4e-16));
  const auto held = minimise_in_box(h, two(3, 0), two(-none, 0.5), two(none, 0.5));
  CHECK(held.x[0] == within(1.25, 4e-16));
  CHECK(held.x[1] == 0.5);
  CHECK(held.optimal);
  const auto flat = minimise_in_box<double, 2>(two(1, 0).asDiagonal(), two(1, 0), two(-1, -1), two(0.5, 1));
  CHECK(flat.x[0] == 0.5);
  CHECK(flat.x[1] == 0);  // nothing pulls it
  CHECK_THROWS_AS(minimise_in_box(h, two(3, 0), two(1, 0), two(0, 1)), bad_argument);
  CHECK_THROWS_AS(
      minimise_in_box(decltype(h)(1e-10 * h), two(1e308, 0), two(-INFINITY, -INFINITY), two(INFINITY, INFINITY)),
      bad_argument);
  CHECK_THROWS_AS(minimise_in_box(h, two(3, std::nan("")), two(0, 0), two(1, 1)), bad_argument);
  CHECK_THROWS_AS(minimise_in_box(h, two(3, 0), two(0, 0), two(std::nan(""), 1)), bad_argument);
}

}  // namespace box_quadratic_program_test
