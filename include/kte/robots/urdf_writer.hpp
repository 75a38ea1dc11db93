#pragma once

#include <kte/robots/describe.hpp>
#include <kte/robots/writing.hpp>

namespace kte {

/// A robot as URDF, with the shortest digits that restore every number. Rotations are roll, pitch and yaw: quarter
/// turns are restored exactly, others to 4e-16. A missing limit is written as 1e308, which every reader accepts and
/// `to_robot` takes as none. Throws `bad_argument`, naming the joint, for contents that change the motion and that URDF
/// does not support: spherical joints; springs and rotor inertias, which `robot_writing::lossy` omits. Other contents
/// that are not in the file are listed: gravity, motors, planes, ellipsoids.
[[nodiscard]] std::string to_urdf(const robot_description& d, const robot_writing& o = {});
[[nodiscard]] std::string to_urdf(const robot& r, const robot_writing& o = {});
[[nodiscard]] std::string to_urdf(const runtime_chain& c, const std::string& name = "robot",
                                  const robot_writing& o = {});

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
