#pragma once

#include <kte/dynamics/closed_loops/constrained_dynamics.hpp>

#ifdef KTE_FUNCTION
#  include <kte/dynamics/closed_loops/loop_variations.hpp>
#  include <kte/dynamics/runtime/derivatives.hpp>
#endif

namespace kte {

/// The result of `constrained_dynamics_derivatives`, for n degrees of freedom and m rows of closures.
struct constrained_dynamics_derivatives_result {
  Eigen::VectorXd a;                                        ///< accelerations, n
  Eigen::VectorXd lambda;                                   ///< closure forces by the rows of `loop_jacobian`, m: N, Nm
  Eigen::MatrixXd by_q, by_v, by_tau;                       ///< derivatives of a, n x n
  Eigen::MatrixXd lambda_by_q, lambda_by_v, lambda_by_tau;  ///< derivatives of lambda, m x n
  int rank = 0, mobility = 0;                               ///< the number of independent rows, and n - rank
};

namespace detail {
struct loop_variations;
/// Writes the derivatives for loops to `kept`.
constrained_dynamics_derivatives_result constrained_dynamics_derived(const runtime_chain& c, runtime_state& s,
                                                                     const Eigen::VectorXd& tau,
                                                                     loop_variations* kept = nullptr);
}  // namespace detail

/// The accelerations of a chain with loops and the forces of its closures, with their derivatives by q (along the
/// numbers of v), by v and by tau: implicit differentiation of the equations of motion,
///
///   ID(q, v, a) - J^T lambda = tau,   J a + J_dot v = 0                                        (1)
///   M da - J^T dlambda = dtau - d(ID - J^T lambda),   J da = -d(J a + J_dot v)                 (2)
///
/// with a, lambda constant in the derivatives d(...) on the right, and the factor of `constrained_dynamics`.
///
///   const auto r = kte::constrained_dynamics_derivatives(c, s, q, v, tau);    r.by_q, r.lambda_by_q
///
/// All coordinates are independent in these derivatives, which include directions that open the loops, where the
/// closures keep J a + J_dot v at zero. For motions on the loops combine them: with v = G v_y (`loop_motion`), by_q *
/// G. With redundant rows, (1) and (2) contain the independent rows that `constrained_dynamics` selects, and the others
/// have no force. On the loops a, its derivatives along motions on the loops, and J^T lambda do not depend on this
/// choice; lambda and derivatives in directions that open the loops do. Arguments and errors as for
/// `constrained_dynamics`.
template <indexable Q, indexable V, indexable T>
constrained_dynamics_derivatives_result constrained_dynamics_derivatives(const runtime_chain& c, runtime_state& s,
                                                                         const Q& q, const V& v, const T& tau) {
  detail::check_regular_tree(c, s), detail::refuse_contacts(c);
  return detail::take(c, s, q, v, detail::found_later{}, tau).call([&] {
    return detail::constrained_dynamics_derived(c, s, detail::as_vector(tau, s.dofs()));
  });
}

}  // namespace kte

#ifdef KTE_FUNCTION
namespace kte::detail {

/// The equations (2) of a chain with loops at a state after `constrained_dynamics`.
class loop_sensitivity {
 public:
  loop_sensitivity(const runtime_chain& c, runtime_state& s) : state_(s), loops_(loops_of(c, s)) {
    const loop_factor chosen = loops_.factor;
    loops_.equations.at_positions(closures_of(c), s, true);
    loops_.factor.factorize(closures_of(c), s, loops_.equations);
    (void)loops_.factor.keep(closures_of(c), s, loops_.equations, chosen, 0);
    if (s.tree().plan.tree)
      articulate_and_invert(runtime_elements{c}, s, inverse_);
    else
      invert_free_rows(runtime_elements{c}, s, inverse_);
  }
  /// Solves for da and dlambda, rows in m and rad, for columns of forces and of J a + J_dot v.
  void solve(const Eigen::MatrixXd& forces, const Eigen::MatrixXd& accelerations, Eigen::MatrixXd& a,
             Eigen::MatrixXd& lambda) {
    const auto& e = loops_.equations;
    a.noalias() = inverse_ * forces;
    lambda.resize(accelerations.rows(), forces.cols());
    for (Eigen::Index k = 0; k < forces.cols(); ++k) {
      const Eigen::VectorXd off = accelerations.col(k) + e.times(a.col(k));
      loops_.factor.least_change(state_, e, off, loops_.change, loops_.multipliers);
      a.col(k) -= loops_.change, lambda.col(k) = -loops_.multipliers;
    }
    for (const auto& x : e.places.closures)
      for (int r = 0; r < x.rows.count(); ++r) lambda.row(x.first + r) *= e.places.scale(x, r);
  }

 private:
  runtime_state& state_;
  loop_memory_of_state& loops_;
  Eigen::MatrixXd inverse_;  ///< of M
};
/// The forces of all closures in a state.
inline Eigen::VectorXd loop_forces(const closure_places& at, const runtime_state& s) {
  Eigen::VectorXd all(at.rows);
  for (const auto& x : at.closures) {
    const auto& loop = s.get<kind::loop>(x.loop);
    for (int r = 0; r < x.rows.count(); ++r) all[x.first + r] = row_of(loop.force, loop.torque, x.rows, r);
  }
  return all;
}
KTE_FUNCTION constrained_dynamics_derivatives_result constrained_dynamics_derived(const runtime_chain& c,
                                                                                  runtime_state& s,
                                                                                  const Eigen::VectorXd& tau,
                                                                                  loop_variations* kept) {
  constrained_dynamics_derivatives_result r;
  const Eigen::Index n = s.dofs();
  for (int i = 0; i < s.dofs(); ++i) s.work.kept[static_cast<std::size_t>(i)] = tau[i];
  r.a = has_loops(c) ? accelerations_on_loops(c, s, false) : accelerations_at_state(c, s);
  r.mobility = s.dofs();
  if (!has_loops(c)) {
    const auto& tree = accelerations_derived(c, s);
    r.by_q = tree.by_q, r.by_v = tree.by_v, r.by_tau = tree.by_tau;
    for (auto* m : {&r.lambda_by_q, &r.lambda_by_v, &r.lambda_by_tau}) m->resize(0, n);
    return r;
  }
  const auto& loops = loops_of(c, s);
  const auto& e = loops.equations;
  r.rank = loops.factor.rank(), r.mobility = s.dofs() - r.rank;
  r.lambda = loop_forces(e.places, s);
  loop_variations by = vary_loops(c, s, e);
  loop_sensitivity equations(c, s);
  equations.solve(-by.forces.by_q, by.accelerations_by_q, r.by_q, r.lambda_by_q);
  equations.solve(-by.forces.by_v, by.accelerations_by_v, r.by_v, r.lambda_by_v);
  equations.solve(Eigen::MatrixXd::Identity(n, n), Eigen::MatrixXd::Zero(e.places.rows, n), r.by_tau, r.lambda_by_tau);
  if (kept != nullptr) *kept = std::move(by);
  return r;
}

}  // namespace kte::detail
#endif
