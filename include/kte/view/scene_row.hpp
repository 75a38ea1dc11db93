#pragma once

#include <vector>

namespace kte {

/// A row of a recording of a mechanism, as numbers.
struct scene_row {
  std::vector<double> poses;    ///< of each track the position and the matrix of the rotation by rows
  std::vector<double> q, v;     ///< positions and velocities
  std::vector<double> signals;  ///< of inputs, vectors and internal states
  std::vector<double> cells;    ///< of columns
};

}  // namespace kte
