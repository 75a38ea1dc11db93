#pragma once

#include <vector>

namespace kte {

/// A row of a recording of a mechanism, as numbers.
struct scene_row {
  std::vector<double> poses;    ///< position and rotation matrix by rows for each track
  std::vector<double> q, v;     ///< positions and velocities
  std::vector<double> signals;  ///< of inputs, vectors and internal states
  std::vector<double> cells;    ///< of columns
};

}  // namespace kte
