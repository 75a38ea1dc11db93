#include <kte/integrators/bogacki_shampine23.hpp>
#include <kte/integrators/dormand_prince45.hpp>
#include <kte/integrators/euler.hpp>
#include <kte/integrators/fehlberg45.hpp>
#include <kte/integrators/midpoint.hpp>
#include <kte/integrators/runge_kutta4.hpp>
#include <kte/integrators/runge_kutta5.hpp>

#include <boost/multiprecision/cpp_int.hpp>

#include <algorithm>

#include "catch.hpp"
#include "integrators/order_conditions.hpp"

using namespace kte;

namespace {

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

}  // namespace

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
  SECTION("Bogacki and Shampine 3(2)") { check_embedded<bogacki_shampine23_tableau>(); }
  SECTION("Fehlberg 4(5)") { check_embedded<fehlberg45_tableau>(); }
  SECTION("Dormand and Prince 5(4)") { check_embedded<dormand_prince45_tableau>(); }
}
