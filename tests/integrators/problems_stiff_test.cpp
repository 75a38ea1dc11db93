#include <Eigen/LU>

#include <algorithm>
#include <array>
#include <cmath>

#include "catch.hpp"
#include "data/problems/hires.hpp"
#include "data/problems/orego.hpp"
#include "data/problems/rober.hpp"
#include "data/problems/vdpol.hpp"
#include "integrators/any_system.hpp"
#include "random.hpp"

namespace problems_stiff_test {

// The stiff problems of data/problems: their Jacobians by differences, and their references by a simple implicit method
// of high order.

using namespace kte::problems;
using stiff_problem = kte::test::any_system<long double>;
using state = stiff_problem::state;
using matrix = stiff_problem::matrix;

/// No right-hand side has more than the square of one of its variables, so central differences are exact but for
/// rounding, eps |f| / h: with states below 3, |f| below 3e8, eps = 1.1e-19 and h = 1/64 that is 2e-9.
void check_jacobian(const stiff_problem& f, int size) {
  random_numbers random(1);
  state x(size);
  for (auto& e : x) e = 2 + random();
  const long double h = 1 / 64.0L;
  matrix J, differences(size, size);
  f.jacobian(0.0L, x, J);
  for (int i = 0; i < size; ++i) {
    const state e = h * state::Unit(size, i);
    differences.col(i) = (f(0.0L, x + e) - f(0.0L, x - e)) / (2 * h);
  }
  CHECK(static_cast<double>((J - differences).cwiseAbs().maxCoeff()) < 2e-9);
}

/// A step h by the linearly implicit Euler method in 1, 2, ... 10 parts, extrapolated:
///
///   (1 - h/n J) (x_{i+1} - x_i) = h/n f(x_i),   T_{j,1} = x_{n_j}                            (1)
///   T_{j,k+1} = T_{j,k} + (T_{j,k} - T_{j-1,k}) / (n_j / n_{j-k} - 1)                        (2)
///
/// Hairer and Wanner, Solving Ordinary Differential Equations II, 1996, IV.9. Puts the step's end into x, and returns
/// what the last extrapolation changed, in units of |x| + smallest.
long double implicit_step(const stiff_problem& f, long double h, long double smallest, state& x) {
  constexpr int columns = 10;
  matrix J;
  f.jacobian(0.0L, x, J);
  std::array<state, columns> row;  // T_{j,1} ... of the last j, backward: row[n] came from n + 1 parts on
  long double error = 0;
  for (int j = 0; j < columns; ++j) {
    const long double part = h / (j + 1);
    const Eigen::PartialPivLU<matrix> lu(matrix::Identity(J.rows(), J.cols()) - part * J);
    state y = x;
    for (int i = 0; i <= j; ++i) y += lu.solve(part * f(0.0L, y));  // (1)
    row[std::size_t(j)] = y;
    for (int k = j - 1; k >= 0; --k) {
      const state change = (row[std::size_t(k + 1)] - row[std::size_t(k)]) / ((j + 1.0L) / (k + 1.0L) - 1);  // (2)
      error = (change.array().abs() / (x.array().abs() + smallest)).maxCoeff();
      row[std::size_t(k)] = row[std::size_t(k + 1)] + change;
    }
  }
  x = row[0];
  return error;
}
/// To the end with steps that keep that change below the tolerance.
state integrate(const stiff_problem& f, state x, long double t_end, long double smallest, long double tolerance) {
  long double t = 0, h = 1e-6L;
  while (t < t_end) {
    h = std::min(h, t_end - t);
    auto y = x;
    const auto error = implicit_step(f, h, smallest, y);
    if (error < tolerance) t = h < t_end - t ? t + h : t_end, x = y;
    h *= std::clamp(0.9L * std::pow(tolerance / error, 0.1L), 0.1L, 4.0L);
  }
  return x;
}
template <class Problem>
stiff_problem system_of() {
  return kte::test::system_with_jacobian_of<Problem, long double>();
}

TEST_CASE("Jacobians of the stiff problems are those of their right-hand sides") {
  check_jacobian(system_of<hires<long double>>(), 8);
  check_jacobian(system_of<vdpol<long double>>(), 2);
  check_jacobian(system_of<orego<long double>>(), 3);
  check_jacobian(system_of<rober<long double>>(), 3);
}

// A tolerance of 1e-14 lets a step err by less, as the change is that of the column before. Rounding is larger: weights
// of the extrapolation, of size 10^10 / 10! and there are some ten of them, make 3e-15 of eps = 1e-19 a step, and some
// 500 steps could sum to 1e-12. A digit is left for the matrices, whose entries cancel.
TEMPLATE_TEST_CASE("references of the stiff problems agree with an implicit method of order 10", "[long]",
                   hires<long double>, orego<long double>, rober<long double>, vdpol<long double>) {
  for (const auto& r : TestType::references) {
    UNSCOPED_INFO(TestType::name << " at " << static_cast<double>(r.time));
    CHECK(scd(integrate(system_of<TestType>(), TestType::start(), r.time, 1e-18L, 1e-14L), r.values) > 11);
  }
}

}  // namespace problems_stiff_test
