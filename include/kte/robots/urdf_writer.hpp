#pragma once

#include <kte/robots/describe.hpp>
#include <kte/robots/writing.hpp>

namespace kte {

/// A robot as URDF, with the shortest digits that read back to the same numbers. Rotations are written as roll, pitch
/// and yaw: of quarter turns they come back exactly, others to 4e-16. Where there is no limit the file has 1e308, which
/// every reader takes, and `to_robot` for none. Throws `bad_argument`, with the joint, for what changes the motion and
/// URDF cannot say: spherical joints; springs and rotor inertias, which `robot_writing::lossy` leaves out. What else is
/// not in the file is listed: gravity, motors, planes, ellipsoids.
std::string to_urdf(const robot_description& d, const robot_writing& o = {});
std::string to_urdf(const robot& r, const robot_writing& o = {});
std::string to_urdf(const runtime_chain& c, const std::string& name = "robot", const robot_writing& o = {});

}  // namespace kte

#ifdef KTE_FUNCTION
#  include <kte/robots/detail/write_urdf.hpp>

namespace kte {
KTE_FUNCTION std::string to_urdf(const robot_description& d, const robot_writing& o) {
  return detail::urdf_writer(d, o).write();
}
KTE_FUNCTION std::string to_urdf(const robot& r, const robot_writing& o) {
  const auto d = describe(r);
  return detail::urdf_writer(d, o, d.not_read).write();
}
KTE_FUNCTION std::string to_urdf(const runtime_chain& c, const std::string& name, const robot_writing& o) {
  const auto d = describe(c, name);
  return detail::urdf_writer(d, o, d.not_read).write();
}
}  // namespace kte
#endif
