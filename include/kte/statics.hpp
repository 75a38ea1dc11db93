#pragma once

/// Equilibria of chains: where they are at rest under loads, how they go on as loads grow, and small motions about
/// them.
#include <kte/dynamics/equilibrium_path.hpp>
#include <kte/dynamics/natural_modes.hpp>
#include <kte/dynamics/static_equilibrium.hpp>
#include <kte/kte.hpp>
