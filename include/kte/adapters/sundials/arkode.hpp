#pragma once

#include <kte/adapters/sundials/explicit_form.hpp>

#include <arkode/arkode_arkstep.h>
#include <optional>

namespace kte::sundials {

/// ARKODE: Runge-Kutta methods by a table of SUNDIALS, explicit for an `ARKODE_ERKTableID`, diagonally implicit for an
/// `ARKODE_DIRKTableID`.
template <class Table, class F, class X>
class arkode : public explicit_form<arkode<Table, F, X>, F, X> {
  using base = explicit_form<arkode, F, X>;
  friend integrator<arkode, F, X>;
  static constexpr bool implicit = std::is_same_v<Table, ARKODE_DIRKTableID>;

 public:
  using typename base::S;

  /// f(t, x), start time, s, start state, tolerances, table. Throws `bad_argument` for tolerances that are not
  /// positive, for a start that is not finite, and for a table that SUNDIALS does not have.
  template <class V>
  arkode(F f, const S& t0, const Eigen::MatrixBase<V>& x0, const tolerances<S>& tol, Table table)
      : base(std::move(f), t0, x0, tol), memory_(detail::made(create())) {
    void* m = memory();
    this->require(ARKStepSetErrHandlerFn(m, detail::relay::keep_message, &this->relay_));
    this->require(ARKStepSetUserData(m, this));
    this->require(ARKStepWFtolerances(m, base::weights));
    this->require(ARKStepSetMinStep(m, tol.smallest_step));
    this->require(ARKStepSetMaxStep(m, tol.largest_step));
    if constexpr (implicit) {
      this->require(ARKStepSetTableNum(m, table, ARKODE_ERK_NONE));
      // Slopes are deduced from Newton's method. Evaluating f at its solution would multiply its error by the
      // stiffness.
      this->require(ARKStepSetDeduceImplicitRhs(m, SUNTRUE));
      this->require(ARKStepSetInterpolantType(m, ARK_INTERP_LAGRANGE));
      linear_.emplace(this->y_.get(), this->context_.get());
      this->require(ARKStepSetLinearSolver(m, linear_->solver.get(), linear_->matrix.get()));
      if constexpr (base::has_jacobian) this->require(ARKStepSetJacFn(m, signed_jacobian));
    } else {
      this->require(ARKStepSetTableNum(m, ARKODE_DIRK_NONE, table));
    }
  }

  /// The memory of ARKODE, for functions without a member here: `ARKStepSetSafetyFactor(solver.memory(), 0.9)`.
  void* memory() { return memory_.get(); }

 private:
  // ARKODE cannot reverse its direction, so it always integrates forward in s t, with s = 1 or -1.
  double sign() const { return this->backward_ ? -1 : 1; }

  static int signed_slope(realtype st, N_Vector y, N_Vector out, void* self) {
    const double s = static_cast<arkode*>(self)->sign();
    const int flag = base::right_hand_side(s * st, y, out, self);
    detail::numbers<X>(out) *= s;
    return implicit ? flag : (std::min)(flag, 0);  // ARKODE stops at NaN; otherwise it reduces the step without end
  }
  static int signed_jacobian(realtype st, N_Vector y, N_Vector f, SUNMatrix out, void* self, N_Vector a, N_Vector b,
                             N_Vector c) {
    const double s = static_cast<arkode*>(self)->sign();
    const int flag = base::jacobian(s * st, y, f, out, self, a, b, c);
    detail::numbers(out) *= s;
    return flag;
  }
  static constexpr ARKRhsFn explicit_part = implicit ? nullptr : signed_slope;
  static constexpr ARKRhsFn implicit_part = implicit ? signed_slope : nullptr;

  void* create() {
    return ARKStepCreate(explicit_part, implicit_part, this->time_, this->y_.get(), this->context_.get());
  }
  int initialize() {
    return ARKStepReInit(memory(), explicit_part, implicit_part, sign() * this->time_, this->y_.get());
  }
  int begin_with(const S& h) { return ARKStepSetInitStep(memory(), h); }
  int take_step(const S& t_end, S& reached) {
    const S end = sign() * t_end;
    int flag = ARKStepSetStopTime(memory(), end);
    if (flag >= 0) flag = ARKStepEvolve(memory(), end, this->y_.get(), &reached, ARK_ONE_STEP);
    reached *= sign();
    return flag;
  }
  int dense_at(const S& t, N_Vector y) const { return ARKStepGetDky(memory_.get(), sign() * t, 0, y); }
  detail::counts counted() {
    detail::counts c;
    ARKStepGetNumErrTestFails(memory(), &c.rejected_by_error);
    ARKStepGetNumStepSolveFails(memory(), &c.rejected_by_newton);
    if constexpr (implicit) {
      ARKStepGetNumJacEvals(memory(), &c.jacobians);
      ARKStepGetNumLinSolvSetups(memory(), &c.factorizations);
    }
    return c;
  }
  static char* flag_name(int flag) { return ARKStepGetReturnFlagName(flag); }

  std::optional<detail::dense_linear_solver> linear_;
  std::unique_ptr<void, detail::freed_by_address<ARKStepFree>> memory_;
};

/// An explicit Runge-Kutta method of ARKODE.
///
///   kte::sundials::explicit_runge_kutta solver(f, 0.0, x0, {.absolute = 1e-9, .relative = 1e-9}, ARKODE_VERNER_8_5_6);
///
/// The dense output is a polynomial of degree 5 at most; of degree 4 and 5 it evaluates f at every sample.
template <class F, class X>
class explicit_runge_kutta : public arkode<ARKODE_ERKTableID, F, X> {
  using base = arkode<ARKODE_ERKTableID, F, X>;

 public:
  template <class V>
  explicit_runge_kutta(F f, const typename base::S& t0, const Eigen::MatrixBase<V>& x0,
                       const tolerances<typename base::S>& tol = {},
                       ARKODE_ERKTableID table = ARKODE_DORMAND_PRINCE_7_4_5)
      : base(std::move(f), t0, x0, tol, table) {}
};
template <class F, class V>
explicit_runge_kutta(F, const typename V::Scalar&, const Eigen::MatrixBase<V>&,
                     const tolerances<typename V::Scalar>& = {}, ARKODE_ERKTableID = ARKODE_DORMAND_PRINCE_7_4_5)
    -> explicit_runge_kutta<F, typename V::PlainObject>;

/// A diagonally implicit Runge-Kutta method of ARKODE, for stiff systems: Newton's method with dense matrices.
///
///   kte::sundials::implicit_runge_kutta solver(f, 0.0, x0, {}, ARKODE_TRBDF2_3_3_2);
///
/// The dense output is a polynomial through states of the last steps.
template <class F, class X>
class implicit_runge_kutta : public arkode<ARKODE_DIRKTableID, F, X> {
  using base = arkode<ARKODE_DIRKTableID, F, X>;

 public:
  template <class V>
  implicit_runge_kutta(F f, const typename base::S& t0, const Eigen::MatrixBase<V>& x0,
                       const tolerances<typename base::S>& tol = {}, ARKODE_DIRKTableID table = ARKODE_KVAERNO_5_3_4)
      : base(std::move(f), t0, x0, tol, table) {}
};
template <class F, class V>
implicit_runge_kutta(F, const typename V::Scalar&, const Eigen::MatrixBase<V>&,
                     const tolerances<typename V::Scalar>& = {}, ARKODE_DIRKTableID = ARKODE_KVAERNO_5_3_4)
    -> implicit_runge_kutta<F, typename V::PlainObject>;

}  // namespace kte::sundials
