#pragma once

#include <kte/robots/description.hpp>

#include <cmath>
#include <optional>

namespace kte_tool {

/// Half the extent of a shape along a unit direction d in its own axes, m; none for meshes, planes and height fields:
///
///   box       |h_x d_x| + |h_y d_y| + |h_z d_z|            with half edges h
///   sphere    r
///   ellipsoid sqrt((h_x d_x)^2 + (h_y d_y)^2 + (h_z d_z)^2)
///   cylinder  |d_z| length/2 + r sqrt(d_x^2 + d_y^2);      capsule: |d_z| length/2 + r
inline std::optional<double> half_extent(const kte::robot_shape& s, const kte::vec3<>& d) {
  using form = kte::robot_shape::form;
  const auto& h = s.size;
  switch (s.is) {
    case form::box:
      return 0.5 * (std::abs(h.x * d.x) + std::abs(h.y * d.y) + std::abs(h.z * d.z));
    case form::sphere:
      return h.x;
    case form::ellipsoid:
      return std::hypot(h.x * d.x, h.y * d.y, h.z * d.z);
    case form::cylinder:
      return 0.5 * h.y * std::abs(d.z) + h.x * std::hypot(d.x, d.y);
    case form::capsule:
      return 0.5 * h.y * std::abs(d.z) + h.x;
    case form::none:
    case form::plane:
    case form::mesh:
    case form::height_field:
      break;
  }
  return {};
}

}  // namespace kte_tool
