#pragma once

#include <kte/contact/impact.hpp>
#include <kte/detail/function_ref.hpp>
#include <kte/dynamics/closed_loops/chain_constraints.hpp>
#include <kte/dynamics/contacts/contact_forces.hpp>
#include <kte/dynamics/contacts/implicit_forces.hpp>

/// The step of velocities of time stepping with contacts, in the working memory of a state.
namespace kte::detail {

/// The velocities at the end of a step h, from v, with forces at the state, and impulses P of the contacts that touch,
/// up to `touching_gap` (Moreau 1999; Jean, Computer Methods in Applied Mechanics and Engineering 177, 1999):
///
///   v^+ = v + h a_0 + M~^-1 J^T P,   u^+ = W P + J (v + h a_0)                                 (1)
///   u_n' = u_n^+ + e min(u_n, 0),   u_t' = u_t^+, a friction problem of lambda = P             (2)
///   if P.(u^+ + u)/2 > 0: e -> theta e, theta the largest in [0, 1] without this gain of energy (3)
///
/// a_0: the accelerations without contacts, with M~ (implicit_forces.hpp). u = J v. Closures are satisfied by v^+.
/// Contacts of the state get the forces P/h.
class velocity_step {
 public:
  /// From the velocities v at the start, with forces at the state: positions of the middle, and velocities near those
  /// of the middle.
  /// `open_gates(m)` finds which contacts pass through their surface.
  void first(const chain_constraints& c, runtime_state& s, contact_solver& m, double h, const force_slopes* law,
             const function_ref<void(contact_workspace&)>& open_gates, Eigen::VectorXd& v);
  /// Again from the velocities v before `first`, with forces at the velocities of the state and the same positions.
  void again(const chain_constraints& c, runtime_state& s, contact_solver& m, double h, Eigen::VectorXd& v);
  /// Whether a contact touches that did not in the step before.
  bool strikes(const contact_solver& m) const {
    return !std::includes(touched_.begin(), touched_.end(), m.touching.begin(), m.touching.end());
  }

 private:
  /// v_m - v.
  void read_change(const runtime_state& s, const Eigen::VectorXd& v) {
    change_.resize(v.size()), read_listed_numbers<vector_of::v>(s, change_), change_ -= v;
  }
  /// M~ by rows.
  void place_by_mass(const chain_constraints& c, runtime_state& s, contact_solver& m);
  /// a_0, to `before`.
  void accelerate(const chain_constraints& c, runtime_state& s, contact_solver& m);
  /// u of (2) without P, of contacts and closures; slip velocities are those of `first`.
  void put_bias(contact_solver& m, double h, const Eigen::VectorXd& v);
  /// The impulses of the last step, by rows of those that touch.
  void guess(const contact_solver& m);
  void finish(const chain_constraints& c, runtime_state& s, contact_solver& m, double h, Eigen::VectorXd& v);

  /// (3).
  void limit_restitution(const chain_constraints& c, contact_solver& m);

