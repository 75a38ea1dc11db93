#pragma once

/// Elements that close kinematic loops (docs/loops.md).
#include <kte/elements/closures/axis_closures.hpp>
#include <kte/elements/closures/coincident_frames.hpp>
#include <kte/elements/closures/coincident_points.hpp>
#include <kte/elements/closures/coupled_coordinates.hpp>
#include <kte/elements/closures/point_closures.hpp>
