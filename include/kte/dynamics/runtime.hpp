#pragma once

/// Deprecated. Include the headers of the algorithms, which serve both kinds of chains, and
/// kte/runtime_chain.hpp.
#include <kte/dynamics/configuration_space.hpp>
#include <kte/dynamics/forward_dynamics.hpp>
#include <kte/dynamics/forward_kinematics.hpp>
#include <kte/dynamics/inverse_dynamics.hpp>
#include <kte/dynamics/mass_matrix.hpp>
#include <kte/runtime_chain.hpp>
