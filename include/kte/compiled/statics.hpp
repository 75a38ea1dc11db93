#pragma once

/// Part of kte/compiled.hpp: equilibria.
#include <kte/compiled/models.hpp>
#include <kte/compiled/registry.hpp>
#include <kte/dynamics/closed_loops/statics.hpp>
#include <kte/statics.hpp>
