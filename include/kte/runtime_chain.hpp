#pragma once

#include <kte/detail/macros_aside.hpp>
#if !defined(__cpp_exceptions) || !defined(__cpp_rtti)
#  error "kte: runtime chains need exceptions and RTTI; the headers of kte/static.hpp need neither"
#  include <kte needs exceptions and RTTI>  // stops the compiler
#endif

/// Runtime chains, with the runtime parts of all headers of dynamics, whether included before or after this one.
/// Headers that were included before are included again here; later ones have these parts immediately. Programs with
/// static chains alone therefore compile nothing for runtime chains (docs/decisions/13-folders.md).
#include <kte/runtime_chain/chain.hpp>

#define KTE_RUNTIME_CHAINS
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
#ifndef KTE_EXTERN
#  include <kte/dynamics/runtime/general_dynamics.hpp>  // for the elements that bring it
#endif

#include <kte/detail/macros_back.hpp>
