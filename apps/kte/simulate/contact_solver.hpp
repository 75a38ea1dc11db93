#pragma once

#include "simulate/solvers.hpp"

namespace kte_tool {

/// Time stepping with contacts, by steps of this length, s.
std::unique_ptr<plant_solver> contact_method(plant& p, const plant::state& x, double step);

}  // namespace kte_tool
