#pragma once

#include <kte/adapters/sundials/integrator.hpp>

#include <ida/ida.h>
#include <ida/ida_ls.h>

namespace kte::sundials {

namespace detail {
/// A residual in the role of a right-hand side, for code that integrators share. It is never called as one.
template <class R>
struct implicit_form {
  R residual;
  template <class X>
  const X& operator()(const double&, const X& x) const {
    return x;
  }
};
}  // namespace detail

/// IDA: backward differentiation formulas of order 1 to 5 for implicit and differential-algebraic equations (of index
/// 1):
///
///   f(t, x, x') = 0                                 (1)
///   J_ij = d f_i / d x_j + c d f_i / d x'_j         (2)
///
/// f(t, x, x_dot) returns the residual, or f(t, x, x_dot, r) writes it into r, of the size of x. J is f.jacobian(t, x,
/// x_dot, c, J) where f has it: f fills a square matrix J of the right size. Otherwise IDA uses differences.
/// `evaluations` of `statistics` counts residuals.
///
///   kte::sundials::ida solver(residual, 0.0, x0, x0_dot, {.absolute = 1e-9, .relative = 1e-9});
///   solver.make_consistent(Eigen::Vector3d(1, 1, 0), 10.0);   // if x0[2] is a guess only
///   solver.integrate(10.0);
template <class R, class X>
class ida : public integrator<ida<R, X>, detail::implicit_form<R>, X> {
  using base = integrator<ida, detail::implicit_form<R>, X>;
  friend base;
  static constexpr int size = X::RowsAtCompileTime;
  using matrix = Eigen::Matrix<double, size, size>;
  static constexpr bool has_jacobian =
      requires(kte::detail::unwrapped_type<R> & f, const double& t, const X& x, matrix& j) {
    f.jacobian(t, x, x, t, j);
  };
  static constexpr bool writes = std::invocable<R&, const double&, const X&, const X&, X&>;
  static_assert(writes || std::invocable<R&, const double&, const X&, const X&>,
                "kte: a residual is called as f(t, x, x_dot) or f(t, x, x_dot, r)");

 public:
  using typename base::S;

  /// Residual, start time (s), start state and its derivative, tolerances. Throws `bad_argument` for tolerances that
  /// are not positive, and for a start that is not finite or whose sizes differ.
  template <class V, class W>
  ida(R f, const S& t0, const Eigen::MatrixBase<V>& x0, const Eigen::MatrixBase<W>& x0_dot,
      const tolerances<S>& tol = {})
      : base({std::move(f)}, t0, x0, tol),
        x_dot_(checked(x0_dot)),
        memory_(detail::made(IDACreate(this->context_.get()))) {
    void* m = memory();
    this->require(IDASetErrHandlerFn(m, detail::relay::keep_message, &this->relay_));
    this->require(IDASetUserData(m, this));
    this->require(IDAInit(m, residual, t0, this->y_.get(), y_dot_.get()));
    this->require(IDAWFtolerances(m, base::weights));
    this->require(IDASetMinStep(m, tol.smallest_step));
    this->require(IDASetMaxStep(m, tol.largest_step));
    this->require(IDASetLinearSolver(m, linear_.solver.get(), linear_.matrix.get()));
    if constexpr (has_jacobian) this->require(IDASetJacFn(m, jacobian));
  }

  /// x' at `time()`.
  const X& derivative() const { return x_dot_; }

  /// Continues from another time, state and derivative. Throws what the constructor throws.
  template <class V, class W>
  void restart(const S& t, const Eigen::MatrixBase<V>& x, const Eigen::MatrixBase<W>& x_dot) {
    const X derivative = checked(x_dot);
    base::restart(t, x);
    x_dot_ = derivative;
  }
  /// Returns to a time of the last step, with the derivative of the dense output there, when an observer stops at a
  /// sample.
  template <class V>
  void restart(const S& t, const Eigen::MatrixBase<V>& x) {
    X x_dot = x_dot_;
    this->check(IDAGetDky(memory(), t, 1, this->vector_of(x_dot).get()));
    restart(t, x, x_dot);
  }

  /// Solves (1) at `time()` for x_i where differential_i is 0 (algebraic), and for x'_i where it is 1; the other x_i
  /// are unchanged. t_next: a time towards which `integrate` will go. Throws `integration_failure` if no solution is
  /// found.
  template <class V>
  void make_consistent(const Eigen::MatrixBase<V>& differential, const S& t_next) {
    X kinds = checked(differential);
    this->require(IDASetId(memory(), this->vector_of(kinds).get()));
    solve_start(IDA_YA_YDP_INIT, t_next);
  }
  /// Solves (1) at `time()` for all x, with x' unchanged; see `make_consistent`.
  void make_state_consistent(const S& t_next) { solve_start(IDA_Y_INIT, t_next); }

