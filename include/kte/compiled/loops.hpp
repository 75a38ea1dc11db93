#pragma once

/// Part of kte/compiled.hpp: chains with loops, and chains in the lanes of packs.
#include <kte/compiled/chains.hpp>
#include <kte/dynamics/lanes.hpp>
#include <kte/kernels/eigen_decomposition.hpp>
#include <kte/kernels/orthogonal_decomposition.hpp>
#include <kte/loops.hpp>
