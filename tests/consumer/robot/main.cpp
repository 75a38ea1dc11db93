#include <array>
#include <cmath>

#include "arm.hpp"

/// A robot of a file as a type: the pendulum of 1 kg at 0.5 m.
int main() {
  const auto m = kte::mass_matrix(robots::arm, std::array{0.3});
  return std::abs(m(0, 0) - 0.25) < 1e-15 ? 0 : 1;
}
