#pragma once

#include <kte/robots/describe.hpp>
#include <kte/robots/writing.hpp>

namespace kte {

/// A robot as MJCF for MuJoCo 2.2.2 or later, with the shortest digits that restore every number. Rotations are
/// quaternions: quarter turns are restored exactly, others to 4e-16. Inertias are principal moments and a quaternion.
/// Throws `bad_argument`, naming the joint or link, for contents that change the motion and that MJCF does not support
/// (docs/robots.md): followers, moving bodies without mass, moments that are not physically realizable, floating poses
/// in a moving link; with `robot_writing::lossy` they are approximated. Other contents that are not in the file are
/// listed.
[[nodiscard]] std::string to_mjcf(const robot_description& d, const robot_writing& o = {});
[[nodiscard]] std::string to_mjcf(const robot& r, const robot_writing& o = {});
[[nodiscard]] std::string to_mjcf(const runtime_chain& c, const std::string& name = "robot",
                                  const robot_writing& o = {});

}  // namespace kte

#ifdef KTE_FUNCTION
#  include <kte/robots/detail/write_mjcf.hpp>

namespace kte {
KTE_FUNCTION std::string to_mjcf(const robot_description& d, const robot_writing& o) {
  return detail::mjcf_writer(d, o).write();
}
KTE_FUNCTION std::string to_mjcf(const robot& r, const robot_writing& o) {
  const auto d = describe(r);
  return detail::mjcf_writer(d, o, d.not_read).write();
}
KTE_FUNCTION std::string to_mjcf(const runtime_chain& c, const std::string& name, const robot_writing& o) {
  const auto d = describe(c, name);
  return detail::mjcf_writer(d, o, d.not_read).write();
}
}  // namespace kte
#endif
