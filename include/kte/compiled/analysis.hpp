#pragma once

/// Part of kte/compiled.hpp: equilibria, linear models, feedback.
#include <kte/compiled/elements.hpp>
#include <kte/compiled/models.hpp>
#include <kte/control/discretize.hpp>
#include <kte/control/linearize_loops.hpp>
#include <kte/control/lqr.hpp>
#include <kte/dynamics/closed_loops/statics.hpp>
#include <kte/statics.hpp>
