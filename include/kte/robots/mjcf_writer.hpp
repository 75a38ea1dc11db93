#pragma once

#include <kte/robots/describe.hpp>

namespace kte {

/// A robot as MJCF, with the shortest digits that read back to the same numbers. Rotations are quaternions: of quarter
/// turns they come back exactly, others to 4e-16. Throws `bad_argument`, with the joint, for what bodies in MJCF cannot
/// say: planar joints, followers, poses free in another body than the world, rates of limits. Shapes are left out of
/// it: geoms would have masses.
std::string to_mjcf(const robot_description& d);
inline std::string to_mjcf(const robot& r) { return to_mjcf(describe(r)); }
inline std::string to_mjcf(const kte_map_chain& c, const std::string& name = "robot") {
  return to_mjcf(describe(c, name));
}

}  // namespace kte

#ifdef KTE_FUNCTION
#  include <kte/robots/detail/write_mjcf.hpp>

namespace kte {
KTE_FUNCTION std::string to_mjcf(const robot_description& d) { return detail::mjcf_writer(d).write(); }
}  // namespace kte
#endif
