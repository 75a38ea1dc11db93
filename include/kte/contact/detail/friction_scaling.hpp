#pragma once

#include <kte/contact/friction_problem.hpp>

#include <algorithm>
#include <cmath>
#include <vector>

namespace kte::detail {

/// A friction problem of contacts with very different masses, in scaled numbers:
///
///   W' = D W D,   b' = D b,   lambda = D lambda',   u = D^-1 u',   D = 1/sqrt(W_nn) of each contact
///
/// Tolerances, which are relative to the largest number, then hold for each contact.
template <class S>
class friction_scaling {
 public:
  /// Whether W_nn of the contacts differ by more than 1e4; then the scaled problem is made.
  bool scales(const friction_problem<S>& p, std::span<const S> start) {
    using std::sqrt;
    S most(0), least(0);
    Eigen::Index row = 0;
    for (const auto& contact : p.contacts) {
      const S w = p.W(row, row);
      if (w > S(0)) most = (std::max<S>)(most, w), least = least > S(0) ? (std::min<S>)(least, w) : w;
      row += contact.rows;
    }
    if (!(most > S(1e4) * least)) return false;
    D_.resize(row);
    row = 0;
    for (const auto& contact : p.contacts) {
      const S w = p.W(row, row);
      for (int k = 0; k < contact.rows; ++k) D_[row++] = S(1) / sqrt(w > S(0) ? w : least);
    }
    W_ = D_.asDiagonal() * p.W * D_.asDiagonal(), b_ = D_.cwiseProduct(p.b);
    start_.assign(start.begin(), start.end());
    for (std::size_t i = 0; i < start_.size(); ++i) start_[i] /= D_[static_cast<Eigen::Index>(i)];
    return true;
  }
  friction_problem<S> scaled(const friction_problem<S>& p) const { return {W_, b_, p.contacts}; }
  std::span<const S> start() const { return start_; }
  /// Converts forces and velocities of the scaled problem.
  void unscale(std::vector<S>& lambda, std::vector<S>& u) const {
    for (std::size_t i = 0; i < lambda.size(); ++i) {
      const S& d = D_[static_cast<Eigen::Index>(i)];
      lambda[i] *= d, u[i] /= d;
    }
  }

 private:
  typename friction_problem<S>::matrix W_;
  typename friction_problem<S>::vector b_, D_;
  std::vector<S> start_;
};

}  // namespace kte::detail
