#pragma once

#include <string>
#include <vector>

#include "timing.hpp"

/// Results known from elsewhere. Of iiwa14, ur5, solo12 and the serial chains of 2 and 8 bodies: the values of 31
/// digits, or 21, in tests/data. What these do not have, and all of the pendulum and the other chains: the recursions
/// of textbook.hpp in long double. Where there are both, up to 32 bodies, they agree to 3e-18.
namespace bench {

/// How many numbers there are in q, and in v, a and tau.
struct model_size {
  int q, v;
};
model_size size_of(const std::string& model);

/// At least one, all of the same size.
std::vector<expectation> expected(const std::string& model, operation o, triangle t);

}  // namespace bench