  /// The memory of IDA, for functions without a member here: `IDASetSuppressAlg(solver.memory(), SUNTRUE)`.
  void* memory() { return memory_.get(); }

 private:
  static int residual(realtype t, N_Vector y, N_Vector y_dot, N_Vector out, void* self) {
    ida& me = *static_cast<ida*>(self);
    return me.relay_.guard([&] {
      me.take(y, y_dot);
      ++me.statistics_.evaluations;
      auto& f = me.system().residual;
      if constexpr (writes) {
        f(t, me.argument_, me.argument_dot_, me.result_);
      } else {
        me.result_ = f(t, me.argument_, me.argument_dot_);
      }
      if (me.result_.size() != me.x_.size()) [[unlikely]]
        kte::detail::raise<bad_argument>("kte: the residual gave " + std::to_string(me.result_.size()) +
                                         " numbers for a state of " + std::to_string(me.x_.size()));
      detail::numbers<X>(out) = me.result_;
      return me.judged(me.result_);
    });
  }
  static int jacobian(realtype t, realtype c, N_Vector y, N_Vector y_dot, N_Vector, SUNMatrix out, void* self, N_Vector,
                      N_Vector, N_Vector) {
    ida& me = *static_cast<ida*>(self);
    return me.relay_.guard([&] {
      me.take(y, y_dot);
      kte::detail::unwrapped(me.system().residual).jacobian(t, me.argument_, me.argument_dot_, c, me.jacobian_);
      detail::numbers(out) = me.jacobian_;
      return me.judged(me.jacobian_);
    });
  }
  void take(N_Vector y, N_Vector y_dot) {
    argument_ = detail::numbers<X>(y);
    argument_dot_ = detail::numbers<X>(y_dot);
  }

  int initialize() {
    next_dot_ = x_dot_;
    N_VSetArrayPointer(next_dot_.data(), y_dot_.get());
    return IDAReInit(memory(), this->time_, this->y_.get(), y_dot_.get());
  }
  int begin_with(const S& h) { return IDASetInitStep(memory(), this->backward_ ? -h : h); }
  int take_step(const S& t_end, S& reached) {
    N_VSetArrayPointer(next_dot_.data(), y_dot_.get());
    int flag = IDASetStopTime(memory(), t_end);
    if (flag >= 0) flag = IDASolve(memory(), t_end, &reached, this->y_.get(), y_dot_.get(), IDA_ONE_STEP);
    if (flag >= 0 && this->next_is_finite()) x_dot_.swap(next_dot_);
    return flag;
  }
  int dense_at(const S& t, N_Vector y) const { return IDAGetDky(memory_.get(), t, 0, y); }
  detail::counts counted() {
    detail::counts c;
    IDAGetNumErrTestFails(memory(), &c.rejected_by_error);
    IDAGetNumStepSolveFails(memory(), &c.rejected_by_newton);
    IDAGetNumJacEvals(memory(), &c.jacobians);
    IDAGetNumLinSolvSetups(memory(), &c.factorizations);
    return c;
  }
  static char* flag_name(int flag) { return IDAGetReturnFlagName(flag); }

  void solve_start(int what, const S& t_next) {
    this->restart_solver();
    const int flag = IDACalcIC(memory(), what, t_next);
    this->count();
    this->check(flag);
    X x = this->x_;
    N_VSetArrayPointer(x.data(), this->y_.get());
    this->check(IDAGetConsistentIC(memory(), this->y_.get(), y_dot_.get()));
    restart(this->time_, x, next_dot_);
  }
  template <class W>
  X checked(const Eigen::MatrixBase<W>& v) const {
    if (v.size() != this->x_.size())
      kte::detail::raise<bad_argument>("kte: " + std::to_string(v.size()) + " numbers for a state of " +
                                       std::to_string(this->x_.size()));
    for (Eigen::Index i = 0; i < v.size(); ++i) kte::detail::check_finite(S(v[i]), "number of a derivative");
    return v;
  }

  X x_dot_, next_dot_ = x_dot_, argument_ = x_dot_, argument_dot_ = x_dot_, result_ = x_dot_;
  matrix jacobian_ = matrix::Zero(x_dot_.size(), x_dot_.size());
  detail::vector_handle y_dot_ = this->vector_of(x_dot_);
  detail::dense_linear_solver linear_{y_dot_.get(), this->context_.get()};
  std::unique_ptr<void, detail::freed_by_address<IDAFree>> memory_;
};

template <class R, class V, class W>
ida(R, const typename V::Scalar&, const Eigen::MatrixBase<V>&, const Eigen::MatrixBase<W>&,
    const tolerances<typename V::Scalar>& = {}) -> ida<R, typename V::PlainObject>;

}  // namespace kte::sundials
