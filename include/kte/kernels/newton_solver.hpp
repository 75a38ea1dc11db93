#pragma once

#include <kte/contract/closure.hpp>
#include <kte/math/dual.hpp>

#include <array>
#include <cmath>
#include <limits>
#include <utility>

/// Functions y(q) that equations define:
///
///   F(q, y) = 0,   as many rows as y has numbers          (1)
namespace kte::detail {

template <class S, std::size_t N>
using numbers = std::array<S, N>;

/// A solution y of (1), and (dF/dy)^-1 there.
template <class S, std::size_t M>
struct implicit_solution {
  numbers<S, M> y;
  numbers<numbers<S, M>, M> inverse;
};
/// Why there is none.
enum class no_solution_of {
  none,
  beyond,        ///< no solution, or none is found
  undetermined,  ///< a dead point: rates of y do not follow from those of q
  ambiguous      ///< two solutions, too near to each other
};

/// The relative error of dF/dy, and whether rates of y are bounded where it is large.
struct rate_certainty {
  double error;
  bool bounded;
};

/// f(q_1, ..., y_1, ...) as an array of M rows: of a function that returns a number, or `make_rows(...)`.
template <class T, std::size_t N, std::size_t M, class Law>
constexpr numbers<T, M> rows_of(const Law& law, const numbers<T, N>& q, const numbers<T, M>& y) {
  return [&]<std::size_t... I, std::size_t... K>(std::index_sequence<I...>, std::index_sequence<K...>) {
    const auto f = law(q[I]..., y[K]...);
    if constexpr (M == 1) {
      if constexpr (requires { nth<0>(f); })
        return numbers<T, M>{as<T>(nth<0>(f))};
      else
        return numbers<T, M>{as<T>(f)};
    } else {
      return numbers<T, M>{as<T>(nth<K>(f))...};
    }
  }
  (std::make_index_sequence<N>{}, std::make_index_sequence<M>{});
}
template <class S, std::size_t M>
constexpr numbers<S, M> product(const numbers<numbers<S, M>, M>& a, const numbers<S, M>& x) {
  numbers<S, M> y{};
  for (std::size_t i = 0; i < M; ++i)
    for (std::size_t k = 0; k < M; ++k) y[i] += a[i][k] * x[k];
  return y;
}
/// a^-1 by elimination with row pivots; false if a pivot is nothing.
template <class S, std::size_t M>
constexpr bool invert(numbers<numbers<S, M>, M> a, numbers<numbers<S, M>, M>& x) {
  using std::abs;
  x = {};
  for (std::size_t i = 0; i < M; ++i) x[i][i] = S(1);
  for (std::size_t k = 0; k < M; ++k) {
    std::size_t p = k;
    for (std::size_t i = k + 1; i < M; ++i)
      if (abs(a[i][k]) > abs(a[p][k])) p = i;
    if (!(abs(a[p][k]) > S(0))) return false;
    std::swap(a[p], a[k]), std::swap(x[p], x[k]);
    const S pivot = S(1) / a[k][k];
    for (std::size_t c = 0; c < M; ++c) a[k][c] *= pivot, x[k][c] *= pivot;
    for (std::size_t i = 0; i < M; ++i) {
      if (i == k) continue;
      const S factor = a[i][k];
      for (std::size_t c = 0; c < M; ++c) a[i][c] -= factor * a[k][c], x[i][c] -= factor * x[k][c];
    }
  }
  return true;
}
/// The largest of numbers, each relative to that of y where that is above 1.
template <class S, std::size_t M>
constexpr S largest(const numbers<S, M>& d, const numbers<S, M>& y) {
  using std::abs;
  S most(0);
  for (std::size_t k = 0; k < M; ++k) {
    const S size = S(abs(d[k])) / (S(abs(y[k])) > S(1) ? S(abs(y[k])) : S(1));
    if (!(size <= most)) most = size;  // NaN stays
  }
  return most;
}

/// Newton's method for (1) at plain numbers q. A step that does not bring the next one down is shortened (natural
/// monotonicity: Deuflhard, Newton Methods for Nonlinear Problems, 2004, 3.3).
template <class Law, class S, std::size_t N, std::size_t M>
class newton_solver {
 public:
  using number = dual<S, static_cast<int>(M)>;
  using vector = numbers<S, M>;

  constexpr newton_solver(const Law& law, const numbers<S, N>& q) : law_(law), q_(q) {}

