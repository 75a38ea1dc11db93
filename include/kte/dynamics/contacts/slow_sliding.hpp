#pragma once

#include <kte/dynamics/contacts/forces_in_modes.hpp>

/// Friction of slow sliding in space. The direction of the velocity, u_t/|u_t|, turns at a rate of 1/|u_t|: a fast
/// transient, which explicit integrators cannot resolve, to a motion that is smooth. So contacts slower than v have
/// the force that one implicit step of the length tau gives:
///
///   lambda_t = -mu lambda_n d,   d = P(w),   w = d + p/(k tau),   P(w) = w/max(1, |w|)               (1)
///   p = u_t + tau u_t'(d),   tau = 2 (v/k) (1 - |u_t|/v)^2,   k = mu a W_tt/W_nn                     (2)
///
/// k is the deceleration by friction of a contact alone, a the largest |u_n'| of all contacts without contact forces. k
/// must not depend on modes: with k = mu lambda_n W_tt, the force of a contact may be beyond friction if another one
/// sticks, and stop it at once if it slides.
/// tau and its derivative are 0 at |u_t| = v. Where |w| > 1, d is the direction of p, the velocity after tau; |w| <= 1
/// means that friction stops the contact within tau, at |u_t| = v/2 if it is alone. (|w| - 1) k tau is the speed
/// after tau, or negative: events find where it falls to zero, and there the contact sticks. (1) is a continuous map of
/// discs into themselves, so it has a solution (Brouwer); for given normal forces it is the optimum of a convex
/// problem, and u_t' is unique and continuous.
///
/// d turns at most at the rate k/v. The error of velocities is about the distance to the exact direction while
/// |u_t| < v: v^1.5/sqrt(j), where |u_t| = j t^2/2; places change by v^2/(8 k) where sliding stops.
namespace kte::detail {

/// A contact that slides slowly.
struct slow_contact {
  std::size_t number;  ///< of those that touch
  double stop;         ///< k of (2), m/s^2
};
/// Finds the contacts that slide slowly, and sets the times to look ahead of all, and the speeds of those that slide
/// fast; call `solve` of k first.
inline std::vector<slow_contact> slow_contacts(const contact_solver& m, forces_in_modes& k) {
  std::vector<slow_contact> slow;
  const std::size_t n = m.touching.size();
  k.look_aheads.assign(n, 0), k.speeds.assign(n, 0);
  const double length = m.equations.places.length, v = k.slow_speed * length;
  for (std::size_t i = 0; i < n; ++i) {
    if (m.modes[i] != contact_mode::slides) continue;
    const auto& x = m.touched(i);
    const vec3<> t = contact_workspace::tangential(x);
    const double share = 1 - std::sqrt(dot(t, t)) / v;
    k.speeds[i] = dot(t, x.basis[1]);
    if (x.planar || !(share > 0)) continue;
    double free = 0;  // a
    for (std::size_t j = 0; j < n; ++j) free = (std::max)(free, length * std::abs(m.bias[m.touched(j).first]));
    const Eigen::Index row = k.rows.of_closures + x.first;
    const double stop =
        m.laws[i].friction * free * k.rows.all.col(row + 1).squaredNorm() / k.rows.all.col(row).squaredNorm();
    if (!(stop > 0) || !std::isfinite(stop)) continue;
    k.look_aheads[i] = 2 * v / stop * share * share;
    slow.push_back({i, stop});
  }
  return slow;
}

/// Solves (1) for all slow contacts by Newton's method, from the solution k for the directions of `sliding_direction`,
/// and sets speeds of sliding. Returns whether the forces are regular; `is_regular`: at the start.
class slow_sliding {
 public:
  slow_sliding(contact_solver& m, forces_in_modes& k, const std::vector<slow_contact>& slow, bool is_regular)
      : m_(m), k_(k), slow_(slow), is_regular_(is_regular), length_(m.equations.places.length) {
    w_.resize(slow_.size()), f_.resize(2 * static_cast<Eigen::Index>(slow_.size()));
  }

  bool solve() {
    double most = misfit();
    for (int step = 0; step < most_steps && most > 1e-14; ++step) {
      const double before = most;
      improve(most);
      if (most < 1e-11 && most >= before / 2) break;  // only rounding is left
    }
    put_results();
    return is_regular_;
  }

 private:
  using vector2 = Eigen::Vector2d;
  static constexpr int most_steps = 40;
  static constexpr double least_step = 0.1, least_independence = 1e-12;
  /// Sliding that fades, as where a body begins to roll, ends where |w| is this near to 1.
  static constexpr double least_excess = 1e-10;

