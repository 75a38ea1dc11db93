#include "scenes.hpp"

namespace contact_bench {

std::vector<row> mujoco_rows(const scene&, bool) { return {}; }

}  // namespace contact_bench
