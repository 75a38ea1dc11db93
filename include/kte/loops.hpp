#pragma once

#include <kte/detail/macros_aside.hpp>

/// Closed kinematic loops (docs/loops.md): elements that close them, assembly, accelerations with the forces of
/// closures, velocities on the loops, the equations of motion in actuated coordinates, derivatives.
#include <kte/dynamics/closed_loops/actuated_derivatives.hpp>
#include <kte/dynamics/closed_loops/actuated_dynamics.hpp>
#include <kte/dynamics/closed_loops/actuated_forces.hpp>
#include <kte/dynamics/closed_loops/assemble.hpp>
#include <kte/dynamics/closed_loops/assemblies.hpp>
#include <kte/dynamics/closed_loops/closure_derivatives.hpp>
#include <kte/dynamics/closed_loops/constrained_dynamics.hpp>
#include <kte/dynamics/closed_loops/derivatives.hpp>
#include <kte/dynamics/closed_loops/hybrid.hpp>
#include <kte/dynamics/closed_loops/static_chains.hpp>
#include <kte/dynamics/closed_loops/static_derivatives.hpp>
#include <kte/dynamics/closed_loops/static_hybrid.hpp>
#include <kte/elements/closures.hpp>
#include <kte/models/detail/static_model_at_run_time.hpp>

#include <kte/detail/macros_back.hpp>
