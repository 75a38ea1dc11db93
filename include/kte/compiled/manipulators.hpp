#pragma once

/// Arms, inverse kinematics.
#include <kte/manipulators/numerical_inverse_kinematics.hpp>
#include <kte/manipulators/runtime_manipulator.hpp>
