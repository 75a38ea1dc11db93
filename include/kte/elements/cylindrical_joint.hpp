#pragma once

#include <kte/elements/joint_series.hpp>
#include <kte/elements/prismatic_joint.hpp>
#include <kte/elements/revolute_joint.hpp>

namespace kte {

/// A cylindrical joint: the end turns about a unit axis n by the coordinate `turn`, rad, and slides along it by
/// `slide`, m. The axis is constant in base and end axes. The joint consists of a revolute and a prismatic joint, with
/// the frame `inner_of(end)` between them.
///
///   R = Rot(n, turn),  p = slide n
template <class Q1, class Q2, class B, class E, class X, class Y, class Z>
[[nodiscard]] constexpr auto cylindrical_joint_3D(const Q1& turn, const Q2& slide, const B& base, const E& end,
                                                  const vec3<X, Y, Z>& axis) {
  const auto inner = inner_of(end);
  const auto turning =
      revolute_joint_3D(turn, base, inner, axis);  // evaluated first, so that its errors come first with every compiler
  return detail::in_series(turning, prismatic_joint_3D(slide, inner, end, axis));
}

KTE_CALL(cylindrical_joint_3D, "(turn, slide, base, end, axis); an axis is a vector, such as kte::axis::x")

}  // namespace kte
