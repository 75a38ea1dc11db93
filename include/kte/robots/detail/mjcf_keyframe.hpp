#pragma once

#include <kte/robots/detail/xml_item.hpp>

namespace kte::detail {

/// The number of entries of q of a joint in MJCF; a free joint has its position, then the quaternion w, x, y, z.
inline std::size_t numbers_of_q(const robot_joint& j) {
  using kind = robot_joint::kind;
  return j.is == kind::fixed ? 0 : j.is == kind::floating ? 7 : j.is == kind::spherical ? 4 : 1;
}

/// Reads a <key> as a configuration. Its qpos has the numbers of all joints in the order of the bodies, parents first,
/// which is the order of joints in the description. Quaternions are normalized; a quaternion of length 0 stands for no
/// rotation, as in MuJoCo.
inline void read_mjcf_keyframe(const xml_item& x, robot_description& d) {
  x.only({}, {"name", "qpos"});
  if (!x.has("qpos")) return;
  const auto q = x.list("qpos");
  std::size_t all = 0;
  for (const auto& j : d.joints) all += numbers_of_q(j);
  if (all != q.size())
    return x.warn("its qpos has " + std::to_string(q.size()) + " numbers, q of the robot " + std::to_string(all) +
                  ": it is not read");
  const auto usual = "keyframe" + std::to_string(d.configurations.size());
  robot_configuration c{x.text_or("name", usual.c_str()), x.line(), {}};
  auto at = q.begin();
  for (const auto& j : d.joints) {
    const auto count = numbers_of_q(j);
    if (count == 0) continue;
    std::vector<double> own(at, at + static_cast<std::ptrdiff_t>(count));
    at += static_cast<std::ptrdiff_t>(count);
    if (count > 1) {
      auto* const r = own.data() + count - 4;
      const double length = std::hypot(std::hypot(r[0], r[1]), std::hypot(r[2], r[3]));
      if (length == 0) x.warn("the quaternion of joint '" + j.name + "' has length 0: it is taken as no rotation");
      for (int i = 0; i < 4; ++i) r[i] = length > 0 ? r[i] / length : i == 0 ? 1 : 0;
    }
    c.joints.emplace_back(j.name, std::move(own));
  }
  d.configurations.push_back(std::move(c));
}

}  // namespace kte::detail
