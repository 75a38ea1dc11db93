#pragma once

/// Equilibria.
#include <kte/dynamics/closed_loops/statics.hpp>
#include <kte/statics.hpp>
