#pragma once

#include <kte/models/detail/contact_gates.hpp>
#include <kte/models/detail/contact_steps.hpp>

/// Events of rigid contacts in a model: the functions that pass through zero where a contact changes its mode, and the
/// change (docs/contact.md).
namespace kte::detail {

/// Sliding in space slower than this stops, m/s relative to the length of the chain: the direction of slow sliding
/// turns fast, which is stiff.
inline constexpr double stop_of_sliding = 1e-8;
/// Whether a contact slides, at an event.
inline bool slides_at_event(const contact_solver& m, const contact_at& x) {
  const vec3<> t = contact_workspace::tangential(x);
  return std::sqrt(dot(t, t)) > (x.planar ? rest_velocity : 2 * stop_of_sliding) * m.equations.places.length;
}

/// Forces that satisfy the laws and give the accelerations of the modes, if those of least norm do not, and there are
/// such: contacts are redundant. Returns whether there are.
template <class Contacts, class State>
bool find_admissible_forces(const Contacts& c, State& s, contact_solver& m) {
  const Eigen::VectorXd a = m.change_of_motion, forces = m.forces, bias = m.bias;
  const auto modes = m.modes;
  m.make_matrix(c, s, m.equations.acceleration);
  const auto status = find_friction(m);
  bool same = false;
  if (status == friction_status::solved || status == friction_status::several_solutions) {
    m.accelerate(s, m.change_of_motion);
    same = (m.change_of_motion - a).norm() <= 1e-8 * a.norm();
  }
  m.modes = modes, m.change_of_motion = a;
  if (!same) m.forces = forces;
  m.bias = bias;
  return same;
}
/// Whether a contact that touches leaves the surface, at an event: not if it would fall back from a height that events
/// do not resolve.
inline bool leaves_at_event(const contact_solver& m, const contact_at& x) {
  const double speed = dot(x.place.normal, x.slip), height = unresolved_height * m.equations.places.length;
  return normal_velocity(m, x) > 1 && speed * speed > 2 * height * std::abs(free_gap_ddot(m, x));
}
/// The normal force of contact i of those that touch, and its reserve of friction, mu lambda_n - |lambda_t|, N.
inline std::array<double, 2> reserves(const contact_solver& m, std::size_t i) {
  const auto& x = m.touched(i);
  const vec3<> force = m.force_of(x);
  const double normal = dot(force, x.place.normal);
  const vec3<> t = force - normal * x.place.normal;
  return {normal, x.place.law.friction * normal - std::sqrt(dot(t, t))};
}
/// The functions of contact i of those that touch: its normal force, N; of one that sticks, its reserve of friction; of
/// one that slides, its velocity in the direction in which sliding began, less that of rest, and relative to zero.
inline std::array<double, 3> margins_of_closed(const contact_solver& m, std::size_t i, const vec3<>& start,
                                               double tiny) {
  const auto& x = m.touched(i);
  const auto [normal, reserve] = reserves(m, i);
  if (m.modes[i] == contact_mode::sticks) return {normal + tiny, reserve + tiny, 1};
  if (x.place.law.friction == 0) return {normal + tiny, 1, 1};
  const double along = dot(contact_workspace::tangential(x), start);
  if (x.planar) return {normal + tiny, along, 1};
  const double length = m.equations.places.length;
  return {normal + tiny, along - stop_of_sliding * length, along + least_sliding * length};
}
/// The largest force of contacts that touch, N.
inline double largest_force(const contact_solver& m) {
  return m.forces.size() > 0 ? m.forces.cwiseAbs().maxCoeff() / m.equations.places.length : 0;
}
/// The largest force of contacts that touch, and of those that would hold against the other forces, N.
inline double largest_force(const contact_solver& m, const forces_in_modes& forces) {
  double most = 0;
  for (std::size_t i = 0; i < m.touching.size(); ++i) {
    const auto& x = m.touched(i);
    const auto b = forces.rows.all.col(forces.rows.of_closures + x.first);
    most = (std::max)({most, std::abs(m.forces[x.first]), std::abs(m.bias[x.first]) / b.squaredNorm()});
  }
  return most / m.equations.places.length;
}
/// The first contact, of those that touch, whose force violates the laws by more than `tolerated`, N; -1: none.
inline int first_wrong_mode(const contact_solver& m, double tolerated) {
  for (std::size_t i = 0; i < m.touching.size(); ++i) {
    const auto [normal, reserve] = reserves(m, i);
    if (normal < -tolerated || (m.modes[i] == contact_mode::sticks && reserve < -tolerated)) return static_cast<int>(i);
  }
  return -1;
}
/// Replaces forces that do not satisfy the laws by such that do, if there are. Returns the first contact, of those that
/// touch, that violates them by more than `tolerated`, relative to the largest force; -1: none.
template <class Contacts, class State>
int admit_forces(const Contacts& c, State& s, contact_solver& m, forces_in_modes& forces, double tolerated) {
  const double most = tolerated * largest_force(m, forces);
  if (const int wrong = first_wrong_mode(m, most); wrong < 0 || !forces.redundant() || !find_admissible_forces(c, s, m))
    return wrong;
  put_contacts(m, s);
  return -1;
}
/// The functions of all contacts at the time t and the state x, by number; of open ones their gap, m.
template <class Access, class X>
const std::vector<std::array<double, 3>>& contact_margins(const Access& a, double t, const X& x) {
  auto& step = a.memory();
  if (step.margin_x.size() == x.size() && step.margin_x == x && step.margin_time == t) return step.margins;
  step.margin_x.resize(0);
  if (is_stepped(a, x)) {
    step.margins.assign(static_cast<std::size_t>(a.contacts()), {1, 1, 1});
    return step.margins;
  }
  a.at(t, x, [&](const auto& c, auto& s, contact_solver& m) {
    step.margins.assign(m.contacts.size(), {1, 1, 1});
    step.zero_gaps.resize(m.contacts.size());
    bool closed = false;
    for (const auto& y : m.contacts) closed |= mode_of(s.template get<kind::contact>(y.slot)) != contact_mode::open;
    std::vector<vec3<>> starts;
    for (const auto& y : m.contacts) starts.push_back(s.template get<kind::contact>(y.slot).direction);
    if (!closed) {
      m.equations.at_positions(c, s, false);
      m.find(c, s);
      m.touching.clear();
    } else {
      accelerate_in_modes(c, s, m, step.forces);
    }
    for (std::size_t k = 0; k < m.contacts.size(); ++k)
      step.margins[k][0] = m.contacts[k].place.gap - step.zero_gaps[k];
    if (!closed) return;
    const bool admitted = admit_forces(c, s, m, step.forces, 1e-13) < 0;
    step.largest_force = (std::max)(step.largest_force, largest_force(m, step.forces));
    const double tiny = 1e-13 * step.largest_force;
    for (std::size_t i = 0; i < m.touching.size(); ++i) {
      const auto k = static_cast<std::size_t>(m.touching[i]);
      auto& own = step.margins[k] = margins_of_closed(m, i, starts[k], tiny);
      if (!admitted) continue;
      own[0] = (std::max)(own[0], tiny);
      if (m.modes[i] == contact_mode::sticks) own[1] = (std::max)(own[1], tiny);
    }
    if (step.forces.jammed >= 0) {
      auto& own = step.margins[static_cast<std::size_t>(m.touching[static_cast<std::size_t>(step.forces.jammed)])];
      own[0] = -std::abs(own[0]) - tiny;
    }
  });
  step.margin_x = x, step.margin_time = t;
  return step.margins;
}

/// Throws `bad_argument` for modes whose forces violate the laws, after `accelerate_in_modes`.
template <class Contacts, class State>
void refuse_wrong_modes(const Contacts& c, State& s, contact_solver& m, forces_in_modes& forces) {
  const int wrong = admit_forces(c, s, m, forces, 1e-6);
  if (wrong < 0) return;
  const auto& x = m.touched(static_cast<std::size_t>(wrong));
  const double normal = reserves(m, static_cast<std::size_t>(wrong))[0];
  raise<bad_argument>("kte: " + name_of(c, m, x) +
                      (normal < 0 ? " is closed, but pulls with " + number(-normal) + " N"
                                  : std::string(" sticks, but its force exceeds friction")) +
                      ": integrate with kte::element_events(model), which changes modes");
}
/// The accelerations of a model at x, for stages of steps, written to `forces` of the working memory. Wrong modes
/// at the start of a step are noted, because events may mend them, and refused at the next one.
template <class Access, class Contacts, class State, class X>
void accelerate_in_step(const Access& a, const Contacts& c, State& s, contact_solver& m, const X& x) {
  auto& step = a.memory();
  step.margin_x.resize(0);
  accelerate_in_modes(c, s, m, step.forces);
  put_forces_of_closures(m, s);
  if (first_wrong_mode(m, 1e-6 * largest_force(m, step.forces)) < 0) [[likely]]
    return;
  step.wrong = x;
  if (step.x0.size() != x.size() || step.x0 != x) return;
  if (step.begun > 1) refuse_wrong_modes(c, s, m, step.forces);
  step.starts_wrong = true;
}
/// A step begins at x0.
template <class Access, class X>
void begin_step_with_contacts(const Access& a, const X& x0) {
  if (is_stepped(a, x0)) return;
  auto& step = contact_step_from(a, x0);
  if (!step.starts_wrong) [[likely]]
    return;
  step.x0.resize(0), step.wrong.resize(0);  // another integration may begin here, with events
  a.at(step.start_time, x0, [&](const auto& c, auto& s, contact_solver& m) {
    accelerate_in_modes(c, s, m, step.forces);
    refuse_wrong_modes(c, s, m, step.forces);
  });
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

/// What happened to a contact at an event.
struct contact_change {
  const char* impact = nullptr;
  double rest_time = -1;  ///< of bounces that get smaller, s
  bool bounces = false;
  contact_mode before{}, after{};
  vec3<> direction{};  ///< of sliding, before
  bool turns = false;
  bool passes = false;    ///< begins to pass through its surface
  bool at_limit[2] = {};  ///< whether the normal force, or the reserve of friction, has fallen to zero
};
template <class Contacts>
std::string text_of_changes(const Contacts& c, const contact_solver& m, const std::vector<contact_change>& all) {
  std::string text;
  for (std::size_t i = 0; i < all.size(); ++i) {
    const auto& x = all[i];
    std::string words;
    const auto say = [&words](const std::string& w) { words += (words.empty() ? "" : ", ") + w; };
    if (x.impact) say(x.impact);
    if (x.passes) say("passes");
    if (x.rest_time >= 0) say("rests at " + number(x.rest_time) + " s");
    if (x.before != x.after || x.impact)
      say(x.after == contact_mode::sticks   ? "sticks"
          : x.after == contact_mode::slides ? "slides"
          : x.impact                        ? "bounces"
                                            : "lifts");
    else if (x.turns)
      say("turns");
    if (words.empty()) continue;
    text += (text.empty() ? "'" : "; '") + c.loop_name(m.place(m.contacts[i]).loop) + "': " + words;
  }
  return text;
}

/// Resolves impacts at the state x, finds the modes of all contacts, and puts x on the rows of closed ones:
///
///   while contacts approach: impact; then Coulomb's law for accelerations; if that is jammed: tangential impact
///
/// A contact whose next bounce is lower than the touching gap comes to rest: bounces at intervals that shrink by e
/// would end, with a constant acceleration -g_n of the gap, at
///
///   t + 2 e w/(g_n (1 - e)),   w: velocity of approach                                    (1)
/// `along_solution`: x is a state of an integrator with the present modes, and first put on their rows.
/// Throws `bad_argument` for a state that is not finite.
template <class Access, class X>
void resolve_contacts(const Access& a, double t, X& x, bool along_solution) {
  for (Eigen::Index i = 0; i < x.size(); ++i)
    if (!std::isfinite(x[i])) [[unlikely]]
      raise<bad_argument>("kte: x[" + std::to_string(i) + "] of a state with contacts is not finite: " + number(x[i]));
  auto& step = a.memory();
  step.x0.resize(0), step.margin_x.resize(0), step.wrong.resize(0), step.time = t;
  if (is_stepped(a, x)) a.model.each_contact([&x](int, int first) { x[first] = 0; });
  if (along_solution) {
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
      accelerate_freely(c, s, m, no_forces{});
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
          c, s, m, no_forces{}, [&m](const contact_at& y) { return leaves_at_event(m, y); },
          [&m](const contact_at& y) { return slides_at_event(m, y); });
      if (status == friction_status::no_solution) return hit("tangential impact");
      if (status == friction_status::not_converged) [[unlikely]]
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
        changes[i].turns = mode_of(of) == contact_mode::slides && dot(changes[i].direction, of.direction) < 0.999;
        put_mode(of, at_modes + numbers_of_contact * m.contacts[i].slot, x);
      }
      step.change = text_of_changes(c, m, changes);
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
