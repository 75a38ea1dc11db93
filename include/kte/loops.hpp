#pragma once

/// Closed kinematic loops of runtime chains (docs/loops.md): elements that close them, assembly, accelerations with the
/// forces of closures, velocities on the loops, inverse dynamics by actuated coordinates.
#include <kte/dynamics/closed_loops/actuated_forces.hpp>
#include <kte/dynamics/closed_loops/assemble.hpp>
#include <kte/dynamics/closed_loops/assemblies.hpp>
#include <kte/dynamics/closed_loops/constrained_dynamics.hpp>
#include <kte/elements/closures.hpp>
