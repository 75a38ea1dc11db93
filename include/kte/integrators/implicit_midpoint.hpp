#pragma once

#include <kte/integrators/fixed_step.hpp>

namespace kte {

/// The implicit midpoint rule, order 2, with a fixed step h, solved to rounding by fixed-point iteration:
///
///   d = h k,  k the rate of the displacement at (t + h/2, x (+) d/2),   x1 = x (+) d          (1)
///
/// It is symmetric: for reversible motions the energy oscillates without drift. Quadratic invariants of vectors are
/// exact: the energy of linear oscillators, the norm of a momentum. It is symplectic if x holds canonical momenta; for
/// mechanisms use `variational2`. It is stable for every step on the imaginary axis, but the iteration needs h below
/// about 1 over the fastest rate. For stiff systems see `tr_bdf2`.
///
/// Dense output is linear in d, with an error of order 2 in h, the order of the method. Hairer, Lubich and Wanner,
/// Geometric Numerical Integration, 2006, II.1.2, IV.2, V.1; on groups Zanna, Engo
/// and Munthe-Kaas, Adjoint and selfadjoint Lie-group methods, BIT 41 (2001).
template <class F, class X>
class implicit_midpoint : public fixed_step<implicit_midpoint<F, X>, F, X> {
  using base = fixed_step<implicit_midpoint, F, X>;
  friend base;
  friend typename base::integrator;

 public:
  using typename base::rate;
  using typename base::S;
  static constexpr int order = 2, dense_order = 1;  ///< of the method and of its dense output

  /// f(t, x), start time, s, start state, step, s. Throws `bad_argument` for a step that is not positive, and for a
  /// start that is not finite.
  implicit_midpoint(F f, const S& t0, const std::type_identity_t<X>& x0, const S& step)
      : base(std::move(f), t0, x0, step), k_(this->no_rate()), fresh_(k_) {}

 private:
  /// A guess for the first step; later steps start from the k of the previous step.
  void prepare() {
    this->evaluate(this->time_, this->x_, k_);
    this->previous_time_ = this->time_;  // no step to interpolate
  }

  void try_step(const S& end) {
    const S h = end - this->time_, middle = this->time_ + h / 2;
    this->iterate_slope(h, [&] {
      this->displace((h / 2) * k_);
      this->slope(middle, fresh_);
      const S size = fresh_.norm(), change = (fresh_ - k_).norm();
      k_.swap(fresh_);
      return std::pair{change, size};
    });
    this->displace_at_last(h * k_);  // (1)
  }
  static constexpr int degree() { return 1; }
  void dense(const S& theta, X& x) const { this->displaced((theta * (this->time_ - this->previous_time_)) * k_, x); }

  rate k_, fresh_;
};
template <class F, class V>
implicit_midpoint(F, const typename V::Scalar&, const Eigen::MatrixBase<V>&, const typename V::Scalar&)
    -> implicit_midpoint<F, typename V::PlainObject>;

}  // namespace kte
