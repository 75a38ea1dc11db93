#pragma once

#include <kte/contract/transmission.hpp>

namespace kte {

namespace core {

/// The point of a line nearest to the origin of a frame. The line goes along the unit vector t through the point o,
/// both in the axes in which the frame is given:
///
///   p' = o + t (t . (p - o)),   v' = t (t . v),   a' = t (t . a)          (1)
///
/// Gravity is an acceleration of bases, so the frame of the point has only its component along the line: an
/// accelerometer there does not measure the full gravity. The frame of the point does not rotate. A force on it is
/// transmitted as F += t (t . F'); a torque does no work.
template <kind Dim, class Tangent, class Point>
struct line_point_mindist {
  static constexpr type_name type{"line_point_mindist", Dim};
  static constexpr std::array<port, 2> ports{{{Dim, access::in, "base"}, {Dim, access::out, "end"}}};
  static constexpr bool reads_positions = true;

  Tangent tangent;
  Point origin;

  template <class Frame>
  KTE_INLINE constexpr auto doMotion(const Frame& x) const {
    const auto along = [&](const auto& v) KTE_INLINE_LAMBDA { return dot(tangent, x.rotation * v) * tangent; };
    return motion{origin + dot(tangent, x.position - origin) * tangent,
                  no_rotation{},
                  along(x.velocity),
                  zero3{},
                  along(x.acceleration),
                  zero3{}};  // (1)
  }
  template <class Frame, class F, class T>
  KTE_INLINE constexpr auto doForce(const Frame& x, const wrench<F, T>& end) const {
    return make_loads(wrench{transpose(x.rotation) * (dot(tangent, end.force) * tangent), zero3{}});
  }
  constexpr void check(const parameter_check& where) const {
    where.unit(tangent, "tangent must have length 1");
    where.finite(origin, "origin must be finite");
  }
  template <class Self, class Visit>
  static constexpr void parameters(Self& self, Visit&& visit) {
    visit("tangent", self.tangent), visit("origin", self.origin);
  }
};

}  // namespace core

/// A frame at the point of a line in the plane nearest to the origin of another frame, for springs, dampers and
/// measures. The line has the unit direction `tangent` and contains the point `origin`, m.
template <class B, class E, class Tangent, class Point>
[[nodiscard]] constexpr auto line_point_mindist_2D(const B& base, const E& end, const Tangent& tangent,
                                                   const Point& origin) {
  const auto t = detail::planar(tangent);
  const auto o = detail::planar(origin);
  return connect(
      core::line_point_mindist<kind::frame_2D, std::remove_const_t<decltype(t)>, std::remove_const_t<decltype(o)>>{t,
                                                                                                                   o},
      base, end);
}
/// A frame at the point of a line in space nearest to the origin of another frame.
template <class B, class E, class X, class Y, class Z, class OX, class OY, class OZ>
[[nodiscard]] constexpr auto line_point_mindist_3D(const B& base, const E& end, const vec3<X, Y, Z>& tangent,
                                                   const vec3<OX, OY, OZ>& origin) {
  return connect(core::line_point_mindist<kind::frame_3D, vec3<X, Y, Z>, vec3<OX, OY, OZ>>{tangent, origin}, base, end);
}

KTE_CALL(line_point_mindist_2D, "(base, end, tangent, origin)")
KTE_CALL(line_point_mindist_3D, "(base, end, tangent, origin)")

}  // namespace kte
