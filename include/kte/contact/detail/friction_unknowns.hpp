#pragma once

#include <kte/contact/detail/friction_system.hpp>

namespace kte::detail {

/// The linear equations of one step of Newton's method for a friction problem, in the unknowns of its active contacts.
/// With tau = lambda - rho u, a contact is open if tau_n <= 0 (no unknown); else it sticks if |tau_t| <= mu tau_n (all
/// rows of lambda are unknown, u = 0), or slides along t = tau_t/|tau_t|: unknown are lambda_n, with lambda_t = mu
/// lambda_n t, and in space lambda_s across t. The equations of sliding are linear in the next lambda:
///
///   u_n = 0,   u_s + kappa lambda_s = 0,   kappa = (|tau_t| - mu tau_n)/(rho_t mu tau_n)        (1)
template <class S>
class friction_unknowns {
 public:
  /// A combination of the rows of lambda of one contact, and the combination of rows of u in its equation.
  struct unknown {
    int contact, rows;
    S of_lambda[3], of_u[3];
    S diagonal;
  };

  /// Chooses the unknowns at lambda and u; adds `shift` to the diagonal. Contacts within `slack` of
  /// closing or sticking do so.
  void choose(const friction_system<S>& p, const S* lambda, const S* velocity, S shift, S slack = S(0)) {
    using std::sqrt;
    unknowns_.clear();
    for (int i = 0; i < p.count(); ++i) {
      const auto k = static_cast<std::size_t>(i);
      const auto& contact = p.contacts[k];
      const Eigen::Index r = p.first[k];
      const S* u = velocity + r;
      const S tau_n = lambda[r] - p.rho_n[k] * u[0];
      if (!(tau_n > -slack)) continue;
      const S radius = p.mu[k] * tau_n;
      const int n = contact.rows;
      const S eps = shift * p.unit;
      if (const auto& d = contact.sliding) {
        unknowns_.push_back(
            {i, n, {S(1), -p.mu[k] * (*d)[0], n == 3 ? S(-p.mu[k] * (*d)[1]) : S(0)}, {S(1), S(0), S(0)}, eps});
        continue;
      }
      if (!(p.mu[k] > S(0))) {
        unknowns_.push_back({i, n, {S(1), S(0), S(0)}, {S(1), S(0), S(0)}, eps});
        continue;
      }
      const S t1 = lambda[r + 1] - p.rho_t[k] * u[1], t2 = n == 3 ? S(lambda[r + 2] - p.rho_t[k] * u[2]) : S(0);
      const S length = sqrt(t1 * t1 + t2 * t2);
      if (length <= radius + slack) {
        for (int c = 0; c < n; ++c) {
          unknown x{i, n, {S(0), S(0), S(0)}, {S(0), S(0), S(0)}, eps};
          x.of_lambda[c] = x.of_u[c] = S(1);
          unknowns_.push_back(x);
        }
      } else if (radius > S(0)) {
        const S c1 = t1 / length, c2 = t2 / length;
        unknowns_.push_back({i, n, {S(1), p.mu[k] * c1, p.mu[k] * c2}, {S(1), S(0), S(0)}, eps});
        if (n == 3)
          unknowns_.push_back(
              {i, n, {S(0), -c2, c1}, {S(0), -c2, c1}, eps + (length - radius) / (p.rho_t[k] * radius)});
      }
    }
  }

  /// Writes the equations, as for `eliminate`, with the terms of `shift` at lambda if `proximal`.
  void assemble(const friction_system<S>& p, const S* lambda, S shift) {
    const auto n = static_cast<Eigen::Index>(unknowns_.size());
    stride_ = (n / 4 + 1) * 4;
    if (static_cast<Eigen::Index>(A_.size()) < n * stride_ + 4) A_.resize(static_cast<std::size_t>(n * stride_ + 4));
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
        A[i * stride_ + j] = sum;
      }
    }
    for (Eigen::Index i = 0; i < n; ++i) {
      const unknown& y = unknowns_[static_cast<std::size_t>(i)];
      const Eigen::Index row = p.first[static_cast<std::size_t>(y.contact)];
      S sum(0);
      for (int e = 0; e < y.rows; ++e) {
        sum -= y.of_u[e] * p.b[row + e];
        if (lambda) sum += y.of_u[e] * lambda[row + e] * shift * p.unit;
      }
      A[i * stride_ + i] += y.diagonal;
      A[i * stride_ + n] = sum;
    }
  }
  /// lambda of the solution x of the equations.
  void put(const friction_system<S>& p, S* lambda) const {
    std::fill_n(lambda, p.size, S(0));
    const auto n = static_cast<Eigen::Index>(unknowns_.size());
    for (Eigen::Index j = 0; j < n; ++j) {
      const unknown& x = unknowns_[static_cast<std::size_t>(j)];
      const Eigen::Index row = p.first[static_cast<std::size_t>(x.contact)];
      for (int c = 0; c < x.rows; ++c)
        lambda[row + c] += A_[static_cast<std::size_t>(j * stride_ + n)] * x.of_lambda[c];
    }
  }
  Eigen::Index size() const { return static_cast<Eigen::Index>(unknowns_.size()); }
  Eigen::Index stride() const { return stride_; }
  S* equations() { return A_.data(); }

 private:
  std::vector<unknown> unknowns_;
  std::vector<S> A_;
  Eigen::Index stride_ = 0;
};

}  // namespace kte::detail
