#pragma once

#include <kte/robots/robot.hpp>

#include <pybind11/pybind11.h>

namespace kte_python {

/// kte.Robot: a robot, and its chain as a kte.Chain, which a program may extend.
struct robot_object {
  kte::robot robot;
  pybind11::object chain;
  pybind11::tuple source;                    ///< the function that made it, its argument and options
  pybind11::list motors = pybind11::list();  ///< arguments of `add_motors`
};

/// A robot with its chain as it is now.
kte::robot current(const robot_object& r);
/// A kte.RobotWarning in the line of Python that called, or, at level 2, in that which called this one.
void warn_of_robot(const std::string& text, int level = 1);

}  // namespace kte_python
