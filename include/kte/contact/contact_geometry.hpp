#pragma once

#include <kte/contact/surfaces.hpp>
#include <kte/detail/raise.hpp>
#include <kte/errors.hpp>
#include <kte/frames/motion.hpp>

#include <concepts>

namespace kte::detail {
/// The surface of an element that is read from a file. Surfaces of your own functions may have none; files do not hold
/// them.
template <class Surface>
constexpr Surface default_surface() {
  if constexpr (std::default_initializable<Surface>)
    return Surface{};
  else
    raise<bad_argument>("kte: this surface cannot be default-constructed");
}
}  // namespace kte::detail

namespace kte::core {

/// The contact of a sphere of radius r >= 0 about the origin of a frame B with a surface of a frame A, from the motion
/// m of B relative to A: p in axes of A, rates in axes of B (contract/closure.hpp), numbers of one type. With the
/// distance s, the normal n = grad s and the second derivative H of the surface, in axes of A:
///
///   g = s - r,   g_dot = n.p_dot,   g_ddot = n.p_ddot + p_dot.H p_dot          (1)
///   c = p - r n,   u = p_dot - r w x n                                         (2)
///   u_dot = p_ddot - r al x n - r w x (H p_dot)                                (3)
///
/// g_dot = n.u. (3) is the rate of the components of u in axes of A.
template <kind Dim, class Surface = contact_surface>
struct contact_geometry {
  using surface_type = Surface;
  static constexpr char compliant_name[] = "compliant_contact";  ///< the type of its compliant element in files
  static constexpr char rigid_name[] = "sphere_contact";         ///< the type of its rigid element in files
  static constexpr char bristle_name[] = "bristle_contact";      ///< likewise with friction by bristles
  static constexpr bool in_packs = std::is_same_v<Surface, contact_surface>;  ///< whether its functions take packs

  Surface surface = detail::default_surface<Surface>();
  double radius = 0;  ///< m
  vec3<> offset{};    ///< of the centre of the sphere from the origin of B, in axes of B, m

  /// The distance of the farthest point of the sphere from the origin of B, m.
  constexpr double size() const { return std::sqrt(dot(offset, offset)) + radius; }
  /// g, m.
  template <class M>
  KTE_INLINE constexpr auto gap(const M& m) const {
    using S = std::remove_cvref_t<decltype(m.position.x)>;
    return S(surface.at(position(m), radius).distance - S(radius));
  }
  /// g_dot, m/s.
  template <class M>
  KTE_INLINE constexpr auto gap_dot(const M& m) const {
    return dot(normal(m), velocity(m));
  }
  /// g_ddot, m/s^2.
  template <class M>
  KTE_INLINE constexpr auto gap_ddot(const M& m) const {
    const auto v = velocity(m);
    return dot(normal(m), acceleration(m)) + dot(v, surface.bend(position(m), v, radius));
  }
  /// n, from A to B.
  template <class M>
  KTE_INLINE constexpr auto normal(const M& m) const {
    return surface.at(position(m), radius).normal;
  }
  /// c, m.
  template <class M>
  KTE_INLINE constexpr auto point(const M& m) const {
    return position(m) - radius * normal(m);
  }
  /// u, m/s: the velocity of the point of B at c relative to that of A.
  template <class M>
  KTE_INLINE constexpr auto slip(const M& m) const {
    return velocity(m) - radius * cross(m.rotation * m.ang_velocity, normal(m));
  }
  /// u_dot, m/s^2.
  template <class M>
  KTE_INLINE constexpr auto slip_rate(const M& m) const {
    const auto turns = surface.bend(position(m), velocity(m), radius);
    return acceleration(m) -
           radius * (cross(m.rotation * m.ang_acceleration, normal(m)) + cross(m.rotation * m.ang_velocity, turns));
  }
  constexpr void check(const parameter_check& where) const {
    surface.template check<Dim>(where);
    where.not_negative(radius, "radius must be finite and not negative");
    where.finite(offset, "offset must be finite");
    if constexpr (Dim == kind::frame_2D) where.require(offset.z == 0, "offset must be in the plane", offset.z);
    if constexpr (std::is_same_v<Surface, contact_surface>)
      where.require(surface.radius >= 0 || radius < -surface.radius, "radius must be below that of the bowl", radius);
  }
  template <class Self, class Visit>
  static constexpr void parameters(Self& self, Visit&& visit) {
    Surface::parameters(self.surface, visit);
    visit("radius", self.radius), visit("offset", self.offset);
  }

 private:
  // The centre of the sphere, in axes of A.
  template <class M>
  KTE_INLINE constexpr auto position(const M& m) const {
    return as<std::remove_cvref_t<decltype(m.position.x)>>(m.position + m.rotation * offset);
  }
  template <class M>
  KTE_INLINE constexpr auto velocity(const M& m) const {
    return as<std::remove_cvref_t<decltype(m.position.x)>>(m.rotation * plus_cross(m.velocity, m.ang_velocity, offset));
  }
  template <class M>
  KTE_INLINE constexpr auto acceleration(const M& m) const {
    const auto& w = m.ang_velocity;
    return as<std::remove_cvref_t<decltype(m.position.x)>>(
        m.rotation * plus_cross(plus_cross(m.acceleration, m.ang_acceleration, offset), w, cross(w, offset)));
  }
};

}  // namespace kte::core

namespace kte::detail {
/// The contact of a sphere about a point of frame 2 with a surface.
template <kind Dim, class Surface>
constexpr auto sphere_on(const Surface& surface, double radius, const vec3<>& offset) {
  if constexpr (std::is_base_of_v<contact_surface, Surface>)
    return core::contact_geometry<Dim, contact_surface>{surface.template in<Dim>(), radius, offset};
  else
    return core::contact_geometry<Dim, Surface>{surface.template in<Dim>(), radius, offset};
}
}  // namespace kte::detail
