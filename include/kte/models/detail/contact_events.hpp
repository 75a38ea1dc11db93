#pragma once

#include <kte/models/detail/contact_changes.hpp>
#include <kte/models/detail/contact_decision.hpp>
#include <kte/models/detail/contact_gates.hpp>
#include <kte/models/detail/wrong_modes.hpp>

#include <utility>

/// The changes of rigid contacts at events of a model (docs/contact.md).
namespace kte::detail {

/// Decisions at one event: of a contact, four in a row (stop, hold, slip, yield), for several contacts one after the
/// other, and five with longer times to look ahead.
inline constexpr int most_decisions = 16;
/// The longest time to look ahead, relative to the first: flights of unresolved_height * widest_look_ahead^2 = 1e-7 of
/// the length.
inline constexpr double widest_look_ahead = 1024;

/// Moves x so that the gaps of all contacts that touch are zero, also of those that open. Rows that depend on each
/// other on the surfaces are independent by the gaps off them, as where the faces of two bodies on a hinge lie flat: to
/// close a gap by such a row would turn the hinge by any angle.
inline void close_gaps(const runtime_model_contacts& a, double t, Eigen::VectorXd& x) {
  auto& step = a.memory();
  Eigen::VectorXd change;
  for (int i = 0; i < 2; ++i) {
    a.at(t, x, [&](const chain_constraints& c, runtime_state& s, contact_solver& m) {
      auto& e = m.equations;
      e.at_positions(c, s, !s.tree().plan.tree);
      m.factor.factorize(c, s, e);
      m.find(c, s);
      m.choose([&m](const contact_at& y) { return m.touches(y); });
      put_rows_of_gaps(m, step.working);
      put_gaps(m, step.working, step.values);
      step.working.fill(c, s, m), step.working.factorize(nullptr, least_pivot_at(step.values));
      step.working.least_change(s, m, step.values, change);
    });
    const Eigen::VectorXd x0 = x;
    Eigen::VectorXd d = a.no_displacement();
    take_from_displacement(a.model, x0, 0, change, d, x);
  }
}

/// The state of sliding of a contact before a decision.
inline contact_before_decision slow_sliding_of(const contact_state<>& s, const contact_at& x,
                                               const contact_margin& margin) {
  const bool slides = mode_of(s) == contact_mode::slides && !x.planar && x.place.law.friction > 0;
  return {2 * margin.look_ahead, slides && margin.look_ahead > 0 && margin.friction <= 0, false};
}
/// Resolves impacts at the state x, finds the modes of all contacts, and puts x on the rows of closed ones:
///
///   while contacts approach: impact; then the decision of contact_decision.hpp; if that is jammed: tangential impact
///
/// A contact whose next bounce is lower than the touching gap comes to rest: bounces at intervals that shrink by e
/// would end, with a constant acceleration -g_n of the gap, at
///
///   t + 2 e w/(g_n (1 - e)),   w: velocity of approach                                    (1)
/// `event_of`: the number of the contact whose event it is, of a state of an integrator, which is first put on the rows
/// of its modes; -1 at a start.
/// `wide`: the factor of times to look ahead. `changes`: of all contacts until now, empty at first.
inline void resolve_contacts_once(const runtime_model_contacts& a, double t, Eigen::VectorXd& x, int event_of,
                                  double wide, std::vector<contact_change>& changes) {
  for (Eigen::Index i = 0; i < x.size(); ++i)
    if (!std::isfinite(x[i])) [[unlikely]]
      raise<bad_argument>("kte: x[" + std::to_string(i) + "] of a state with contacts is not finite: " + number(x[i]));
  auto& step = a.memory();
  step.x0.resize(0), step.margin_x.resize(0), step.wrong.resize(0), step.time = t;
  if (is_stepped(a, x)) a.model.each_contact([&x](int, int first) { x[first] = 0; });
  if (event_of >= 0 && changes.empty()) {
    const Eigen::VectorXd x0 = x;
    Eigen::VectorXd d = a.no_displacement();
    settle_contacts(a, x0, d, x);
  }
  const auto& model = a.model;
  const Eigen::Index n = model.velocity_count(), at_v = x.size() - model.internals() - n;
  const Eigen::Index at_modes = x.size() - numbers_of_contact * a.contacts();
  const auto passing = ask_gates(a, t, x);
  Eigen::VectorXd v = x.segment(at_v, n);
  const auto margins = contact_margins(a, t, x);
  const double zero = 1e-13 * step.largest_force;
  std::vector<contact_before_decision> before;
  contact_decision decision(wide, step.forces.slow_speed);
  bool done = false, ambiguous = false;
  int round = 0;
  do {
    a.at(t, x, [&](const chain_constraints& c, runtime_state& s, contact_solver& m) {
      if (before.empty())
        for (std::size_t i = 0; i < m.contacts.size(); ++i)
          before.push_back(slow_sliding_of(s.get<kind::contact>(m.contacts[i].slot), m.contacts[i], margins[i]));
      for (std::size_t i = 0; i < changes.size(); ++i) {
        before[i].opens = changes[i].yields && changes[i].has_no_load;
        before[i].stops |= is_stopped(changes[i].slip);
      }
      if (changes.empty()) {
        changes.resize(m.contacts.size());
        for (std::size_t i = 0; i < changes.size(); ++i) {
          const auto& of = s.get<kind::contact>(m.contacts[i].slot);
          auto& own = changes[i];
          own.before = mode_of(of), own.direction = of.direction, own.passes = passing[i] != 0;
          const bool idles = m.contacts[i].slot == event_of && step.idle.are_many(t, event_of);
          const double none = margins[i].is_least ? 2 * least_reserve * step.largest_force
                              : idles             ? least_reserve * step.largest_force
                                                  : zero;
          own.has_no_load = own.before != contact_mode::open && margins[i].touch < none;
          own.has_no_grip = own.before == contact_mode::sticks && margins[i].friction < none;
        }
      }
      if (round == 50) [[unlikely]]
        raise<no_solution>("kte: impacts at contacts " + names_of_touching(c, m) + " do not end");
      const auto note = [&](const char* word) {
        for (std::size_t i = 0; i < m.touching.size(); ++i)
          if (m.forces[m.touched(i).first] > 0) changes[static_cast<std::size_t>(m.touching[i])].impact = word;
      };
      accelerate_freely(c, s, m, tree::given_forces<double>{});
      bool approaches = false;
      for (std::size_t i = 0; i < m.contacts.size(); ++i) {
        const auto& y = m.contacts[i];
        if (!y.passes) refuse_depth(c, m, y, " at the start");
        if (!m.touches(y) || !(normal_velocity(m, y) < -1)) continue;
        approaches = true;
        const double e = y.place.law.restitution, w = -dot(y.place.normal, y.slip);
        const double gap_ddot = free_gap_ddot(m, y);
        changes[i].bounces =
            !(gap_ddot < 0 && e * w * e * w / (-2 * gap_ddot) < touching_gap * m.equations.places.length);
        if (!changes[i].bounces && e > 0) changes[i].rest_time = e < 1 ? t + 2 * e * w / (-gap_ddot * (1 - e)) : t;
      }
      const auto hit = [&](const char* word) {
        strike(c, s, m, step.impacts, impact_law::at_once, v, [&](const contact_at& y) {
          return changes[static_cast<std::size_t>(&y - m.contacts.data())].bounces ? y.place.law.restitution : 0.0;
        });
        note(word);
      };
      if (approaches) return hit("impact");
      friction_status status;
      if (!decision.decide(c, s, m, before, step.working, v, status)) return;
      if (status == friction_status::no_solution) return hit("tangential impact");
      if (!has_forces(status)) [[unlikely]]
        raise_no_forces(c, m, status);
      ambiguous = status == friction_status::several_solutions;
      const double most = (std::max)(step.largest_force, largest_force(m));
      for (std::size_t i = 0; i < m.touching.size(); ++i) {
        const auto& y = m.touched(i);
        const auto& own = changes[static_cast<std::size_t>(m.touching[i])];
        auto& to = s.get<kind::contact>(y.slot);
        const auto [normal, reserve] = reserves(m, i);
        if (own.has_no_load && normal <= least_reserve * most) {
          to.mode = static_cast<double>(contact_mode::open);
        } else if (mode_of(to) == contact_mode::slides && own.slip == slip_state::holds) {
          to.mode = static_cast<double>(contact_mode::sticks);
        } else if (mode_of(to) == contact_mode::sticks && own.slip != slip_state::holds) {
          const vec3<> t_force = to.force - normal * y.place.normal;
          if (y.place.law.friction == 0)
            to.direction = y.basis[1];
          else if (is_sliding(own.slip))
            to.direction = own.slip_direction;
          else if (own.has_no_grip && (own.yields || reserve <= least_reserve * most))
            to.direction = unit_of(-t_force);
          else
            continue;
          to.mode = static_cast<double>(contact_mode::slides);
        }
      }
      for (std::size_t i = 0; i < m.contacts.size(); ++i) {
        const auto& of = s.get<kind::contact>(m.contacts[i].slot);
        changes[i].after = mode_of(of);
        changes[i].turns = mode_of(of) == contact_mode::slides && m.contacts[i].place.law.friction > 0 &&
                           dot(changes[i].direction, of.direction) < 0.999;
        put_mode(of, at_modes + numbers_of_contact * m.contacts[i].slot, x);
      }
      step.change = text_of_changes(c, m, changes, event_of);
      if (ambiguous) step.change += "; ambiguous: other accelerations satisfy the laws of contact too";
      done = true;
    });
    x.segment(at_v, n) = v;
    ++round;
  } while (!done);
  close_gaps(a, t, x);
  const Eigen::VectorXd x0 = x;
  Eigen::VectorXd d = a.no_displacement();
  settle_contacts(a, x0, d, x);
  step.begun = 0, step.largest_force = 0;
  // a contact that has just opened leaves from zero, one that begins to pass is below, whatever the rounding errors
  a.at(t, x, [&](const chain_constraints& c, runtime_state& s, contact_solver& m) {
    m.equations.at_positions(c, s, false);
    m.find(c, s);
    step.zero_gaps.assign(m.contacts.size(), 0);
    for (std::size_t i = 0; i < m.contacts.size(); ++i)
      if (const double gap = m.contacts[i].place.gap; std::abs(gap) <= touching_gap * m.equations.places.length)
        step.zero_gaps[i] = m.contacts[i].passes ? gap + unresolved_height * m.equations.places.length : gap;
  });
}

enum class decision_check { right, wrong, decide_again };
/// Whether the forces of the modes satisfy the laws at x; if not, what to decide next: contacts that were at their
/// limit and still are yield; those that slide but stop at once lose their velocity, and if they still do, all of them
/// stick; those that stick beyond friction slip.
inline decision_check check_decision(const runtime_model_contacts& a, double t, const Eigen::VectorXd& x,
                                     std::vector<contact_change>& changes) {
  auto& step = a.memory();
  auto found = decision_check::right;
  a.at(t, x, [&](const chain_constraints& c, runtime_state& s, contact_solver& m) {
    accelerate_in_modes(c, s, m, step.forces);
    const bool wrong = admit_forces(c, s, m, step.forces, least_reserve) >= 0;
    if (wrong) found = decision_check::wrong;
    const double most = largest_force(m, step.forces), least = least_reserve * most;
    bool one_holds = false;
    const auto note = [&found](contact_change& own, slip_finding what) {
      const slip_state before = std::exchange(own.slip, next_state(own.slip, what));
      if (own.slip != before) found = decision_check::decide_again;
    };
    for (std::size_t i = 0; i < m.touching.size(); ++i) {
      const auto& y = m.touched(i);
      auto& own = changes[static_cast<std::size_t>(m.touching[i])];
      const auto [normal, reserve] = reserves(m, i);
      const bool sticks = m.modes[i] == contact_mode::sticks;
      if (wrong && step.forces.redundant() && normal < -least) own.has_no_load = true;
      const bool at_limit = (own.has_no_load && normal <= least) ||
                            (own.has_no_grip && sticks && reserve <= least && own.slip != slip_state::holds);
      if (at_limit && !own.yields) own.yields = true, found = decision_check::decide_again;
      // A speed below `rest_velocity` is rest, where a contact may stick as well as slide: one that begins to slip does
      // not stop there, one that slid does.
      const double rest = own.before == contact_mode::sticks ? -rest_velocity * m.equations.places.length : 0;
      if (step.forces.look_aheads[i] > 0 && step.forces.speeds[i] <= rest) {
        one_holds |= is_stopped(own.slip) && own.slip < slip_state::holds;
        note(own, slip_finding::stops);
      }
      const double excess = excess_at_onset * y.place.law.friction * normal;
      if (!y.planar && sticks && normal > 0 && reserve < -excess) {
        const vec3<> force = m.force_of(y);
        own.slip_direction = unit_of(dot(y.place.normal, force) * y.place.normal - force);
        note(own, slip_finding::exceeds);
      }
    }
    if (one_holds)
      for (auto& own : changes) note(own, slip_finding::others_hold);
  });
  step.margin_x.resize(0);
  return found;
}
/// `resolve_contacts_once`, until the forces of the modes satisfy the laws at the new state; where nothing else is to
/// be decided, with longer times to look ahead. Throws `bad_argument` for a state that is not finite.
inline void resolve_contacts(const runtime_model_contacts& a, double t, Eigen::VectorXd& x, int event_of) {
  std::vector<contact_change> changes;
  auto found = decision_check::decide_again;
  double wide = 1;
  for (int k = 0; k < most_decisions && wide <= widest_look_ahead && found != decision_check::right; ++k) {
    resolve_contacts_once(a, t, x, event_of, wide, changes);
    if (is_stepped(a, x)) return;
    found = check_decision(a, t, x, changes);
    if (found == decision_check::wrong) wide *= 4;
  }
  a.memory().idle.note(t, event_of,
                       std::any_of(changes.begin(), changes.end(), [](const auto& own) { return own.is_change(); }));
}

}  // namespace kte::detail
