#pragma once

#include <kte/errors.hpp>
#include <kte/math/derivatives_of.hpp>
#include <kte/math/plain_scalar.hpp>
#include <kte/math/select.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <memory>
#include <utility>
#include <vector>

namespace kte {

/// A height z = h(x, y), m, through a grid of heights: a natural bicubic spline, twice continuously differentiable.
/// Beyond the grid it continues along its slopes. Copies share its numbers. For `height_field`:
///
///   height_field(height_grid({.x = -1, .y = -2, .step_x = 0.1, .step_y = 0.1, .columns = 21}, heights))
///
/// With the cubic B-spline b and coefficients c_ij, u = (x - x_0)/step_x, w = (y - y_0)/step_y:
///
///   h = sum c_ij b(u - j) b(w - i),   (c_{k-1} + 4 c_k + c_{k+1})/6 = h_k,   second derivatives 0 at the edges (1)
class height_grid {
 public:
  /// The place of the grid: its first point, the steps between points, and the number of points in a row.
  struct layout {
    double x, y;            ///< of the first height, m
    double step_x, step_y;  ///< m; positive
    std::size_t columns;    ///< along x
  };
  /// Heights in rows along x, the rows along y; at least two in both directions. Throws `bad_argument`.
  height_grid(const layout& at, const std::vector<double>& heights)
      : at_(at), rows_(at.columns == 0 ? 0 : heights.size() / at.columns) {
    const auto require = [](bool ok, const char* why) {
      if (!ok) detail::raise<bad_argument>(std::string("kte: a height_grid ") + why);
    };
    require(at.columns > 1 && rows_ > 1 && heights.size() == at.columns * rows_,
            "needs full rows of heights, two or more in both directions");
    require(at.step_x > 0 && at.step_y > 0 && std::isfinite(at.step_x) && std::isfinite(at.step_y),
            "needs finite and positive steps");
    require(std::isfinite(at.x) && std::isfinite(at.y), "needs a finite first point");
    require(std::all_of(heights.begin(), heights.end(), [](double h) { return std::isfinite(h); }),
            "needs finite heights");
    prepare(heights);
  }

  template <class X, class Y>
  auto operator()(const X& x, const Y& y) const {
    using T = decltype(x + y);
    static_assert(
        !requires { T::lanes; }, "kte: a height_grid takes no packs");
    const auto [u, beyond_x] = clamped(T(T(x - T(at_.x)) / T(at_.step_x)), at_.columns);
    const auto [w, beyond_y] = clamped(T(T(y - T(at_.y)) / T(at_.step_y)), rows_);
    const auto in = cell_at<typename detail::derivatives_of<T>::plain>(detail::as_double(u), detail::as_double(w));
    const T s = T(u - T(in.u)), t = T(w - T(in.w));
    T lines[4], slopes[4];
    for (std::size_t m = 0; m < 4; ++m) lines[m] = cubic(in.c[m], t);
    const T h = cubic(lines, s);
    if (beyond_x == T(0) && beyond_y == T(0)) return h;
    for (std::size_t m = 0; m < 4; ++m) slopes[m] = slope_of_cubic(in.c[m], t);
    return T(h + slope_of_cubic(lines, s) * beyond_x + cubic(slopes, s) * beyond_y);
  }

 private:
  /// The polynomial of a cell: h = sum c_mn s^m t^n, s = u - u_0, t = w - w_0. Its numbers have no derivatives.
  template <class L>
  struct cell {
    double u, w;  ///< u_0, w_0
    L c[4][4];
  };
  /// The cell about u, w: (1) with 6 b as polynomials of the place in the cell.
  template <class L>
  cell<L> cell_at(double u, double w) const {
    constexpr int basis[4][4]{{1, -3, 3, -1}, {4, 0, -6, 3}, {1, 3, 3, -3}, {0, 0, 0, 1}};
    const std::size_t j = first(u, at_.columns), i = first(w, rows_);
    cell<L> in{static_cast<double>(j), static_cast<double>(i), {}};
    for (std::size_t m = 0; m < 4; ++m)
      for (std::size_t n = 0; n < 4; ++n) {
        L sum(0);
        for (std::size_t p = 0; p < 4; ++p)
          for (std::size_t q = 0; q < 4; ++q)
            sum += L((*coefficients_)[(i + p) * (at_.columns + 2) + j + q]) * L(basis[q][m] * basis[p][n]);
        in.c[m][n] = L(sum / L(36));
      }
    return in;
  }
  /// The first point of the cell about u.
  static std::size_t first(double u, std::size_t points) {
    return (std::min)(static_cast<std::size_t>((std::max)(std::floor(u), 0.0)), points - 2);
  }
  // By Horner's rule; not inlined, because products of numbers with second derivatives are long.
  template <class C, class T>
  [[gnu::noinline]] static T cubic(const C (&c)[4], const T& x) {
    return T(T(T(x * c[3] + c[2]) * x + c[1]) * x + c[0]);
  }
  template <class C, class T>
  [[gnu::noinline]] static T slope_of_cubic(const C (&c)[4], const T& x) {
    return T(T(x * T(C(3) * c[3]) + C(2) * c[2]) * x + c[1]);
  }
  /// u within the grid, and how far it was beyond.
  template <class T>
  static std::pair<T, T> clamped(const T& u, std::size_t points) {
    const T last(static_cast<double>(points - 1)), in = select(u < T(0), T(0), T(select(u > last, last, u)));
    return {in, T(u - in)};
  }
  void prepare(const std::vector<double>& heights) {
    const std::size_t width = at_.columns + 2;
    std::vector<double> c(width * (rows_ + 2), 0.0);
    for (std::size_t i = 0; i < rows_; ++i) {
      for (std::size_t j = 0; j < at_.columns; ++j) c[(i + 1) * width + j + 1] = heights[i * at_.columns + j];
      solve(&c[(i + 1) * width], at_.columns, 1);
    }
    for (std::size_t j = 0; j < width; ++j) solve(&c[j], rows_, width);
    coefficients_ = std::make_shared<const std::vector<double>>(std::move(c));
  }
  /// Replaces heights at places 1 to n by coefficients at 0 to n + 1, by (1).
  static void solve(double* line, std::size_t n, std::size_t stride) {
    const auto c = [&](std::size_t k) -> double& { return line[k * stride]; };
    std::vector<double> factor(n + 2, 0.0);
    for (std::size_t k = 2; k < n; ++k) {
      factor[k] = 1 / (4 - factor[k - 1]);
      c(k) = (6 * c(k) - c(k - 1)) * factor[k];
    }
    for (std::size_t k = n - 1; k > 1; --k) c(k) -= factor[k] * c(k + 1);
    c(0) = 2 * c(1) - c(2), c(n + 1) = 2 * c(n) - c(n - 1);
  }

  layout at_;
  std::size_t rows_;
  std::shared_ptr<const std::vector<double>> coefficients_;
};

}  // namespace kte
