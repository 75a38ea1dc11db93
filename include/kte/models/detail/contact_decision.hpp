#pragma once

#include <kte/models/detail/contact_margins.hpp>

/// The modes of contacts at an event, from positions and velocities, by one step of Moreau at frozen time in the space
/// of contacts:
///
///   w = W lambda + b + u/tau,   lambda in Coulomb's laws for w,   b: u' without contact forces             (1)
///   tau_n = sqrt(2 h L / max|b|),   h = unresolved_height                                                   (2)
///
/// tau_n is the time of flights that events do not resolve: velocities below b tau_n are what is left of those. tau of
/// tangents is longer where a contact slides slowly (dynamics/contacts/slow_sliding.hpp). u enters only where it is not
/// rest. Then velocities are put on the modes by the least change in kinetic energy,
///
///   u_n = 0 of closed contacts,   u_t = 0 of those that stick, rest, or whose sliding has stopped           (3)
///
/// and the forces of these modes are found without u/tau.
namespace kte::detail {

/// Whether a contact that touches leaves the surface, at an event: not if it would fall back from a height that events
/// do not resolve.
inline bool leaves_at_event(const contact_solver& m, const contact_at& x) {
  const double speed = dot(x.place.normal, x.slip), height = unresolved_height * m.equations.places.length;
  return normal_velocity(m, x) > 1 && speed * speed > 2 * height * std::abs(free_gap_ddot(m, x));
}

/// What a decision knows of a contact.
struct contact_before_decision {
  double look_ahead = 0;  ///< tau of slow sliding, s
  bool stops = false;     ///< whether its speed has fallen to zero, by slow_sliding.hpp
  bool opens = false;     ///< whether it must open
};

class contact_decision {
 public:
  /// `wide`: a factor of all tau.
  contact_decision(double wide, double slow_speed) : wide_(wide), slow_speed_(slow_speed) {}

  /// Finds forces and modes, written to m and to the contacts of the state; may change the velocities v instead, and
  /// then must be called again: returns whether it is done. Call `accelerate_freely` first.
  bool decide(const chain_constraints& c, runtime_state& s, contact_solver& m,
              const std::vector<contact_before_decision>& before, mode_rows& rows, Eigen::VectorXd& v,
              friction_status& status) {
    const double length = m.equations.places.length, rest = rest_velocity * length;
    find_time_ahead(m);
    choose(c, m, before);
    bool moves = false;
    for (std::size_t i = 0; i < m.touching.size(); ++i) {
      put_bias(m, i);
      const auto& y = m.touched(i);
      if (is_ahead_) continue;
      const double un = dot(y.place.normal, y.slip);
      if (std::abs(un) > rest) m.bias[y.first] += un / (tau_ * length), moves = true;
      const vec3<> t = contact_workspace::tangential(y);
      const auto& known = before[static_cast<std::size_t>(m.touching[i])];
      const double speed = std::sqrt(dot(t, t));
      if (!is_slow(m, y) || !(speed > (known.stops ? 0 : rest))) continue;
      moves = true;
      if (known.stops) continue;
      const double tau = (std::max)(tau_, wide_ * known.look_ahead);
      for (int k = 1; k < y.rows(); ++k)
        m.bias[y.first + k] += dot(y.basis[static_cast<std::size_t>(k)], t) / (tau * length);
    }
    m.make_matrix(c, s, m.equations.acceleration);
    status = find_friction(m);
    if (has_forces(status) && is_near_jam(m)) status = friction_status::no_solution;
    if (!has_forces(status)) return true;
    if (moves && tau_ > 0) {
      is_ahead_ = true;
      note_sliding(m, before);
      put_velocities(c, s, m, before, rows, v);
      return false;
    }
    m.accelerate(s, m.change_of_motion);
    s.work.forces = m.before + m.change_of_motion;
    put_contacts(m, s);
    return true;
  }

