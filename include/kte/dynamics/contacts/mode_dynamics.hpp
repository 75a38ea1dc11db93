#pragma once

#include <kte/dynamics/contacts/mode_rows.hpp>

#include <limits>

/// Accelerations with contacts in given modes, in the working memory of a state. Closed contacts satisfy
///
///   g'' = 0,   and u_t' = 0 where they stick                                              (1)
///
/// with forces lambda_n (n - mu d) where they slide, in the direction
///
///   d = sgn(u_t . d_0) u_t/|u_t|,   d_0: the direction when sliding began                 (2)
///
/// which stays smooth where u_t passes through zero. Forces are those of least norm. Nothing limits them: contacts may
/// pull, or exceed their friction; events find that time.
namespace kte::detail {

/// Below this velocity the direction of sliding becomes d_0, m/s relative to the length of the chain.
inline constexpr double least_sliding = 1e-11;

/// d of (2).
inline vec3<> sliding_direction(const contact_solver& m, const contact_at& x, const vec3<>& start) {
  const auto& n = x.place.normal;
  const vec3<> t = contact_workspace::tangential(x), t0 = unit_of(start - dot(n, start) * n);
  if (x.planar) {
    const vec3<> axis{n.y, -n.x, 0};
    return dot(axis, t0) < 0 ? -axis : axis;
  }
  return unit_of((dot(t, t0) < 0 ? -1.0 : 1.0) * t + least_sliding * m.equations.places.length * t0);
}

/// The forces of (1), and their memory.
class forces_in_modes {
 public:
  mode_rows rows;
  std::vector<int> chosen;           ///< independent rows at the start of a step; empty: they are found at the state
  std::vector<int> chosen_touching;  ///< the closed contacts of `chosen`; other ones find their rows
  std::vector<contact_mode> chosen_modes;  ///< their modes
  Eigen::VectorXd bias;                    ///< u' without forces of closures and contacts, by rows
  int jammed = -1;                         ///< a contact, of those that touch, that slides with W_nn <= mu W_nt

  /// Whether forces are not unique.
  bool redundant() const { return forces_.rank() < unknowns_; }
  /// Finds the forces, to m.forces and `half`; returns false if (1) is singular.
  bool solve(contact_solver& m) {
    const bool same = !chosen.empty() && chosen_touching == m.touching && chosen_modes == m.modes;
    rows.factorize(same ? &chosen : nullptr);
    put_effects(m);
    const auto rank = rows.factor.rank();
    auto transposed = forces_.matrix(unknowns_, rank);
    half.resize(rows.all.rows() + pivoted_qr::padding);
    for (Eigen::Index j = 0; j < unknowns_; ++j) {
      half.setZero(), half.head(rows.all.rows()) = effects_.col(j);
      rows.factor.times_q_transposed(half.data());
      transposed.row(j) = half.head(rank).transpose();
    }
    order_.resize(static_cast<std::size_t>(rank));
    for (std::size_t j = 0; j < order_.size(); ++j) order_[j] = static_cast<int>(j);
    const bool regular = forces_.take(order_, 1e-14);
    target_.setZero(rank + pivoted_qr::padding), lambda_.setZero(unknowns_ + pivoted_qr::padding);
    for (std::size_t j = 0; j < order_.size(); ++j)
      target_[static_cast<Eigen::Index>(j)] = -bias[rows.factor.chosen[j]];
    rows.factor.solve_transposed(target_.data());
    forces_.solve_transposed(target_.data());
    forces_.times_q(target_.data(), lambda_.data());
    half.setZero();
    half.head(rows.all.rows()).noalias() = effects_ * lambda_.head(unknowns_);
    put_forces(m);
    return regular;
  }
  Eigen::VectorXd half;  ///< L^-T J^T of all forces, by places

