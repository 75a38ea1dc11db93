#pragma once

#include <kte/contact/contact_geometry.hpp>
#include <kte/contact/disc_geometry.hpp>
#include <kte/contract/contact.hpp>
#include <kte/elements/gated_contact.hpp>

namespace kte {

namespace core {

/// A rigid contact of a sphere, a point or the rim of a disc of a body with a surface, with Coulomb friction and
/// Newton's restitution. With the gap g, the normal n, the point c and the relative velocity u of
/// contact/contact_geometry.hpp, a force lambda on the body, in axes of the surface:
///
///   g >= 0,   lambda_n >= 0,   g lambda_n = 0                                                   (1)
///   |lambda_t| <= mu lambda_n;   if u_t is not zero, lambda_t = -mu lambda_n u_t/|u_t|          (2)
///   u_n^+ = -e u_n^-  in impacts          (3)
///
/// `contact_dynamics` finds the forces, `impact` the velocities after an impact (kte/contacts.hpp). In simulations,
/// `.only_if(f)` lets a contact land only where f(state) is true (elements/gated_contact.hpp).
template <kind Dim, class Geometry>
struct rigid_contact : contact<rigid_contact<Dim, Geometry>, Dim> {
  static constexpr type_name type{Geometry::rigid_name, Dim};
  static constexpr const char* arguments =
      std::is_same_v<Geometry, disc_geometry>
          ? "{normal}, axis, radius, {friction, restitution}"
          : "{surface_axis, surface_radius}, radius, {friction, restitution}, offset";
  static constexpr bool holds_code = requires { requires Geometry::surface_type::holds_code; };
  static constexpr bool may_have_no_value = true;
  static constexpr bool touches_in_packs = requires { requires Geometry::in_packs; };
  static constexpr std::array<std::string_view, 3> optional_parameters{"offset", "friction", "restitution"};

  Geometry geometry{};
  contact_law law{};

  rigid_contact() = default;
  constexpr rigid_contact(const Geometry& g, const contact_law& l) : geometry(g), law(l) {}

