#include <kte/dynamics/closed_loops/pivoted_qr.hpp>

#include <Eigen/LU>

#include <algorithm>

#include "catch.hpp"
#include "random.hpp"

namespace pivoted_qr_test {

using namespace kte;
using namespace kte::test;
using detail::pivoted_qr;

using matrix = Eigen::MatrixXd;

double largest(const matrix& m) { return m.size() == 0 ? 0 : m.cwiseAbs().maxCoeff(); }

/// Loops in a row: closure i has two columns with entries in the rows 2 i to 2 i + 2, in a random order of columns and
/// rows. `again`: number of columns that are sums of two others.
matrix loops_in_a_row(int loops, int again, random_numbers& draw) {
  const int n = 2 * loops + 1, m = 2 * loops + again;
  std::vector<int> row(static_cast<std::size_t>(n)), column(static_cast<std::size_t>(m));
  const auto shuffle = [&draw](std::vector<int>& x) {
    for (std::size_t i = 0; i < x.size(); ++i) x[i] = static_cast<int>(i);
    for (std::size_t i = x.size(); i-- > 1;) std::swap(x[i], x[std::size_t(0.4999 * (draw() + 1) * double(i + 1))]);
  };
  shuffle(row), shuffle(column);
  matrix b = matrix::Zero(n, m);
  const auto at = [&](int i, int j) -> double& { return b(row[std::size_t(i)], column[std::size_t(j)]); };
  for (int i = 0; i < loops; ++i)
    for (int k = 0; k < 2; ++k)
      for (int r = 0; r < 3; ++r) at(2 * i + r, 2 * i + k) = draw();
  for (int k = 0; k < again; ++k)
    for (int r = 0; r < n; ++r) at(r, 2 * loops + k) = at(r, 2 * k) + at(r, 2 * k + 1);
  return b;
}
void check(const matrix& b, Eigen::Index rank) {
  pivoted_qr qr;
  for (int twice = 0; twice < 2; ++twice) {  // in the memory of the first
    qr.matrix(b.rows(), b.cols()) = b;
    qr.choose(1e-10);
    REQUIRE(qr.rank() == rank);
    const matrix q = qr.q(), r = qr.r();
    CHECK(largest(q.transpose() * q - matrix::Identity(rank, rank)) < 1e-14);
    matrix chosen(b.rows(), rank);
    for (Eigen::Index k = 0; k < rank; ++k) chosen.col(k) = b.col(qr.chosen[std::size_t(k)]);
    CHECK(largest(q * r - chosen) < 1e-14);
    CHECK(largest(b - q * (q.transpose() * b)) < 1e-13);
    const auto d = r.diagonal().cwiseAbs();
    CHECK((qr.largest == d.maxCoeff() && qr.smallest == d.minCoeff()));
    for (Eigen::Index k = 1; k < rank; ++k) CHECK(d[k] < d[k - 1] * (1 + 1e-14));

    Eigen::VectorXd x = Eigen::VectorXd::LinSpaced(rank, -1, 2), y = x;
    qr.solve(y.data());
    CHECK(largest(r.triangularView<Eigen::Upper>() * y - x) < 1e-12);
    y = x;
    qr.solve_transposed(y.data());
    CHECK(largest(r.transpose() * y - x) < 1e-12);
    y = Eigen::VectorXd::Zero(b.rows() + pivoted_qr::padding);
    y.head(b.rows()) = q * x;
    qr.times_q_transposed(y.data());
    CHECK(largest(y.head(rank) - x) < 1e-13);
  }
}

TEST_CASE("pivoted QR of full matrices, and of loops in a row") {
  random_numbers draw(5);
  check(matrix::NullaryExpr(5, 3, [&] { return draw(); }), 3);
  check(matrix::NullaryExpr(3, 5, [&] { return draw(); }), 3);
  check(matrix::NullaryExpr(30, 20, [&] { return draw(); }), 20);
  for (const int loops : {3, 6, 7, 31, 40}) {
    INFO(loops << " loops");
    check(loops_in_a_row(loops, 0, draw), 2 * loops);
    check(loops_in_a_row(loops, loops / 2, draw), 2 * loops);
  }
}

TEST_CASE("a given order of columns, and columns that are dependent") {
  random_numbers draw(6);
  for (const int loops : {3, 20}) {
    const matrix b = loops_in_a_row(loops, 1, draw);
    std::vector<int> columns;
    pivoted_qr qr;
    qr.matrix(b.rows(), b.cols()) = b;
    qr.choose(1e-10);
    columns = qr.chosen;
    std::reverse(columns.begin(), columns.end());
    const auto take = [&](const std::vector<int>& these) {
      auto m = qr.matrix(b.rows(), static_cast<Eigen::Index>(these.size()));
      for (std::size_t k = 0; k < these.size(); ++k) m.col(Eigen::Index(k)) = b.col(these[k]);
      return qr.take(these, 1e-10);
    };
    CHECK(take(columns));
    CHECK(qr.chosen == columns);
    const matrix q = qr.q(), r = qr.r();
    for (std::size_t k = 0; k < columns.size(); ++k)
      CHECK(largest(q * r.col(Eigen::Index(k)) - b.col(columns[k])) < 1e-14);
    std::vector<int> all;
    for (int j = 0; j < b.cols(); ++j) all.push_back(j);
    CHECK(!take(all));
    columns.back() = columns.front();
    CHECK(!take(columns));
    qr.matrix(b.rows(), 2).setZero();
    CHECK(!qr.take({0, 1}, 1e-10));
  }
}

}  // namespace pivoted_qr_test
