#pragma once

/// Integrators of SUNDIALS 6 for right-hand sides of kte. Link those of sundials_cvode, sundials_arkode and
/// sundials_ida that you use.
#include <kte/adapters/sundials/arkode.hpp>
#include <kte/adapters/sundials/cvode.hpp>
#include <kte/adapters/sundials/ida.hpp>
