#pragma once

#include <Eigen/Core>

#include <limits>

namespace kte::detail {

/// Accelerates a fixed-point iteration x <- x + g(x) for g(x) = 0. The change is s = B g with
///
///   B <- B + (s - B y)(s^T B) / (s^T B y),   y = g(x) - g(x + s),   B = 1 at first          (1)
///
/// so that B approximates -(dg/dx)^-1 from the last changes. B is kept for the next problem, which is similar. If
/// changes do not halve, B is 1 for the rest of the problem. B stays 1 for more than 16 numbers, and for vectors of
/// dynamic size.
///
/// Broyden, Math. Comp. 19 (1965), his first method.
template <class S, int N>
class secant_iteration {
  static constexpr bool learns = N > 0 && N <= 16;
  using vector = Eigen::Matrix<S, N, 1>;

 public:
  /// Begins another problem. `afresh`: discards B.
  void begin(bool afresh) {
    if (afresh || plain_) b_.setIdentity();
    plain_ = has_last_ = false;
  }
  /// Restarts the iteration with B = 1.
  void begin_plainly() { plain_ = true, has_last_ = false; }
  /// Replaces g by s. size: the size of x.
  template <class V>
  void improve(V& g, const S& size) {
    if constexpr (learns) {
      if (has_last_ && s_.norm() > S(1e5) * std::numeric_limits<S>::epsilon() * size) {  // else rounding
        plain_ = plain_ || !(2 * g.norm() < g_.norm());
        if (!plain_) learn(vector(g_ - g));
      }
      if (plain_) return;
      g_ = g;
      s_.noalias() = b_ * g_;
      g = s_;
      has_last_ = true;
    }
  }

 private:
  static constexpr int stored = learns ? N : 0;

  void learn(const vector& y) {
    const vector by = b_ * y;
    const S along = s_.dot(by), least = S(0.1) * s_.squaredNorm();
    if (!(along > least)) return;
    const Eigen::Matrix<S, 1, N> sb = s_.transpose() * b_;
    b_ += (s_ - by) / along * sb;
  }

  Eigen::Matrix<S, stored, stored> b_ = Eigen::Matrix<S, stored, stored>::Identity();
  Eigen::Matrix<S, stored, 1> g_, s_;  ///< of the last iteration
  bool plain_ = false, has_last_ = false;
};

}  // namespace kte::detail
