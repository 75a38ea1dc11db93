#pragma once

#include <kte/runtime_chain/runtime_chain.hpp>

#include <cstddef>
#include <vector>

#include "signal_watch.hpp"

/// Many states in packs (kte/dynamics/batch.hpp), of arrays with the numbers of states side by side.
namespace kte_python {

/// Whether the states of a chain can be computed in packs.
bool can_be_in_packs(const kte::runtime_chain& c);

void inverse_dynamics_in_packs(const kte::runtime_chain& c, std::size_t states, const std::vector<const double*>& in,
                               double* tau, const interruptible_threads& team);
void forward_dynamics_in_packs(const kte::runtime_chain& c, std::size_t states, const std::vector<const double*>& in,
                               double* a, const interruptible_threads& team);
void mass_matrix_in_packs(const kte::runtime_chain& c, std::size_t states, const std::vector<const double*>& in,
                          double* m, const interruptible_threads& team);

}  // namespace kte_python
