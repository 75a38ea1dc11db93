#pragma once

/// Part of kte/compiled.hpp: dynamics of chains with loops, and of chains in the lanes of packs.
#include <kte/compiled/chains.hpp>
#include <kte/dynamics/closed_loops/actuated_derivatives.hpp>
#include <kte/dynamics/closed_loops/actuated_dynamics.hpp>
#include <kte/dynamics/closed_loops/actuated_forces.hpp>
#include <kte/dynamics/closed_loops/assemblies.hpp>
#include <kte/dynamics/closed_loops/closure_derivatives.hpp>
#include <kte/dynamics/closed_loops/constrained_dynamics.hpp>
#include <kte/dynamics/closed_loops/derivatives.hpp>
#include <kte/dynamics/closed_loops/given_motion.hpp>
#include <kte/dynamics/closed_loops/hybrid.hpp>
#include <kte/dynamics/closed_loops/static_chains.hpp>
#include <kte/dynamics/lanes.hpp>
#include <kte/elements/closures.hpp>
#include <kte/kernels/eigen_decomposition.hpp>
#include <kte/kernels/orthogonal_decomposition.hpp>
