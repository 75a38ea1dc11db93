#pragma once

#include <kte/contract/parameter_check.hpp>

namespace kte::detail {

/// The error in the moments of a body, by the rule for elements (contract/parameter_check.hpp); empty if there is none.
inline std::string unphysical(const rigid_body<>& b) {
  parameter_check::breach broken;
  const parameter_check where{"", {}, {}, broken};
  where.physical(b);
  if (broken.rule == nullptr) return {};
  const auto& [largest, middle, smallest] = broken.moments;
  char text[200];
  std::snprintf(
      text, sizeof text,
      "the inertia is not physically realizable: its principal moment %.6g is above %.6g + %.6g by %.3g kg m^2",
      largest, middle, smallest, broken.value);
  return text;
}

/// Two bodies as one, with the inertia about the common centre of mass:
///
///   m = m1 + m2,  c = (m1 c1 + m2 c2)/m,  I = I1 + I2 + (m1 m2/m) (|d|^2 1 - d d^T),  d = c1 - c2          (1)
inline rigid_body<> together(const rigid_body<>& a, const rigid_body<>& b) {
  const double m = a.mass + b.mass;
  const double wa = m > 0 ? a.mass / m : 0, wb = m > 0 ? b.mass / m : 0, k = wa * b.mass;
  const vec3<> d = a.com - b.com;
  const auto& i = a.inertia;
  const auto& j = b.inertia;
  return {m,
          wa * a.com + wb * b.com,
          {i.xx + j.xx + k * (d.y * d.y + d.z * d.z), i.xy + j.xy - k * (d.x * d.y), i.xz + j.xz - k * (d.x * d.z),
           i.yy + j.yy + k * (d.z * d.z + d.x * d.x), i.yz + j.yz - k * (d.y * d.z),
           i.zz + j.zz + k * (d.x * d.x + d.y * d.y)}};  // (1)
}

}  // namespace kte::detail
