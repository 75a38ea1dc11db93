#pragma once

#include <kte/contract/transmission.hpp>

namespace kte {

namespace core {

/// The point of a plane nearest to the origin of a frame. The plane has the unit normal n and goes through the point o,
/// both in the axes in which the frame is given:
///
///   p' = p - n (n . (p - o)),   v' = v - n (n . v),   a' = a - n (n . a)          (1)
///
/// Gravity is an acceleration of bases, so the frame of the point has only its component in the plane: an accelerometer
/// there does not measure the full gravity. The frame of the point does not rotate. A force on it is transmitted as F
/// += F' - n (n . F'); a torque does no work.
template <class Normal, class Point>
struct plane_point_mindist {
  static constexpr type_name type{"plane_point_mindist", kind::frame_3D};
  static constexpr std::array<port, 2> ports{
      {{kind::frame_3D, access::in, "base"}, {kind::frame_3D, access::out, "end"}}};
  static constexpr bool reads_positions = true;

  Normal normal;
  Point origin;

  template <class Frame>
  KTE_INLINE constexpr auto doMotion(const Frame& x) const {
    return motion{x.position - dot(normal, x.position - origin) * normal,
                  no_rotation{},
                  in_plane(x.rotation * x.velocity),
                  zero3{},
                  in_plane(x.rotation * x.acceleration),
                  zero3{}};  // (1)
  }
  template <class Frame, class F, class T>
  KTE_INLINE constexpr auto doForce(const Frame& x, const wrench<F, T>& end) const {
    return make_loads(wrench{transpose(x.rotation) * in_plane(end.force), zero3{}});
  }
  constexpr void check(const parameter_check& where) const {
    where.unit(normal, "normal must have length 1");
    where.finite(origin, "origin must be finite");
  }
  template <class Self, class Visit>
  static constexpr void parameters(Self& self, Visit&& visit) {
    visit("normal", self.normal), visit("origin", self.origin);
  }

 private:
  template <class V>
  KTE_INLINE constexpr auto in_plane(const V& v) const {
    return v - dot(normal, v) * normal;
  }
};

}  // namespace core

/// A frame at the point of a plane nearest to the origin of another frame, for springs, dampers and measures. The plane
/// has the unit `normal` and contains the point `origin`, m.
template <class B, class E, class X, class Y, class Z, class OX, class OY, class OZ>
[[nodiscard]] constexpr auto plane_point_mindist_3D(const B& base, const E& end, const vec3<X, Y, Z>& normal,
                                                    const vec3<OX, OY, OZ>& origin) {
  return connect(core::plane_point_mindist<vec3<X, Y, Z>, vec3<OX, OY, OZ>>{normal, origin}, base, end);
}

KTE_CALL(plane_point_mindist_3D, "(base, end, normal, origin)")

}  // namespace kte
