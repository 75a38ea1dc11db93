#pragma once

#include <kte/contact/surfaces.hpp>
#include <kte/detail/raise.hpp>
#include <kte/frames/motion.hpp>

namespace kte::core {

/// The contact of the rim of a disc with a half space of a frame A of normal n. The disc of radius R lies about the
/// origin of a frame B, normal to its axis a, from the motion of B relative to A as in contact/contact_geometry.hpp. In
/// axes of A, with a_dot = w x a:
///
///   k = n - (n.a) a,   e = k/|k|,   g = n.p - R |k|,   c = p - R e             (1)
///   u = p_dot - R w x e,   g_dot = n.u                                         (2)
///   e_dot = (k_dot - e (e.k_dot))/|k|,   u_dot = p_ddot - R (al x e + w x e_dot),   g_ddot = n.u_dot          (3)
///
/// The lowest point of a disc that lies flat, |k| = 0, is not known, and beside it c moves around the rim at a rate of
/// |w|/|k|: neither steps nor events resolve that. So where |k| <= 1/1000 and g <= R/1000, (1), except g, to (3) raise
/// `bad_argument`, but for `place`. Farther away e is 0 if |k| = 0.
struct disc_geometry {
  using surface_type = contact_surface;
  static constexpr char compliant_name[] = "compliant_disc_contact";  ///< the type of its compliant element in files
  static constexpr char rigid_name[] = "disc_contact";                ///< the type of its rigid element in files

  contact_surface surface{};
  vec3<> axis{};
  double radius = 0;  ///< m

  /// The distance of the rim from the origin of B, m.
  constexpr double size() const { return radius; }
  /// g, m.
  template <class M>
  KTE_INLINE constexpr auto gap(const M& m) const {
    const auto below = detail::to_polar(downhill(m.rotation * axis));
    return dot(surface.axis, m.position) - radius * below.length;
  }
  /// g_dot, m/s.
  template <class M>
  KTE_INLINE constexpr auto gap_dot(const M& m) const {
    return dot(surface.axis, slip(m));
  }
  /// g_ddot, m/s^2.
  template <class M>
  KTE_INLINE constexpr auto gap_ddot(const M& m) const {
    return dot(surface.axis, slip_rate(m));
  }
  /// n, from A to B.
  template <class M>
  KTE_INLINE constexpr auto normal(const M& m) const {
    return as<std::remove_cvref_t<decltype(m.position.x)>>(surface.axis);
  }
  /// c, m.
  template <class M>
  KTE_INLINE constexpr auto point(const M& m) const {
    return place(m, lowest(m, m.rotation * axis).direction).first;
  }
  /// u, m/s: the velocity of the point of B at c relative to that of A.
  template <class M>
  KTE_INLINE constexpr auto slip(const M& m) const {
    return place(m, lowest(m, m.rotation * axis).direction).second;
  }
  /// c and u; of a disc that lies flat those of its centre, without error: for pictures and recordings.
  template <class M>
  KTE_INLINE constexpr auto place(const M& m) const {
    return place(m, lowest_or_none(m.rotation * axis).direction);
  }
  /// u_dot, m/s^2.
  template <class M>
  KTE_INLINE constexpr auto slip_rate(const M& m) const {
    const auto& n = surface.axis;
    const auto a = m.rotation * axis, w = m.rotation * m.ang_velocity, a_dot = cross(w, a);
    const auto [length, e] = lowest(m, a);
    const auto k_dot = -(dot(n, a_dot) * a + dot(n, a) * a_dot);
    using S = std::remove_cvref_t<decltype(m.position.x)>;
    const auto e_dot = S(S(1) / length) * (k_dot - dot(e, k_dot) * e);
    return m.rotation * m.acceleration - radius * (cross(m.rotation * m.ang_acceleration, e) + cross(w, e_dot));  // (3)
  }
  constexpr void check(const parameter_check& where) const {
    where.unit(surface.axis, "normal must have length 1");
    where.unit(axis, "axis must have length 1");
    where.positive(radius, "radius must be finite and positive");
  }
  template <class Self, class Visit>
  static constexpr void parameters(Self& self, Visit&& visit) {
    visit("normal", self.surface.axis), visit("axis", self.axis), visit("radius", self.radius);
  }

 private:
  template <class A>
  KTE_INLINE constexpr auto downhill(const A& a) const {
    return surface.axis - dot(surface.axis, a) * a;
  }
  template <class M, class E>
  KTE_INLINE constexpr auto place(const M& m, const E& e) const {
    return std::pair{m.position - radius * e, m.rotation * m.velocity - radius * cross(m.rotation * m.ang_velocity, e)};
  }
  template <class M, class A>
  KTE_INLINE constexpr auto lowest(const M& m, const A& a) const {
    const auto below = detail::to_polar(downhill(a));
    using S = std::remove_cvref_t<decltype(below.length)>;
    if (all(below.length > S(1e-3))) [[likely]]
      return below;
    const S height = S(dot(surface.axis, m.position) - S(1e-3 * radius));
    if (!all(select(below.length > S(1e-3), S(1), height) > S(0)))
      detail::raise<bad_argument>(
          "kte: a disc lies flat on its surface, within 0.001 rad: it has no lowest point; give the body points of the "
          "rim as contacts");
    return lowest_or_none(a);
  }
  /// |k| and e, or 1 and 0 if |k| = 0.
  template <class A>
  KTE_INLINE constexpr auto lowest_or_none(const A& a) const {
    auto below = detail::to_polar(downhill(a));
    using S = std::remove_cvref_t<decltype(below.length)>;
    const auto steep = below.length > S(1e-12);
    below.length = select(steep, below.length, S(1));
    below.direction = select(steep, S(1), S(0)) * below.direction;
    return below;
  }
};

}  // namespace kte::core
