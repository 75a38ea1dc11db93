#pragma once

#include <kte/contact/detail/friction_admm.hpp>
#include <kte/contact/detail/friction_gauss_seidel.hpp>
#include <kte/contact/detail/friction_newton.hpp>

namespace kte::detail {

/// Methods for friction problems that Newton's method does not solve from its start. Each ends with Newton's method.
template <class S>
class friction_rescue {
 public:
  /// Regularised problems W + eps I, eps from 1 to 1e-9: Newton's method, each from the solution before, and from there
  /// that of W itself. The ratio of one eps to the next is `least`; where Newton's method fails, its root, at least
  /// 0.95.
  bool continuation(const friction_system<S>& p, friction_newton<S>& newton, S* lambda, const friction_options<S>& o,
                    int& iterations, S& residual, S least = S(0.1), int stages = 60) {
    using std::sqrt;
    const auto m = static_cast<std::size_t>(p.size);
    kept_.assign(m, S(0));
    S eps(10), ratio(least);
    for (int stage = 0; stage < stages && eps > S(1e-9); ++stage) {
      std::copy_n(kept_.begin(), m, lambda);
      iterations += newton.solve(p, lambda, eps * ratio, 12, S(1e-9), false, residual);
      if (!(residual <= S(1e-9))) iterations += newton.solve(p, lambda, eps * ratio, 25, S(1e-9), true, residual);
      const bool solved = residual <= S(1e-9);
      if (!solved && ratio < S(0.9)) {
        ratio = sqrt(ratio);
        continue;
      }
      eps *= ratio;
      if (solved) ratio = (std::max<S>)(ratio * ratio, least);
      std::copy_n(lambda, m, kept_.begin());
      iterations += newton.solve(p, lambda, S(0), 10, o.tolerance, false, residual);
      if (residual <= o.tolerance) return true;
    }
    return false;
  }
  bool admm(const friction_system<S>& p, friction_newton<S>& newton, S* lambda, const friction_options<S>& o,
            int& iterations, S& residual) {
    admm_.start(p, lambda);
    int next = 20;
    for (int k = 1; k <= o.admm_steps; ++k) {
      admm_.step(p);
      ++iterations;
      if (k < next && k < o.admm_steps) continue;
      next += next / 2;
      std::copy_n(admm_.lambda().data(), p.size, lambda);
      iterations += newton.solve(p, lambda, S(0), o.newton_steps / 2, o.tolerance, k > 100, residual);
      if (residual <= o.tolerance) return true;
    }
    return false;
  }
  bool gauss_seidel(const friction_system<S>& p, friction_newton<S>& newton, S* lambda, const friction_options<S>& o,
                    int& iterations, S& residual) {
    const auto m = static_cast<std::size_t>(p.size);
    u_.resize(m), kept_.assign(m, S(0));
    p.velocity(kept_.data(), u_.data());
    int next = 10;
    for (int k = 1; k <= o.sweeps; ++k) {
      gauss_seidel_sweep(p, kept_.data(), u_.data());
      ++iterations;
      if (k < next && k < o.sweeps) continue;
      next += next / 2;
      p.velocity(kept_.data(), u_.data());
      std::copy_n(kept_.data(), m, lambda);
      iterations += newton.solve(p, lambda, S(0), o.newton_steps / 2, o.tolerance, k > 100, residual);
      if (residual <= o.tolerance) return true;
    }
    return false;
  }

 private:
  friction_admm<S> admm_;
  std::vector<S> u_, kept_;
};

}  // namespace kte::detail
