#pragma once

#include <kte/models/detail/loop_steps.hpp>
#include <kte/models/detail/runtime_model_contacts.hpp>

/// Steps of a model with rigid contacts. In a step, contacts keep their modes: closed ones keep their gap at zero, and
/// those that stick their tangential velocity. As for loops (models/detail/loop_steps.hpp), with the rows J_g of gaps
/// and J_u of velocities:
///
///   q(d) = q0 (+) (d_q + N_g mu),   g(q) = 0           (1)
///   v(d) = v0 + d_v + N_u nu,       J_u(q) v = 0       (2)
namespace kte::detail {

inline void put_rows_of_gaps(const contact_solver& m, mode_rows& rows) {
  rows.clear(m);
  for (const int i : m.touching) rows.rows.push_back({i, m.contacts[static_cast<std::size_t>(i)].place.normal, true});
}
inline void put_gaps(const contact_solver& m, const mode_rows& rows, Eigen::VectorXd& to) {
  rows.put_values(
      m, m.equations.residual, [](const contact_at& x) { return x.place.gap * x.place.normal; }, to);
}
inline void put_rates(const contact_solver& m, const mode_rows& rows, const Eigen::VectorXd& of_all,
                      Eigen::VectorXd& to) {
  rows.put_values(
      m, of_all, [](const contact_at& x) { return x.slip; }, to);
}
/// J_u v of closures; contacts have theirs.
inline Eigen::VectorXd rates_of_closures(const contact_solver& m, const Eigen::VectorXd& v) {
  return m.closures.empty() ? Eigen::VectorXd() : m.equations.times(v);
}
inline std::string name_of(const chain_constraints& c, const contact_solver& m, const contact_at& x) {
  return "contact '" + c.loop_name(m.place(x).loop) + "'";
}
/// Throws `bad_argument` for a contact that is open and deep in its surface.
inline void refuse_depth(const chain_constraints& c, const contact_solver& m, const contact_at& x, const char* advice) {
  if (!(x.place.gap < -deepest_start * m.equations.places.length)) [[likely]]
    return;
  raise<bad_argument>("kte: " + name_of(c, m, x) + " is " + number(-x.place.gap) + " m inside its surface" + advice);
}
/// Throws `bad_argument` if a step does not begin on the rows of its contacts.
inline void check_start_of_step(const chain_constraints& c, const runtime_state& s, const contact_solver& m) {
  for (const auto& x : m.contacts) {
    if (x.passes) continue;
    const auto mode = mode_of(s.get<kind::contact>(x.slot));
    if (mode == contact_mode::open) {
      refuse_depth(c, m, x, ": kte::element_events(model) finds impacts, and so does kte::moreau_jean");
      continue;
    }
    if (std::abs(x.place.gap) > deepest_start * m.equations.places.length) [[unlikely]]
      raise<bad_argument>("kte: " + name_of(c, m, x) + " is closed, but its gap is " + number(x.place.gap) +
                          " m: kte::settled gives consistent modes");
    const vec3<> u = mode == contact_mode::sticks ? x.slip : dot(x.place.normal, x.slip) * x.place.normal;
    if (std::sqrt(dot(u, u)) > 1e-6 * m.equations.places.length) [[unlikely]]
      raise<bad_argument>("kte: " + name_of(c, m, x) + " is closed, but moves at " + number(std::sqrt(dot(u, u))) +
                          " m/s: kte::settled gives consistent modes");
  }
}
/// Whether x is a state of time stepping.
inline bool is_stepped(const runtime_model_contacts& a, const Eigen::VectorXd& x) {
  bool is = false;
  a.model.each_contact([&](int i, int first) { is |= i == 0 && x[first] == stepped_mode; });
  return is;
}
/// The data of the step from x0; begins the step if necessary. `check`: whether x0 must be on the rows of its contacts.
inline contact_step& contact_step_from(const runtime_model_contacts& a, const Eigen::VectorXd& x0, bool check = true) {
  auto& step = a.memory();
  if (step.x0.size() == x0.size() && step.x0 == x0) return step;
  step.x0.resize(0), step.margin_x.resize(0);
  step.start_time = step.time;
  a.at(step.time, x0, [&](const chain_constraints& c, runtime_state& s, contact_solver&) {
    auto& m = step.at;
    take_passing(s, m);
    m.equations.at_positions(c, s, true);
    m.factor.factorize(c, s, m.equations);
    m.equations.at_velocities(c, s);
    m.find(c, s);
    if (check) check_start_of_step(c, s, m);
    put_rows_of_modes(s, m, step.rates), put_rows_of_gaps(m, step.gaps);
    step.keeps.assign(m.equations.places.closures.size(), 1);
    for (const auto& x : m.contacts) step.keeps[static_cast<std::size_t>(x.closure)] = x.touches;
    step.all_open = m.touching.empty() && m.closures.empty();
    step.rates.fill(c, s, m), step.gaps.fill(c, s, m);
    step.rates.factorize(nullptr), step.gaps.factorize(nullptr);
    step.rates.put_chosen(step.forces.chosen), step.gaps.put_chosen(step.chosen_gaps);
    step.forces.chosen_touching = m.touching, step.forces.chosen_modes = m.modes;
    step.zero_gaps.resize(m.contacts.size());
    for (std::size_t i = 0; i < m.contacts.size(); ++i)
      if (m.contacts[i].place.gap > touching_gap * m.equations.places.length) step.zero_gaps[i] = 0;
  });
  step.x0 = x0, ++step.begun;
  step.starts_wrong = step.wrong.size() == x0.size() && step.wrong == x0;
  return step;
}

/// (1) and (2).
inline void settle_contacts(const runtime_model_contacts& a, const Eigen::VectorXd& x0, Eigen::VectorXd& d,
                            Eigen::VectorXd& x) {
  const bool stepped = is_stepped(a, x0);
  if (stepped && !a.model.has_loops()) return;
  auto& step = contact_step_from(a, x0, false);
  if (step.all_open) return;
  const auto& model = a.model;
  const auto kept = [&step](int closure) { return step.keeps[static_cast<std::size_t>(closure)] != 0; };
  Eigen::VectorXd change;
  double last = std::numeric_limits<double>::infinity();
  bool at_start = true;  // whether rows are those of x0
  for (int i = 0;; ++i) {
    bool closed = false;
    a.at(step.time, x, [&](const chain_constraints& c, runtime_state& s, contact_solver& m) {
      auto& e = m.equations;
      e.at_positions_of(c, s, false, false, kept);
      m.find(c, s, kept);
      put_gaps(m, step.gaps, step.values);
      const double gap = step.gaps.largest_of_chosen(step.values);
      const auto rounding = [&] {
        e.at_positions(c, s, true);
        return e.rounding(s, x);
      };
      closed = gap <= 1e-16 || (gap > last / 20 && (gap <= on_loops_within || gap <= rounding()));
      if (closed) return;
      if (!(gap < 1e300) || i == 20) [[unlikely]]
        raise<bad_argument>("kte: contacts " + names_of_touching(c, step.at) +
                            " do not stay closed at the end of a step: a shorter step");
      at_start = at_start && gap <= last / 20;
      last = gap;
      if (at_start) return step.gaps.least_change(s, step.at, step.values, change);
      e.at_positions(c, s, !s.tree().plan.tree);
      m.factor.factorize(c, s, e);
      put_rows_of_modes(s, m, step.working), put_rows_of_gaps(m, step.working);
      step.working.fill(c, s, m), step.working.factorize(&step.chosen_gaps);
      step.working.least_change(s, m, step.values, change);
    });
    if (closed) break;
    take_from_displacement(model, x0, 0, change, d, x);
  }
  const Eigen::Index n = model.velocity_count();
  for (int i = 0; i < 2; ++i) {
    a.at(step.time, x, [&](const chain_constraints& c, runtime_state& s, contact_solver& m) {
      auto& e = m.equations;
      e.at_positions_of(c, s, !m.closures.empty() || !s.tree().plan.tree, false, kept);
      if (i == 0) m.factor.factorize(c, s, e);
      e.at_velocities(c, s, kept);
      m.find(c, s, kept);
      if (i == 0) {
        put_rows_of_modes(s, m, step.working);
        step.working.fill(c, s, m), step.working.factorize(&step.forces.chosen);
      }
      put_rates(m, step.working, rates_of_closures(m, model.velocities_of(x)), step.values);
      step.working.least_change(s, m, step.values, change);
    });
    take_from_displacement(model, x0, n, change, d, x);
  }
}
/// Takes out of a displacement from x0 what (1) and (2) would.
inline void make_tangential_to_contacts(const runtime_model_contacts& a, const Eigen::VectorXd& x0,
                                        Eigen::VectorXd& e) {
  if (is_stepped(a, x0)) return;
  auto& step = contact_step_from(a, x0, false);
  if (step.all_open) return;
  const Eigen::Index n = a.model.velocity_count();
  Eigen::VectorXd change;
  a.at(step.start_time, x0, [&](const chain_constraints&, runtime_state& s, contact_solver&) {
    auto& m = step.at;
    for (const Eigen::Index first : {Eigen::Index(0), n}) {
      auto& rows = first == 0 ? step.gaps : step.rates;
      const Eigen::VectorXd all = m.equations.times(e.segment(first, n));
      rows.put_values(
          m, all, [&](const contact_at& x) { return m.unscaled(x, all); }, step.values);
      rows.least_change(s, m, step.values, change);
      e.segment(first, n) -= change;
    }
  });
}

}  // namespace kte::detail
