#pragma once

#include <kte/dynamics/contacts/impact.hpp>
#include <kte/dynamics/runtime/at_run_time.hpp>

#ifdef KTE_FUNCTION
#  include <kte/dynamics/contacts/contact_variations.hpp>
#  include <kte/dynamics/contacts/mode_dynamics.hpp>
#  include <kte/kernels/orthogonal_decomposition.hpp>
#endif

namespace kte {

/// The result of `impact_derivatives`, for n degrees of freedom.
struct impact_derivatives_result {
  Eigen::VectorXd v;           ///< velocities after the impact
  Eigen::MatrixXd by_q, by_v;  ///< their derivatives, n x n
};

namespace detail {
impact_derivatives_result impact_derived(const runtime_chain& c, runtime_state& s);
}  // namespace detail

/// The velocities after `impact`, with their derivatives by q (along the numbers of v) and by the velocities v before,
/// as long as each contact that touches keeps its mode: implicit differentiation of
///
///   M(q) (v^+ - v) - J(q)^T P = 0                                                    (1)
///   u_n^+ + e u_n = 0,   u_t^+ = 0 of contacts that stick                            (2)
///   u_n^+ + e u_n = 0,   |u_t^+| P_t + mu P_n u_t^+ = 0 of those that slide          (3)
///
/// with P = 0 of contacts that open. The set of touching contacts does not depend on q. Throws `bad_argument` for a
/// chain with closures of loops, and for an impact that reduces its coefficients of restitution so that energy does not
/// grow. Arguments and other errors as for `impact`.
///
///   const auto r = kte::impact_derivatives(c, s, q, v);    r.v, r.by_q, r.by_v
template <indexable Q, indexable V>
impact_derivatives_result impact_derivatives(const runtime_chain& c, runtime_state& s, const Q& q, const V& v) {
  detail::check_regular_tree(c, s);
  return detail::take(c, s, q, v).call([&] { return detail::impact_derived(c, s); });
}
/// As for runtime chains.
template <class Gravity, class... E, indexable Q, indexable V>
[[nodiscard]] impact_derivatives_result impact_derivatives(const static_chain<Gravity, E...>& c, const Q& q,
                                                           const V& v) {
  return detail::at_run_time(c, q, v, [&](auto&... at) { return impact_derivatives(at...); });
}

}  // namespace kte

#ifdef KTE_FUNCTION
namespace kte::detail {

/// A contact in an impact whose mode is known.
struct contact_in_impact {
  int closure = 0;  ///< its number among closures and contacts
  bool planar = false, sticks = false;
  double friction = 0, restitution = 0;
  vec3<> impulse{};         ///< P, in axes of the surface
  contact_basis<> basis{};  ///< n, t
  int rows() const { return planar ? 2 : 3; }

