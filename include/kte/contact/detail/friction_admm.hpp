#pragma once

#include <kte/contact/detail/cholesky.hpp>
#include <kte/contact/detail/friction_system.hpp>

namespace kte::detail {

/// The alternating direction method of multipliers for a friction problem (Carpentier, Le Lidec and Montaut, From
/// compliant to rigid contact simulation, RSS 2024):
///
///   (W + (eta + rho) I) x = -(b + s(z)) + eta x + rho y + z,   y = P(x - z/rho),   z += rho (y - x),
///
/// s = mu |z_t| on normal rows (De Saxce), P: the projection on the friction cones. rho follows the ratio of the primal
/// residual |x - y| and the dual residual |rho (y - y_before)|.
template <class S>
class friction_admm {
 public:
  using vector = Eigen::Matrix<S, Eigen::Dynamic, 1>;

  void start(const friction_system<S>& p, const S* lambda) {
    x_ = typename friction_system<S>::const_view(lambda, p.size);
    y_ = x_;
    for (int i = 0; i < p.count(); ++i) project(p, i, y_);
    z_.setZero(p.size);
    rho_ = S(0.1) * p.unit;
    factor(p);
  }
  void step(const friction_system<S>& p) {
    using std::sqrt;
    right_ = eta(p) * x_ + rho_ * y_ + z_ - typename friction_system<S>::const_view(p.b, p.size);
    for (int i = 0; i < p.count(); ++i) right_[p.first[static_cast<std::size_t>(i)]] -= shift(p, i);
    factor_.solve(right_.data());
    x_.swap(right_);
    before_ = y_;
    y_ = x_ - z_ / rho_;
    for (int i = 0; i < p.count(); ++i) project(p, i, y_);
    z_ += rho_ * (y_ - x_);
    const S primal = (x_ - y_).norm() * p.unit, dual = rho_ * (y_ - before_).norm();
    if (++steps_ % 10 != 0) return;
    const S ratio = dual > S(0) ? S(primal / dual) : S(1);
    if (ratio > S(10) || ratio < S(0.1)) {
      rho_ *= ratio > S(1) ? S(3) : S(1) / S(3);
      factor(p);
    }
  }
  const vector& lambda() const { return y_; }

 private:
  static S eta(const friction_system<S>& p) { return p.unit * S(1e-6); }
  void factor(const friction_system<S>& p) { factor_.factor(p.W, p.size, p.stride, eta(p) + rho_); }
  S shift(const friction_system<S>& p, int i) const {
    using std::sqrt;
    const auto k = static_cast<std::size_t>(i);
    const Eigen::Index r = p.first[k];
    S of_t(0);
    if (const auto& d = p.contacts[k].sliding) {
      for (int c = 0; c + 1 < p.contacts[k].rows; ++c) of_t += (*d)[static_cast<std::size_t>(c)] * z_[r + 1 + c];
      return p.mu[k] * of_t;
    }
    for (int c = 1; c < p.contacts[k].rows; ++c) of_t += z_[r + c] * z_[r + c];
    return p.mu[k] * sqrt(of_t);
  }
  /// Onto the friction cone, or the ray of a contact that slides in a fixed direction.
  static void project(const friction_system<S>& p, int i, vector& y) {
    using std::sqrt;
    const auto k = static_cast<std::size_t>(i);
    const Eigen::Index r = p.first[k];
    const S mu = p.mu[k];
    const int n = p.contacts[k].rows;
    if (const auto& d = p.contacts[k].sliding) {
      S along = y[r];
      for (int c = 0; c + 1 < n; ++c) along -= mu * (*d)[static_cast<std::size_t>(c)] * y[r + 1 + c];
      y[r] = (std::max<S>)(S(0), along / (S(1) + mu * mu));
      for (int c = 0; c + 1 < n; ++c) y[r + 1 + c] = -mu * (*d)[static_cast<std::size_t>(c)] * y[r];
      return;
    }
    S length(0);
    for (int c = 1; c < n; ++c) length += y[r + c] * y[r + c];
    length = sqrt(length);
    if (length <= mu * y[r]) return;
    const S normal = (std::max<S>)(S(0), (y[r] + mu * length) / (S(1) + mu * mu));
    for (int c = 1; c < n; ++c) y[r + c] *= length > S(0) ? S(mu * normal / length) : S(0);
    y[r] = normal;
  }

  vector x_, y_, z_, right_, before_;
  cholesky<S> factor_;
  S rho_{};
  int steps_ = 0;
};

}  // namespace kte::detail
