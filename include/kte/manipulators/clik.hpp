#pragma once

/// The former name of this header.
#include <kte/manipulators/numerical_inverse_kinematics.hpp>