  /// Calls put(row, value) for (2) or (3) of `impact_derivatives`.
  template <class D, class Put>
  void each_equation(const vec3<D>& n, const vec3<D>& before, const vec3<D>& after, const vec3<D>& p,
                     const Put& put) const {
    put(0, D(dot(n, after) + restitution * dot(n, before)));
    const auto along = [&n](const vec3<D>& x) { return as<D>(x - D(dot(n, x)) * n); };
    vec3<D> rest = along(sticks ? after : p);
    if (!sticks && friction > 0) {
      using std::sqrt;
      const vec3<D> slip = along(after);
      const D speed = D(sqrt(D(dot(slip, slip))));
      if (planar) {
        const double sense = as_double(dot(basis[1], slip)) < 0 ? -1 : 1;
        rest = as<D>(rest + D(D(friction * sense) * D(dot(n, p))) * vec3<D>{n.y, D(-n.x), D(0)});
      } else {
        rest = as<D>(speed * rest + D(D(friction) * D(dot(n, p))) * slip);
      }
    }
    for (int k = 1; k < rows(); ++k) put(k, D(dot(as<D>(basis[static_cast<std::size_t>(k)]), rest)));
  }
};
/// The contacts that stick or slide after an impact, which `strike` has solved.
inline std::vector<contact_in_impact> closed_in_impact(const contact_solver& m, const impact_memory& memory) {
  std::vector<contact_in_impact> all;
  for (std::size_t i = 0; i < m.touching.size(); ++i) {
    if (m.modes[i] == contact_mode::open) continue;
    const auto& x = m.touched(i);
    all.push_back({x.closure, x.planar, m.modes[i] == contact_mode::sticks, x.place.law.friction, memory.restitution[i],
                   m.force_of(x), x.basis});
  }
  return all;
}

/// The derivatives of v^+ at the state, with the velocities v before and v^+ after an impact.
inline impact_derivatives_result derive_impact(const runtime_chain& c, runtime_state& s, contact_solver& m,
                                               const Eigen::VectorXd& before, const Eigen::VectorXd& after,
                                               const std::vector<contact_in_impact>& contacts) {
  using D = derivative_number;
  constexpr int lanes = D::variables;
  const Eigen::Index n = s.dofs();
  Eigen::Index rows = 0;
  for (const auto& x : contacts) rows += x.rows();
  struct motion_by_q {
    vec3<D> normal, slip;
  };
  // By groups of `lanes` directions, then by contact
  using motions = std::vector<std::vector<motion_by_q>>;
  inverse_dynamics_result<double, Eigen::Dynamic> forces;
  forces.tau.resize(n), forces.by_q.setZero(n, n), forces.by_v.setZero(n, n);
  const auto vary = [&](const Eigen::VectorXd& v, const Eigen::VectorXd& a, bool pushes, motions& found) {
    write_numbers<vector_of::v>(s, v, "v"), write_numbers<vector_of::a>(s, a, "a");
    derivative_state& d = state_in_duals(c, s);
    found.clear();
    const auto derive = [&](const directions& moving) -> const auto& {
      if (moving.by == vector_of::q) found.emplace_back();
      inverse_dynamics_in_duals(runtime_elements{c}, s, d, moving, [&](derivative_state&) {
        for (const auto& x : contacts) {
          const auto& at = m.equations.places.closures[static_cast<std::size_t>(x.closure)];
          const auto motion = closing_motion_in_duals(s, d, at);
          const auto found_at = runtime_elements{c}.element(at.element).touch_at(motion);
          if (moving.by == vector_of::q) found.back().push_back({found_at.normal, found_at.slip});
          if (pushes) push_at_contact(s, at, motion, as<D>(x.impulse), found_at.point, d.work.loads);
        }
      });
      return d.forces;
    };
    derive_by_duals(s.freedoms(), std::span(d.q), std::span(d.v), std::span(d.a), false, derive, forces);
  };
  const Eigen::VectorXd none = Eigen::VectorXd::Zero(n);
  motions at_start, at_end, at_rest;
  vary(none, none, false, at_rest);
  Eigen::MatrixXd by_q = -forces.by_q;
  vary(none, after - before, true, at_rest);
  by_q += forces.by_q;  // of (1)
  vary(before, none, false, at_start), vary(after, none, false, at_end);

  m.equations.at_positions(contacts_of(c), s, true);
  const Eigen::MatrixXd scaled = m.equations.scaled_jacobian();
  Eigen::MatrixXd jacobian = Eigen::MatrixXd::Zero(3 * static_cast<Eigen::Index>(contacts.size()), n);
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    const auto& at = m.equations.places.closures[static_cast<std::size_t>(contacts[i].closure)];
    jacobian.middleRows(3 * static_cast<Eigen::Index>(i), at.rows.count()) =
        m.equations.places.length * scaled.middleRows(at.first, at.rows.count());
  }
  // The equations of contacts, and the matrix of impulses
  Eigen::MatrixXd of_q(rows, n), of_before(rows, n), of_after(rows, n), of_impulses = Eigen::MatrixXd::Zero(rows, rows);
  Eigen::MatrixXd push(rows, n);  // J of impulses
  Eigen::Index row = 0;
  for (std::size_t i = 0; i < contacts.size(); row += contacts[i].rows(), ++i) {
    const auto& x = contacts[i];
    const auto value = [](const D& y) { return D(y.value); };
    const auto still = [&value](const vec3<D>& y) { return vec3<D>{value(y.x), value(y.y), value(y.z)}; };
    const auto put = [&](Eigen::MatrixXd& to, Eigen::Index first) {
      return [&to, &row, first](int k, const D& y) {
        for (int lane = 0; lane < lanes && first + lane < to.cols(); ++lane)
          to(row + k, first + lane) = y.derivative[static_cast<std::size_t>(lane)];
      };
    };
    const auto moved = [&](vec3<D> y, Eigen::Index first) {
      for (int lane = 0; lane < lanes && first + lane < n; ++lane) {
        const auto j = jacobian.col(first + lane).segment<3>(3 * static_cast<Eigen::Index>(i));
        const auto at = static_cast<std::size_t>(lane);
        y.x.derivative[at] = j[0], y.y.derivative[at] = j[1], y.z.derivative[at] = j[2];
      }
      return y;
    };
    const vec3<D> p = as<D>(x.impulse);
    for (Eigen::Index group = 0; group * lanes < n; ++group) {
      const auto &from = at_start[static_cast<std::size_t>(group)][i], &to = at_end[static_cast<std::size_t>(group)][i];
      const vec3<D> normal = still(to.normal), u = still(from.slip), u_after = still(to.slip);
      const Eigen::Index first = group * lanes;
      x.each_equation(to.normal, from.slip, to.slip, p, put(of_q, first));
      x.each_equation(normal, moved(u, first), u_after, p, put(of_before, first));
      x.each_equation(normal, u, moved(u_after, first), p, put(of_after, first));
    }
    vec3<D> varied = p;
    varied.x.derivative[0] = varied.y.derivative[1] = 1;
    if (!x.planar) varied.z.derivative[2] = 1;
    const auto &from = at_start[0][i], &to = at_end[0][i];
    Eigen::MatrixXd of_own = Eigen::MatrixXd::Zero(rows, x.rows());
    x.each_equation(still(to.normal), still(from.slip), still(to.slip), varied, put(of_own, 0));
    of_impulses.block(row, row, x.rows(), x.rows()) = of_own.middleRows(row, x.rows());
    push.middleRows(row, x.rows()) = jacobian.middleRows(3 * static_cast<Eigen::Index>(i), x.rows());
  }

