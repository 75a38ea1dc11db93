#pragma once

/// Part of kte/compiled.hpp: equilibria, linear models, discretization, feedback.
#include <kte/compiled/models.hpp>
#include <kte/compiled/registry.hpp>
#include <kte/control/discretize.hpp>
#include <kte/control/linearize_loops.hpp>
#include <kte/control/lqr.hpp>
#include <kte/dynamics/closed_loops/statics.hpp>
#include <kte/statics.hpp>
