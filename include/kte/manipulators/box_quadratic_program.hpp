#pragma once

#include <kte/detail/interruption.hpp>
#include <kte/kernels/joint_vector.hpp>

#include <limits>

namespace kte {

/// The result of `minimise_in_box`: the minimum x.
template <class S, int N>
struct box_minimum {
  joint_vector<S, N> x;
  Eigen::Matrix<signed char, N, 1> at;  ///< -1, 1: at its lower or upper bound; 0: free
  int pivots;                           ///< number of linear systems solved
  bool optimal;                         ///< false if rounding prevents (2); x is within bounds in any case
};

namespace detail {
/// The Cholesky factorization H = L L^T of the free rows and columns, and its solution for one right-hand side.
/// Unknowns of directions without curvature are 0.
template <class S, int N>
class free_cholesky {
 public:
  explicit free_cholesky(Eigen::Index n) : l_(n, n), index_(n) {}
  template <class H, class At>
  void factorise(const H& h, const At& at) {
    n_ = 0;
    for (Eigen::Index i = 0; i < at.size(); ++i)
      if (at[i] == 0) index_[n_++] = i;
    using std::sqrt;
    for (Eigen::Index i = 0; i < n_; ++i) {
      for (Eigen::Index j = 0; j <= i; ++j) {
        S sum = h(index_[i], index_[j]);
        for (Eigen::Index k = 0; k < j; ++k) sum -= l_(i, k) * l_(j, k);
        if (j < i) {
          l_(i, j) = sum * l_(j, j);  // the diagonal has reciprocals
        } else {
          const S least = S(4) * std::numeric_limits<S>::epsilon() * S(at.size()) * h(index_[i], index_[i]);
          l_(i, i) = sum > least ? S(1) / sqrt(sum) : S(0);
        }
      }
    }
  }
  /// x_free = H_free^-1 r_free; the others 0.
  template <class R, class X>
  void solve(const R& r, X& x) const {
    x.setZero();
    for (Eigen::Index i = 0; i < n_; ++i) {
      S sum = r[index_[i]];
      for (Eigen::Index k = 0; k < i; ++k) sum -= l_(i, k) * x[index_[k]];
      x[index_[i]] = sum * l_(i, i);
    }
    for (Eigen::Index i = n_; i-- > 0;) {
      S sum = x[index_[i]];
      for (Eigen::Index k = i + 1; k < n_; ++k) sum -= l_(k, i) * x[index_[k]];
      x[index_[i]] = sum * l_(i, i);
    }
  }