  Eigen::MatrixXd inverse;
  if (s.tree().plan.tree)
    articulate_and_invert(runtime_elements{c}, s, inverse);
  else
    invert_free_rows(runtime_elements{c}, s, inverse);
  impact_derivatives_result r;
  r.v = after;
  r.by_q = -inverse * by_q, r.by_v = Eigen::MatrixXd::Identity(n, n);
  if (rows == 0) return r;
  const Eigen::MatrixXd effect = inverse * push.transpose();
  orthogonal_decomposition system;
  system.compute(of_after * effect + of_impulses, 1e-10);
  r.by_q -= effect * system.solve(of_q + of_after * r.by_q);
  r.by_v -= effect * system.solve(of_before + of_after);
  return r;
}

KTE_FUNCTION impact_derivatives_result impact_derived(const runtime_chain& c, runtime_state& s) {
  if (has_loops(c))
    throw bad_argument("kte: the derivatives of impacts are not known for chains with closures of loops");
  auto& m = contact_memory(c, s);
  impact_memory memory;
  const Eigen::VectorXd before = read_numbers<vector_of::v>(s);
  Eigen::VectorXd after = before;
  strike(contacts_of(c), s, m, memory, impact_law::at_once, after);
  if (memory.result.restitution != 1)
    throw bad_argument("kte: at contacts " + names_of_touching(contacts_of(c), m) +
                       " restitution is reduced so that energy does not grow: the impact has no known derivatives");
  auto r = derive_impact(c, s, m, before, after, closed_in_impact(m, memory));
  write_numbers<vector_of::v>(s, after, "v");
  return r;
}

}  // namespace kte::detail
#endif
