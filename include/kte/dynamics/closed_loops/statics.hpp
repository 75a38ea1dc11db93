#pragma once

#include <kte/dynamics/closed_loops/actuated_derivatives.hpp>
#include <kte/dynamics/natural_modes.hpp>
#include <kte/dynamics/runtime/at_run_time.hpp>
#include <kte/dynamics/static_equilibrium.hpp>

/// Equilibria of mechanisms with loops, and small motions about them, in their actuated coordinates.
namespace kte {

namespace detail {
natural_modes_result modes_of_loops(const runtime_chain& c, runtime_state& s, const std::vector<std::string>& names);
equilibrium equilibrium_of_loops(const runtime_chain& c, runtime_state& s, const std::vector<std::string>& names);
}  // namespace detail

/// Natural modes of a mechanism with loops about an equilibrium q on the loops, in its actuated coordinates y. With G
/// of `loop_motion` and y'' = a(y, y'),
///
///   M = G^T M_tree G,   K = -M da/dy,   C = -M da/dy'          (1)
///
/// `shape` has rows for y; G times `shape` has rows for all coordinates. Throws as `actuated_dynamics_derivatives`, and
/// `bad_argument` if q is not an equilibrium.
template <indexable Q>
natural_modes_result natural_modes(const runtime_chain& c, runtime_state& s, const Q& q,
                                   const actuated_coordinates& by) {
  detail::check_regular_tree(c, s), detail::refuse_contacts(c);
  const Eigen::VectorXd none = Eigen::VectorXd::Zero(s.dofs());
  return detail::take(c, s, q, none, detail::found_later{}).call([&] {
    return detail::modes_of_loops(c, s, by.names);
  });
}

/// A static equilibrium of a mechanism with loops under the inputs of the state, starting from q0, in its actuated
/// coordinates y. Newton steps are damped, at most a tenth of a turn or of the length of the chain, with M and K of
/// (1):
///
///   (K + mu M) d = M a,   mu >= 0 so that K + mu M is positive definite          (2)
///
/// They lead to a stable equilibrium, unless q0 is an unstable one. The loops are assembled after each step. All loads
/// act in full (`load` is 1). The state is then at q. Throws as `actuated_dynamics_derivatives`, `cannot_assemble`, and
/// `no_solution` if 1000 steps do not reach an equilibrium; the state is then unchanged.
template <indexable Q>
equilibrium static_equilibrium(const runtime_chain& c, runtime_state& s, const Q& q0, const actuated_coordinates& by) {
  detail::check_regular_tree(c, s), detail::refuse_contacts(c);
  const Eigen::VectorXd none = Eigen::VectorXd::Zero(s.dofs());
  return detail::take(c, s, q0, none, detail::found_later{}).call([&] {
    return detail::equilibrium_of_loops(c, s, by.names);
  });
}

// ---- static chains
template <class Gravity, class... E, indexable Q>
[[nodiscard]] natural_modes_result natural_modes(const static_chain<Gravity, E...>& c, const Q& q,
                                                 const actuated_coordinates& by) {
  return detail::at_run_time(c, q, [&](auto&... at) { return natural_modes(at..., by); });
}
template <class Gravity, class... E, indexable Q>
[[nodiscard]] equilibrium static_equilibrium(const static_chain<Gravity, E...>& c, const Q& q0,
                                             const actuated_coordinates& by) {
  return detail::at_run_time(c, q0, [&](auto&... at) { return static_equilibrium(at..., by); });
}

}  // namespace kte

#ifdef KTE_FUNCTION
#  include <Eigen/Cholesky>
#  include <Eigen/Eigenvalues>

namespace kte::detail {

/// (1) at a state at rest.
struct loops_at_rest {
  Eigen::MatrixXd mass, stiffness, damping;
  Eigen::VectorXd force;  ///< M a

  loops_at_rest(const runtime_chain& c, runtime_state& s, const std::vector<std::string>& names) {
    const auto by = actuated_dynamics_derived(c, s, Eigen::VectorXd::Zero(s.dofs()), names);
    const Eigen::MatrixXd g = actuated_motion(c, s, names);
    mass_of_coordinates(runtime_elements{c}, s);
    mass = g.transpose() * s.work.mass * g;
    stiffness = -mass * by.by_q, damping = -mass * by.by_v, force = mass * by.a;
  }
};
KTE_FUNCTION natural_modes_result modes_of_loops(const runtime_chain& c, runtime_state& s,
                                                 const std::vector<std::string>& names) {
  const loops_at_rest at(c, s, names);
  for (Eigen::Index i = 0; i < at.force.size(); ++i)
    if (!(std::abs(at.force[i]) <= 1e-6 * at.stiffness.row(i).cwiseAbs().sum()))
      raise<bad_argument>("kte: natural_modes: the mechanism is not in equilibrium, actuated coordinate " +
                          std::to_string(i + 1) + " is held by " + number(-at.force[i]) + "; see static_equilibrium");
  return natural_modes_of(at.mass, at.stiffness, at.damping);
}
KTE_FUNCTION equilibrium equilibrium_of_loops(const runtime_chain& c, runtime_state& s,
                                              const std::vector<std::string>& names) {
  constexpr int most_steps = 1000;
  const std::vector<int> rows = rows_of_coordinates(c, s, names);
  equilibrium x;
  x.q = assembled(c, s, read_numbers<vector_of::q>(s), names);
  for (; x.iterations < most_steps; ++x.iterations) {
    const loops_at_rest at(c, s, names);
    const Eigen::MatrixXd symmetric = 0.5 * (at.stiffness + at.stiffness.transpose());
    const double lowest =
        at.mass.rows() > 0
            ? Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd>(symmetric, at.mass).eigenvalues()[0]
            : 1.0;
    x.residual = at.force.size() > 0 ? at.force.cwiseAbs().maxCoeff() : 0;
    x.stability = stability_of(sparse_matrix(at.stiffness.sparseView()));
    x.status = x.stability.stable() ? equilibrium_status::stable : equilibrium_status::unstable;
    const double size = at.stiffness.size() > 0 ? at.stiffness.cwiseAbs().maxCoeff() : 0;
    const double damping = lowest > 0 ? 0 : (std::max)(-1.5 * lowest, 1e-3 * (1 + std::abs(lowest)));
    Eigen::VectorXd d = (at.stiffness + damping * at.mass).partialPivLu().solve(at.force);
    const double largest = d.size() > 0 ? d.cwiseAbs().maxCoeff() : 0;
    if (largest <= 1e-10 && x.residual <= 1e-9 * (size + x.residual)) {
      x.load = 1, x.load_steps = 1;
      return x;
    }
    if (!(largest < 1e300)) break;
    constexpr double tenth_of_turn = 0.6283185307179586;
    if (largest > tenth_of_turn) d *= tenth_of_turn / largest;
    x.q = assembled(c, s, integrate(c, x.q, Eigen::VectorXd(actuated_motion(c, s, names) * d), 1.0), names);
  }
  raise<no_solution>("kte: static_equilibrium: no equilibrium of the mechanism was found in " +
                     std::to_string(x.iterations) + " steps");
}

}  // namespace kte::detail
#endif
