#pragma once

#include <kte/dynamics/contacts/contact_dynamics.hpp>
#include <kte/dynamics/runtime/at_run_time.hpp>

#ifdef KTE_FUNCTION
#  include <kte/dynamics/contacts/contact_variations.hpp>
#  include <kte/dynamics/runtime/derivatives.hpp>
#  include <kte/kernels/invert_general.hpp>
#  include <kte/kernels/orthogonal_decomposition.hpp>
#endif

namespace kte {

/// The result of `contact_dynamics_derivatives`, for n degrees of freedom.
struct contact_dynamics_derivatives_result {
  Eigen::VectorXd a;                   ///< accelerations, n
  Eigen::MatrixXd by_q, by_v, by_tau;  ///< derivatives of a, n x n

  /// A contact, and the derivatives of its force.
  struct contact_derivatives {
    contact_state<> at;                                    ///< gap, slip, force and mode
    Eigen::MatrixXd force_by_q, force_by_v, force_by_tau;  ///< derivatives of the force, 3 x n, in axes of its surface
  };
  /// A contact. Throws `unknown_name`.
  const contact_derivatives& contact(std::string_view name) const { return detail::named_value(names, contacts, name); }

  std::vector<std::string> names;  ///< of contacts, in order
  std::vector<contact_derivatives> contacts;
};

namespace detail {
contact_dynamics_derivatives_result contact_dynamics_derived(const runtime_chain& c, runtime_state& s,
                                                             const Eigen::VectorXd& tau);
}  // namespace detail

/// The accelerations and contact forces of `contact_dynamics`, with their derivatives by q (along the numbers of v), by
/// v and by tau, as long as each contact keeps its mode: implicit differentiation of
///
///   ID(q, v, a) - J^T f = tau                                                                         (1)
///   u' = 0 of contacts that stick;   g'' = 0, f = lambda_n (n - mu u_t/|u_t|) of those that slide         (2)
///   g'' = 0, f_t = -mu lambda_n u_t'/|u_t'| of those that begin to slide, at rest                        (3)
///
/// The direction of sliding depends on q and v, and so does its friction. Open contacts have no force. Closures of
/// loops are satisfied: J a + J_dot v = 0.
///
///   const auto r = kte::contact_dynamics_derivatives(c, s, q, v, tau);    r.by_q, r.contact("foot").force_by_tau
///
/// Positions and velocities are independent, also in directions in which a contact opens or a body that sticks slips:
/// there (2) holds, not the laws. Where a mode changes, the derivatives are those of one side. Where forces are not
/// unique, their derivatives have the least norm. Arguments and errors as for `contact_dynamics`.
template <indexable Q, indexable V, indexable T>
contact_dynamics_derivatives_result contact_dynamics_derivatives(const runtime_chain& c, runtime_state& s, const Q& q,
                                                                 const V& v, const T& tau) {
  detail::check_regular_tree(c, s);
  return detail::take(c, s, q, v, detail::found_later{}, tau).call([&] {
    return detail::contact_dynamics_derived(c, s, detail::as_vector(tau, s.dofs()));
  });
}
/// As for runtime chains.
template <class Gravity, class... E, indexable Q, indexable V, indexable T>
[[nodiscard]] contact_dynamics_derivatives_result contact_dynamics_derivatives(const static_chain<Gravity, E...>& c,
                                                                               const Q& q, const V& v, const T& tau) {
  return detail::at_run_time(c, q, v, tau, [&](auto&... at) { return contact_dynamics_derivatives(at...); });
}

}  // namespace kte

