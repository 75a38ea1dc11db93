#pragma once

/// Part of kte/compiled.hpp: linear models, discretization, feedback.
#include <kte/compiled/loops.hpp>
#include <kte/control/discretize.hpp>
#include <kte/control/linearize_loops.hpp>
#include <kte/control/lqr.hpp>
