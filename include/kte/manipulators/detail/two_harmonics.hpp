#pragma once

#include <kte/detail/short_list.hpp>

#include <array>
#include <cmath>
#include <numbers>

namespace kte::detail {

/// f(t) = al cos 2t + be sin 2t + ga cos t + de sin t + ep          (1)
struct two_harmonics {
  double al, be, ga, de, ep;

  /// f and four derivatives at an angle.
  struct point {
    double t;
    std::array<double, 5> y;
  };
  point at(double t) const {
    const double c = std::cos(t), s = std::sin(t), c2 = (c - s) * (c + s), s2 = 2 * s * c;
    const double f = ga * c + de * s, g = de * c - ga * s, f2 = al * c2 + be * s2, g2 = 2 * (be * c2 - al * s2);
    return {t, {f2 + f + ep, g2 + g, -4 * f2 - f, -4 * g2 - g, 16 * f2 + f}};
  }

  using angles = short_list<double, 64>;
  /// All zeros in [-pi, pi), including points where |f| has a minimum below `reach`. The zeros of a function lie
  /// between those of its derivative. The third derivative is assumed to have at most one zero per sixteenth of a turn.
  angles zeros(double reach) const {
    constexpr int parts = 16;
    angles found;
    point a = at(-std::numbers::pi);
    for (int k = 1; k <= parts; ++k) {
      const point b = at(std::numbers::pi * (2.0 * k / parts - 1));
      look_between<3>(a, b, reach, found);
      a = b;
    }
    return found;
  }

 private:
  /// The zero of derivative D in an interval: Newton's method, with bisection if a step leaves the interval.
  template <std::size_t D>
  point zero_between(double lower, double upper, bool rises) const {
    point p = at((lower + upper) / 2);
    for (int k = 0; k < 60 && upper - lower > 1e-16; ++k) {
      ((p.y[D] < 0) == rises ? lower : upper) = p.t;
      const double step = p.y[D] / p.y[D + 1], next = p.t - step;
      const bool inside = next > lower && next < upper;
      if (inside && std::abs(step) < 1e-15) break;
      p = at(inside ? next : (lower + upper) / 2);
    }
    return p;
  }
  /// Zeros of f in an interval in which derivative D + 1 has no zero.
  template <std::size_t D>
  void look_between(const point& a, const point& b, double reach, angles& found) const {
    const bool changes = (a.y[D] < 0) != (b.y[D] < 0);
    if constexpr (D == 0) {
      if (changes)
        found.push_back(zero_between<0>(a.t, b.t, a.y[0] < 0).t);
      else if (std::abs(b.y[0]) <= reach)
        found.push_back(b.t);  // possibly found twice: subproblem 6 merges equal roots
    } else if (changes) {
      const point p = zero_between<D>(a.t, b.t, a.y[D] < 0);
      look_between<D - 1>(a, p, reach, found), look_between<D - 1>(p, b, reach, found);
    } else {
      look_between<D - 1>(a, b, reach, found);
    }
  }
};

}  // namespace kte::detail
