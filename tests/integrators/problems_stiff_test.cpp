#include <Eigen/LU>

#include <algorithm>
#include <array>
#include <cmath>

#include "catch.hpp"
#include "data/problems/hires.hpp"
#include "data/problems/orego.hpp"
#include "data/problems/rober.hpp"
#include "data/problems/vdpol.hpp"
#include "random.hpp"

// The stiff problems of data/problems: their Jacobians by differences, and their references by a simple implicit method
// of high order.

namespace problems_stiff_test {

using namespace kte::problems;

/// No right-hand side has more than the square of one of its variables, so central differences are exact but for
/// rounding, eps |f| / h: with states below 3, |f| below 3e8, eps = 1.1e-19 and h = 1/64 that is 2e-9.
template <class Problem>
void check_jacobian(const Problem& f) {
  random_numbers random(1);
  typename Problem::state x;
  for (auto& e : x) e = 2 + random();
  const long double h = 1 / 64.0L;
  typename Problem::matrix J, differences;
  f.jacobian(0.0L, x, J);
  for (int i = 0; i < Problem::size; ++i) {
    const typename Problem::state e = h * Problem::state::Unit(i);
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
template <class Problem>
long double implicit_step(const Problem& f, long double h, long double smallest, typename Problem::state& x) {
  using state = typename Problem::state;
  using matrix = typename Problem::matrix;
  constexpr int columns = 10;
  matrix J;
  f.jacobian(0.0L, x, J);
  std::array<state, columns> row;  // T_{j,1} ... of the last j, backward: row[n] came from n + 1 parts on
  long double error = 0;
  for (int j = 0; j < columns; ++j) {
    const long double part = h / (j + 1);
    const Eigen::PartialPivLU<matrix> lu(matrix::Identity() - part * J);
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
template <class Problem>
typename Problem::state integrate(const Problem& f, long double t_end, long double smallest, long double tolerance) {
  auto x = f.start();
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

TEST_CASE("Jacobians of the stiff problems are those of their right-hand sides") {
  check_jacobian(hires<long double>{});
  check_jacobian(vdpol<long double>{});
  check_jacobian(orego<long double>{});
  check_jacobian(rober<long double>{});
}

// A tolerance of 1e-14 lets a step err by less, as the change is that of the column before. Rounding is larger: weights
// of the extrapolation, of size 10^10 / 10! and there are some ten of them, make 3e-15 of eps = 1e-19 a step, and some
// 500 steps could sum to 1e-12. A digit is left for the matrices, whose entries cancel.
TEMPLATE_TEST_CASE("references of the stiff problems agree with an implicit method of order 10", "[long]",
                   hires<long double>, orego<long double>, rober<long double>, vdpol<long double>) {
  for (const auto& r : TestType::references) {
    UNSCOPED_INFO(TestType::name << " at " << static_cast<double>(r.time));
    CHECK(scd(integrate(TestType{}, r.time, 1e-18L, 1e-14L), r.values) > 11);
  }
}

}  // namespace problems_stiff_test
