#pragma once

#include <kte/integrators/tolerances.hpp>

#include "simulate/solvers.hpp"

namespace kte_tool {

/// The methods for stiff systems; nothing for the names of others.
std::unique_ptr<plant_solver> make_stiff_solver(plant& p, const plant::state& x, const solver_options& o,
                                                const kte::tolerances<double>& exact);

}  // namespace kte_tool
