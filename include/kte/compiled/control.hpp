#pragma once

/// Linear models, discretization, LQR.
#include <kte/control/discretize.hpp>
#include <kte/control/linearize_loops.hpp>
#include <kte/control/lqr.hpp>
