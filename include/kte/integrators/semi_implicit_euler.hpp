#pragma once

#include <kte/integrators/fixed_step.hpp>
#include <kte/integrators/second_order.hpp>

namespace kte {

/// Semi-implicit (symplectic) Euler method, order 1, one evaluation a step h:
///
///   v1 = v + h a(t, q, v),   q1 = q (+) h v1            (1)
///
/// Symplectic if a depends on q only: the energy of a conservative system then stays near its value without drift.
/// Internal states are integrated by Euler's method. Dense output is linear. Hairer, Lubich and Wanner, Geometric
/// Numerical Integration, 2006, I.1 (1.9).
template <class F, class X>
class semi_implicit_euler : public fixed_step<semi_implicit_euler<F, X>, F, X> {
  using base = fixed_step<semi_implicit_euler, F, X>;
  friend base;
  friend typename base::integrator;

 public:
  using typename base::rate;
  using typename base::S;
  static constexpr int order = 1, dense_order = 1;  ///< of the method and of its dense output

  /// f(t, x), start time, s, start state, step, s. Throws `bad_argument` for a step that is not positive, and for a
  /// start that is not finite.
  semi_implicit_euler(F f, const S& t0, const std::type_identity_t<X>& x0, const S& step)
      : base(std::move(f), t0, x0, step), d_(this->no_rate()) {}

 private:
  void try_step(const S& end) {
    const S h = end - this->time_;
    this->evaluate(this->time_, this->x_, d_);
    const Eigen::Index n = velocities_in(this->system(), d_);
    d_.head(n) += h * d_.segment(n, n);
    d_ *= h;
    this->displace_at_last(d_);  // (1)
  }
  static constexpr int degree() { return 1; }
  void dense(const S& theta, X& x) const { this->displaced(theta * d_, x); }

  rate d_;
};
template <class F, class V>
semi_implicit_euler(F, const typename V::Scalar&, const Eigen::MatrixBase<V>&, const typename V::Scalar&)
    -> semi_implicit_euler<F, typename V::PlainObject>;

}  // namespace kte
