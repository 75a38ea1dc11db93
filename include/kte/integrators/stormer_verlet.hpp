#pragma once

#include <kte/integrators/detail/hermite.hpp>
#include <kte/integrators/fixed_step.hpp>
#include <kte/integrators/second_order.hpp>

namespace kte {

/// The Stormer-Verlet method, order 2, with a fixed step h:
///
///   v' = v + h/2 a(t, q, v')              (1)
///   q1 = q (+) h v'                       (2)
///   v1 = v' + h/2 a(t + h, q1, v')        (3)
///
/// Explicit if a does not depend on velocities, with one evaluation a step if f declares this (`second_order`). It is
/// then symplectic: the energy of conservative systems stays near its value without drift. In general (1) is solved by
/// fixed-point iteration; the method is then symmetric, without drift for reversible motions. Internal states are
/// integrated like v. Dense output: cubics with the slopes at both ends. Hairer, Lubich and Wanner,
/// Geometric numerical integration illustrated by the Stormer-Verlet method, Acta Numerica 12 (2003), (1.5), (1.7).
template <class F, class X>
class stormer_verlet : public fixed_step<stormer_verlet<F, X>, F, X> {
  using base = fixed_step<stormer_verlet, F, X>;
  friend base;
  friend typename base::integrator;

 public:
  using typename base::rate;
  using typename base::S;
  static constexpr int order = 2, dense_order = 2;  ///< of the method and of its dense output

  /// f(t, x), start time, s, start state, step, s. Throws `bad_argument` for a step that is not positive, and for a
  /// start that is not finite.
  stormer_verlet(F f, const S& t0, const std::type_identity_t<X>& x0, const S& step)
      : base(std::move(f), t0, x0, step), k0_(this->no_rate()), k1_(k0_), raw_(k0_), d_(k0_) {}

 private:
  static constexpr bool separable = requires { requires detail::unwrapped_type<F>::accelerations_ignore_velocities; };

  /// Before the first step: a at the start.
  void prepare() {
    this->evaluate(this->time_, this->x_, raw_);
    this->previous_time_ = this->time_;  // no step to interpolate
  }

  void try_step(const S& end) {
    const S h = end - this->time_;
    const Eigen::Index n = velocities_in(this->system(), k0_), m = k0_.size() - n;
    const auto v = this->x_.segment(this->x_.size() - m, n);
    k0_.swap(raw_);
    if constexpr (!separable) solve_kick(h, m);  // (1)
    d_.head(n) = h * (v + (h / 2) * k0_.segment(n, n));
    d_.tail(m) = (h / 2) * k0_.tail(m);
    this->displace_with_lost(d_);  // (2)
    this->evaluate(end, this->next_, raw_);
    d_.tail(m) += (h / 2) * raw_.tail(m);  // (3)
    k0_.head(n) = v;
    k1_ = raw_, k1_.head(n) = v + d_.segment(n, n);
    this->displace_at_last(d_);
    this->pull_back(k1_);
  }
  /// The rates of v and internal states that satisfy (1), starting from a guess.
  void solve_kick(const S& h, Eigen::Index m) {
    d_.setZero();
    this->iterate_slope(h, [&] {
      d_.tail(m) = (h / 2) * k0_.tail(m);
      this->displace(d_);
      this->evaluate(this->time_, this->next_, k1_);
      const S size = k1_.tail(m).norm(), change = (k1_ - k0_).tail(m).norm();
      k0_.swap(k1_);
      return std::pair{change, size};
    });
  }
  static constexpr int degree() { return 3; }
  void dense(const S& theta, X& x) const {
    this->displaced(detail::hermite_cubic(theta, S(this->time_ - this->previous_time_), d_, k0_, k1_), x);
  }

  rate k0_, k1_;  ///< of the last step, at its start and its end
  rate raw_;      ///< at its end, before (3)
  rate d_;
};
template <class F, class V>
stormer_verlet(F, const typename V::Scalar&, const Eigen::MatrixBase<V>&, const typename V::Scalar&)
    -> stormer_verlet<F, typename V::PlainObject>;

}  // namespace kte