 private:
  /// (2).
  void find_time_ahead(const contact_solver& m) {
    free_ = 0;
    for (const auto& y : m.contacts) {
      if (!m.touches(y)) continue;
      const vec3<> b = m.unscaled(y, m.equations.acceleration);
      free_ = (std::max)(free_, std::sqrt(dot(b, b)));
    }
    tau_ = free_ > 0 ? wide_ * std::sqrt(2 * unresolved_height * m.equations.places.length / free_) : 0;
  }
  /// Whether the law of friction decides if a contact slides, and where to.
  bool is_slow(const contact_solver& m, const contact_at& y) const {
    const vec3<> t = contact_workspace::tangential(y);
    const double speed = std::sqrt(dot(t, t)), length = m.equations.places.length;
    if (speed <= rest_velocity * length) return true;
    return y.place.law.friction > 0 && speed < (std::max)(tau_ * free_, y.planar ? 0 : slow_speed_ * length);
  }
  void choose(const chain_constraints& c, contact_solver& m, const std::vector<contact_before_decision>& before) const {
    choose_contacts(
        c, m,
        [&](const contact_at& y) {
          return before[static_cast<std::size_t>(&y - m.contacts.data())].opens || leaves_at_event(m, y);
        },
        [&](const contact_at& y) { return !is_slow(m, y); });
    if (!is_ahead_) return;
    for (std::size_t i = 0; i < m.touching.size(); ++i) {
      const vec3<> t = contact_workspace::tangential(m.touched(i));
      const auto& d = directions_[static_cast<std::size_t>(m.touching[i])];
      if (dot(d, d) > 0 && std::sqrt(dot(t, t)) > rest_velocity * m.equations.places.length) m.let_slide(i, d);
    }
  }
  /// Slow contacts that go on sliding keep their velocity, and the direction found; but what is left of flights that
  /// are not resolved has no direction.
  void note_sliding(const contact_solver& m, const std::vector<contact_before_decision>& before) {
    directions_.assign(m.contacts.size(), {});
    for (std::size_t i = 0; i < m.touching.size(); ++i) {
      const auto k = static_cast<std::size_t>(m.touching[i]);
      const auto& y = m.touched(i);
      const vec3<> t = contact_workspace::tangential(y);
      if (m.modes[i] != contact_mode::slides || before[k].stops || m.laws[i].sliding) continue;
      if (std::sqrt(dot(t, t)) < tau_ * free_) continue;
      const vec3<> force = m.force_of(y);
      directions_[k] = unit_of(dot(y.place.normal, force) * y.place.normal - force);
    }
  }
  /// (3).
  void put_velocities(const chain_constraints& c, runtime_state& s, contact_solver& m,
                      const std::vector<contact_before_decision>& before, mode_rows& rows, Eigen::VectorXd& v) const {
    rows.clear(m);
    for (std::size_t i = 0; i < m.touching.size(); ++i) {
      if (m.modes[i] == contact_mode::open) continue;
      const auto& y = m.touched(i);
      const bool stands = m.modes[i] == contact_mode::sticks || !slides(m, y) ||
                          (before[static_cast<std::size_t>(m.touching[i])].stops && is_slow(m, y));
      for (int r = 0; r < (stands ? y.rows() : 1); ++r)
        rows.rows.push_back({m.touching[i], y.basis[static_cast<std::size_t>(r)], true});
    }
    auto& e = m.equations;
    e.at_positions(c, s, true);
    m.factor.factorize(c, s, e);
    e.at_rates(c, s);
    rows.fill(c, s, m), rows.factorize(nullptr);
    Eigen::VectorXd values, change;
    rows.put_values(
        m, rates_of_closures(m, v), [](const contact_at& y) { return y.slip; }, values);
    rows.least_change(s, m, values, change);
    v -= change;
  }

  double wide_, slow_speed_, tau_ = 0, free_ = 0;
  bool is_ahead_ = false;           ///< whether velocities have been put on the modes
  std::vector<vec3<>> directions_;  ///< of slow sliding, by contact; 0: none
};

}  // namespace kte::detail
