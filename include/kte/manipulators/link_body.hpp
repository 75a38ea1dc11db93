#pragma once

#include <kte/math/rigid_body.hpp>

#include <array>
#include <numbers>

namespace kte {

/// An assumed body of a link without published data: a rod from the origin to d with ends of radius r,
///
///   c = d/2,   I = m/12 (d.d 1 - d d^T) + 2/5 m r^2 1                (1)
///
/// about its centre of mass. Arms that use it say so.
template <class X, class Y, class Z>
[[nodiscard]] constexpr auto link_body(double m, const vec3<X, Y, Z>& d, double r) {
  const auto v = as<double>(d);
  const double k = m / 12, own = 0.4 * m * r * r;
  return rigid_body{m, vec3<>{v.x / 2, v.y / 2, v.z / 2},
                    sym3<>{k * (v.y * v.y + v.z * v.z) + own, -k * v.x * v.y, -k * v.x * v.z,
                           k * (v.x * v.x + v.z * v.z) + own, -k * v.y * v.z, k * (v.x * v.x + v.y * v.y) + own}};
}

namespace detail {
template <std::size_t N>
constexpr std::array<double, N> in_radians(std::array<double, N> degrees) {
  for (double& x : degrees) x *= std::numbers::pi / 180;
  return degrees;
}
template <std::size_t N>
constexpr std::array<double, N> negated(std::array<double, N> x) {
  for (double& each : x) each = -each;
  return x;
}
}  // namespace detail

}  // namespace kte
