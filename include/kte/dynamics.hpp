#pragma once

/// All algorithms on static and runtime chains: those of kte.hpp, and derivatives of inverse and forward dynamics, the
/// inverse of the mass matrix, hybrid dynamics, generalized momenta, the regressor of inertial parameters. (Many states
/// at once: kte/dynamics/batch.hpp.)
#include <kte/chain/checks.hpp>
#include <kte/dynamics/derivatives.hpp>
#include <kte/dynamics/hybrid_dynamics.hpp>
#include <kte/dynamics/mass_matrix_inverse.hpp>
#include <kte/dynamics/momentum.hpp>
#include <kte/dynamics/regressor.hpp>
#include <kte/dynamics/runtime_derivatives.hpp>
#include <kte/dynamics/runtime_regressor.hpp>
#include <kte/kte.hpp>
