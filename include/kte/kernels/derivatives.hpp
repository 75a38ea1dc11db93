#pragma once

#include <kte/kernels/joint_vector.hpp>

namespace kte {

/// Forces and their derivatives: by_q(i, j) is the change of tau_i where the configuration moves along v_j (for a
/// number the partial derivative; for rotations and poses along the axes of the moving frame), by_v and by_a by
/// velocity and acceleration j; by_a is the mass matrix, less the friction by what joints carry, derived.
template <class S, int N>
struct inverse_dynamics_result {
  joint_vector<S, N> tau;
  joint_matrix<S, N> by_q, by_v, by_a;
};
/// Accelerations and their derivatives, likewise; by_tau is the inverse of by_a.
template <class S, int N>
struct forward_dynamics_result {
  joint_vector<S, N> a;
  joint_matrix<S, N> by_q, by_v, by_tau;
};

}  // namespace kte
