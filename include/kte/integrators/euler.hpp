#pragma once

#include <kte/integrators/integrator.hpp>

namespace kte {

/// Euler's method of order 1 with a fixed step h:
///
///   x_{i+1} = x_i + h f(t_i, x_i),   t_i = t0 + i h                                       (1)
///   x(t_i + theta h) = (1 - theta) x_i + theta x_{i+1}   between the steps                (2)
///
/// Steps are counted from the start of each `integrate`; the last one is shorter where h does not divide the time.
///
///   kte::euler solver(f, 0.0, x0, 0.001);
///   solver.integrate(10.0);
template <class F, class X>
class euler : public integrator<euler<F, X>, F, X> {
  using base = integrator<euler, F, X>;
  friend base;

 public:
  using S = typename X::Scalar;

  /// f(t, x), start time (s), start state, step (s). Throws `bad_argument` for a step that is not positive, and for a
  /// start that is not finite.
  template <class V>
  euler(F f, const S& t0, const Eigen::MatrixBase<V>& x0, const S& step)
      : base(std::move(f), t0, x0), slope_(x0), step_(step) {
    detail::check_positive(step, "step");
  }

 private:
  void start(const S& t_end) {
    grid_ = time_grid<S>(this->time_, t_end, step_, "step");
    index_ = 0;
  }
  void advance(const S&) {
    const S end = grid_[++index_];
    this->evaluate(this->time_, this->x_, slope_);
    this->next_ = this->x_ + S(end - this->time_) * slope_;  // (1)
    if (!((this->next_ - this->next_).array() == S(0)).all()) [[unlikely]]
      this->fail("the next state is not a finite number");
    this->accept(end);
  }
  void dense(const S& theta, X& x) const { x = (S(1) - theta) * this->previous_ + theta * this->x_; }  // (2)

  X slope_;
  S step_;
  time_grid<S> grid_;
  long long index_ = 0;
};

template <class F, class V>
euler(F, const typename V::Scalar&, const Eigen::MatrixBase<V>&, const typename V::Scalar&)
    -> euler<F, typename V::PlainObject>;

}  // namespace kte
