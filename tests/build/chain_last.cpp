// The chain after the algorithms: any order of includes gives both kinds.
// clang-format off
#include <kte/dynamics/batch.hpp>
#include <kte/dynamics/bias_forces.hpp>
#include <kte/dynamics/centre_of_mass.hpp>
#include <kte/dynamics/centroidal.hpp>
#include <kte/dynamics/configuration_space.hpp>
#include <kte/dynamics/derivatives.hpp>
#include <kte/dynamics/energy.hpp>
#include <kte/dynamics/forward_dynamics.hpp>
#include <kte/dynamics/forward_kinematics.hpp>
#include <kte/dynamics/frame_motion.hpp>
#include <kte/dynamics/hybrid_dynamics.hpp>
#include <kte/dynamics/inverse_dynamics.hpp>
#include <kte/dynamics/jacobian.hpp>
#include <kte/dynamics/mass_matrix.hpp>
#include <kte/dynamics/mass_matrix_inverse.hpp>
#include <kte/dynamics/regressor.hpp>
#include <kte/dynamics/state_vectors.hpp>
#include <kte/runtime_chain.hpp>
// clang-format on

#include "all_algorithms.hpp"

double with_the_chain_last(const kte::runtime_chain& c, kte::runtime_state& s, const Eigen::VectorXd& x);
double with_the_chain_last(const kte::runtime_chain& c, kte::runtime_state& s, const Eigen::VectorXd& x) {
  return all_algorithms(c, s, x, x, x);
}
