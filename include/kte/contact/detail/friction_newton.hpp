#pragma once

#include <kte/contact/detail/eliminate.hpp>
#include <kte/contact/detail/friction_system.hpp>

namespace kte::detail {

/// Newton's method on the natural map of a friction problem, in the unknowns of its active contacts. With tau = lambda -
/// rho u, a contact is open if tau_n <= 0 (no unknown); else it sticks if |tau_t| <= mu tau_n (all rows of lambda are
/// unknown, u = 0), or slides along t = tau_t/|tau_t|: unknown are lambda_n, with lambda_t = mu lambda_n t, and in space
/// lambda_s across t. The equations of sliding are linear in the new lambda:
///
///   u_n = 0,   u_s + kappa lambda_s = 0,   kappa = (|tau_t| - mu tau_n)/(rho_t mu tau_n)        (1)
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
      if (!direction(p, lambda, shift, merit <= S(1e-6))) break;
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

 private:
  S evaluate(const friction_system<S>& p, const S* lambda, S shift) {
    p.velocity(lambda, u_.data());
    if (shift > S(0))
      for (Eigen::Index i = 0; i < p.size; ++i) u_[static_cast<std::size_t>(i)] += shift * p.unit * lambda[i];
    return p.residual(lambda, u_.data(), F_.data());
  }

  /// An unknown: a combination of the rows of one contact, and the one of its equation.
  struct unknown {
    int contact, rows;
    S of_lambda[3], of_u[3];
    S diagonal;
  };

  void collect(const friction_system<S>& p, const S* lambda, S shift) {
    using std::sqrt;
    unknowns_.clear();
    for (int i = 0; i < p.count(); ++i) {
      const auto k = static_cast<std::size_t>(i);
      const auto& contact = p.contacts[k];
      const Eigen::Index r = p.first[k];
      const S* u = u_.data() + r;
      const S tau_n = lambda[r] - p.rho_n[k] * u[0];
      if (!(tau_n > S(0))) continue;
      const S radius = p.mu[k] * tau_n;
      const int n = contact.rows;
      const S eps_n = shift * p.unit, eps_t = shift * p.unit;
      if (const auto& d = contact.sliding) {
        unknowns_.push_back({i, n, {S(1), -p.mu[k] * (*d)[0], n == 3 ? S(-p.mu[k] * (*d)[1]) : S(0)}, {S(1), S(0), S(0)}, eps_n});
        continue;
      }
      if (!(p.mu[k] > S(0))) {
        unknowns_.push_back({i, n, {S(1), S(0), S(0)}, {S(1), S(0), S(0)}, eps_n});
        continue;
      }
      const S t1 = lambda[r + 1] - p.rho_t[k] * u[1], t2 = n == 3 ? S(lambda[r + 2] - p.rho_t[k] * u[2]) : S(0);
      const S length = sqrt(t1 * t1 + t2 * t2);
      if (length <= radius) {
        for (int c = 0; c < n; ++c) {
          unknown x{i, n, {S(0), S(0), S(0)}, {S(0), S(0), S(0)}, c == 0 ? eps_n : eps_t};
          x.of_lambda[c] = x.of_u[c] = S(1);
          unknowns_.push_back(x);
        }
      } else {
        const S c1 = t1 / length, c2 = t2 / length;
        unknowns_.push_back({i, n, {S(1), p.mu[k] * c1, p.mu[k] * c2}, {S(1), S(0), S(0)}, eps_n});
        if (n == 3)
          unknowns_.push_back({i, n, {S(0), -c2, c1}, {S(0), -c2, c1}, eps_t + (length - radius) / (p.rho_t[k] * radius)});
      }
    }
  }

  /// The next lambda by (1).
  bool direction(const friction_system<S>& p, const S* lambda, S shift, bool proximal) {
    collect(p, lambda, shift > S(0) ? shift : S(1e-9));
    const auto n = static_cast<Eigen::Index>(unknowns_.size());
    const Eigen::Index stride = (n / 4 + 1) * 4;
    if (static_cast<Eigen::Index>(A_.size()) < n * stride + 8) A_.resize(static_cast<std::size_t>(n * stride + 8));
    S* const A = A_.data();
    for (Eigen::Index j = 0; j < n; ++j) {
      const unknown& x = unknowns_[static_cast<std::size_t>(j)];
      const Eigen::Index first = p.first[static_cast<std::size_t>(x.contact)];
      for (Eigen::Index i = 0; i < n; ++i) {
        const unknown& y = unknowns_[static_cast<std::size_t>(i)];
        const Eigen::Index row = p.first[static_cast<std::size_t>(y.contact)];
        S sum(0);
        for (int c = 0; c < x.rows; ++c) {
          if (x.of_lambda[c] == S(0)) continue;
          const S* const w = p.column(first + c) + row;
          S part(0);
          for (int e = 0; e < y.rows; ++e) part += y.of_u[e] * w[e];
          sum += x.of_lambda[c] * part;
        }
        A[i * stride + j] = sum;
      }
    }
    for (Eigen::Index i = 0; i < n; ++i) {
      const unknown& y = unknowns_[static_cast<std::size_t>(i)];
      const Eigen::Index row = p.first[static_cast<std::size_t>(y.contact)];
      S sum(0);
      for (int e = 0; e < y.rows; ++e) {
        sum -= y.of_u[e] * p.b[row + e];
        if (proximal) sum += y.of_u[e] * lambda[row + e] * S(1e-9) * p.unit;
      }
      A[i * stride + i] += y.diagonal;
      A[i * stride + n] = sum;
    }
    if (n > 0 && !eliminate(A, n, stride)) return false;
    std::fill(next_.begin(), next_.begin() + p.size, S(0));
    for (Eigen::Index j = 0; j < n; ++j) {
      const unknown& x = unknowns_[static_cast<std::size_t>(j)];
      const auto row = static_cast<std::size_t>(p.first[static_cast<std::size_t>(x.contact)]);
      for (int c = 0; c < x.rows; ++c) next_[row + static_cast<std::size_t>(c)] += A[j * stride + n] * x.of_lambda[c];
    }
    return true;
  }

  std::vector<S> u_, F_, next_, trial_, best_, A_;
  std::vector<unknown> unknowns_;
};

}  // namespace kte::detail
