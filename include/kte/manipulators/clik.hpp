#pragma once

/// Deprecated header name; use kte/manipulators/numerical_inverse_kinematics.hpp.
#include <kte/manipulators/numerical_inverse_kinematics.hpp>
