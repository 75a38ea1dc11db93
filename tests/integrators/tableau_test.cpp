#include <kte/integrators/dormand_prince45.hpp>

#include <boost/multiprecision/cpp_int.hpp>

#include <vector>

#include "catch.hpp"

using namespace kte;

namespace {

// Butcher's order conditions sum_i b_i phi_i(tree) = 1 / gamma(tree), in exact arithmetic.
using rational = boost::multiprecision::cpp_rational;
using vector = std::vector<rational>;
using tableau = dormand_prince45_tableau;
constexpr std::size_t n = tableau::stages;

rational exact(const ratio& r) { return rational(r.num, r.den); }
vector exact(const tableau::row& w) {
  vector v;
  for (const auto& r : w) v.push_back(exact(r));
  return v;
}
vector operator*(const vector& a, const vector& b) {
  vector v(n);
  for (std::size_t i = 0; i < n; ++i) v[i] = a[i] * b[i];
  return v;
}
vector operator-(vector a, const vector& b) {
  for (std::size_t i = 0; i < n; ++i) a[i] -= b[i];
  return a;
}
rational sum(const vector& a) {
  rational s = 0;
  for (const auto& x : a) s += x;
  return s;
}
vector A(const vector& x) {
  vector v(n);
  for (std::size_t i = 0; i < n; ++i) v[i] = sum(exact(tableau::a[i]) * x);
  return v;
}

struct tree {
  int order;
  int gamma;
  vector phi;
};
std::vector<tree> trees() {
  const vector c = exact(tableau::c), one(n, 1);
  return {{1, 1, one},           {2, 2, c},
          {3, 3, c * c},         {3, 6, A(c)},
          {4, 4, c * c * c},     {4, 8, c * A(c)},
          {4, 12, A(c * c)},     {4, 24, A(A(c))},
          {5, 5, c * c * c * c}, {5, 10, c * c * A(c)},
          {5, 20, A(c) * A(c)},  {5, 15, c * A(c * c)},
          {5, 30, c * A(A(c))},  {5, 20, A(c * c * c)},
          {5, 40, A(c * A(c))},  {5, 60, A(A(c * c))},
          {5, 120, A(A(A(c)))}};
}

/// How many conditions of an order the weights break at theta.
int broken(const vector& b, int order, const rational& theta = 1) {
  int count = 0;
  for (const auto& t : trees()) {
    if (t.order != order) continue;
    rational power = 1;
    for (int i = 0; i < order; ++i) power *= theta;
    count += sum(b * t.phi) != power / t.gamma;
  }
  return count;
}

TEST_CASE("Dormand-Prince: rows of the tableau sum to its times") {
  for (std::size_t i = 0; i < n; ++i) CHECK(sum(exact(tableau::a[i])) == exact(tableau::c[i]));
}

TEST_CASE("Dormand-Prince: the solution has order 5, the embedded one order 4") {
  const vector b = exact(tableau::a.back()), embedded = b - exact(tableau::error);
  for (int order = 1; order <= 5; ++order) CHECK(broken(b, order) == 0);
  for (int order = 1; order <= 4; ++order) CHECK(broken(embedded, order) == 0);
  CHECK(broken(embedded, 5) > 0);
}

TEST_CASE("Dormand-Prince: the dense output has order 4 everywhere") {
  const vector b = exact(tableau::a.back()), d = exact(tableau::dense);
  for (int i = 0; i <= 8; ++i) {
    const rational u(i, 8), r = 1 - u;
    vector w(n);
    for (std::size_t j = 0; j < n; ++j)
      w[j] = u * b[j] - u * r * (1 - 2 * u) * b[j] + u * u * r * r * d[j];  // (4) of embedded_runge_kutta
    w.front() += u * r * r;
    w.back() -= u * u * r;
    for (int order = 1; order <= 4; ++order) CHECK(broken(w, order, u) == 0);
    CHECK((broken(w, 5, u) == 0) == (i == 0 || i == 8));
  }
}

}  // namespace
