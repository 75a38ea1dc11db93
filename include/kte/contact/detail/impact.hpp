#pragma once

#include <kte/contact/impact.hpp>

namespace kte {

namespace detail {
/// The largest theta in [0, 1] with gain(theta) <= 0, for gain(1) > 0: 0 if gain(0) >= 0. By the secant method with the
/// Illinois rule.
template <class S, class Gain>
S largest_without_gain(S at_high, const Gain& gain) {
  S low(0), high(1), at_low = (std::min<S>)(gain(low), S(0));
  int side = 0;
  for (int step = 0; step < 200 && high - low > std::numeric_limits<S>::epsilon() && at_low < S(0); ++step) {
    S middle = step % 8 == 7 ? S((low + high) / 2) : S(low - at_low * (high - low) / (at_high - at_low));
    if (!(middle > low && middle < high)) middle = (low + high) / 2;
    if (!(middle > low && middle < high)) break;
    const S at = gain(middle);
    if (at <= S(0)) {
      low = middle, at_low = at;
      if (side < 0) at_high /= 2;
      side = -1;
    } else {
      high = middle, at_high = at;
      if (side > 0) at_low /= 2;
      side = 1;
    }
  }
  return low;
}
}  // namespace detail

/// Solves (1) with theta e for `part`, whose b is u^-. Returns (2) relative to the sum of |P| (|u^+| + |u^-|)/2;
/// 1 if there is no solution: contacts may not be able to separate as fast as their e demand.
template <class S>
S impact_solver<S>::gain(S theta, const friction_problem<S>& part, std::span<const S> restitution) {
  using std::abs;
  const auto m = static_cast<std::size_t>(part.b.size());
  b_.assign(part.b.data(), part.b.data() + m);
  std::size_t row = 0;
  for (std::size_t k = 0; k < part.contacts.size(); ++k) {
    b_[row] += theta * restitution[k] * (std::min<S>)(b_[row], S(0));
    row += static_cast<std::size_t>(part.contacts[k].rows);
  }
  friction_problem<S> shifted(part);
  new (&shifted.b) Eigen::Map<const typename friction_problem<S>::vector>(b_.data(), part.b.size());
  last_ = &solver_.solve(shifted, options_, start_);
  if (!is_taken(last_->status, last_->residual)) return S(1);
  start_ = last_->lambda;
  S energy(0), scale(0);
  for (std::size_t r = 0; r < m; ++r) {
    const S before = part.b[static_cast<Eigen::Index>(r)], after = last_->u[r] - (b_[r] - before);
    energy += last_->lambda[r] * (after + before) / 2;
    scale += abs(last_->lambda[r]) * (abs(after) + abs(before)) / 2;
  }
  return scale > S(0) ? S(energy / scale) : S(0);
}

/// (1) to (3) for contacts from `first` on, whose rows are those of `part`; adds to the impulses.
template <class S>
void impact_solver<S>::resolve(const friction_problem<S>& part, std::span<const S> restitution, std::size_t first) {
  using std::abs;
  const S rounding = S(16) * std::numeric_limits<S>::epsilon();
  start_.clear();
  const S at_high = gain(S(1), part, restitution);
  if (at_high > (std::max<S>)(rounding, last_->residual)) {
    S theta(0);
    // Two solutions of one problem may differ by its tolerance: if the last one gains, theta is that of a small loss.
    for (const S loss : {S(0), S(4) * options_.tolerance}) {
      const auto excess = [&](const S& middle) { return S(gain(middle, part, restitution) + loss); };
      theta = detail::largest_without_gain(S(at_high + loss), excess);
      if (gain(theta, part, restitution) <= rounding) break;
    }
    found_.restitution_factor = (std::min<S>)(found_.restitution_factor, theta);
  }
  std::size_t row = 0;
  for (std::size_t k = 0; k < first; ++k) row += static_cast<std::size_t>(all_->contacts[k].rows);
  for (std::size_t r = 0; r < last_->lambda.size(); ++r) {
    const S P = last_->lambda[r];
    found_.impulse[row + r] += P;
    for (std::size_t i = 0; i < found_.u.size(); ++i)
      found_.u[i] += all_->W(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(row + r)) * P;
  }
  for (std::size_t k = 0; k < last_->modes.size(); ++k) found_.modes[first + k] = last_->modes[k];
  S of_part(0), of_all(0);
  for (const S& P : last_->lambda) of_part = (std::max<S>)(of_part, abs(P));
  for (const S& P : found_.impulse) of_all = (std::max<S>)(of_all, abs(P));
  const S residual = of_all > S(0) ? S(last_->residual * of_part / of_all) : last_->residual;
  found_.residual = (std::max<S>)(found_.residual, residual);
  if (!last_->solved() && !(residual <= options_.tolerance && last_->status == friction_status::not_converged))
    found_.status = last_->status;
}

/// The fastest contact first, until none approaches; after 200 rounds all at once with e = 0.
template <class S>
void impact_solver<S>::one_at_a_time(const friction_problem<S>& p, std::span<const S> restitution) {
  S scale(0);
  for (Eigen::Index r = 0; r < p.b.size(); ++r) scale = (std::max<S>)(scale, p.b[r] < S(0) ? S(-p.b[r]) : p.b[r]);
  for (found_.rounds = 0; found_.rounds < 200; ++found_.rounds) {
    std::size_t fastest = 0;
    Eigen::Index row = 0, at = 0;
    S speed = -S(1e-12) * scale;
    bool any = false;
    for (std::size_t k = 0; k < p.contacts.size(); row += p.contacts[k].rows, ++k)
      if (const S& u = found_.u[static_cast<std::size_t>(row)]; u < speed) speed = u, fastest = k, at = row, any = true;
    if (!any) return;
    const Eigen::Index n = p.contacts[fastest].rows;
    before_.assign(found_.u.begin() + at, found_.u.begin() + at + n);
    resolve({p.W.block(at, at, n, n), Eigen::Map<const typename friction_problem<S>::vector>(before_.data(), n),
             p.contacts.subspan(fastest, 1)},
            restitution.subspan(fastest, 1), fastest);
  }
  before_ = found_.u;
  const std::vector<S> none(p.contacts.size(), S(0));
  resolve({p.W, Eigen::Map<const typename friction_problem<S>::vector>(before_.data(), p.b.size()), p.contacts}, none,
          0);
}

}  // namespace kte
