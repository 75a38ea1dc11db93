#pragma once

#include <mujoco/mujoco.h>

#include "serial_robot.hpp"

namespace work_precision {

/// The robot in MuJoCo, integrated by its method RK4, without contacts, constraints or sensors. A joint whose axis is 0
/// is a ball joint. Throws `std::runtime_error` with what MuJoCo says.
mjModel* load_mujoco(const bench::serial_robot& robot);

}  // namespace work_precision
