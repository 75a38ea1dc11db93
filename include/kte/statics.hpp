#pragma once

#include <kte/detail/macros_aside.hpp>

/// Static equilibria of chains under loads, their paths as loads grow, and small motions about them.
#include <kte/dynamics/equilibrium_path.hpp>
#include <kte/dynamics/natural_modes.hpp>
#include <kte/dynamics/static_equilibrium.hpp>
#include <kte/kte.hpp>

#include <kte/detail/macros_back.hpp>
