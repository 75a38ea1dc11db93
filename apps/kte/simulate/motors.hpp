#pragma once

#include <kte/robots/motors.hpp>

#include "mechanism.hpp"
#include "message.hpp"

namespace kte_tool {

/// Adds the motors of a robot's file to its chain. Writes warnings about them to standard error.
inline void take_motors(mechanism& m) {
  const auto before = m.robot.warnings.size();
  kte::add_motors(m.robot);
  for (std::size_t i = before; i < m.robot.warnings.size(); ++i) say(texts_of({m.robot.warnings[i]}, m.file)[0]);
  if (m.robot.motors.empty()) say(m.file + ": it has no motors");
}

}  // namespace kte_tool