 private:
  static int unknowns_of(const contact_solver& m, std::size_t i) {
    return m.modes[i] == contact_mode::slides ? 1 : m.touched(i).rows();
  }
  /// L^-T of the load of each unknown force.
  void put_effects(const contact_solver& m) {
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
      effects_.col(to) -= m.laws[i].friction * rows.all.col(from + 1);
      if (rows.of_closures == 0 && !(rows.all.col(from).dot(effects_.col(to)) > 0)) jammed = static_cast<int>(i);
    }
  }
  void put_forces(contact_solver& m) const {
    Eigen::Index from = rows.of_closures;
    for (std::size_t i = 0; i < m.touching.size(); from += unknowns_of(m, i), ++i) {
      const auto& x = m.touched(i);
      m.forces.segment(x.first, unknowns_of(m, i)) = lambda_.segment(from, unknowns_of(m, i));
      if (m.modes[i] == contact_mode::slides) m.forces[x.first + 1] = -m.laws[i].friction * lambda_[from];
    }
    Eigen::VectorXd& of_closures = m.loop_forces;
    of_closures.setZero(m.equations.places.rows);
    int row = 0;
    for (const int k : m.closures) {
      const auto& x = m.equations.places.closures[static_cast<std::size_t>(k)];
      for (int r = 0; r < x.rows.count(); ++r) of_closures[x.first + r] = lambda_[row++];
    }
  }

  pivoted_qr forces_;
  Eigen::Index unknowns_ = 0;
  Eigen::MatrixXd effects_;
  Eigen::VectorXd lambda_, target_;
  std::vector<int> order_;
};

/// Chooses the closed contacts, and their rows, by the modes of the state; call `m.find` first.
template <class State>
void put_rows_of_modes(const State& s, contact_solver& m, mode_rows& rows) {
  const auto mode = [&s](const contact_at& x) { return mode_of(s.template get<kind::contact>(x.slot)); };
  m.choose([&](const contact_at& x) { return mode(x) != contact_mode::open; });
  m.modes.clear(), rows.clear(m);
  for (std::size_t i = 0; i < m.touching.size(); ++i) {
    const auto& x = m.touched(i);
    m.modes.push_back(mode(x));
    const bool slides = m.modes.back() == contact_mode::slides;
    if (slides) m.let_slide(i, sliding_direction(m, x, s.template get<kind::contact>(x.slot).direction));
    for (int r = 0; r < x.rows(); ++r)
      rows.rows.push_back({m.touching[i], x.basis[static_cast<std::size_t>(r)], r == 0 || !slides});
  }
}
/// Accelerations with contacts in the modes of the state, written to `forces` of the working memory. Contacts of the
/// state get their forces. Raises `no_solution` where (1) is singular.
template <class Contacts, class State>
void accelerate_in_modes(const Contacts& c, State& s, contact_solver& m, forces_in_modes& k) {
  accelerate_freely(c, s, m, tree::given_forces<double>{});
  put_rows_of_modes(s, m, k.rows);
  for (std::size_t i = 0; i < m.touching.size(); ++i) put_bias(m, i);
  k.rows.fill(c, s, m);
  k.rows.put_values(
      m, m.equations.acceleration, [](const contact_at&) { return vec3<>{}; }, k.bias);
  k.bias.tail(m.bias.size()) = m.bias;
  if (!k.solve(m)) [[unlikely]]
    raise<no_solution>("kte: contacts " + names_of_touching(c, m) +
                       " cannot stay closed: their equations are singular");
  m.factor.other_half(s, m.equations, k.half, m.change_of_motion);
  auto& a = s.work.forces;
  a = m.before + m.change_of_motion;
  // Bodies at rest stay at rest: differences that are rounding errors are zero.
  constexpr double rounding = 16 * std::numeric_limits<double>::epsilon();
  for (Eigen::Index i = 0; i < a.size(); ++i)
    if (std::abs(a[i]) <= rounding * std::abs(m.before[i])) a[i] = 0;
  put_contacts(m, s);
}

}  // namespace kte::detail
