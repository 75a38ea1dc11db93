#pragma once

/// Part of kte/compiled.hpp: runtime chains, their states, and algorithms of dynamics with derivatives.
#include <kte/dynamics/bias_forces.hpp>
#include <kte/dynamics/centroidal.hpp>
#include <kte/dynamics/configuration_space.hpp>
#include <kte/dynamics/derivatives.hpp>
#include <kte/dynamics/energy.hpp>
#include <kte/dynamics/forward_dynamics.hpp>
#include <kte/dynamics/frame_motion.hpp>
#include <kte/dynamics/hybrid_dynamics.hpp>
#include <kte/dynamics/inverse_dynamics.hpp>
#include <kte/dynamics/jacobian.hpp>
#include <kte/dynamics/mass_matrix.hpp>
#include <kte/dynamics/mass_matrix_inverse.hpp>
#include <kte/dynamics/regressor.hpp>
#include <kte/models/detail/runtime_rate_derivatives.hpp>
#include <kte/runtime_chain.hpp>
