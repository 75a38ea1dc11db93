#pragma once

#include <kte/dynamics/contacts/mode_rows.hpp>

namespace kte::detail {

/// The forces of (1) of mode_dynamics.hpp, and their memory.
class forces_in_modes {
 public:
  mode_rows rows;
  std::vector<int> chosen;           ///< independent rows at the start of a step; empty: they are found at the state
  std::vector<int> chosen_touching;  ///< the closed contacts of `chosen`; other ones find their rows
  std::vector<contact_mode> chosen_modes;  ///< their modes
  Eigen::VectorXd bias;                    ///< u' without forces of closures and contacts, by rows
  int jammed = -1;                         ///< a contact, of those that touch, whose sliding is jammed
  double slow_speed = 3e-4;                ///< v of slow_sliding.hpp, relative to the length of the chain, 1/s
  // ---- by contacts that touch
  std::vector<std::array<double, 2>> directions;  ///< d of sliding along t_1 and t_2
  std::vector<double> look_aheads;                ///< tau of slow_sliding.hpp, s; 0: none
  std::vector<double> speeds;                     ///< of sliding along d after tau, m/s

  /// Whether forces are not unique.
  bool redundant() const { return forces_.rank() < unknowns_; }
  /// Finds the forces, to m.forces and `half`; returns false if (1) is singular.
  bool solve(contact_solver& m);
  /// As `solve` for other `directions`.
  bool solve_in_directions(contact_solver& m);
  /// The derivative of `half` by number r of the direction of contact i of those that touch, which slides, at the last
  /// solution. With T = Q^T E, lambda = T^+ c:
  ///
  ///   lambda' = -T^+ T' lambda + (1 - T^+ T) T'^T y,   y = (T T^T)^-1 c                   (1)
  void derive_by_direction(const contact_solver& m, std::size_t i, int r, Eigen::VectorXd& to);
  Eigen::VectorXd half;  ///< L^-T J^T of all forces, by places

 private:
  /// Q^T x, for the chosen rows; valid until the next call.
  template <class X>
  Eigen::VectorBlock<Eigen::VectorXd> on_rows(const X& x) {
    part_.setZero(rows.all.rows() + pivoted_qr::padding), part_.head(rows.all.rows()) = x;
    rows.factor.times_q_transposed(part_.data());
    return part_.head(rows.factor.rank());
  }
  static int unknowns_of(const contact_solver& m, std::size_t i) {
    return m.modes[i] == contact_mode::slides ? 1 : m.touched(i).rows();
  }
  /// L^-T of the load of each unknown force.
  void put_effects(const contact_solver& m);
  void put_forces(contact_solver& m) const;

