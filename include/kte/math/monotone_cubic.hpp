#pragma once

#include <kte/math/constant.hpp>

#include <cstddef>
#include <vector>

namespace kte {

/// A curve through points (x_i, y_i), `x` increasing, `y` any: cubic between neighbours, straight beyond the ends, with
/// a continuous slope. It is monotone where the points are, and does not overshoot. Slopes m_i at inner points, with
/// d_i = (y_{i+1} - y_i)/h_i, h_i = x_{i+1} - x_i:
///
///   m_i = 0 where d_{i-1} d_i <= 0, else 3 (h_{i-1} + h_i) / ((2 h_i + h_{i-1})/d_{i-1} + (h_i + 2 h_{i-1})/d_i)   (1)
///
/// At the ends the slope is d of the outer piece. Two points give a straight line.
///
/// Fritsch and Butland, A method for constructing local monotone piecewise cubic interpolants, SIAM J. Sci. Stat.
/// Comput. 5 (1984).
template <class List = std::vector<double>>
class monotone_cubic {
 public:
  monotone_cubic() = default;
  /// A curve through the points (x_i, y_i), at least two, x increasing. It does not check them: see `is_sound`.
  constexpr monotone_cubic(const List& of_x, const List& of_y) : x(of_x), y(of_y), slope_(of_x), area_(of_x) {
    prepare();
  }
  List x;
  List y;

  /// Whether there are as many x as y, at least two, all finite, with x increasing.
  [[nodiscard]] constexpr bool is_sound() const {
    if (x.size() < 2 || x.size() != y.size()) return false;
    for (std::size_t i = 1; i < x.size(); ++i)
      if (!(x[i - 1] < x[i])) return false;
    return true;
  }
  /// Computes the slopes; to be called after a change of `x` or `y`.
  constexpr void prepare() {
    if (!is_sound()) return;
    slope_ = area_ = x;
    const std::size_t n = x.size();
    const auto h = [this](std::size_t i) { return x[i + 1] - x[i]; };
    slope_[0] = rise(0), slope_[n - 1] = rise(n - 2);
    for (std::size_t i = 1; i + 1 < n; ++i) {
      const double before = rise(i - 1), behind = rise(i), w = h(i - 1), v = h(i);
      const bool turns = before == 0 || behind == 0 || (before < 0) != (behind < 0);
      slope_[i] = turns ? 0 : 3 * (w + v) / ((2 * v + w) / before + (v + 2 * w) / behind);  // (1)
    }
    area_[0] = 0;
    for (std::size_t i = 1; i < n; ++i) area_[i] = area_[i - 1] + piece(i - 1, x[i]).area;
  }
  template <class T>
  constexpr T operator()(const T& at) const {
    return at_place(at).value;
  }
  /// The integral of the curve from the first x to `at`.
  template <class T>
  [[nodiscard]] constexpr T integral(const T& at) const {
    return at_place(at).area;
  }

 private:
  template <class T>
  struct both {
    T value, area;
  };
  constexpr double rise(std::size_t i) const { return (y[i + 1] - y[i]) / (x[i + 1] - x[i]); }

  template <class T>
  constexpr both<T> at_place(const T& at) const {
    const std::size_t n = x.size();
    if (at < T(x[0])) return straight(0, at);
    if (at > T(x[n - 1])) return straight(n - 1, at);
    std::size_t low = 0, high = n - 1;
    while (high - low > 1) {
      const std::size_t middle = low + (high - low) / 2;
      (at < T(x[middle]) ? high : low) = middle;
    }
    return piece(low, at);
  }
  template <class T>
  constexpr both<T> straight(std::size_t i, const T& at) const {
    const T u = at - T(x[i]), m = T(slope_[i]), start = T(y[i]);
    return {T(start + m * u), T(T(area_[i]) + u * (start + m * u / T(2)))};
  }
  template <class T>
  constexpr both<T> piece(std::size_t i, const T& at) const {
    const T h = T(x[i + 1]) - T(x[i]), u = at - T(x[i]), t = u / h, start = T(y[i]);
    const T m = T(slope_[i]), next = T(slope_[i + 1]), d = (T(y[i + 1]) - start) / h;
    const T square = T(3) * d - T(2) * m - next, cube = m + next - T(2) * d;
    return {T(start + u * (m + t * (square + t * cube))),
            T(T(area_[i]) + u * (start + u * (m / T(2) + t * (square / T(3) + t * cube / T(4)))))};
  }

  List slope_, area_;
};

}  // namespace kte
