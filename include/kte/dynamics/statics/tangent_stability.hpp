#pragma once

#include <kte/detail/compiled.hpp>

#ifdef KTE_FUNCTION
#  include <kte/detail/interruption.hpp>
#  include <kte/dynamics/statics/problem.hpp>

#  include <Eigen/OrderingMethods>
#  include <Eigen/SparseCholesky>

#  include <algorithm>
#  include <cmath>
#endif

namespace kte {

/// The stability of an equilibrium: eigenvalues of (K + K^T)/2, the symmetric part of the tangent K = d tau/dq, along
/// the numbers of v.
struct tangent_stability {
  double stiffness = 0;  ///< the smallest eigenvalue, N/m and Nm/rad
  int unstable = 0;      ///< number of negative eigenvalues, which is the number of unstable directions
  double asymmetry = 0;  ///< largest entry of |K - K^T| relative to |K|; 0 if all forces have a potential
  /// Whether all eigenvalues are positive.
  bool stable() const { return stiffness > 0; }
};

#ifdef KTE_FUNCTION
namespace detail {

/// Eigenvalues of a symmetric matrix A by factorizations A - shift = L D L^T. The number of negative entries of D is
/// the number of eigenvalues of A below the shift (Sylvester).
class symmetric_spectrum {
 public:
  explicit symmetric_spectrum(const sparse_matrix& a) : a_(a) {
    for (int j = 0; j < a.outerSize(); ++j) {
      double sum = 0;
      for (sparse_matrix::InnerIterator x(a, j); x; ++x) sum += std::abs(x.value());
      bound_ = (std::max)(bound_, sum);
    }
    factors_.analyzePattern(a);
  }
  int below(double shift) {
    const auto factor = [&] {
      look_for_interruption();
      shift_ = shift;
      factors_.setShift(-shift);
      factors_.factorize(a_);
      return factors_.info() == Eigen::Success;
    };
    for (double nudge = 1e-15 * bound_; !factor(); nudge *= 10) shift -= nudge;  // if a pivot is exactly 0
    return static_cast<int>((factors_.vectorD().array() < 0).count());
  }
  /// The smallest eigenvalue, by inverse iteration with a shift below all eigenvalues. The Rayleigh quotient is that of
  /// the inverse, which keeps its digits if the matrix has much larger eigenvalues.
  double smallest() {
    double low = below_all();
    Eigen::VectorXd x = Eigen::VectorXd::LinSpaced(a_.rows(), 1, 2).normalized(), y;
    double value = low;
    for (int i = 0; i < 40; ++i) {
      y = factors_.solve(x);
      const double length = y.norm();
      value = shift_ + y.dot(x) / (length * length);
      const double miss = (x + (shift_ - value) * y).norm() / length;
      x = y / length;
      if (!(miss > 1e-10 * std::abs(value))) break;
      if (const double next = value - 2 * miss; next > low && below(next) == 0)
        low = next;
      else
        below(low);
    }
    return value;
  }

 private:
  /// Finds a shift below all eigenvalues, near the smallest, and factorizes with it.
  double below_all() {
    if (below(0) == 0) return 0;
    double low = -bound_, high = -1e-16 * bound_;
    while (low < 2 * high) {
      const double middle = -std::sqrt(low * high);
      (below(middle) == 0 ? low : high) = middle;
    }
    below(low);
    return low;
  }

  const sparse_matrix& a_;
  double bound_ = 0, shift_ = 0;
  Eigen::SimplicialLDLT<sparse_matrix> factors_;
};

inline tangent_stability stability_of(const sparse_matrix& k) {
  tangent_stability x;
  if (k.rows() == 0) return x;
  const sparse_matrix back = k.transpose(), both = 0.5 * (k + back), twist = k - back;
  const double most = largest_number(k);
  if (most == 0) return x;
  x.asymmetry = largest_number(twist) / most;
  symmetric_spectrum spectrum(both);
  x.unstable = spectrum.below(0);
  x.stiffness = spectrum.smallest();
  return x;
}

}  // namespace detail
#endif

}  // namespace kte