  pivoted_qr forces_;
  Eigen::Index unknowns_ = 0;
  Eigen::MatrixXd effects_;
  Eigen::VectorXd lambda_, target_, part_, change_, null_;
  std::vector<int> order_;
};

#ifdef KTE_FUNCTION
KTE_FUNCTION bool forces_in_modes::solve(contact_solver& m) {
  const bool same = !chosen.empty() && chosen_touching == m.touching && chosen_modes == m.modes;
  rows.factorize(same ? &chosen : nullptr);
  directions.assign(m.touching.size(), {1, 0});
  return solve_in_directions(m);
}
KTE_FUNCTION bool forces_in_modes::solve_in_directions(contact_solver& m) {
  put_effects(m);
  const auto rank = rows.factor.rank();
  auto transposed = forces_.matrix(unknowns_, rank);
  for (Eigen::Index j = 0; j < unknowns_; ++j) transposed.row(j) = on_rows(effects_.col(j)).transpose();
  order_.resize(static_cast<std::size_t>(rank));
  for (std::size_t j = 0; j < order_.size(); ++j) order_[j] = static_cast<int>(j);
  const bool regular = forces_.take(order_, 1e-14);
  target_.setZero(rank + pivoted_qr::padding), lambda_.setZero(unknowns_ + pivoted_qr::padding);
  for (std::size_t j = 0; j < order_.size(); ++j) target_[static_cast<Eigen::Index>(j)] = -bias[rows.factor.chosen[j]];
  rows.factor.solve_transposed(target_.data());
  forces_.solve_transposed(target_.data());
  forces_.times_q(target_.data(), lambda_.data());
  half.setZero(rows.all.rows() + pivoted_qr::padding);
  half.head(rows.all.rows()).noalias() = effects_ * lambda_.head(unknowns_);
  put_forces(m);
  return regular;
}
KTE_FUNCTION void forces_in_modes::derive_by_direction(const contact_solver& m, std::size_t i, int r,
                                                       Eigen::VectorXd& to) {
  Eigen::Index column = rows.of_closures;
  for (std::size_t k = 0; k < i; ++k) column += unknowns_of(m, k);
  const auto turned = -m.laws[i].friction * rows.all.col(rows.of_closures + m.touched(i).first + 1 + r);
  const auto rank = rows.factor.rank();
  change_.setZero(rank + pivoted_qr::padding), null_ = target_;
  change_.head(rank) = on_rows(turned);
  forces_.solve(null_.data());
  const double of_null = change_.head(rank).dot(null_.head(rank));
  change_ *= -lambda_[column];
  forces_.solve_transposed(change_.data());
  null_.setZero(unknowns_ + pivoted_qr::padding), null_[column] = 1;
  forces_.times_q_transposed(null_.data());
  change_.head(rank) -= of_null * null_.head(rank);
  null_.setZero();
  forces_.times_q(change_.data(), null_.data());
  null_[column] += of_null;
  to.noalias() = effects_ * null_.head(unknowns_);
  to += lambda_[column] * turned;
}
KTE_FUNCTION void forces_in_modes::put_effects(const contact_solver& m) {
  unknowns_ = rows.of_closures;
  for (std::size_t i = 0; i < m.touching.size(); ++i) unknowns_ += unknowns_of(m, i);
  effects_.resize(rows.all.rows(), unknowns_);
  effects_.leftCols(rows.of_closures) = rows.all.leftCols(rows.of_closures);
  jammed = -1;
  Eigen::Index to = rows.of_closures;
  for (std::size_t i = 0; i < m.touching.size(); to += unknowns_of(m, i), ++i) {
    const auto& x = m.touched(i);
    const Eigen::Index from = rows.of_closures + x.first;
    effects_.middleCols(to, unknowns_of(m, i)) = rows.all.middleCols(from, unknowns_of(m, i));
    if (m.modes[i] != contact_mode::slides) continue;
    for (int r = 0; r + 1 < x.rows(); ++r)
      effects_.col(to) -= m.laws[i].friction * directions[i][static_cast<std::size_t>(r)] * rows.all.col(from + 1 + r);
    const auto normal = rows.all.col(from);
    if (rows.of_closures == 0 && !(normal.dot(effects_.col(to)) > least_support * normal.squaredNorm()))
      jammed = static_cast<int>(i);
  }
}
KTE_FUNCTION void forces_in_modes::put_forces(contact_solver& m) const {
  Eigen::Index from = rows.of_closures;
  for (std::size_t i = 0; i < m.touching.size(); from += unknowns_of(m, i), ++i) {
    const auto& x = m.touched(i);
    m.forces.segment(x.first, unknowns_of(m, i)) = lambda_.segment(from, unknowns_of(m, i));
    if (m.modes[i] != contact_mode::slides) continue;
    for (int r = 0; r + 1 < x.rows(); ++r)
      m.forces[x.first + 1 + r] = -m.laws[i].friction * directions[i][static_cast<std::size_t>(r)] * lambda_[from];
  }
  Eigen::VectorXd& of_closures = m.loop_forces;
  of_closures.setZero(m.equations.places.rows);
  int row = 0;
  for (const int k : m.closures) {
    const auto& x = m.equations.places.closures[static_cast<std::size_t>(k)];
    for (int r = 0; r < x.rows.count(); ++r) of_closures[x.first + r] = lambda_[row++];
  }
}
#endif

}  // namespace kte::detail
