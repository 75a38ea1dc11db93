#pragma once

#include <kte/robots/describe.hpp>
#include <kte/robots/writing.hpp>

namespace kte {

/// A robot as MJCF that MuJoCo reads, from 2.2.2 on, with the shortest digits that read back to the same numbers.
/// Rotations are quaternions: of quarter turns they come back exactly, others to 4e-16. Inertias are principal moments
/// and a quaternion. Throws `bad_argument`, with the joint or link, for what changes the motion and MJCF cannot say
/// (docs/robots.md): followers, bodies that move without mass, moments that no body can have, poses that float in what
/// moves; `robot_writing::lossy` has them as near as may be. What else is not in the file is listed.
std::string to_mjcf(const robot_description& d, const robot_writing& o = {});
std::string to_mjcf(const robot& r, const robot_writing& o = {});
std::string to_mjcf(const runtime_chain& c, const std::string& name = "robot", const robot_writing& o = {});

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
