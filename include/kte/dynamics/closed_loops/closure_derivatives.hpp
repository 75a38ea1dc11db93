#pragma once

#include <kte/dynamics/closed_loops/actuated_dynamics.hpp>
#include <kte/dynamics/closed_loops/derivatives.hpp>

namespace kte {

/// The result of `closure_derivatives`, one column per parameter, for n coordinates and m rows of closures.
struct closure_derivatives_result {
  Eigen::MatrixXd q;          ///< n rows, along the numbers of v: derivatives of the configuration
  Eigen::MatrixXd v;          ///< n rows: derivatives of the velocities
  Eigen::MatrixXd a, lambda;  ///< of accelerations and closure forces, n and m rows, on the closed loops
  Eigen::MatrixXd a_in_place,
      lambda_in_place;  ///< of accelerations and closure forces at constant q and v: partial derivatives
};

namespace detail {
closure_derivatives_result closures_derived(const runtime_chain& c, runtime_state& s, const Eigen::VectorXd& tau,
                                            const std::vector<closure_parameter>& parameters,
                                            const std::vector<std::string>& actuated);
}  // namespace detail

/// Derivatives of `constrained_dynamics` by parameters of closures, at tau, with the actuated coordinates and their
/// rates constant: a longer rod moves the mechanism. With the residuals g of the closures,
///
///   J dq = -dg,   J dv = -d(J v),   dq_actuated = dv_actuated = 0          (1)
///
/// and (2) of `constrained_dynamics_derivatives` along (dq, dv).
///
///   closure_derivatives(c, s, q, v, tau, {{"rod", "length"}}, kte::actuated("crank")).a
///
/// Throws as `constrained_dynamics_derivatives` and `loop_motion`; `unknown_name` for a closure or parameter that the
/// chain does not have; `no_solution` for a parameter for which redundant closures contradict each other.
template <indexable Q, indexable V, indexable T>
closure_derivatives_result closure_derivatives(const runtime_chain& c, runtime_state& s, const Q& q, const V& v,
                                               const T& tau, const std::vector<closure_parameter>& parameters,
                                               const actuated_coordinates& by) {
  detail::check_regular_tree(c, s);
  return detail::take(c, s, q, v, detail::found_later{}, tau).call([&] {
    return detail::closures_derived(c, s, detail::as_vector(tau, s.dofs()), parameters, by.names);
  });
}

}  // namespace kte

#ifdef KTE_FUNCTION
#  include <kte/dynamics/closed_loops/closure_variations.hpp>

namespace kte::detail {

KTE_FUNCTION closure_derivatives_result closures_derived(const runtime_chain& c, runtime_state& s,
                                                         const Eigen::VectorXd& tau,
                                                         const std::vector<closure_parameter>& parameters,
                                                         const std::vector<std::string>& actuated) {
  closure_variations variations(c, s, parameters);
  const Eigen::MatrixXd g = actuated_motion(c, s, actuated);
  const std::vector<int> rows = rows_of_coordinates(c, s, actuated);
  const auto all = constrained_dynamics_derived(c, s, tau);
  const Eigen::MatrixXd velocities_by_q = loop_derivatives_of(c, s).by.velocities_by_q;
  auto& loops = loops_of(c, s);
  auto& e = loops.equations;
  const auto own = variations.at_state(c, s);

  closure_derivatives_result r;
  const auto count = static_cast<Eigen::Index>(parameters.size());
  r.q.resize(s.dofs(), count), r.v.resize(s.dofs(), count);
  for (Eigen::Index k = 0; k < count; ++k) {
    r.q.col(k) = followed_motion(s, loops, g, rows, own.residuals.col(k));
    const Eigen::VectorXd open = e.times(r.q.col(k)) + own.residuals.col(k);
    if (open.size() > 0 && !(open.cwiseAbs().maxCoeff() <= 1e-8 * (1 + own.residuals.col(k).cwiseAbs().maxCoeff())))
      throw no_solution("kte: '" + parameters[static_cast<std::size_t>(k)].parameter + "' of '" +
                        parameters[static_cast<std::size_t>(k)].closure +
                        "' cannot change: redundant closures would contradict each other");
    r.v.col(k) = followed_motion(s, loops, g, rows, own.velocities.col(k) + velocities_by_q * r.q.col(k));
  }
  loop_sensitivity equations;
  equations.compute(c, s, false);
  Eigen::MatrixXd right(s.dofs() + e.places.rows, count);
  right << own.forces, -own.accelerations;
  const Eigen::MatrixXd in_place = equations.inverse * right;
  r.a_in_place = in_place.topRows(s.dofs()), r.lambda_in_place = in_place.bottomRows(e.places.rows);
  r.a = r.a_in_place + all.by_q * r.q + all.by_v * r.v;
  r.lambda = r.lambda_in_place + all.lambda_by_q * r.q + all.lambda_by_v * r.v;
  return r;
}

}  // namespace kte::detail
#endif
