#pragma once

/// Integrators of SUNDIALS 6 for right-hand sides of kte. Needs SUNDIALS: link sundials_cvode, sundials_arkode and
/// sundials_ida, as far as you use them.
#include <kte/adapters/sundials/arkode.hpp>
#include <kte/adapters/sundials/cvode.hpp>
#include <kte/adapters/sundials/ida.hpp>
