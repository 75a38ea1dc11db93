// Headers of this folder that were included before kte/runtime_chain/runtime_chain.hpp get their parts for runtime
// chains here; that header includes this one at its end (docs/decisions/13-folders.md). Headers that are included later
// have these parts immediately. Programs with static chains alone therefore compile nothing for runtime chains, and the
// order of includes does not matter.
#ifdef KTE_STATE_VECTORS_HPP
#  include <kte/dynamics/state_vectors.hpp>
#endif
#ifdef KTE_CONFIGURATION_SPACE_HPP
#  include <kte/dynamics/configuration_space.hpp>
#endif
#ifdef KTE_INVERSE_DYNAMICS_HPP
#  include <kte/dynamics/inverse_dynamics.hpp>
#endif
#ifdef KTE_MASS_MATRIX_HPP
#  include <kte/dynamics/mass_matrix.hpp>
#endif
#ifdef KTE_FORWARD_DYNAMICS_HPP
#  include <kte/dynamics/forward_dynamics.hpp>
#endif
#ifdef KTE_FORWARD_KINEMATICS_HPP
#  include <kte/dynamics/forward_kinematics.hpp>
#endif
#ifdef KTE_FRAME_MOTION_HPP
#  include <kte/dynamics/frame_motion.hpp>
#endif
#ifdef KTE_JACOBIAN_HPP
#  include <kte/dynamics/jacobian.hpp>
#endif
#ifdef KTE_BIAS_FORCES_HPP
#  include <kte/dynamics/bias_forces.hpp>
#endif
#ifdef KTE_ENERGY_HPP
#  include <kte/dynamics/energy.hpp>
#endif
#ifdef KTE_CENTRE_OF_MASS_HPP
#  include <kte/dynamics/centre_of_mass.hpp>
#endif
#ifdef KTE_CENTROIDAL_HPP
#  include <kte/dynamics/centroidal.hpp>
#endif
#ifdef KTE_MASS_MATRIX_INVERSE_HPP
#  include <kte/dynamics/mass_matrix_inverse.hpp>
#endif
#ifdef KTE_DERIVATIVES_HPP
#  include <kte/dynamics/derivatives.hpp>
#endif
#ifdef KTE_HYBRID_DYNAMICS_HPP
#  include <kte/dynamics/hybrid_dynamics.hpp>
#endif
#ifdef KTE_REGRESSOR_HPP
#  include <kte/dynamics/regressor.hpp>
#endif
#ifdef KTE_BATCH_HPP
#  include <kte/dynamics/batch.hpp>
#endif
