#pragma once

#include <kte/dynamics/bias_forces.hpp>
#include <kte/dynamics/centroidal.hpp>
#include <kte/dynamics/coriolis_matrix.hpp>
#include <kte/dynamics/derivatives.hpp>
#include <kte/dynamics/energy.hpp>
#include <kte/dynamics/frame_motion.hpp>
#include <kte/dynamics/jacobian_rate.hpp>
#include <kte/dynamics/mass_matrix_inverse.hpp>
#include <kte/dynamics/momentum_rate.hpp>
#include <kte/dynamics/regressor.hpp>
#include <kte/static.hpp>

#include <new>

#include "timing.hpp"

namespace bench {

/// The algorithms of a static chain on numbers S as calls. Results are made where y points to, without a copy.
template <class Model, class S>
struct static_calls {
  static constexpr auto& chain = Model::chain;
  static constexpr int nq = std::remove_cvref_t<decltype(chain)>::nq, nv = std::remove_cvref_t<decltype(chain)>::dofs;

  /// On a state that stays where it is, as in a simulation.
  [[gnu::noinline]] static void passes(const S* x, S* y) {
    static constinit auto s = kte::make_state<S>(chain);
    kte::set_positions(s, x), kte::set_velocities(s, x + nq), kte::set_accelerations(s, x + nq + nv);
    chain.doMotion(s);
    chain.clearForce(s);
    chain.doForce(s);
    new (y) auto(kte::joint_vector<S, nv>(-kte::forces(s)));
  }
  [[gnu::noinline]] static void forward_kinematics(const S* x, S* y) {
    new (y) auto(kte::forward_kinematics(chain, x, Model::tool));
  }
  [[gnu::noinline]] static void jacobian(const S* x, S* y) {
    new (y) auto(kte::jacobian(chain, x, Model::tool, kte::in_world_axes));
  }
  [[gnu::noinline]] static void inverse_dynamics(const S* x, S* y) {
    new (y) auto(kte::inverse_dynamics(chain, x, x + nq, x + nq + nv));
  }
  [[gnu::noinline]] static void nonlinear_effects(const S* x, S* y) {
    new (y) auto(kte::nonlinear_effects(chain, x, x + nq));
  }
  [[gnu::noinline]] static void mass_matrix(const S* x, S* y) { new (y) auto(kte::mass_matrix(chain, x)); }
  [[gnu::noinline]] static void forward_dynamics(const S* x, S* y) {
    new (y) auto(kte::forward_dynamics(chain, x, x + nq, x + nq + nv));
  }
  [[gnu::noinline]] static void mass_matrix_inverse(const S* x, S* y) {
    new (y) auto(kte::mass_matrix_inverse(chain, x));
  }
  [[gnu::noinline]] static void id_derivatives(const S* x, S* y) {
    if constexpr (side_by_side<kte::inverse_dynamics_result<S, nv>>) {
      new (y) auto(kte::inverse_dynamics_derivatives(chain, x, x + nq, x + nq + nv));
    } else {
      const auto r = kte::inverse_dynamics_derivatives(chain, x, x + nq, x + nq + nv);
      copy(y, r.tau, r.by_q, r.by_v, r.by_a);
    }
  }
  [[gnu::noinline]] static void fd_derivatives(const S* x, S* y) {
    if constexpr (side_by_side<kte::forward_dynamics_result<S, nv>>) {
      new (y) auto(kte::forward_dynamics_derivatives(chain, x, x + nq, x + nq + nv));
    } else {
      const auto r = kte::forward_dynamics_derivatives(chain, x, x + nq, x + nq + nv);
      copy(y, r.a, r.by_q, r.by_v, r.by_tau);
    }
  }
  [[gnu::noinline]] static void regressor(const S* x, S* y) {
    new (y) auto(kte::torque_regressor(chain, x, x + nq, x + nq + nv));
  }
  [[gnu::noinline]] static void frames(const S* x, S* y) {
    new (y) auto(kte::forward_kinematics(chain, x)[Model::tool]);
  }
  [[gnu::noinline]] static void kinetic_energy(const S* x, S* y) { *y = kte::kinetic_energy(chain, x, x + nq); }
  [[gnu::noinline]] static void potential_energy(const S* x, S* y) { *y = kte::potential_energy(chain, x); }
  [[gnu::noinline]] static void gravity_forces(const S* x, S* y) { new (y) auto(kte::gravity_forces(chain, x)); }
  [[gnu::noinline]] static void coriolis_matrix(const S* x, S* y) {
    Eigen::Map<kte::joint_vector<S, nv>>(y).noalias() =
        kte::coriolis_matrix(chain, x, x + nq) * Eigen::Map<const kte::joint_vector<S, nv>>(x + nq);
  }
  [[gnu::noinline]] static void jacobian_rate(const S* x, S* y) {
    new (y) auto(kte::jacobian_rate(chain, x, x + nq, Model::tool, kte::in_world_axes));
  }
  [[gnu::noinline]] static void com_jacobian(const S* x, S* y) { new (y) auto(kte::centre_of_mass_jacobian(chain, x)); }
  [[gnu::noinline]] static void momentum_matrix(const S* x, S* y) {
    new (y) auto(kte::centroidal_momentum_matrix(chain, x));
  }
  [[gnu::noinline]] static void momentum_rate(const S* x, S* y) {
    new (y) auto(kte::centroidal_momentum_rate(chain, x, x + nq, x + nq + nv));
  }

 private:
  /// Whether there are no gaps between a vector and three matrices.
  template <class Result>
  static constexpr bool side_by_side = sizeof(Result) == (nv + 3 * nv * nv) * sizeof(S);
  template <class... M>
  static void copy(S* y, const M&... m) {
    ((y = std::copy_n(m.data(), m.size(), y)), ...);
  }
};

/// Registers the algorithms without derivatives.
template <class Model, class S>
void add_algorithms(const std::string& how) {
  using calls = static_calls<Model, S>;
  const auto add = [&](operation o, call<S> f) { bench::add(o, how, Model::name, f); };
  add(operation::forward_kinematics, calls::forward_kinematics);
  add(operation::jacobian, calls::jacobian);
  add(operation::inverse_dynamics, calls::inverse_dynamics);
  add(operation::nonlinear_effects, calls::nonlinear_effects);
  add(operation::mass_matrix, calls::mass_matrix);
  add(operation::forward_dynamics, calls::forward_dynamics);
}
template <class Model, class S>
void add_derivatives(const std::string& how) {
  using calls = static_calls<Model, S>;
  const auto add = [&](operation o, call<S> f) { bench::add(o, how, Model::name, f); };
  add(operation::mass_matrix_inverse, calls::mass_matrix_inverse);
  add(operation::id_derivatives, calls::id_derivatives);
  add(operation::fd_derivatives, calls::fd_derivatives);
}

}  // namespace bench
