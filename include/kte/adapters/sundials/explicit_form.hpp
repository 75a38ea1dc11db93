#pragma once

#include <kte/adapters/sundials/integrator.hpp>

namespace kte::sundials {

/// Integrators of SUNDIALS for x' = f(t, x), with callbacks for f and its Jacobian as in CVODE and ARKODE.
///
///   J_ij = d f_i / d x_j          (1)
///
/// J is f.jacobian(t, x, J) if f has it, with return type void: f fills the square matrix J of the right size.
/// Otherwise SUNDIALS computes differences, with one evaluation per column.
template <class Method, class F, class X>
class explicit_form : public integrator<Method, F, X> {
  using base = integrator<Method, F, X>;

 public:
  using typename base::S;

 protected:
  static constexpr int size = X::RowsAtCompileTime;
  using matrix = Eigen::Matrix<double, size, size>;
  static constexpr bool has_jacobian = requires(kte::detail::unwrapped_type<F> & f, const S& t, const X& x, matrix& j) {
    { f.jacobian(t, x, j) } -> std::same_as<void>;
  };

  template <class V>
  explicit_form(F f, const S& t0, const Eigen::MatrixBase<V>& x0, const tolerances<S>& tol)
      : base(std::move(f), t0, x0, tol), argument_(this->x_), slope_(this->x_) {}

  static int right_hand_side(realtype t, N_Vector y, N_Vector y_dot, void* self) {
    explicit_form& me = *static_cast<Method*>(self);
    return me.relay_.guard([&] {
      me.argument_ = detail::numbers<X>(y);
      if (!me.computes([&] { me.evaluate(t, me.argument_, me.slope_); }, me.argument_)) return me.refused();
      detail::numbers<X>(y_dot) = me.slope_;
      return me.judged(me.slope_);
    });
  }
  static int jacobian(realtype t, N_Vector y, N_Vector, SUNMatrix out, void* self, N_Vector, N_Vector, N_Vector) {
    explicit_form& me = *static_cast<Method*>(self);
    return me.relay_.guard([&] {
      me.argument_ = detail::numbers<X>(y);
      me.system().jacobian(t, me.argument_, me.jacobian_);
      detail::numbers(out) = me.jacobian_;
      return me.judged(me.jacobian_);
    });
  }

 private:
  X argument_, slope_;
  matrix jacobian_ = matrix::Zero(this->x_.size(), this->x_.size());
};

}  // namespace kte::sundials
