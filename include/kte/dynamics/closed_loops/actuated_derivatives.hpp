#pragma once

#include <kte/dynamics/closed_loops/actuated_dynamics.hpp>
#include <kte/dynamics/closed_loops/derivatives.hpp>

namespace kte {

/// The result of `actuated_dynamics_derivatives`, for k actuated coordinates.
struct actuated_dynamics_derivatives_result {
  Eigen::VectorXd a;  ///< accelerations y'' of the actuated coordinates, k
  Eigen::MatrixXd by_q, by_v,
      by_tau;  ///< derivatives of y'' by y, y' and the forces on the actuated coordinates, k x k
};

namespace detail {
actuated_dynamics_derivatives_result actuated_dynamics_derived(const runtime_chain& c, runtime_state& s,
                                                               const Eigen::VectorXd& tau,
                                                               const std::vector<std::string>& names);
}  // namespace detail

/// The accelerations of the actuated coordinates of a mechanism with loops under the forces tau on all coordinates, and
/// their derivatives along motions on the loops, where the other coordinates follow:
///
///   dq = G dy,   dv = G dy' + K dy,   J K = -d(J v)/dq G,  K_actuated = 0          (1)
///
/// q and v contain all coordinates and satisfy the loops. Throws as `constrained_dynamics_derivatives` and
/// `loop_motion`.
template <indexable Q, indexable V, indexable T>
actuated_dynamics_derivatives_result actuated_dynamics_derivatives(const runtime_chain& c, runtime_state& s, const Q& q,
                                                                   const V& v, const T& tau,
                                                                   const actuated_coordinates& by) {
  detail::check_regular_tree(c, s), detail::refuse_contacts(c);
  return detail::take(c, s, q, v, detail::found_later{}, tau).call([&] {
    return detail::actuated_dynamics_derived(c, s, detail::as_vector(tau, s.dofs()), by.names);
  });
}

}  // namespace kte

#ifdef KTE_FUNCTION
namespace kte::detail {

KTE_FUNCTION actuated_dynamics_derivatives_result actuated_dynamics_derived(const runtime_chain& c, runtime_state& s,
                                                                            const Eigen::VectorXd& tau,
                                                                            const std::vector<std::string>& names) {
  const Eigen::MatrixXd g = actuated_motion(c, s, names);
  const std::vector<int> rows = rows_of_coordinates(c, s, names);
  Eigen::MatrixXd followed = Eigen::MatrixXd::Zero(g.rows(), g.cols());
  const auto all = constrained_dynamics_derived(c, s, tau);
  if (has_loops(c))
    for (Eigen::Index k = 0; k < g.cols(); ++k)
      followed.col(k) =
          followed_motion(s, loops_of(c, s), g, rows, loop_derivatives_of(c, s).by.velocities_by_q * g.col(k));
  const auto of_actuated = [&rows](const Eigen::MatrixXd& m) {
    Eigen::MatrixXd part(static_cast<Eigen::Index>(rows.size()), m.cols());
    for (Eigen::Index k = 0; k < part.rows(); ++k) part.row(k) = m.row(rows[static_cast<std::size_t>(k)]);
    return part;
  };
  actuated_dynamics_derivatives_result r;
  r.a = of_actuated(all.a);
  r.by_q = of_actuated(all.by_q * g + all.by_v * followed);
  r.by_v = of_actuated(all.by_v * g);
  r.by_tau = of_actuated(of_actuated(all.by_tau).transpose()).transpose();
  return r;
}

}  // namespace kte::detail
#endif
