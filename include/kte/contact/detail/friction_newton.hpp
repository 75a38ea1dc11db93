#pragma once

#include <kte/contact/detail/eliminate.hpp>
#include <kte/contact/detail/friction_unknowns.hpp>
#include <kte/contact/detail/singular_limit.hpp>

namespace kte::detail {

/// Newton's method on the natural map of a friction problem, with the equations of `friction_unknowns`. W + 1e-9 I is
/// used in its steps, first unchanged, which leads to lambda of least norm, then, from residuals of 1e-6, relative
/// to the last lambda, which leaves no error in u.
template <class S>
class friction_newton {
 public:
  using view = Eigen::Map<Eigen::Matrix<S, Eigen::Dynamic, 1>>;

  /// Steps from lambda, which becomes the best iterate, to W + shift/rho: damped if `damped`. Returns the number of
  /// steps; `residual` is of the result.
  int solve(const friction_system<S>& p, S* lambda, S shift, int steps, S tolerance, bool damped, S& residual) {
    const Eigen::Index m = p.size;
    const auto size = static_cast<std::size_t>(m);
    u_.resize(size), F_.resize(size), next_.resize(size), trial_.resize(size), best_.resize(size);
    S merit = evaluate(p, lambda, shift);
    residual = merit;
    std::copy_n(lambda, m, best_.data());
    int step = 0;
    for (; step < steps && !(residual <= tolerance); ++step) {
      if (!direction(p, lambda, shift, shift == S(0) && merit <= S(1e-6))) break;
      S a(1);
      S best_merit(-1), best_a(1);
      for (int halving = 0;; ++halving) {
        for (Eigen::Index i = 0; i < m; ++i)
          trial_[static_cast<std::size_t>(i)] = lambda[i] + a * (next_[static_cast<std::size_t>(i)] - lambda[i]);
        merit = evaluate(p, trial_.data(), shift);
        if (merit == merit && (best_merit < S(0) || merit < best_merit)) best_merit = merit, best_a = a;
        if (!damped || merit < residual * S(0.999) || halving == 5) break;
        a = a / 2;
      }
      if (a != best_a) {
        for (Eigen::Index i = 0; i < m; ++i)
          trial_[static_cast<std::size_t>(i)] = lambda[i] + best_a * (next_[static_cast<std::size_t>(i)] - lambda[i]);
        merit = evaluate(p, trial_.data(), shift);
      }
      if (!(merit == merit)) break;
      std::copy_n(trial_.data(), m, lambda);
      if (damped) residual = merit;
      if (merit <= residual) {
        residual = merit;
        std::copy_n(lambda, m, best_.data());
      }
    }
    if (!damped) std::copy_n(best_.data(), m, lambda);
    return step;
  }
  /// Undamped steps as long as the residual falls by half. Returns their number.
  int polish(const friction_system<S>& p, S* lambda, S& residual) {
    int steps = 0;
    for (S before = 2 * residual; residual < before / 2 && residual > S(0) && steps < 8; ++steps) {
      before = residual;
      solve(p, lambda, S(0), 1, S(0), false, residual);
    }
    return steps;
  }

  /// Replaces lambda, a solution, by the limit of solutions of W + eps I for eps to 0 with the same u', if it is a
  /// solution too. For contacts that all stick: lambda of least norm.
  void balance(const friction_system<S>& p, S* lambda, S tolerance, S& residual) {
    if (!(smallest_ < S(1e-7) * p.unit)) return;
    kept_.assign(lambda, lambda + p.size);
    const S before = residual, slack = S(1e-9) * view(lambda, p.size).cwiseAbs().maxCoeff();
    for (S shift(0); shift<S(1e-3); shift = shift> S(0) ? S(shift * S(100)) : S(1e-7)) {
      if (shift > S(0)) solve(p, lambda, shift, 20, S(1e-9), false, residual);
      evaluate(p, lambda, shift);
      unknowns_.choose(p, lambda, u_.data(), S(0), shift > S(0) ? S(0) : slack);
      unknowns_.assemble(p, nullptr, S(0));
      if (unknowns_.size() > 0 && !limit_.solve(unknowns_.equations(), unknowns_.size(), unknowns_.stride())) continue;
      unknowns_.put(p, lambda);
      solve(p, lambda, S(0), 3, S(0.01) * tolerance, false, residual);
      if (residual <= tolerance) return;
    }
    std::copy(kept_.begin(), kept_.end(), lambda);
    residual = before;
  }

 private:
  S evaluate(const friction_system<S>& p, const S* lambda, S shift) {
    p.velocity(lambda, u_.data());
    if (shift > S(0))
      for (Eigen::Index i = 0; i < p.size; ++i) u_[static_cast<std::size_t>(i)] += shift * p.unit * lambda[i];
    return p.residual(lambda, u_.data(), F_.data());
  }

  /// The next lambda. With `proximal`, the shift of the matrix is relative to lambda.
  bool direction(const friction_system<S>& p, const S* lambda, S shift, bool proximal) {
    const S used = shift > S(0) ? shift : S(1e-9);
    unknowns_.choose(p, lambda, u_.data(), used);
    unknowns_.assemble(p, proximal ? lambda : nullptr, used);
    smallest_ = p.unit;
    if (unknowns_.size() > 0) smallest_ = eliminate(unknowns_.equations(), unknowns_.size(), unknowns_.stride());
    if (!(smallest_ > S(0))) return false;
    unknowns_.put(p, next_.data());
    return true;
  }

  friction_unknowns<S> unknowns_;
  singular_limit<S> limit_;
  S smallest_{1};  // pivot of the last step
  std::vector<S> u_, F_, next_, trial_, best_, kept_;
};

}  // namespace kte::detail
