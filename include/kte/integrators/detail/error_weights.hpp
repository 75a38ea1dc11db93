#pragma once

#include <kte/integrators/detail/packet_sum.hpp>
#include <kte/integrators/detail/step_control.hpp>

namespace kte::detail {

/// `error_norm` of several errors of one step, with one division per component.
template <class X>
class error_weights {
 public:
  using S = typename X::Scalar;

  error_weights(const tolerances<S>& tol, Eigen::Index n)
      : tolerances_(tol), absolute_(n), relative_(n), inverse_(n), share_(1 / S(static_cast<double>(n))) {
    for (Eigen::Index i = 0; i < n; ++i) absolute_[i] = tol.absolute[i], relative_[i] = tol.relative[i];
  }
  /// The weights of a step from x0 to x1.
  KTE_INLINE void weigh(const X& x0, const X& x1) {
    using std::abs;
    for (Eigen::Index i = 0; i < inverse_.size(); ++i) {
      const S before = abs(x0[i]), after = abs(x1[i]);
      inverse_[i] = S(1) / S(absolute_[i] + relative_[i] * (before < after ? after : before));
    }
  }
  /// The squared norm of e by the last weights, which must be those of x0 and x1.
  template <class E>
  KTE_INLINE S square(const E& e, const X& x0, const X& x1) const {
    const S mean = sum_by_packets(e.cwiseProduct(inverse_).cwiseAbs2()) * share_;
    if (is_finite(mean)) [[likely]]
      return mean;
    const S norm = error_norm_without_zeros(tolerances_, e, x0, x1);
    return norm * norm;
  }
  const tolerances<S>& of() const { return tolerances_; }

 private:
  tolerances<S> tolerances_;
  X absolute_, relative_, inverse_;
  S share_;  ///< weight of each component in the mean
};

}  // namespace kte::detail
