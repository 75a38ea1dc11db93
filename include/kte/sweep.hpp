#pragma once

#include <kte/detail/macros_aside.hpp>

/// Sweeps: a function on many cases, in packs, threads and processes (docs/sweeps.md). Packs are in kte/math/pack.hpp,
/// ready-made simulations in kte/sweep/final_state.hpp, clusters in kte/sweep/mpi.hpp.
#include <kte/sweep/sweep.hpp>

#include <kte/detail/macros_back.hpp>
