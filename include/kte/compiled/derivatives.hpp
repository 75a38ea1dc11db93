#pragma once

/// Derivatives of dynamics.
#include <kte/dynamics/derivatives.hpp>
#include <kte/models/detail/runtime_rate_derivatives.hpp>
