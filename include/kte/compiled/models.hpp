#pragma once

/// Runtime chains as systems x' = f(t, x).
#include <kte/models/runtime_dynamics_model.hpp>
#include <kte/models/runtime_models.hpp>