  template <class M>
  KTE_INLINE constexpr auto gap(const M& m) const {
    return geometry.gap(m);
  }
  template <class M>
  KTE_INLINE constexpr auto gap_ddot(const M& m) const {
    return geometry.gap_ddot(m);
  }
  template <class M>
  KTE_INLINE constexpr auto normal(const M& m) const {
    return geometry.normal(m);
  }
  template <class M>
  KTE_INLINE constexpr auto point(const M& m) const {
    return geometry.point(m);
  }
  template <class M>
  KTE_INLINE constexpr auto slip(const M& m) const {
    return geometry.slip(m);
  }
  template <class M>
  KTE_INLINE constexpr auto slip_rate(const M& m) const {
    return geometry.slip_rate(m);
  }
  constexpr void check(const parameter_check& where) const {
    geometry.check(where);
    where.not_negative(law.friction, "friction must be finite and not negative");
    where.not_negative(law.restitution, "restitution must be between 0 and 1");
    where.require(law.restitution <= 1, "restitution must be between 0 and 1", law.restitution);
  }
  template <class Self, class Visit>
  static constexpr void parameters(Self& self, Visit&& visit) {
    Geometry::parameters(self.geometry, visit);
    visit("friction", self.law.friction), visit("restitution", self.law.restitution);
  }
};

}  // namespace core

namespace detail {
template <kind Dim, class Geometry>
struct gate<core::rigid_contact<Dim, Geometry>> : gate_on_contact<core::rigid_contact<Dim, Geometry>> {};
template <kind Dim, class Geometry, class C, class A, class B>
constexpr auto touching(const Geometry& g, const C& name, const A& surface, const B& body, const contact_law& law) {
  return connect(core::rigid_contact<Dim, Geometry>{g, law}, surface, body, name);
}
}  // namespace detail

/// A rigid contact, in the plane, of a surface of frame1 with a circle of a radius, m, about the origin of frame2, or
/// about the point `offset` of it, m. `contact` names the contact, its force and its mode.
template <class C, class A, class B, class Surface = contact_surface, entry Radius = double>
[[nodiscard]] constexpr auto sphere_contact_2D(const C& contact, const A& frame1, const B& frame2,
                                               const Surface& surface, const Radius& radius, const contact_law& law) {
  return detail::touching<kind::frame_2D>(detail::sphere_on<kind::frame_2D>(surface, as<double>(radius), {}), contact,
                                          frame1, frame2, law);
}
template <class C, class A, class B, class Surface = contact_surface, class Offset, entry Radius = double>
[[nodiscard]] constexpr auto sphere_contact_2D(const C& contact, const A& frame1, const B& frame2,
                                               const Surface& surface, const Radius& radius, const contact_law& law,
                                               const Offset& offset) {
  return detail::touching<kind::frame_2D>(
      detail::sphere_on<kind::frame_2D>(surface, as<double>(radius), as<double>(detail::planar(offset))), contact,
      frame1, frame2, law);
}
/// A rigid contact, in space, of a surface of frame1 with a sphere of a radius, m, about the origin of frame2, or about
/// the point `offset` of it, m:
///
///   sphere_contact_3D(foot, ground, shank_tip, half_space{}, 0.016, {.friction = 0.7, .restitution = 0.0})
///
/// Surfaces: `half_space`, `ball_surface`, `bowl_surface`, `cylinder_surface`, `height_field`, `surface`.
template <class C, class A, class B, class Surface = contact_surface, entry Radius = double>
[[nodiscard]] constexpr auto sphere_contact_3D(const C& contact, const A& frame1, const B& frame2,
                                               const Surface& surface, const Radius& radius, const contact_law& law) {
  return detail::touching<kind::frame_3D>(detail::sphere_on<kind::frame_3D>(surface, as<double>(radius), {}), contact,
                                          frame1, frame2, law);
}
template <class C, class A, class B, class Surface = contact_surface, class X, class Y, class Z, entry Radius = double>
[[nodiscard]] constexpr auto sphere_contact_3D(const C& contact, const A& frame1, const B& frame2,
                                               const Surface& surface, const Radius& radius, const contact_law& law,
                                               const vec3<X, Y, Z>& offset) {
  return detail::touching<kind::frame_3D>(
      detail::sphere_on<kind::frame_3D>(surface, as<double>(radius), as<double>(offset)), contact, frame1, frame2, law);
}
/// A rigid contact, in the plane, of a surface of frame1 with the origin of frame2.
template <class C, class A, class B, class Surface>
[[nodiscard]] constexpr auto point_contact_2D(const C& contact, const A& frame1, const B& frame2,
                                              const Surface& surface, const contact_law& law) {
  return sphere_contact_2D(contact, frame1, frame2, surface, 0.0, law);
}
/// A rigid contact, in space, of a surface of frame1 with the origin of frame2.
template <class C, class A, class B, class Surface>
[[nodiscard]] constexpr auto point_contact_3D(const C& contact, const A& frame1, const B& frame2,
                                              const Surface& surface, const contact_law& law) {
  return sphere_contact_3D(contact, frame1, frame2, surface, 0.0, law);
}
/// A rigid contact of a half space of frame1 with the rim of a disc about the origin of frame2, of a unit axis, in axes
/// of frame2, and a radius, m. A disc that lies flat is refused.
template <class C, class A, class B, class X, class Y, class Z, entry Radius>
[[nodiscard]] constexpr auto disc_contact_3D(const C& contact, const A& frame1, const B& frame2,
                                             const half_space& surface, const vec3<X, Y, Z>& axis, const Radius& radius,
                                             const contact_law& law) {
  return detail::touching<kind::frame_3D>(
      core::disc_geometry{surface.in<kind::frame_3D>(), as<double>(axis), as<double>(radius)}, contact, frame1, frame2,
      law);
}

KTE_CALL(sphere_contact_2D, "(contact, frame1, frame2, surface, radius, law[, offset])")
KTE_CALL(sphere_contact_3D, "(contact, frame1, frame2, surface, radius, law[, offset])")
KTE_CALL(point_contact_2D, "(contact, frame1, frame2, surface, law)")
KTE_CALL(point_contact_3D, "(contact, frame1, frame2, surface, law)")
KTE_CALL(disc_contact_3D, "(contact, frame1, frame2, surface, axis, radius, law)")

}  // namespace kte
