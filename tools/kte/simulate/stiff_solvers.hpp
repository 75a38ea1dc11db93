#pragma once

#include <kte/integrators/tolerances.hpp>

#include "simulate/solvers.hpp"

namespace kte_tool {

/// The methods for stiff systems; nothing for the names of others.
std::optional<run_result> run_stiff(plant& p, plant::state& x, const run_settings& s, const run_observer& observe,
                                    const kte::tolerances<double>& exact);

}  // namespace kte_tool
