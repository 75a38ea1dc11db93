#pragma once

#include <kte/dynamics/external_wrenches.hpp>
#include <kte/dynamics/statics/tangent_stability.hpp>
#include <kte/runtime_chain.hpp>

#ifdef KTE_FUNCTION
#  include <kte/dynamics/statics/newton.hpp>
#endif

#include <vector>

namespace kte {

/// Options of `static_equilibrium`.
struct equilibrium_options {
  std::vector<external_wrench>
      loads{};               ///< wrenches in addition to those of the chain, in axes of their frames (follower loads)
  double tolerance = 1e-10;  ///< of the last step: rad, and lengths relative to the size of the chain
  int iterations = 1000;     ///< total limit for Newton's method
  bool must_reach = true;    ///< throw `no_solution` instead of returning a status
};

/// The stability of an equilibrium, or that none was found.
enum class equilibrium_status {
  stable,       ///< a minimum of energy: all eigenvalues of the symmetric tangent are positive
  unstable,     ///< some eigenvalue is not positive
  not_reached,  ///< the result is the equilibrium under `load` times the loads
};

/// The result of `static_equilibrium`: the configuration q and its `status`.
struct equilibrium {
  Eigen::VectorXd q;
  equilibrium_status status = equilibrium_status::not_reached;
  double load = 0;              ///< the load factor at q; 1 under all loads
  double residual = 0;          ///< largest residual force, N or Nm
  tangent_stability stability;  ///< stability of the tangent at q
  int load_steps = 0;           ///< number of increments of the loads
  int iterations = 0;           ///< of Newton's method, in total
};

#ifdef KTE_FUNCTION
namespace detail {
/// Applies the loads in increments as large as Newton's method can take from one equilibrium to the next. The first
/// attempt applies all of them.
inline void put_loads_on(static_newton& newton, equilibrium& at) {
  for (double part = 1; at.load < 1 && newton.left() > 0 && part > 1e-5;) {
    const double before = at.load, wanted = (std::min)(1.0, before + part);
    const int iterations = newton.iterations();
    double load = wanted;
    if (!newton.solve(at.q, load, true)) {
      part /= newton.iterations() - iterations > 2 ? 2 : 4;
      continue;
    }
    at.load = wanted, ++at.load_steps;
    if (newton.iterations() - iterations <= 8) part *= 2;
  }
}
[[noreturn, gnu::cold]] inline void raise_no_equilibrium(static_problem& f, const equilibrium& at) {
  const double loads = at.load > 0 ? at.load : 1;  // without loads nothing needs to be held
  if (const auto name = coordinate_not_held(f, at.q, loads); !name.empty())
    raise<no_solution>("kte: static_equilibrium: nothing holds '" + name + "' at load factor " + number(loads) +
                       ": the derivatives of the forces by the configuration are singular");
  raise<no_solution>("kte: static_equilibrium: no equilibrium was found under all loads, but at load factor " +
                     number(at.load) + ", after " + std::to_string(at.iterations) +
                     " iterations: a limit point, beyond which equilibrium_path follows, or too few iterations");
}
}  // namespace detail

/// The implementation of `static_equilibrium`.
KTE_FUNCTION equilibrium find_static_equilibrium(const runtime_chain& c, runtime_state& s, const Eigen::VectorXd& q0,
                                                 const equilibrium_options& options) {
  using namespace detail;
  if (!(options.tolerance > 0 && options.tolerance < 1) || options.iterations < 1)
    raise<bad_argument>("kte: options of static_equilibrium: tolerance must be between 0 and 1, iterations at least 1");
  static_problem f(c, s, options.loads, "");
  equilibrium x;
  x.q = q0;
  const Eigen::VectorXd unbalanced = f.forces(q0, 0);
  static_newton newton(f, weights_of_steps(f, q0, 0), options.tolerance, options.iterations);
  f.hold(unbalanced);
  put_loads_on(newton, x);
  if (x.load == 0 && newton.left() > 0) {  // a chain that only its loads hold has no starting equilibrium
    double load = 1;
    if (newton.solve(x.q, load, false)) x.load = 1, x.load_steps = 1;
  }
  x.iterations = newton.iterations();
  x.residual = f.forces(x.q, x.load).cwiseAbs().maxCoeff();
  if (x.load < 1 && options.must_reach) raise_no_equilibrium(f, x);
  x.stability = stability_of(f.tangent(x.q, x.load));
  if (x.load == 1) x.status = x.stability.stable() ? equilibrium_status::stable : equilibrium_status::unstable;
  set_positions(s, x.q);
  return x;
}
#else
equilibrium find_static_equilibrium(const runtime_chain&, runtime_state&, const Eigen::VectorXd&,
                                    const equilibrium_options&);
#endif

namespace detail {
template <indexable Q>
Eigen::VectorXd start_of_statics(const runtime_chain& c, const runtime_state& s, const Q& q0) {
  check_regular(c, s);
  if (s.dofs() == 0) raise<bad_argument>("kte: equilibria need a chain with degrees of freedom");
  check_positions(s, q0);
  Eigen::VectorXd q(s.nq());
  for (Eigen::Index i = 0; i < q.size(); ++i) q[i] = static_cast<double>(q0[static_cast<std::size_t>(i)]);
  return q;
}
}  // namespace detail

/// A static equilibrium: q with static_forces(q) = 0 under the inputs of the state and the wrenches of `options`.
/// Newton's method from q0, with rotations updated by `integrate`. Afterwards the state is at q.
///
/// Loads are applied in increments, as large as Newton's method converges, so that the solution is the state that
/// continuous loading reaches from q0. With the load factor x from 0 to 1 these loads are multiplied by x:
///
///   gravity, as accelerations of bases;  `constant_force`, `follower_force`;  `driving_actuator`, `external_force` by
///   inputs;  wrenches of `options`
///
/// Springs, motors and other elements act in full. If they are not in balance at q0 without loads, holding forces are
/// applied, which decrease as 1 - x. A chain that only its loads hold, such as a pendulum, has no equilibrium without
/// them; damped steps under all loads then find an equilibrium nearby.
///
///   const auto r = kte::static_equilibrium(beam, s, q0);
///   r.q, r.status == kte::equilibrium_status::stable
///
/// Derivatives are computed by dual numbers, with the sparsity of the wiring: the time for a row of beams is
/// proportional to its length. Throws `bad_argument` for arguments that are not finite, `no_solution` naming a
/// coordinate that nothing holds, or the load factor reached; the state is then unchanged. With `must_reach` false a
/// status is returned instead.
template <indexable Q>
equilibrium static_equilibrium(const runtime_chain& c, runtime_state& s, const Q& q0,
                               const equilibrium_options& options = {}) {
  return find_static_equilibrium(c, s, detail::start_of_statics(c, s, q0), options);
}

}  // namespace kte
