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
constrained_dynamics_derivatives_result constrained_dynamics_derived(const runtime_chain& c, runtime_state& s,
                                                                     const Eigen::VectorXd& tau);
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

/// The inverse of the matrix of the equations (2), by L, Q and R of loop_factor.hpp:
///
///   [da; dlambda] = K [dtau - d(ID - J^T lambda); -d(J a + J_dot v)]
///   K = [M^-1 - X X^T,  X R^-T;  -R^-1 X^T,  R^-1 R^-T],   X = L^-1 Q          (3)
///
/// Rows of lambda are in N and Nm, the last rows of right sides are divided by the length of the chain; rows that are
/// not selected are zero.
class loop_sensitivity {
 public:
  /// `current`: at a state after `constrained_dynamics`, whose factors are still in the memory of the state. Otherwise
  /// they are computed again, with the rows that were selected.
  void compute(const runtime_chain& c, runtime_state& s, bool current) {
    loop_memory_of_state& loops = loops_of(c, s);
    auto& e = loops.equations;
    auto& factor = loops.factor;
    if (!current) {
      const loop_factor chosen = factor;
      e.at_positions(closures_of(c), s, true);
      factor.factorize(closures_of(c), s, e);
      (void)factor.keep(closures_of(c), s, e, chosen, 0);
    }
    const Eigen::Index n = s.dofs(), rows = e.places.rows;
    inverse.setZero(n + rows, n + rows);
    Eigen::Index column = 0;
    x_.resize(n, factor.rank()), roots_.setZero(rows, factor.rank());
    for (std::size_t i = 0; i < factor.parts.size(); ++i) {
      const auto& part = factor.parts[i];
      of_r_.resize(rows);
      for (Eigen::Index k = 0; k < part.rank(); ++k, ++column) {
        factor.other_half_of_q(s, e, i, k, loops.change);
        x_.col(column) = loops.change;
        part.column_of_inverse(k, of_r_.data());
        for (Eigen::Index j = 0; j <= k; ++j)
          roots_(closure_places::row_of(e.places.blocks[i], part.chosen[static_cast<std::size_t>(j)]), column) =
              of_r_[j];
      }
    }
    if (!s.tree().plan.tree)
      invert_free_rows(runtime_elements{c}, s, masses_);
    else if (current)
      invert_articulated(s, masses_);
    else
      articulate_and_invert(runtime_elements{c}, s, masses_);
    masses_.noalias() -= x_ * x_.transpose();
    inverse.topLeftCorner(n, n) = masses_;
    inverse.topRightCorner(n, rows).noalias() = x_ * roots_.transpose();
    inverse.bottomLeftCorner(rows, n) = -inverse.topRightCorner(n, rows).transpose();
    inverse.bottomRightCorner(rows, rows).noalias() = roots_ * roots_.transpose();
    for (const auto& x : e.places.closures)
      for (int r = 0; r < x.rows.count(); ++r) inverse.row(n + x.first + r) *= e.places.scale(x, r);
  }

  Eigen::MatrixXd inverse;  ///< K

 private:
  Eigen::MatrixXd masses_, x_, roots_;  ///< M^-1, X, R^-1 by rows of all closures
  Eigen::VectorXd of_r_;                ///< a column of R^-1
};
/// The memory of `constrained_dynamics_derived`.
struct loop_derivatives_memory {
  closure_path path;
  loop_variations by;
  loop_sensitivity equations;
  Eigen::MatrixXd right, solution;
};
inline loop_derivatives_memory& loop_derivatives_of(const runtime_chain& c, runtime_state& s) {
  return loops_of(c, s).derivatives.get<loop_derivatives_memory>([] { return loop_derivatives_memory(); });
}
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
                                                                                  const Eigen::VectorXd& tau) {
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
  const Eigen::Index rows = e.places.rows;
  r.rank = loops.factor.rank(), r.mobility = s.dofs() - r.rank;
  r.lambda = loop_forces(e.places, s);
  auto& m = loop_derivatives_of(c, s);
  m.equations.compute(c, s, true);
  vary_loops(c, s, e, m.path, m.by);
  m.right.resize(n + rows, 2 * n);
  m.right << m.by.forces_by_q, m.by.forces_by_v, m.by.accelerations_by_q, m.by.accelerations_by_v;
  m.solution.noalias() = m.equations.inverse * m.right;
  r.by_q = -m.solution.topLeftCorner(n, n), r.lambda_by_q = -m.solution.bottomLeftCorner(rows, n);
  r.by_v = -m.solution.topRightCorner(n, n), r.lambda_by_v = -m.solution.bottomRightCorner(rows, n);
  r.by_tau = m.equations.inverse.topLeftCorner(n, n);
  r.lambda_by_tau = m.equations.inverse.bottomLeftCorner(rows, n);
  return r;
}

}  // namespace kte::detail
#endif
