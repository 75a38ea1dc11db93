#pragma once

#include <kte/adapters/sundials/explicit_form.hpp>

#include <cvode/cvode.h>
#include <cvode/cvode_ls.h>
#include <optional>

namespace kte::sundials {

/// CVODE: linear multistep methods of variable order. `Lmm`: CV_BDF or CV_ADAMS.
template <int Lmm, class F, class X>
class cvode : public explicit_form<cvode<Lmm, F, X>, F, X> {
  using base = explicit_form<cvode, F, X>;
  friend integrator<cvode, F, X>;

 public:
  using typename base::S;

  /// f(t, x), start time, s, start state, tolerances. Throws `bad_argument` for tolerances that are not positive, and
  /// for a start that is not finite.
  template <class V>
  cvode(F f, const S& t0, const Eigen::MatrixBase<V>& x0, const tolerances<S>& tol = {})
      : base(std::move(f), t0, x0, tol), memory_(detail::made(CVodeCreate(Lmm, this->context_.get()))) {
    void* m = memory();
    this->require(CVodeSetErrHandlerFn(m, detail::relay::keep_message, &this->relay_));
    this->require(CVodeSetUserData(m, this));
    this->require(CVodeInit(m, base::right_hand_side, t0, this->y_.get()));
    this->require(CVodeWFtolerances(m, base::weights));
    this->require(CVodeSetMinStep(m, tol.smallest_step));
    this->require(CVodeSetMaxStep(m, tol.largest_step));
    if constexpr (Lmm == CV_BDF) {
      linear_.emplace(this->y_.get(), this->context_.get());
      this->require(CVodeSetLinearSolver(m, linear_->solver.get(), linear_->matrix.get()));
      if constexpr (base::has_jacobian) this->require(CVodeSetJacFn(m, base::jacobian));
    } else {
      fixed_point_.reset(detail::made(SUNNonlinSol_FixedPoint(this->y_.get(), 0, this->context_.get())));
      this->require(CVodeSetNonlinearSolver(m, fixed_point_.get()));
    }
  }

  /// The memory of CVODE, for functions without a member here: `CVodeSetMaxOrd(solver.memory(), 2)`.
  void* memory() { return memory_.get(); }

 private:
  int initialize() { return CVodeReInit(memory(), this->time_, this->y_.get()); }
  int begin_with(const S& h) { return CVodeSetInitStep(memory(), this->backward_ ? -h : h); }
  int take_step(const S& t_end, S& reached) {
    const int flag = CVodeSetStopTime(memory(), t_end);
    return flag < 0 ? flag : CVode(memory(), t_end, this->y_.get(), &reached, CV_ONE_STEP);
  }
  int dense_at(const S& t, N_Vector y) const { return CVodeGetDky(memory_.get(), t, 0, y); }
  detail::counts counted() {
    detail::counts c;
    CVodeGetNumErrTestFails(memory(), &c.rejected_by_error);
    CVodeGetNumStepSolveFails(memory(), &c.rejected_by_newton);
    if constexpr (Lmm == CV_BDF) {
      CVodeGetNumJacEvals(memory(), &c.jacobians);
      CVodeGetNumLinSolvSetups(memory(), &c.factorizations);
    }
    return c;
  }
  static char* flag_name(int flag) { return CVodeGetReturnFlagName(flag); }

  std::optional<detail::dense_linear_solver> linear_;
  detail::nonlinear_solver_handle fixed_point_;
  std::unique_ptr<void, detail::freed_by_address<CVodeFree>> memory_;
};

/// CVODE's backward differentiation formulas of order 1 to 5, for stiff systems: Newton's method with dense matrices.
///
///   kte::sundials::bdf solver(f, 0.0, x0, {.absolute = 1e-9, .relative = 1e-9});
///   solver.integrate(10.0);
template <class F, class X>
class bdf : public cvode<CV_BDF, F, X> {
 public:
  using cvode<CV_BDF, F, X>::cvode;
};
template <class F, class V>
bdf(F, const typename V::Scalar&, const Eigen::MatrixBase<V>&, const tolerances<typename V::Scalar>& = {})
    -> bdf<F, typename V::PlainObject>;

/// CVODE's Adams-Moulton formulas of order 1 to 12, for systems that are not stiff: functional iteration, no Jacobian.
template <class F, class X>
class adams : public cvode<CV_ADAMS, F, X> {
 public:
  using cvode<CV_ADAMS, F, X>::cvode;
};
template <class F, class V>
adams(F, const typename V::Scalar&, const Eigen::MatrixBase<V>&, const tolerances<typename V::Scalar>& = {})
    -> adams<F, typename V::PlainObject>;

}  // namespace kte::sundials