  implicit_forces implicit_;
  Eigen::VectorXd change_, from_;  ///< v_m - v, and that of `first`
  Eigen::VectorXd correction_;     ///< D (v_m - v)
  Eigen::VectorXd at_end_, by_forces_, changes_, at_start_;
  Eigen::VectorXd before_, bounce_;  ///< J v, and the part of e in the bias; empty if all e are 0
  std::vector<vec3<>> impulses_;     ///< of the last step, by contact, in axes of its surface, Ns
  std::vector<double> guess_;
  std::vector<int> touched_;  ///< in the step before
};

#ifdef KTE_FUNCTION
KTE_FUNCTION void velocity_step::first(const chain_constraints& c, runtime_state& s, contact_solver& m, double h,
                                       const force_slopes* law,
                                       const function_ref<void(contact_workspace&)>& open_gates, Eigen::VectorXd& v) {
  check_loops(c, s);
  auto& e = m.equations;
  const bool tree = s.tree().plan.tree;
  read_change(s, v);
  from_ = change_;
  implicit_.find(c.elements(), s, h, law);
  if (implicit_.coupled()) place_by_mass(c, s, m);
  accelerate(c, s, m);
  m.find_anew(c, s);
  if (!implicit_.coupled()) {
    e.at_positions(c, s, true, tree);
    if (tree)
      m.factor.take_articulated(s, e);
    else
      m.factor.factorize(c, s, e), e.at_rates(c, s);
  }
  open_gates(m);
  touched_.swap(m.touching);
  m.choose([&m](const contact_at& x) { return m.touches(x); });
  put_bias(m, h, v);
  m.make_matrix(c, s, at_end_);
  guess(m);
  finish(c, s, m, h, v);
}
KTE_FUNCTION void velocity_step::again(const chain_constraints& c, runtime_state& s, contact_solver& m, double h,
                                       Eigen::VectorXd& v) {
  read_change(s, v);
  accelerate(c, s, m);
  put_bias(m, h, v);
  m.subtract_closures(at_end_);
  guess_.assign(m.forces.data(), m.forces.data() + m.forces.size());
  finish(c, s, m, h, v);
}
KTE_FUNCTION void velocity_step::place_by_mass(const chain_constraints& c, runtime_state& s, contact_solver& m) {
  m.equations.at_positions(c, s, true);
  if (m.factor.factorize_mass(c, s, m.equations, &implicit_.added)) {
    if (!s.tree().plan.tree) m.equations.at_rates(c, s);
  } else {
    implicit_.leave_out();
  }
}
KTE_FUNCTION void velocity_step::accelerate(const chain_constraints& c, runtime_state& s, contact_solver& m) {
  correction_.resize(s.dofs());
  for (int i = 0; i < s.dofs(); ++i) correction_[i] = implicit_.correction(i, change_);
  if (!implicit_.coupled()) {
    accelerations_on_coordinates(c.elements(), s, tree::given_forces(correction_.data()), {});
    m.before = s.work.forces;
    return;
  }
  for_each_listed_freedom(s, [](auto& x, const freedom&) { visit_a(x, [](double& a) { a = 0; }); });
  forces_on_coordinates(c.elements(), s, acting::all);
  m.before.resize(s.dofs()), read_listed_numbers<vector_of::f>(s, m.before);
  m.before += correction_;
  m.factor.solve_mass(m.before);
}
KTE_FUNCTION void velocity_step::put_bias(contact_solver& m, double h, const Eigen::VectorXd& v) {
  auto& e = m.equations;
  if (!m.closures.empty()) by_forces_ = v + h * m.before, e.times(by_forces_, at_end_);
  before_.resize(0), bounce_.resize(0);
  if (m.touching.empty()) return;
  by_forces_ = h * m.before - from_;
  e.times(by_forces_, changes_);
  bool bounces = false;
  for (const int i : m.touching) bounces |= m.contacts[static_cast<std::size_t>(i)].place.law.restitution > 0;
  if (bounces) {
    e.times(from_, at_start_);
    before_.setZero(m.bias.size()), bounce_.setZero(m.bias.size());
  }
  for (std::size_t i = 0; i < m.touching.size(); ++i) {
    const auto& x = m.touched(i);
    m.put_rows(x, x.slip + m.unscaled(x, changes_), m.bias);
    if (!bounces) continue;
    m.put_rows(x, x.slip - m.unscaled(x, at_start_), before_);
    bounce_[x.first] = x.place.law.restitution * (std::min)(before_[x.first], 0.0);
  }
  if (bounces) m.bias += bounce_;
}
KTE_FUNCTION void velocity_step::guess(const contact_solver& m) {
  guess_.assign(static_cast<std::size_t>(m.bias.size()), 0.0);
  if (impulses_.empty()) return;
  for (const int i : m.touching) {
    const auto& x = m.contacts[static_cast<std::size_t>(i)];
    for (int k = 0; k < x.rows(); ++k)
      guess_[static_cast<std::size_t>(x.first + k)] =
          m.equations.places.length *
          dot(x.basis[static_cast<std::size_t>(k)], impulses_[static_cast<std::size_t>(x.slot)]);
  }
}
KTE_FUNCTION void velocity_step::finish(const chain_constraints& c, runtime_state& s, contact_solver& m, double h,
                                        Eigen::VectorXd& v) {
  (void)solve_friction(c, m, true, guess_);
  if (bounce_.size() > 0) limit_restitution(c, m);
  v += h * m.before;
  m.accelerate(s, m.change_of_motion);
  v += m.change_of_motion;
  put_contacts(m, s);
  impulses_.resize(m.contacts.size());
  for (const auto& x : m.contacts) {
    auto& force = s.get<kind::contact>(x.slot).force;
    impulses_[static_cast<std::size_t>(x.slot)] = force;
    force = (1 / h) * force;
  }
}
KTE_FUNCTION void velocity_step::limit_restitution(const chain_constraints& c, contact_solver& m) {
  double now = 1;
  const auto gain = [&] {
    double work = 0, scale = 0;
    at_end_.noalias() = m.w * m.forces;
    at_end_ += m.bias - now * bounce_ + before_;  // u^+ + u
    for (Eigen::Index r = 0; r < m.forces.size(); ++r) {
      work += m.forces[r] * at_end_[r];
      scale += std::abs(m.forces[r]) * (std::abs(at_end_[r] - before_[r]) + std::abs(before_[r]));
    }
    return scale > 0 ? work / scale : 0.0;
  };
  const auto solve_with = [&](double theta) {
    m.bias += (theta - now) * bounce_, now = theta;
    (void)solve_friction(c, m, true, guess_);
    return gain();
  };
  if (const double first = gain(); first > largest_residual) solve_with(largest_without_gain(first, solve_with));
}
#endif

}  // namespace kte::detail
