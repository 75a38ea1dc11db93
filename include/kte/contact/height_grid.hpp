#pragma once

#include <kte/errors.hpp>
#include <kte/math/plain_scalar.hpp>
#include <kte/math/select.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

namespace kte {

/// A height z = h(x, y), m, through a grid of heights: a natural bicubic spline, twice continuously differentiable.
/// Beyond the grid it continues along its slopes. For `height_field`:
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
    const auto a = weights(u, at_.columns), b = weights(w, rows_);
    T h(0), by_u(0), by_w(0);
    for (std::size_t i = 0; i < 4; ++i)
      for (std::size_t j = 0; j < 4; ++j) {
        const T c(coefficients_[(b.first + i) * (at_.columns + 2) + a.first + j]);
        h = T(h + c * b.value[i] * a.value[j]);
        by_u = T(by_u + c * b.value[i] * a.slope[j]), by_w = T(by_w + c * b.slope[i] * a.value[j]);
      }
    return T(h + by_u * beyond_x + by_w * beyond_y);
  }

 private:
  template <class T>
  struct four {
    std::size_t first;
    T value[4], slope[4];
  };
  /// u within the grid, and how far it was beyond.
  template <class T>
  static std::pair<T, T> clamped(const T& u, std::size_t points) {
    const T last(static_cast<double>(points - 1)), in = select(u < T(0), T(0), T(select(u > last, last, u)));
    return {in, T(u - in)};
  }
  template <class T>
  static four<T> weights(const T& u, std::size_t points) {
    const double place = std::floor(detail::as_double(u));
    const std::size_t k = (std::min)(static_cast<std::size_t>((std::max)(place, 0.0)), points - 2);
    const T t = T(u - T(static_cast<double>(k))), s = T(T(1) - t), sixth = T(T(1) / T(6)), half(0.5);
    return {k,
            {T(sixth * s * s * s), T(sixth * (T(4) + t * t * (T(3) * t - T(6)))),
             T(sixth * (T(4) + s * s * (T(3) * s - T(6)))), T(sixth * t * t * t)},
            {T(-(half * s * s)), T(t * (T(1.5) * t - T(2))), T(-(s * (T(1.5) * s - T(2)))), T(half * t * t)}};
  }
  void prepare(const std::vector<double>& heights) {
    const std::size_t width = at_.columns + 2;
    coefficients_.assign(width * (rows_ + 2), 0.0);
    for (std::size_t i = 0; i < rows_; ++i) {
      for (std::size_t j = 0; j < at_.columns; ++j)
        coefficients_[(i + 1) * width + j + 1] = heights[i * at_.columns + j];
      solve(&coefficients_[(i + 1) * width], at_.columns, 1);
    }
    for (std::size_t j = 0; j < width; ++j) solve(&coefficients_[j], rows_, width);
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
  std::vector<double> coefficients_;
};

}  // namespace kte
