#pragma once

/// Sweeps: a function on many cases, in packs, threads and processes (docs/sweeps.md). kte/sweep/mpi.hpp adds clusters.
#include <kte/math/pack.hpp>
#include <kte/sweep/sweep.hpp>
