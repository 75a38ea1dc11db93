#include <kte/integrators/kennedy_carpenter34.hpp>
#include <kte/integrators/rodas.hpp>
#include <kte/integrators/rosenbrock23.hpp>
#include <kte/integrators/tr_bdf2.hpp>
#include <kte/integrators/trapezoidal.hpp>

#include "catch.hpp"
#include "integrators/implicit_conditions.hpp"

namespace implicit_coefficients_test {

using namespace kte;
using kte::test::real50;

/// How far the largest entries, about 35 and known to 19 digits, may miss a condition: the sums are shorter than 10
/// times that. Exact coefficients miss it by far less.
const real50 rounding = 1e-17;

/// Weights of an order, and of no higher one.
template <class Method, class V>
void check_order(const Method& method, const V& b, int order, const real50& theta = 1) {
  for (int p = 1; p <= order; ++p) CHECK(method.defect(b, p, theta) < rounding);
  if (order < 4) CHECK(method.defect(b, order + 1, theta) > 1e-5);
}
template <class Method, class V>
double growth(const Method& method, const V& b, const std::complex<double>& z) {
  return std::abs(method.growth(b, z));
}
/// |R| <= 1 on the imaginary axis, and far out |R(z)| = 1, or about 10 / |z| at most.
template <class Method, class V>
void check_stability(const Method& method, const V& b, bool damps) {
  for (double y = 1e-3; y < 1e6; y *= 1.1) CHECK(growth(method, b, {0, y}) < 1 + 1e-9);
  CHECK(growth(method, b, -1e6) == within(damps ? 0.0 : 1.0, 1e-5));
}

/// The coefficients of the slopes k, from those of u = h Gamma k.
template <class Coefficients>
struct slopes {
  static constexpr auto stages = Coefficients::stages;
  static constexpr int n = static_cast<int>(stages);
  using vector = typename test::implicit_method<stages>::vector;
  using matrix = typename test::implicit_method<stages>::matrix;

  decltype(Coefficients::template table<real50>()) table = Coefficients::template table<real50>();
  matrix inverse = matrix::Identity() / table.gamma - test::matrix_of(table.c);
  matrix Gamma = inverse.inverse();
  matrix A = test::matrix_of(table.a) * Gamma;
  test::implicit_method<stages> method{A, A + Gamma};

  vector weights(const std::array<real50, stages>& of_u) const { return Gamma.transpose() * test::vector_of(of_u); }
  vector solution() const { return weights(table.m); }
  vector embedded() const { return solution() - weights(table.e); }
  vector dense(const real50& theta) const {
    vector b = vector::Zero();
    real50 power = 1;
    for (const auto& row : table.dense) b += (power *= theta) * weights(row);
    return b;
  }
};

template <class Coefficients>
void check_rosenbrock() {
  const slopes<Coefficients> s;
  check_order(s.method, s.solution(), Coefficients::order);
  check_order(s.method, s.embedded(), Coefficients::embedded_order);
  CHECK(Coefficients::order_of_error == std::min(Coefficients::order, Coefficients::embedded_order) + 1);
  CHECK((s.A.rowwise().sum() - test::vector_of(s.table.alpha)).norm() < rounding);
  CHECK((s.Gamma.rowwise().sum() - test::vector_of(s.table.gammas)).norm() < rounding);
  for (int i = 1; i < 8; ++i) check_order(s.method, s.dense(real50(i) / 8), Coefficients::dense_order, real50(i) / 8);
  CHECK((s.dense(1) - s.solution()).norm() < rounding);
  CHECK((s.A.row(s.n - 1).transpose() - s.solution()).isZero(1e-17) == Coefficients::first_same_as_last);
  check_stability(s.method, s.solution(), true);
}

template <class Tableau>
void check_esdirk() {
  const auto table = Tableau::template table<real50>();
  const auto A = test::matrix_of(table.a);
  const test::implicit_method<Tableau::stages> method{A, A};
  using vector = typename decltype(method)::vector;
  const vector b = A.row(method.n - 1);
  check_order(method, b, Tableau::order);
  check_stability(
      method, b, !requires { Tableau::error_constant; });
  CHECK((A * vector::Ones() - test::vector_of(table.c)).norm() < rounding);
  for (int i = 0; i < method.n; ++i) CHECK(A(i, i) == (i == 0 ? real50(0) : table.gamma));
  for (int i = 1; i < 8; ++i) {  // hermite_cubic
    const real50 u = real50(i) / 8, r = 1 - u;
    vector w = (u + u * r * (u - r)) * b;
    w[0] += u * r * r;
    w[method.n - 1] -= u * u * r;
    check_order(method, w, Tableau::dense_order, u);
  }
  if constexpr (requires { Tableau::embedded_order; }) {
    check_order(method, vector(b - test::vector_of(table.e)), Tableau::embedded_order);
    CHECK(Tableau::order_of_error == std::min(Tableau::order, Tableau::embedded_order) + 1);
  }
}

TEST_CASE("Rosenbrock methods have their orders, at the ends of steps and between them, and are L-stable") {
  SECTION("Shampine and Reichelt 2(3)") { check_rosenbrock<rosenbrock23_coefficients>(); }
  SECTION("RODAS 4(3)") { check_rosenbrock<rodas_coefficients>(); }
}

TEST_CASE("rosenbrock23 is of order 2 with any matrix instead of the Jacobian") {
  const slopes<rosenbrock23_coefficients> s;
  const auto b = s.solution(), one = decltype(b)(b.Ones());
  CHECK(abs(b.dot(s.A * one) - 0.5) < rounding);
  CHECK(abs(b.dot(s.Gamma * one)) < rounding);
}

TEST_CASE("RODAS has the stages of a stiffly accurate method") {
  const slopes<rodas_coefficients> s;
  CHECK((s.method.B.row(5).transpose() - s.solution()).norm() < rounding);
  CHECK((s.method.B.row(4).transpose() - s.embedded()).norm() < rounding);
}

TEST_CASE("diagonally implicit methods have their orders, at the ends of steps and between them, and are stable") {
  SECTION("TR-BDF2") { check_esdirk<tr_bdf2_tableau>(); }
  SECTION("trapezoidal rule") { check_esdirk<trapezoidal_tableau>(); }
  SECTION("Kennedy and Carpenter 4(3)") { check_esdirk<kennedy_carpenter34_tableau>(); }
}

}  // namespace implicit_coefficients_test
