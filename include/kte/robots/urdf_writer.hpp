#pragma once

#include <kte/robots/describe.hpp>

namespace kte {

/// A robot as URDF, with the shortest digits that read back to the same numbers. Rotations are written as roll, pitch
/// and yaw: of quarter turns they come back exactly, others to 4e-16. Unlimited coordinates have infinite limits
/// ("inf"), unless they are turns. Throws `bad_argument`, with the joint, for what URDF cannot say: spherical joints,
/// springs, rotor inertias, other rest positions. Gravity is not in URDF.
std::string to_urdf(const robot_description& d);
inline std::string to_urdf(const robot& r) { return to_urdf(describe(r)); }
inline std::string to_urdf(const kte_map_chain& c, const std::string& name = "robot") {
  return to_urdf(describe(c, name));
}

}  // namespace kte

#ifdef KTE_FUNCTION
#  include <kte/robots/detail/write_urdf.hpp>

namespace kte {
KTE_FUNCTION std::string to_urdf(const robot_description& d) { return detail::urdf_writer(d).write(); }
}  // namespace kte
#endif
