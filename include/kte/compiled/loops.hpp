#pragma once

/// Closed loops, also in packs.
#include <kte/dynamics/lanes.hpp>
#include <kte/loops.hpp>
