#pragma once

#include <kte/dynamics/looped/mass_matrix.hpp>
#include <kte/dynamics/runtime/elements.hpp>

#include <cmath>
#include <limits>

namespace kte::detail {

/// The factor of the mass matrix, M = L^T L, of a chain that is not a tree of joints; or of M + A.
class mass_root {
 public:
  /// Returns false if M + A is not positive definite; without A it throws.
  template <class State>
  bool factorize(const runtime_elements& c, State& s, const Eigen::MatrixXd* added = nullptr) {
    mass_of_coordinates(c, s);
    const Eigen::Index n = s.dofs();
    l_ = s.work.mass;
    if (added != nullptr) l_ += *added;
    for (Eigen::Index k = n; k-- > 0;) {
      const double own = s.work.mass(k, k);
      if (!(l_(k, k) > 4 * std::numeric_limits<double>::epsilon() * own)) [[unlikely]] {
        if (added != nullptr) return false;
        c.diagnose_mass(s, static_cast<int>(k), own - own == 0);
      }
      l_(k, k) = std::sqrt(l_(k, k));
      for (Eigen::Index i = k; i-- > 0;) l_(i, k) /= l_(k, k);
      for (Eigen::Index i = k; i-- > 0;)
        for (Eigen::Index j = i + 1; j-- > 0;) l_(j, i) -= l_(i, k) * l_(j, k);
    }
    return true;
  }
  /// b becomes L^-T b.
  void half_solve(double* b) const {
    for (Eigen::Index k = l_.rows(); k-- > 0;) {
      b[k] /= l_(k, k);
      for (Eigen::Index j = k; j-- > 0;) b[j] -= l_(j, k) * b[k];
    }
  }
  /// y becomes L^-1 y.
  void other_half(double* y) const {
    for (Eigen::Index k = 0; k < l_.rows(); ++k) {
      for (Eigen::Index i = k; i-- > 0;) y[k] -= l_(i, k) * y[i];
      y[k] /= l_(k, k);
    }
  }
  double inverse_root(int k) const { return 1 / l_(k, k); }

 private:
  Eigen::MatrixXd l_;  ///< its upper triangle holds L^T
};

}  // namespace kte::detail