  /// `starts_near`: the start is close to the solution, on its branch.
  constexpr no_solution_of solve(const vector& start, bool starts_near, implicit_solution<S, M>& x) const {
    using std::sqrt;
    const S eps = std::numeric_limits<S>::epsilon(), half_digits = S(sqrt(eps));
    x.y = start;
    S before(-1), shortened(1);
    for (int step = 0; step < 60; ++step) {
      const auto [f, by_y] = at(x.y);
      if (!invert(by_y, x.inverse)) return no_solution_of::undetermined;
      const vector d = product(x.inverse, f);
      const S size = largest(d, x.y);
      if (!(size < std::numeric_limits<S>::infinity())) return no_solution_of::undetermined;
      if (starts_near && step == 1 && size > S(1e3) * eps && size > before / S(4)) return no_solution_of::ambiguous;
      if (size <= S(4) * eps || (before >= S(0) && size < half_digits && size * S(2) > before)) {
        move(x.y, d, S(1));
        return no_solution_of::none;
      }
      S part(1);
      if (size > half_digits)
        for (part = S(shortened + shortened < S(1) ? shortened + shortened : S(1));; part /= S(2)) {
          vector y = x.y;
          move(y, d, part);
          const vector next = product(x.inverse, rows_of<S>(law_, q_, y));
          if (largest(next, y) <= (S(1) - part / S(4)) * size) break;
          if (part < S(1e-4)) return no_solution_of::beyond;
        }
      move(x.y, d, part);
      shortened = part, before = part < S(1) ? S(-1) : size;
    }
    return no_solution_of::beyond;
  }
  /// How certain derivatives of y are. F is uncertain by its rounding r, about eps times the largest of
  /// |F_q q|, |F_y y| and, as terms may cancel in these, |F_yy y y|; y is uncertain by e = |F_y^-1| r, and F_y by
  ///
  ///   F_y^-1 (d/dy F_y) e          (2)
  ///
  /// At a dead point y' = -F_y^-1 F_q q' grows beyond all limits, where branches cross it does not.
  constexpr rate_certainty rates(const implicit_solution<S, M>& x) const {
    using std::abs;
    using all = dual<S, static_cast<int>(N + M)>;
    using along = dual<S, 1>;
    using twice = dual<along, static_cast<int>(M)>;
    const S eps = std::numeric_limits<S>::epsilon();
    const auto size = [](const S& a) { return S(abs(a)) > S(1) ? S(abs(a)) : S(1); };
    numbers<all, N> q;
    numbers<all, M> y;
    numbers<twice, N> q_fixed;
    numbers<twice, M> y_moving;
    for (std::size_t i = 0; i < N; ++i) q[i] = all(q_[i]), q[i].derivative[i] = S(1), q_fixed[i] = twice(along(q_[i]));
    for (std::size_t k = 0; k < M; ++k) {
      y[k] = all(x.y[k]), y[k].derivative[N + k] = S(1);
      along moved(x.y[k]);
      moved.derivative[0] = size(x.y[k]);
      y_moving[k] = twice(moved), y_moving[k].derivative[k] = along(S(1));
    }
    const auto f = rows_of<all>(law_, q, y);
    const auto g = rows_of<twice>(law_, q_fixed, y_moving);
    S relative(0);
    for (std::size_t k = 0; k < M; ++k) {
      S e(0);
      for (std::size_t r = 0; r < M; ++r) {
        S rounding = abs(f[r].value);
        for (std::size_t i = 0; i < N; ++i) rounding += eps * S(abs(f[r].derivative[i])) * size(q_[i]);
        for (std::size_t i = 0; i < M; ++i)
          rounding += eps * size(x.y[i]) * (S(abs(f[r].derivative[N + i])) + S(abs(g[r].derivative[i].derivative[0])));
        e += S(abs(x.inverse[k][r])) * rounding;
      }
      e /= size(x.y[k]);
      if (!(e < relative)) relative = e;
    }
    S most(0);
    for (std::size_t c = 0; c < M; ++c) {
      vector change;
      for (std::size_t r = 0; r < M; ++r) change[r] = g[r].derivative[c].derivative[0];
      for (const S& part : product(x.inverse, change))
        if (!(abs(part) * relative <= most)) most = abs(part) * relative;
    }
    return {static_cast<double>(most), slope(x, f) < S(100)};
  }

 private:
  /// The largest rate of y at unit rates of q, from rows with their derivatives.
  template <class Rows>
  static constexpr S slope(const implicit_solution<S, M>& x, const Rows& f) {
    vector all{};
    for (std::size_t i = 0; i < N; ++i) {
      vector by_q;
      for (std::size_t r = 0; r < M; ++r) by_q[r] = f[r].derivative[i];
      const vector y = product(x.inverse, by_q);
      for (std::size_t k = 0; k < M; ++k) {
        using std::abs;
        all[k] += S(abs(y[k]));
      }
    }
    return largest(all, x.y);
  }
  static constexpr void move(vector& y, const vector& d, const S& part) {
    for (std::size_t k = 0; k < M; ++k) y[k] -= part * d[k];
  }
  constexpr std::pair<vector, numbers<vector, M>> at(const vector& at_y) const {
    numbers<number, N> q;
    numbers<number, M> y;
    for (std::size_t i = 0; i < N; ++i) q[i] = number(q_[i]);
    for (std::size_t k = 0; k < M; ++k) y[k] = number(at_y[k]), y[k].derivative[k] = S(1);
    const auto f = rows_of<number>(law_, q, y);
    std::pair<vector, numbers<vector, M>> x;
    for (std::size_t r = 0; r < M; ++r) {
      x.first[r] = f[r].value;
      for (std::size_t k = 0; k < M; ++k) x.second[r][k] = f[r].derivative[k];
    }
    return x;
  }
  const Law& law_;
  const numbers<S, N>& q_;
};

}  // namespace kte::detail
