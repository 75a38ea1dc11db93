#pragma once

#include <kte/detail/macros_aside.hpp>

/// All algorithms on static and runtime chains: those of kte.hpp, derivatives of inverse and forward dynamics, the
/// inverse of the mass matrix, hybrid dynamics, generalized momenta, the regressor of inertial parameters, time
/// derivatives of Jacobians, relative motion, the Coriolis matrix, joint reactions, rates of momenta, inertias of
/// subtrees, ancestors, external wrenches, random and interpolated configurations, chains with locked joints. Many
/// states at once: kte/dynamics/batch.hpp.
#include <kte/contract/checks.hpp>
#include <kte/dynamics/configurations.hpp>
#include <kte/dynamics/coriolis_matrix.hpp>
#include <kte/dynamics/derivatives.hpp>
#include <kte/dynamics/external_wrenches.hpp>
#include <kte/dynamics/hybrid_dynamics.hpp>
#include <kte/dynamics/joint_reactions.hpp>
#include <kte/dynamics/mass_matrix_inverse.hpp>
#include <kte/dynamics/momentum.hpp>
#include <kte/dynamics/momentum_rate.hpp>
#include <kte/dynamics/reduced.hpp>
#include <kte/dynamics/regressor.hpp>
#include <kte/dynamics/relative_motion.hpp>
#include <kte/dynamics/subtree_inertia.hpp>
#include <kte/dynamics/support.hpp>
#include <kte/kte.hpp>
#include <kte/reak/mass_matrix_calc.hpp>

#include <kte/detail/macros_back.hpp>
