#pragma once

#include <array>
#include <string>
#include <vector>

#include "digits.hpp"

namespace bench {

/// The blocks of an operation on a serial robot (serial_robot.hpp) at q, v and a or tau, by textbook.hpp in long
/// double: the mass matrix by columns of inverse dynamics, its inverse by columns of forward dynamics, derivatives by
/// complex steps.
std::vector<block> from_textbook(operation o, const std::string& model, const std::array<std::vector<double>, 3>& x);

}  // namespace bench
