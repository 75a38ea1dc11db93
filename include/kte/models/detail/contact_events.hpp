#pragma once

#include <kte/models/detail/contact_changes.hpp>
#include <kte/models/detail/contact_gates.hpp>
#include <kte/models/detail/wrong_modes.hpp>

/// The changes of rigid contacts at events of a model (docs/contact.md).
namespace kte::detail {

/// Whether a contact slides, at an event.
inline bool slides_at_event(const contact_solver& m, const contact_at& x) {
  const vec3<> t = contact_workspace::tangential(x);
  return std::sqrt(dot(t, t)) > (x.planar ? rest_velocity : 2 * stop_of_sliding) * m.equations.places.length;
}

/// Whether a contact that touches leaves the surface, at an event: not if it would fall back from a height that events
/// do not resolve.
inline bool leaves_at_event(const contact_solver& m, const contact_at& x) {
  const double speed = dot(x.place.normal, x.slip), height = unresolved_height * m.equations.places.length;
  return normal_velocity(m, x) > 1 && speed * speed > 2 * height * std::abs(free_gap_ddot(m, x));
}
/// Moves x so that the gaps of all contacts that touch are zero, also of those that open.
template <class Access, class X>
void close_gaps(const Access& a, double t, X& x) {
  auto& step = a.memory();
  Eigen::VectorXd change;
  for (int i = 0; i < 2; ++i) {
    a.at(t, x, [&](const auto& c, auto& s, contact_solver& m) {
      auto& e = m.equations;
      e.at_positions(c, s, !s.tree().plan.tree);
      m.factor.factorize(c, s, e);
      m.find(c, s);
      m.choose([&m](const contact_at& y) { return m.touches(y); });
      put_rows_of_gaps(m, step.working);
      step.working.fill(c, s, m), step.working.factorize(nullptr);
      put_gaps(m, step.working, step.values);
      step.working.least_change(s, m, step.values, change);
    });
    const X x0 = x;
    auto d = a.no_displacement();
    take_from_displacement(a.model, x0, 0, change, d, x);
  }
}

/// Resolves impacts at the state x, finds the modes of all contacts, and puts x on the rows of closed ones:
///
///   while contacts approach: impact; then Coulomb's law for accelerations; if that is jammed: tangential impact
///
/// A contact whose next bounce is lower than the touching gap comes to rest: bounces at intervals that shrink by e
/// would end, with a constant acceleration -g_n of the gap, at
///
///   t + 2 e w/(g_n (1 - e)),   w: velocity of approach                                    (1)
/// `event_of`: the number of the contact whose event it is, of a state of an integrator, which is first put on the rows
/// of its modes; -1 at a start.
/// Throws `bad_argument` for a state that is not finite.
template <class Access, class X>
void resolve_contacts(const Access& a, double t, X& x, int event_of) {
  for (Eigen::Index i = 0; i < x.size(); ++i)
    if (!std::isfinite(x[i])) [[unlikely]]
      raise<bad_argument>("kte: x[" + std::to_string(i) + "] of a state with contacts is not finite: " + number(x[i]));
  auto& step = a.memory();
  step.x0.resize(0), step.margin_x.resize(0), step.wrong.resize(0), step.time = t;
  if (is_stepped(a, x)) a.model.each_contact([&x](int, int first) { x[first] = 0; });
  if (event_of >= 0) {
    const X x0 = x;
    auto d = a.no_displacement();
    settle_contacts(a, x0, d, x);
  }
  const auto& model = a.model;
  const Eigen::Index n = model.velocity_count(), at_v = x.size() - model.internals() - n;
  const Eigen::Index at_modes = x.size() - numbers_of_contact * a.contacts();
  const auto passing = ask_gates(a, t, x);
  Eigen::VectorXd v = x.segment(at_v, n);
  const auto margins = contact_margins(a, t, x);
  const double zero = 1e-13 * step.largest_force;
  std::vector<contact_change> changes;
  bool done = false, ambiguous = false;
  int round = 0;
  do {
    a.at(t, x, [&](const auto& c, auto& s, contact_solver& m) {
      if (changes.empty()) {
        changes.resize(m.contacts.size());
        for (std::size_t i = 0; i < changes.size(); ++i) {
          const auto& of = s.template get<kind::contact>(m.contacts[i].slot);
          auto& own = changes[i];
          own.before = mode_of(of), own.direction = of.direction, own.passes = passing[i] != 0;
          own.at_limit[0] = own.before != contact_mode::open && margins[i][0] < zero;
          own.at_limit[1] = own.before == contact_mode::sticks && margins[i][1] < zero;
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
      const auto status = find_contact_forces(
          c, s, m, tree::given_forces<double>{}, [&m](const contact_at& y) { return leaves_at_event(m, y); },
          [&m](const contact_at& y) { return slides_at_event(m, y); });
      if (status == friction_status::no_solution) return hit("tangential impact");
      if (!has_forces(status)) [[unlikely]]
        raise_no_forces(c, m, status);
      ambiguous = status == friction_status::several_solutions;
      // Within the accuracy of the solution, forces at their limits are beyond them.
      const double most = (std::max)(step.largest_force, largest_force(m));
      for (std::size_t i = 0; i < m.touching.size(); ++i) {
        const auto& y = m.touched(i);
        const auto& own = changes[static_cast<std::size_t>(m.touching[i])];
        auto& to = s.template get<kind::contact>(y.slot);
        const auto [normal, reserve] = reserves(m, i);
        if (own.at_limit[0] && normal <= 1e-9 * most) {
          to.mode = static_cast<double>(contact_mode::open);
        } else if (mode_of(to) == contact_mode::sticks) {
          const vec3<> t_force = to.force - normal * y.place.normal;
          if (y.place.law.friction == 0)
            to.direction = y.basis[1];
          else if (own.at_limit[1] && reserve <= 1e-9 * most)
            to.direction = unit_of(-t_force);
          else
            continue;
          to.mode = static_cast<double>(contact_mode::slides);
        }
      }
      for (std::size_t i = 0; i < m.contacts.size(); ++i) {
        const auto& of = s.template get<kind::contact>(m.contacts[i].slot);
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
  const X x0 = x;
  auto d = a.no_displacement();
  settle_contacts(a, x0, d, x);
  step.begun = 0, step.largest_force = 0;
  // a contact that has just opened leaves from zero, one that begins to pass is below, whatever the rounding errors
  a.at(t, x, [&](const auto& c, auto& s, contact_solver& m) {
    m.equations.at_positions(c, s, false);
    m.find(c, s);
    step.zero_gaps.assign(m.contacts.size(), 0);
    for (std::size_t i = 0; i < m.contacts.size(); ++i)
      if (const double gap = m.contacts[i].place.gap; std::abs(gap) <= touching_gap * m.equations.places.length)
        step.zero_gaps[i] = m.contacts[i].passes ? gap + unresolved_height * m.equations.places.length : gap;
  });
}

}  // namespace kte::detail