#ifdef KTE_FUNCTION
namespace kte::detail {

/// The linear equations of derivatives of a chain with contacts in the modes of a solution. With unknowns x of closures
/// and contacts, whose forces are K x, equations N, and E the derivatives of (3) of `contact_in_mode` by x:
///
///   M da - K dx = F,   N da + E dx = A          (4)
///
///   [da; dx] = [M^-1 - M^-1 K S N M^-1,  M^-1 K S;  -S N M^-1,  S] [F; A],   S = (N M^-1 K + E)^+          (5)
class contact_sensitivity {
 public:
  /// `inverse`: M^-1.
  contact_sensitivity(const loop_equations& e, const std::vector<contact_in_mode>& contacts, int closure_rows_count,
                      int equations, const Eigen::MatrixXd& inverse) {
    const Eigen::MatrixXd j = e.scaled_jacobian();
    const Eigen::Index n = j.cols();
    rows_.setZero(equations, n), forces_.setZero(equations, n), own_.setZero(equations, equations);
    int closed = 0;
    for (const auto& x : e.places.closures) {
      const bool is_contact_row = std::any_of(contacts.begin(), contacts.end(), [&](const auto& k) {
        return &e.places.closures[static_cast<std::size_t>(k.closure)] == &x;
      });
      if (is_contact_row || closed == closure_rows_count) continue;
      rows_.middleRows(closed, x.rows.count()) = forces_.middleRows(closed, x.rows.count()) =
          j.middleRows(x.first, x.rows.count());
      closed += x.rows.count();
    }
    for (const auto& x : contacts) put(x, e, j);
    all.resize(n + equations, n + equations);
    const Eigen::MatrixXd by_x = inverse * forces_.transpose(), by_force = rows_ * inverse;  // M^-1 K, N M^-1
    Eigen::MatrixXd s(equations, equations);
    if (equations > 0) invert(rows_ * by_x + own_, s);
    all.topRightCorner(n, equations).noalias() = by_x * s;
    all.bottomLeftCorner(equations, n).noalias() = -s * by_force;
    all.bottomRightCorner(equations, equations) = s;
    all.topLeftCorner(n, n) = inverse;
    all.topLeftCorner(n, n).noalias() -= all.topRightCorner(n, equations) * by_force;
  }
  Eigen::MatrixXd all;  ///< the matrix of (5)

 private:
  /// The inverse; if that is large, the pseudoinverse, where pivots below 1e-10 of the largest are zero.
  static void invert(const Eigen::MatrixXd& x, Eigen::MatrixXd& inverse) {
    Eigen::MatrixXd left = x;
    const auto size = [](const Eigen::MatrixXd& y) { return y.cwiseAbs().maxCoeff(); };
    if (invert_general(left, inverse) && size(x) * size(inverse) < 1e7) return;
    orthogonal_decomposition factor;
    factor.compute(x, 1e-10);
    inverse = factor.solve(Eigen::MatrixXd::Identity(x.rows(), x.rows()));
  }
  void put(const contact_in_mode& x, const loop_equations& e, const Eigen::MatrixXd& j) {
    using equations = contact_in_mode::equations;
    const auto& at = e.places.closures[static_cast<std::size_t>(x.closure)];
    Eigen::MatrixXd u = Eigen::MatrixXd::Zero(3, j.cols());  // u = u v
    u.topRows(at.rows.count()) = e.places.length * j.middleRows(at.first, at.rows.count());
    const auto along = [&u](const vec3<>& d) -> Eigen::RowVectorXd {
      return d.x * u.row(0) + d.y * u.row(1) + d.z * u.row(2);
    };
    const auto axis = [&x](int k) -> const vec3<>& { return x.basis[static_cast<std::size_t>(k)]; };
    if (x.kind == equations::slides || x.kind == equations::slides_along) {
      rows_.row(x.first) = along(axis(0));
      forces_.row(x.first) = along(axis(0) - x.friction * x.direction);
      return;
    }
    for (int k = 0; k < x.count(); ++k) rows_.row(x.first + k) = forces_.row(x.first + k) = along(axis(k));
    if (x.kind != equations::begins) return;
    const double load = x.pressure();
    const vec3<> t = x.slip_rate - dot(axis(0), x.slip_rate) * axis(0);
    const double speed = std::sqrt(dot(t, t)), factor = speed / (x.friction * load);
    const vec3<> d = speed > 0 ? (1 / speed) * t : vec3<>{}, f = x.force - load * axis(0);
    for (int k = 1; k < 3; ++k) {
      rows_.row(x.first + k) += dot(axis(k), f) / (x.friction * load) * along(d);
      own_(x.first + k, x.first + k) = factor;
      own_(x.first + k, x.first) = -factor * dot(axis(k), f) / load;
    }
  }