  Eigen::Index row_of(std::size_t i) const { return k_.rows.of_closures + m_.touched(i).first; }
  vector2 direction(std::size_t i) const { return {k_.directions[i][0], k_.directions[i][1]}; }
  /// A rate u_t' of contact i along t_1 and t_2 by forces whose L^-T J^T is `half`, m/s^2.
  vector2 rate_by(std::size_t i, const Eigen::VectorXd& half) const {
    const auto b = k_.rows.all.middleCols(row_of(i) + 1, 2);
    return length_ * (b.transpose() * half.head(b.rows()));
  }
  /// d - P(w) of all, to f; returns its largest number.
  double misfit() {
    for (std::size_t j = 0; j < slow_.size(); ++j) {
      const std::size_t i = slow_[j].number;
      const auto& x = m_.touched(i);
      const vec3<> t = contact_workspace::tangential(x);
      const vector2 u(dot(t, x.basis[1]), dot(t, x.basis[2])), d = direction(i);
      const vector2 bias = length_ * k_.bias.segment<2>(row_of(i) + 1);
      w_[j] = d + (u / k_.look_aheads[i] + bias + rate_by(i, k_.half)) / slow_[j].stop;
      f_.segment<2>(2 * static_cast<Eigen::Index>(j)) = d - w_[j] / (std::max)(1.0, w_[j].norm());
    }
    return f_.cwiseAbs().maxCoeff();
  }
  /// A step of Newton's method, shortened until the misfit becomes smaller; if none does, one of the map (1).
  void improve(double& most) {
    const auto n = f_.size();
    auto slope = factor_.matrix(n, n);  // transposed
    for (Eigen::Index c = 0; c < n; ++c) {
      k_.derive_by_direction(m_, slow_[static_cast<std::size_t>(c / 2)].number, static_cast<int>(c % 2), half_);
      for (std::size_t j = 0; j < slow_.size(); ++j) {
        vector2 of_w = rate_by(slow_[j].number, half_) / slow_[j].stop;
        const auto row = 2 * static_cast<Eigen::Index>(j);
        const vector2 own(row == c, row + 1 == c);
        of_w += own;
        const double size = w_[j].norm();
        if (size > 1) of_w = (of_w - w_[j].dot(of_w) / (size * size) * w_[j]) / size;
        slope.block<1, 2>(c, row) = (own - of_w).transpose();
      }
    }
    factor_.choose(least_independence);
    Eigen::VectorXd part = Eigen::VectorXd::Zero(n + pivoted_qr::padding), by = part;
    for (std::size_t j = 0; j < factor_.chosen.size(); ++j) part[static_cast<Eigen::Index>(j)] = f_[factor_.chosen[j]];
    factor_.solve_transposed(part.data());
    factor_.times_q(part.data(), by.data());  // the least one that satisfies the independent equations
    const Eigen::VectorXd start = f_;
    const auto kept = k_.directions;
    const auto go = [&](const Eigen::VectorXd& way, double share) {
      k_.directions = kept;
      for (std::size_t j = 0; j < slow_.size(); ++j)
        for (std::size_t r = 0; r < 2; ++r)
          k_.directions[slow_[j].number][r] -= share * way[static_cast<Eigen::Index>(2 * j + r)];
      is_regular_ = k_.solve_in_directions(m_);
      return misfit();
    };
    if (by.allFinite())
      for (double share = 1; share > least_step; share /= 2)
        if (const double now = go(by, share); now < most) return void(most = now);
    most = go(start, 1 / static_cast<double>(slow_.size()));
  }
  /// By how much other contacts that stick and closures of loops reduce the change of u_t' along w by friction: the
  /// excess |w| - 1 is this share of the excess of the force that would make it stick.
  double mobility(std::size_t j) {
    const double size = w_[j].norm();
    if (!(size > 1 && size < 1 + 1e-6)) return 1;
    double change = 0;
    for (int r = 0; r < 2; ++r) {
      k_.derive_by_direction(m_, slow_[j].number, r, half_);
      change -= w_[j][r] / size * w_[j].dot(rate_by(slow_[j].number, half_)) / size;
    }
    return std::clamp(change / slow_[j].stop, 1e-3, 1.0);
  }
  void put_results() {
    for (std::size_t j = 0; j < slow_.size(); ++j) {
      const std::size_t i = slow_[j].number;
      k_.speeds[i] = (w_[j].norm() - 1 - least_excess * mobility(j)) * slow_[j].stop * k_.look_aheads[i];
    }
    for (std::size_t j = 0; j < slow_.size(); ++j) {
      const std::size_t i = slow_[j].number;
      const vector2 d = direction(i);
      if (!(d.norm() > 0)) continue;
      auto& x = m_.touched(i);
      const double friction = m_.laws[i].friction * m_.forces[x.first] * d.norm();
      m_.let_slide(i, unit_of(d[0] * x.basis[1] + d[1] * x.basis[2]));
      m_.forces[x.first + 1] = -friction, m_.forces[x.first + 2] = 0;
      put_bias(m_, i);
    }
  }

  contact_solver& m_;
  forces_in_modes& k_;
  const std::vector<slow_contact>& slow_;
  bool is_regular_;
  double length_;
  std::vector<vector2> w_;
  Eigen::VectorXd f_, half_;
  pivoted_qr factor_;
};

}  // namespace kte::detail
