#include <kte/integrators/dormand_prince45.hpp>
#include <kte/integrators/euler.hpp>
#include <kte/integrators/midpoint.hpp>
#include <kte/integrators/prince_dormand87.hpp>
#include <kte/integrators/runge_kutta4.hpp>
#include <kte/integrators/runge_kutta5.hpp>

#include <boost/multiprecision/cpp_int.hpp>

#include <algorithm>

#include "catch.hpp"
#include "digits50.hpp"
#include "integrators/order_conditions.hpp"

namespace tableau_test {

using namespace kte;

using rational = boost::multiprecision::cpp_rational;

/// Weights of an order, and of no higher one.
template <class Conditions>
void check_order(const Conditions& conditions, const typename Conditions::vector& b, int order,
                 const rational& theta = 1) {
  for (int r = 1; r <= order; ++r) CHECK(conditions.defect(b, r, theta) == 0);
  CHECK(conditions.defect(b, order + 1, theta) != 0);
}

/// A method with fixed steps.
template <class Tableau>
void check_fixed() {
  const test::order_conditions<rational, Tableau> conditions(Tableau::order + 1);
  CHECK(conditions.defect_of_rows() == 0);
  const auto b = conditions.exact(Tableau::weights);
  check_order(conditions, b, Tableau::order);
  auto p = b;
  for (int i = 0; i <= 8; ++i) {
    const rational theta(i, 8);
    rational power = 1;
    for (auto& x : p) x = 0;
    for (const auto& row : Tableau::interpolant) {
      power *= theta;
      const auto w = conditions.exact(row);
      for (std::size_t j = 0; j < p.size(); ++j) p[j] += power * w[j];
    }
    if (i == 8) CHECK(p == b);
    if (i > 0 && i < 8) check_order(conditions, p, Tableau::dense_order, theta);
  }
}

/// A method that chooses its steps.
template <class Tableau>
void check_embedded() {
  const test::order_conditions<rational, Tableau> conditions(std::max(Tableau::order, Tableau::embedded_order) + 1);
  CHECK(conditions.defect_of_rows() == 0);
  const auto b = conditions.exact(Tableau::a.back()), embedded = conditions.exact(Tableau::embedded);
  auto w = b;
  check_order(conditions, b, Tableau::order);
  check_order(conditions, embedded, Tableau::embedded_order);
  CHECK(Tableau::order_of_error == std::min(Tableau::order, Tableau::embedded_order) + 1);
  for (int i = 1; i < 8; ++i) {  // (4) of embedded_runge_kutta
    const rational u(i, 8), r = 1 - u;
    for (std::size_t j = 0; j < b.size(); ++j) w[j] = u * b[j] - u * r * (1 - 2 * u) * b[j];
    w.front() += u * r * r;
    w.back() -= u * u * r;
    if constexpr (requires { Tableau::dense; }) {
      const auto d = conditions.exact(Tableau::dense);
      for (std::size_t j = 0; j < b.size(); ++j) w[j] += u * u * r * r * d[j];
    }
    check_order(conditions, w, Tableau::dense_order, u);
  }
}

using real50 = kte::test::digits50;

/// A tableau and the stages of its extension in one.
template <class Tableau>
struct extended {
  static constexpr std::size_t stages = Tableau::stages + Tableau::extension::stages;
  using row = tableau_row<stages>;
  template <std::size_t N>
  static constexpr row padded(const tableau_row<N>& r) {
    row w{};
    for (std::size_t i = 0; i < N; ++i) w[i] = r[i];
    return w;
  }
  static constexpr std::array<row, stages> all_rows() {
    std::array<row, stages> rows{};
    for (std::size_t i = 0; i < Tableau::stages; ++i) rows[i] = padded(Tableau::a[i]);
    for (std::size_t i = Tableau::stages; i < stages; ++i) rows[i] = Tableau::extension::a[i - Tableau::stages];
    return rows;
  }
  static constexpr row all_times() {
    row w = padded(Tableau::c);
    for (std::size_t i = Tableau::stages; i < stages; ++i) w[i] = Tableau::extension::c[i - Tableau::stages];
    return w;
  }
  static constexpr row c = all_times();
  static constexpr std::array<row, stages> a = all_rows();
};

/// Weights of an order up to the rounding of published fractions, and of no higher one.
template <class Conditions>
void check_rounded_order(const Conditions& conditions, const typename Conditions::vector& b, int order,
                         const real50& theta = 1) {
  for (int r = 1; r <= order; ++r) CHECK(conditions.defect(b, r, theta) < 2e-17);
  CHECK(conditions.defect(b, order + 1, theta) > 1e-7);
}

TEST_CASE("rooted trees") {
  const test::order_conditions<rational, euler_tableau> conditions(8);
  const std::size_t known[]{1, 1, 2, 4, 9, 20, 48, 115};
  for (int r = 1; r <= 8; ++r) CHECK(conditions.count(r) == known[r - 1]);
}

TEST_CASE("methods with fixed steps have their order, at the ends of steps and between them") {
  SECTION("Euler") { check_fixed<euler_tableau>(); }
  SECTION("midpoint") { check_fixed<midpoint_tableau>(); }
  SECTION("Kutta, order 4") { check_fixed<runge_kutta4_tableau>(); }
  SECTION("Butcher, order 5") { check_fixed<runge_kutta5_tableau>(); }
}

TEST_CASE("methods that choose their steps have their orders") {
  SECTION("Dormand and Prince 5(4)") { check_embedded<dormand_prince45_tableau>(); }
}

TEST_CASE("Prince and Dormand 8(7) has its orders, between the ends too, as exactly as its fractions are published") {
  using tableau = prince_dormand87_tableau;
  using whole = extended<tableau>;
  const test::order_conditions<real50, whole> conditions(9);
  CHECK(conditions.count(9) == 286);
  CHECK(conditions.defect_of_rows() < 2e-17);
  const auto b = conditions.exact(whole::padded(tableau::a.back()));
  check_rounded_order(conditions, b, tableau::order);
  check_rounded_order(conditions, conditions.exact(whole::padded(tableau::embedded)), tableau::embedded_order);
  CHECK(tableau::order_of_error == tableau::embedded_order + 1);
  auto w = b;
  for (int i = 1; i < 16; ++i) {  // (4) of embedded_runge_kutta, with (2) of continuous_extension
    const real50 u = real50(i) / 16, r = 1 - u;
    for (std::size_t j = 0; j < b.size(); ++j) w[j] = u * b[j] - u * r * (1 - 2 * u) * b[j];
    w[0] += u * r * r;
    w[tableau::stages - 1] -= u * u * r;
    real50 power = u * u * r * r;
    for (const auto& row : tableau::extension::dense) {
      const auto d = conditions.exact(row);
      for (std::size_t j = 0; j < b.size(); ++j) w[j] += power * d[j];
      power *= u;
    }
    check_rounded_order(conditions, w, tableau::dense_order, u);
  }
}

}  // namespace tableau_test
