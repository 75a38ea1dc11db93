#pragma once

#include <kte/kernels/joint_vector.hpp>

namespace kte {

/// Generalized forces tau and their derivatives: by_q(i, j) is the derivative of tau_i along v_j (for numbers the
/// partial derivative; for rotations and poses along axes of the moving frame), by_v and by_a are those by velocity and
/// acceleration j. by_a is the mass matrix, minus the derivatives of load-dependent friction.
template <class S, int N>
struct inverse_dynamics_result {
  joint_vector<S, N> tau;
  joint_matrix<S, N> by_q, by_v, by_a;
};
/// Accelerations a and their derivatives by_q, by_v and by_tau, as in `inverse_dynamics_result`; by_tau is the inverse
/// of by_a.
template <class S, int N>
struct forward_dynamics_result {
  joint_vector<S, N> a;
  joint_matrix<S, N> by_q, by_v, by_tau;
};

}  // namespace kte