  Eigen::MatrixXd rows_, forces_, own_;  ///< N, K^T, E
};

/// Writes the derivatives of accelerations and contact forces to r, in the modes of a solution, which is in the state
/// and its memory; `planar`: whether the direction of contacts that slide in the plane is given.
inline void derive_in_modes(const runtime_chain& c, runtime_state& s, contact_solver& m, bool planar,
                            contact_dynamics_derivatives_result& r) {
  const Eigen::Index n = s.dofs();
  auto& e = m.equations;
  const closure_places* closures = has_loops(c) ? &loops_of(c, s).equations.places : nullptr;
  const int closed = closures != nullptr ? closures->rows : 0;
  auto contacts = contacts_in_modes(m, s, closed);
  for (auto& x : contacts)
    if (planar && x.planar && x.kind == contact_in_mode::equations::slides)
      x.kind = contact_in_mode::equations::slides_along;
  const int equations = contacts.empty() ? closed : contacts.back().first + contacts.back().count();
  const contact_variations by = vary_contacts(c, s, closures, e.places, contacts, equations);
  e.at_positions(contacts_of(c), s, true);
  Eigen::MatrixXd inverse;
  if (s.tree().plan.tree)
    articulate_and_invert(runtime_elements{c}, s, inverse);
  else
    invert_free_rows(runtime_elements{c}, s, inverse);
  const contact_sensitivity system(e, contacts, closed, equations, inverse);
  Eigen::MatrixXd right(n + equations, 2 * n);
  right << by.forces_by_q, by.forces_by_v, by.equations_by_q, by.equations_by_v;
  const Eigen::MatrixXd solution = -system.all * right;
  r.by_q = solution.topLeftCorner(n, n), r.by_v = solution.topRightCorner(n, n);
  r.by_tau = system.all.topLeftCorner(n, n);

  r.contacts.clear();
  for (std::size_t i = 0; i < m.contacts.size(); ++i) {
    const Eigen::MatrixXd none = Eigen::MatrixXd::Zero(3, n);
    r.contacts.push_back({s.get<kind::contact>(static_cast<int>(i)), none, none, none});
  }
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    const auto& at = contacts[i];
    Eigen::MatrixXd unit(3, at.count());
    for (int k = 0; k < at.count(); ++k) {
      const vec3<> f =
          at.count() > 1 ? at.basis[static_cast<std::size_t>(k)] : vec3<>(at.basis[0] - at.friction * at.direction);
      unit.col(k) << f.x, f.y, f.z;
    }
    auto& to = r.contacts[at.slot];
    const Eigen::Index row = n + at.first, count = at.count();
    to.force_by_q = by.contact_forces[i][0] + unit * solution.block(row, 0, count, n);
    to.force_by_v = by.contact_forces[i][1] + unit * solution.block(row, n, count, n);
    to.force_by_tau = unit * system.all.block(row, 0, count, n);
  }
}
KTE_FUNCTION contact_dynamics_derivatives_result contact_dynamics_derived(const runtime_chain& c, runtime_state& s,
                                                                          const Eigen::VectorXd& tau) {
  contact_dynamics_derivatives_result r;
  for (int i = 0; i < s.dofs(); ++i) s.work.kept[static_cast<std::size_t>(i)] = tau[i];
  auto& m = contact_memory(c, s);
  const struct polishing {
    bool& on;
    explicit polishing(bool& x) : on(x) { on = true; }
    polishing(const polishing&) = delete;
    polishing& operator=(const polishing&) = delete;
    ~polishing() { on = false; }
  } exactly(m.polish);
  const auto& found = contact_dynamics_under_kept(c, s);
  r.a = found.a, r.names = found.names;
  derive_in_modes(c, s, m, false, r);
  return r;
}

}  // namespace kte::detail
#endif