 private:
  joint_matrix<S, N> l_;
  Eigen::Matrix<Eigen::Index, N, 1> index_;
  Eigen::Index n_ = 0;
};
template <class S, int N>
box_minimum<S, N>& finite_minimum(box_minimum<S, N>& found) {
  check_finite(found.x, static_cast<std::size_t>(found.x.size()),
               "kte: the minimum of a quadratic function in a box is not finite: a number is too large or too small");
  return found;
}
}  // namespace detail

/// Minimizes a convex quadratic function in a box by a primal active-set method (Nocedal, Wright: Numerical
/// Optimization, 2006, section 16.5), starting from the unconstrained minimum projected into the box:
///
///   x^T H x / 2 - g^T x,   lower <= x <= upper                                          (1)
///   r = H x - g:   r_i = 0 where free,  r_i >= 0 at lower,  r_i <= 0 at upper           (2)
///
/// H is symmetric and positive definite or semidefinite; bounds may be infinite, or equal. (2) holds to rounding. For a
/// fixed size nothing is allocated. Throws `bad_argument` unless lower <= upper and H, g are finite, and if x is not
/// finite because numbers are too large or too small.
template <class S, int N>
[[nodiscard]] box_minimum<S, N> minimise_in_box(const joint_matrix<S, N>& h, const joint_vector<S, N>& g,
                                                const joint_vector<S, N>& lower, const joint_vector<S, N>& upper) {
  const Eigen::Index n = g.size();
  detail::check_finite(g, static_cast<std::size_t>(n), "kte: the linear part of a quadratic function is not finite");
  detail::check_finite(h.data(), static_cast<std::size_t>(h.size()), "kte: a quadratic function is not finite");
  for (Eigen::Index i = 0; i < n; ++i)
    if (!(lower[i] <= upper[i])) detail::raise<bad_argument>("kte: bound " + std::to_string(i + 1) + " is empty");

  using std::abs;
  box_minimum<S, N> out{joint_vector<S, N>(n), Eigen::Matrix<signed char, N, 1>::Zero(n), 1, false};
  auto& x = out.x;
  auto& at = out.at;
  detail::free_cholesky<S, N> free(n);
  joint_vector<S, N> step(n), r(n);
  free.factorise(h, at), free.solve(g, x);
  for (Eigen::Index i = 0; i < n; ++i) {
    if (x[i] <= lower[i]) x[i] = lower[i], at[i] = -1;
    if (x[i] >= upper[i]) x[i] = upper[i], at[i] = 1;
  }
  const auto gradient = [&] {
    for (Eigen::Index i = 0; i < n; ++i) {
      r[i] = -g[i];
      for (Eigen::Index j = 0; j < n; ++j) r[i] += h(i, j) * x[j];
    }
  };
  const S rounding = S(8) * S(n) * std::numeric_limits<S>::epsilon();
  const auto size_of_terms = [&](Eigen::Index i) {
    S size = abs(g[i]);
    for (Eigen::Index j = 0; j < n; ++j) size += abs(h(i, j) * x[j]);
    return size;
  };
  if (at.isZero(0)) {  // the usual case: within bounds, where one step with the same factors is enough
    gradient(), free.solve(r, step);
    x -= step;
    gradient();
    out.optimal = true;
    for (Eigen::Index i = 0; i < n; ++i)
      out.optimal &= abs(r[i]) <= rounding * size_of_terms(i) && x[i] >= lower[i] && x[i] <= upper[i];
    if (out.optimal) return detail::finite_minimum(out);
    x = x.cwiseMax(lower).cwiseMin(upper);
  }
  const int most = 20 * static_cast<int>(n) + 20;
  bool refined = false;  // refines the free part of (2) to rounding by a second step with the same factors
  if (!at.isZero(0)) free.factorise(h, at);
  for (; out.pivots < most; ++out.pivots) {
    detail::look_for_interruption();
    gradient(), free.solve(r, step);  // x - step is the minimum over the free unknowns
    S t = S(1);
    Eigen::Index blocking = -1;
    for (Eigen::Index i = 0; i < n; ++i) {
      if (at[i] != 0) continue;
      const S room = step[i] > 0 ? x[i] - lower[i] : upper[i] - x[i];
      if (abs(step[i]) * t > room) t = room / abs(step[i]), blocking = i;
    }
    for (Eigen::Index i = 0; i < n; ++i)
      if (at[i] == 0) x[i] = (std::min)((std::max)(S(x[i] - t * step[i]), lower[i]), upper[i]);
    if (blocking >= 0) {
      const bool down = step[blocking] > 0;
      at[blocking] = down ? -1 : 1, x[blocking] = down ? lower[blocking] : upper[blocking];
      free.factorise(h, at), refined = false;
      continue;
    }
    gradient();
    Eigen::Index worst = -1;
    S most_wrong(0);
    for (Eigen::Index i = 0; i < n; ++i) {
      if (at[i] == 0 || lower[i] == upper[i]) continue;
      const S size = size_of_terms(i), wrong = (at[i] < 0 ? -r[i] : r[i]) / (size > 0 ? size : S(1));
      if (wrong > rounding && wrong > most_wrong) most_wrong = wrong, worst = i;
    }
    out.optimal = worst < 0 && refined;
    if (out.optimal) return detail::finite_minimum(out);
    refined = worst < 0;
    if (worst >= 0) at[worst] = 0, free.factorise(h, at);
  }
  return detail::finite_minimum(out);
}

}  // namespace kte
