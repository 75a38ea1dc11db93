#include <kte/tree/fill_matrix.hpp>
#include <kte/tree/solve_limbs.hpp>

#include "catch.hpp"
#include "random.hpp"

namespace solve_limbs_test {

// Matrices over axes that know which bodies stand on each other.
using kte::tree::body_tree;

/// A body of `axes` axes on body `parent` (-1: the base), the next one in order.
void add(body_tree<double>& f, int parent, int axes) {
  kte::tree::body_node<double> r;
  r.parent = f.bases + parent, r.first = static_cast<int>(f.axes()), r.axes = axes, r.last = r.first + axes;
  for (int k = 0; k < axes; ++k) f.row.push_back(r.first + k);
  if (parent >= 0 && parent + 1 != static_cast<int>(f.nodes.size()))
    f.nodes[static_cast<std::size_t>(parent)].branches = true;
  for (int p = parent; p >= 0; p = f.nodes[static_cast<std::size_t>(p)].parent - f.bases)
    f.nodes[static_cast<std::size_t>(p)].last = r.last;
  f.nodes.push_back(r);
}
/// A trunk of six axes with legs of `joints` each.
body_tree<double> walker(int legs, int joints) {
  body_tree<double> f;
  f.bases = 1;
  add(f, -1, 6);
  for (int leg = 0; leg < legs; ++leg)
    for (int k = 0; k < joints; ++k) add(f, k == 0 ? 0 : static_cast<int>(f.nodes.size()) - 1, 1);
  return f;
}
body_tree<double> arm(int joints) {
  body_tree<double> f;
  f.bases = 1;
  for (int k = 0; k < joints; ++k) add(f, k - 1, 1);
  return f;
}
/// Whether one of the bodies of two axes stands on the other.
bool related(const body_tree<double>& f, int j, int k) {
  for (const auto& r : f.nodes)
    if ((r.first <= j && j < r.first + r.axes && r.first <= k && k < r.last) ||
        (r.first <= k && k < r.first + r.axes && r.first <= j && j < r.last))
      return true;
  return false;
}

void check_solved(const body_tree<double>& f, bool coupled) {
  const int n = static_cast<int>(f.axes());
  random_numbers draw(7);
  Eigen::MatrixXd inverse(n, n), b(n, n), c(n, n), x(n, n), y(n, n);
  for (int j = 0; j < n; ++j)
    for (int k = 0; k < n; ++k) {
      inverse(j, k) = draw();
      const bool anything = coupled || related(f, j, k);
      b(j, k) = anything ? draw() : 0.0, c(j, k) = anything ? draw() : 0.0;
    }
  x.setConstant(17), y.setConstant(17);
  std::vector<int> rows;
  kte::tree::solve_limbs(f, coupled, rows, inverse.data(), b.data(), c.data(), x.data(), y.data());
  INFO(n);
  CHECK((x + inverse * b).cwiseAbs().maxCoeff() <= 2.3e-16 * n * n);
  CHECK((y + inverse * c).cwiseAbs().maxCoeff() <= 2.3e-16 * n * n);
}

TEST_CASE("products with the inverse of a mass matrix leave out bodies that have nothing in common") {
  for (const int joints : {1, 2, 3, 4, 5, 7, 9}) check_solved(arm(joints), false), check_solved(arm(joints), true);
  for (const int legs : {1, 2, 4})
    for (const int joints : {1, 2, 3, 4, 5}) {
      check_solved(walker(legs, joints), false);
      check_solved(walker(legs, joints), true);
    }
}

TEST_CASE("symmetric matrices from rows over axes") {
  body_tree<double> f = walker(2, 3);
  const int n = static_cast<int>(f.axes());
  random_numbers draw(8);
  kte::tree::axis_rows<double> rows;
  rows.resize(f.axes(), f.axes());
  Eigen::MatrixXd of_tree = Eigen::MatrixXd::Zero(n, n), of_all(n, n), m;
  for (int j = 0; j < n; ++j)
    for (int k = j; k < n; ++k) {
      rows[j][k] = of_all(j, k) = of_all(k, j) = draw();
      if (related(f, j, k)) of_tree(j, k) = of_tree(k, j) = rows[j][k];
    }
  for (int j = 1; j < n; ++j) rows[j][0] = std::nan("");  // below the diagonal anything may stand
  kte::tree::fill_symmetric(f, n, rows, false, m);
  CHECK(m == of_tree);
  kte::tree::fill_symmetric(f, n, rows, true, m);
  CHECK(m == of_all);

  // Coordinates in another order, without the last one, and two axes on one.
  f.in_order = false;
  for (int k = 0; k < n; ++k) f.row[static_cast<std::size_t>(k)] = n - 1 - k;
  kte::tree::fill_symmetric(f, n - 1, rows, true, m);
  CHECK(m == of_all.reverse().topLeftCorner(n - 1, n - 1));
  f.row.assign(static_cast<std::size_t>(n), 0);
  kte::tree::fill_symmetric(f, 1, rows, true, m);
  CHECK(m(0, 0) == within(of_all.sum(), 1e-14));
}

}  // namespace solve_limbs_test
