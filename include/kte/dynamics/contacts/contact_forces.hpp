#pragma once

#include <kte/contact/friction_solver.hpp>
#include <kte/dynamics/contacts/contact_results.hpp>
#include <kte/dynamics/contacts/contact_rows.hpp>
#include <kte/errors.hpp>

#include <limits>

/// Accelerations with contact forces, in the working memory of a state.
namespace kte::detail {

/// Sliding is jammed (Painleve) where W_nn - mu W_nt <= this times W_nn: the force of a contact alone is divided by
/// W_nn - mu W_nt, and grows without limit before that is 0.
inline constexpr double least_support = 1e-5;

struct contact_solver : contact_workspace {
  using contact_workspace::contact_workspace;
  friction_solver<double> solver;
  std::vector<contact_mode> modes;  ///< of contacts that touch
  bool polish = false;              ///< option of the friction solver
  Eigen::VectorXd loop_forces, change_of_motion, before, velocities;
  double residual = 0;  ///< of a friction problem that was not solved

  /// Calls put(number of the contact, force or impulse) for the contacts that touch.
  template <class Put>
  void each_force(const Put& put) const {
    for (const int i : touching) put(static_cast<std::size_t>(i), force_of(contacts[static_cast<std::size_t>(i)]));
  }
};

constexpr contact_mode as_contact_mode(friction_mode mode) {
  return mode == friction_mode::open     ? contact_mode::open
         : mode == friction_mode::sticks ? contact_mode::sticks
                                         : contact_mode::slides;
}
std::string names_of_touching(const chain_constraints& c, const contact_workspace& m);
/// Writes the modes of the contacts that touch, from those of the solution: contacts without force that separate are
/// open.
template <class Solver, class Numbers>
void put_modes(Solver& m, const std::vector<friction_mode>& found, const Numbers& lambda, const Numbers& u) {
  const auto row = [&m](std::size_t i) { return static_cast<std::size_t>(m.touched(i).first); };
  double force = 0;
  for (std::size_t i = 0; i < found.size(); ++i) force = (std::max)(force, lambda[row(i)]);
  const double rate = m.bias.cwiseAbs().maxCoeff();
  m.modes.clear();
  for (std::size_t i = 0; i < found.size(); ++i) {
    const bool apart = lambda[row(i)] <= 1e-10 * force && u[row(i)] > 1e-10 * rate;
    m.modes.push_back(apart ? contact_mode::open : as_contact_mode(found[i]));
  }
}
/// Finds the forces of the contacts that touch, those of least norm if there are several with the same motion, unless
/// `any`. `start`: forces to start from, or none.
template <class Solver>
friction_status find_friction(Solver& m, bool any = false, std::span<const double> start = {}) {
  m.modes.clear();
  if (m.touching.empty()) return friction_status::solved;
  const friction_problem<> p(m.w, m.bias, m.laws);
  friction_options<> options;
  options.least_norm = !any, options.polish = m.polish;
  const auto& r = m.solver.solve(p, options, start);
  if (!is_taken(r.status, r.residual)) [[unlikely]] {
    if (m.bias.allFinite()) return m.residual = r.residual, r.status;
    m.forces.setConstant(std::numeric_limits<double>::quiet_NaN());  // checks of results name the argument at fault
    m.modes.assign(m.touching.size(), contact_mode::sticks);
    return friction_status::solved;
  }
  for (Eigen::Index k = 0; k < m.forces.size(); ++k) m.forces[k] = r.lambda[static_cast<std::size_t>(k)];
  put_modes(m, r.modes, r.lambda, r.u);
  return r.solved() ? r.status : friction_status::solved;
}
constexpr bool has_forces(friction_status status) {
  return status == friction_status::solved || status == friction_status::several_solutions;
}
std::string text_of_no_forces(const std::string& names, friction_status status, double residual);
[[noreturn, gnu::cold]] inline void raise_no_forces(const chain_constraints& c, const contact_solver& m,
                                                    friction_status status) {
  raise<no_solution>(text_of_no_forces(names_of_touching(c, m), status, m.residual));
}
/// `find_friction`; throws `no_solution`. Returns whether there are several solutions.
bool solve_friction(const chain_constraints& c, contact_solver& m, bool any = false,
                    std::span<const double> start = {});
/// The normal and the tangential velocity of a contact, relative to `rest_velocity`.
inline double normal_velocity(const contact_workspace& m, const contact_at& x) {
  return dot(x.place.normal, x.slip) / (rest_velocity * m.equations.places.length);
}
inline bool slides(const contact_workspace& m, const contact_at& x) {
  const vec3<> t = contact_workspace::tangential(x);
  return std::sqrt(dot(t, t)) > rest_velocity * m.equations.places.length;
}
inline vec3<> unit_of(const vec3<>& v) {
  const double length = std::sqrt(dot(v, v));
  return length > 0 ? (1 / length) * v : vec3<>{};
}
/// Writes all contacts to at(slot), with the forces found by `solve_friction`.
template <class At>
void put_contacts_at(const contact_solver& m, const At& at) {
  for (const auto& x : m.contacts) {
    auto& to = at(x.slot);
    to.gap = x.place.gap, to.slip = x.slip, to.point = x.place.point;
    to.force = to.direction = {}, to.mode = x.passes ? passing_mode : static_cast<double>(contact_mode::open);
  }
  for (std::size_t i = 0; i < m.touching.size(); ++i) {
    const auto& x = m.touched(i);
    auto& to = at(x.slot);
    to.force = m.force_of(x);
    to.mode = static_cast<double>(m.modes[i]);
    if (m.modes[i] != contact_mode::slides) continue;
    to.direction = m.laws[i].sliding ? x.basis[1] : unit_of(dot(x.place.normal, to.force) * x.place.normal - to.force);
  }
}
inline void put_contacts(const contact_solver& m, runtime_state& s) {
  put_contacts_at(
      m, [&s](int slot) -> auto& { return s.get<kind::contact>(slot); });
}

/// Writes `loop_forces` to the closures of the state.
void put_forces_of_closures(const contact_solver& m, runtime_state& s);
/// Accelerations a_0 of the tree under applied(i), to `before`, with the places and slip velocities of contacts, and
/// the second derivatives of rows for a_0 in the equations: of closures, and of contacts that touch, are closed, or
/// have a gate.
void accelerate_freely(const chain_constraints& c, runtime_state& s, contact_solver& m,
                       const tree::given_forces<double>& applied);
/// g'' of a contact without contact forces, after `accelerate_freely`.
inline double free_gap_ddot(const contact_solver& m, const contact_at& x) {
  return dot(x.place.normal, m.unscaled(x, m.equations.acceleration)) + x.place.bending;
}
/// Writes u' of contact i of those that touch, after `accelerate_freely`; its normal part is g''.
inline void put_bias(contact_solver& m, std::size_t i) {
  const auto& x = m.touched(i);
  m.put_rows(x, m.unscaled(x, m.equations.acceleration), m.bias);
  m.bias[x.first] += x.place.bending / m.equations.places.length;
}
inline std::string text_of_approach(const std::string& contact, double speed) {
  return "kte: contact '" + contact + "' approaches at " + number(speed) +
         " m/s: kte::impact gives the velocities after it";
}
/// Chooses the contacts that touch: not those with leaves(contact); those with slides(contact) slide. Raises
/// `bad_argument` for a contact that approaches.
template <class Leaves, class Slides>
void choose_contacts(const chain_constraints& c, contact_solver& m, const Leaves& leaves, const Slides& slides) {
  m.choose([&](const contact_at& x) { return m.touches(x) && !leaves(x); });
  for (std::size_t i = 0; i < m.touching.size(); ++i) {
    const auto& x = m.touched(i);
    if (normal_velocity(m, x) < -1) [[unlikely]]
      raise<bad_argument>(text_of_approach(c.loop_name(m.place(x).loop), -dot(x.place.normal, x.slip)));
    if (slides(x)) m.let_slide(i);
  }
}
/// Contacts leave and slide by their velocities.
struct leaves_by_motion {
  const contact_solver& m;
  bool operator()(const contact_at& x) const { return normal_velocity(m, x) > 1; }
};
struct slides_by_motion {
  const contact_solver& m;
  bool operator()(const contact_at& x) const { return slides(m, x); }
};
/// Accelerations under applied(i), written to `forces` of the working memory, with the contact forces:
///
///   u' = W lambda + b,   a = a_0 + L^-1 B lambda          (1)
///
/// a_0: accelerations of the tree, b: u' for a_0. Contacts are those of `choose_contacts`. If there are no forces that
/// satisfy the laws, the accelerations are not found.
template <class Leaves, class Slides>
friction_status find_contact_forces(const chain_constraints& c, runtime_state& s, contact_solver& m,
                                    const tree::given_forces<double>& applied, const Leaves& leaves,
                                    const Slides& slides) {
  accelerate_freely(c, s, m, applied);
  choose_contacts(c, m, leaves, slides);
  for (std::size_t i = 0; i < m.touching.size(); ++i) put_bias(m, i);
  m.make_matrix(c, s, m.equations.acceleration);
  const auto status = find_friction(m);
  if (!has_forces(status)) return status;
  m.accelerate(s, m.change_of_motion);
  s.work.forces = m.before + m.change_of_motion;
  put_contacts(m, s);
  return status;
}
/// As `find_contact_forces` in a tree, by one factorization and one pass of accelerations: without a_0.
template <class Leaves, class Slides>
friction_status find_contact_forces_in_tree(const chain_constraints& c, runtime_state& s, contact_solver& m,
                                            const tree::given_forces<double>& applied, const Leaves& leaves,
                                            const Slides& slides) {
  check_loops(c, s);
  const auto biases = articulate_under(c.elements(), s, applied, {});
  if (!m.closures.empty()) m.equations.at_positions(c, s, false, true);
  m.factor.take_articulated(s, m.equations);
  m.find_biased(c, s);
  choose_contacts(c, m, leaves, slides);
  m.make_matrix_and_bias(c, s);
  const auto status = find_friction(m);
  if (!has_forces(status)) return status;
  m.accelerate_with_tree(s);
  accelerate_after(s, biases);
  put_contacts(m, s);
  return status;
}
/// `find_contact_forces` with sliding contacts by their velocity. Throws `no_solution`. Returns whether there are
/// several solutions.
bool accelerate_with_contacts(const chain_constraints& c, runtime_state& s, contact_solver& m,
                              const tree::given_forces<double>& applied);

#ifdef KTE_FUNCTION
KTE_FUNCTION std::string names_of_touching(const chain_constraints& c, const contact_workspace& m) {
  std::string names;
  for (std::size_t i = 0; i < m.touching.size(); ++i)
    names.append(i == 0 ? "'" : ", '").append(c.loop_name(m.place(m.touched(i)).loop)).append("'");
  return names;
}
KTE_FUNCTION std::string text_of_no_forces(const std::string& names, friction_status status, double residual) {
  if (status == friction_status::nearly_singular)
    return "kte: the forces of contacts " + names +
           " cannot be computed: their equations are nearly singular, as where a body stands on one that is 1e12 times "
           "lighter";
  return "kte: no contact forces satisfy the laws of friction at contacts " + names +
         (status == friction_status::no_solution ? ": a jam (Painleve): kte::impact finds the velocities after it"
                                                 : "; residual " + number(residual));
}
KTE_FUNCTION bool solve_friction(const chain_constraints& c, contact_solver& m, bool any,
                                 std::span<const double> start) {
  const auto status = find_friction(m, any, start);
  if (!has_forces(status)) [[unlikely]]
    raise_no_forces(c, m, status);
  return status == friction_status::several_solutions;
}
KTE_FUNCTION void put_forces_of_closures(const contact_solver& m, runtime_state& s) {
  for (const int k : m.closures) {
    const auto& x = m.equations.places.closures[static_cast<std::size_t>(k)];
    auto& loop = s.get<kind::loop>(x.loop);
    for (int r = 0; r < x.rows.count(); ++r)
      row_of(loop.force, loop.torque, x.rows, r) = m.equations.places.scale(x, r) * m.loop_forces[x.first + r];
  }
}
KTE_FUNCTION void accelerate_freely(const chain_constraints& c, runtime_state& s, contact_solver& m,
                                    const tree::given_forces<double>& applied) {
  check_loops(c, s);
  auto& e = m.equations;
  const bool tree = s.tree().plan.tree;
  accelerations_on_coordinates(c.elements(), s, applied, {});
  auto& a = s.work.forces;
  m.before = a;
  const auto& a0 = m.before;
  e.at_positions(c, s, !tree, tree);
  if (tree) {
    m.factor.take_articulated(s, e);
    m.find(c, s);
    for (const int k : m.closures) e.accelerate_residual(c, s, k, [&a](int i) { return a[i]; });
    for (const auto& x : m.contacts)
      if (m.touches(x) || x.has_gate || mode_of(s.get<kind::contact>(x.slot)) != contact_mode::open)
        e.accelerate_residual_of_frames(c, x.closure, x.motion);
  } else {
    for_each_listed_freedom(s, [&a0](auto& x, const freedom& at) { put<vector_of::a>(x, at, a0); });
    m.factor.factorize(c, s, e);
    e.at_rates(c, s);
    m.find(c, s);
    e.acceleration += e.times(a0);
  }
}
KTE_FUNCTION bool accelerate_with_contacts(const chain_constraints& c, runtime_state& s, contact_solver& m,
                                           const tree::given_forces<double>& applied) {
  const auto status = s.tree().plan.tree
                          ? find_contact_forces_in_tree(c, s, m, applied, leaves_by_motion{m}, slides_by_motion{m})
                          : find_contact_forces(c, s, m, applied, leaves_by_motion{m}, slides_by_motion{m});
  if (!has_forces(status)) [[unlikely]]
    raise_no_forces(c, m, status);
  return status == friction_status::several_solutions;
}
#endif

}  // namespace kte::detail
