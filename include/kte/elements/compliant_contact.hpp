#pragma once

#include <kte/contact/contact_geometry.hpp>
#include <kte/contact/disc_geometry.hpp>
#include <kte/contract/contact_between.hpp>
#include <kte/kernels/force_laws.hpp>

namespace kte {

/// Parameters of a compliant contact.
struct compliant_contact_parameters {
  double stiffness;          ///< k, N/m^p; positive
  double exponent = 1.5;     ///< p, not below 1: 1 linear, 1.5 Hertz
  double dissipation = 0;    ///< c, s/m; not negative
  double friction = 0;       ///< coefficient mu, not negative
  double slip_speed = 1e-3;  ///< v_s, m/s; positive
};

namespace core {

/// The normal force of a compliant contact: the law, its energy, its event and its parameters, those of a `Geometry`
/// (contact/contact_geometry.hpp) and of `Parameters`.
template <kind Dim, class Geometry, class Parameters>
struct compliant_normal_force {
  static constexpr bool reads_positions = true;
  static constexpr bool holds_code = requires { requires Geometry::surface_type::holds_code; };
  static constexpr bool may_have_no_value = true;
  static constexpr std::array<std::string_view, 5> optional_parameters{"offset", "exponent", "dissipation", "friction",
                                                                       "slip_speed"};

  Geometry geometry{};
  Parameters p{};

  /// J
  template <class A, class B, class... Kept>
  KTE_INLINE constexpr auto potential_energy(const A& a, const B& b, const Kept&...) const {
    const auto m = detail::motion_between(a, b);
    return detail::hertz_energy(geometry.gap(m), p.stiffness, p.exponent);
  }
  /// The penetration, m: zero where the bodies touch.
  template <class A, class B, class... Kept>
  KTE_INLINE constexpr auto switching(const A& a, const B& b, const Kept&...) const {
    const auto gap = geometry.gap(detail::motion_between(a, b));
    return std::remove_cvref_t<decltype(gap)>(-gap);
  }
  constexpr void check(const parameter_check& where) const {
    geometry.check(where);
    where.positive(p.stiffness, "stiffness must be finite and positive");
    where.finite(p.exponent, "exponent must be finite and not below 1");
    where.require(p.exponent >= 1, "exponent must be finite and not below 1", p.exponent);
    where.not_negative(p.dissipation, "dissipation must be finite and not negative");
    where.not_negative(p.friction, "friction must be finite and not negative");
    where.positive(p.slip_speed, "slip_speed must be finite and positive");
  }
  template <class Self, class Visit>
  static constexpr void parameters(Self& self, Visit&& visit) {
    Geometry::parameters(self.geometry, visit);
    visit("stiffness", self.p.stiffness), visit("exponent", self.p.exponent);
    visit("dissipation", self.p.dissipation), visit("friction", self.p.friction);
    visit("slip_speed", self.p.slip_speed);
  }
};

/// A compliant contact of a sphere, a point or the rim of a disc of frame 2 with a surface of frame 1. With the gap g,
/// the normal n, the point c and the relative velocity u, u_t = u - n (n.u), of contact/contact_geometry.hpp:
///
///   delta = max(0, -g),   lambda_n = max(0, k delta^p (1 - c g_dot))           (1)
///   lambda_t = -mu lambda_n u_t / sqrt(u_t.u_t + v_s^2)                        (2)
///
/// The force n lambda_n + lambda_t acts on frame 2 at c, the opposite on frame 1 at the same point. A body that should
/// stick creeps, at about v_s times the force over its largest value; take `bristle_contact` if that matters. The
/// system is stiff: its rates are about sqrt(k_n/m), with the slope k_n of (1), and mu lambda_n/(m v_s).
///
/// (1) is the law of Hunt and Crossley, Coefficient of restitution interpreted as damping in vibroimpact, J. Applied
/// Mechanics 42 (1975). Its restitution e depends on the speed v of the impact:
///
///   c v (1 + e) = ln((1 + c v)/(1 - e c v))          (3)
template <kind Dim, class Geometry>
struct compliant_contact : compliant_normal_force<Dim, Geometry, compliant_contact_parameters> {
  static constexpr type_name type{Geometry::compliant_name, Dim};
  static constexpr const char* arguments =
      std::is_same_v<Geometry, disc_geometry>
          ? "{normal}, axis, radius, {stiffness, exponent, dissipation, friction, slip_speed}"
          : "{surface_axis, surface_radius}, radius, {stiffness, exponent, dissipation, friction, slip_speed}, offset";
  static constexpr std::array<port, 2> ports{{{Dim, access::on, "frame1"}, {Dim, access::on, "frame2"}}};

  template <class A, class B>
  KTE_INLINE constexpr auto doForce(const A& a, const B& b) const {
    const auto m = detail::motion_between(a, b);
    const auto gap = this->geometry.gap(m);
    using S = std::remove_cvref_t<decltype(m.position.x)>;
    if (all(gap > S(0))) return detail::loads_at_contact<Dim>(m, vec3<S>{}, vec3<S>{});
    const auto& law = this->p;
    const auto u = as<S>(this->geometry.slip(m)), n = as<S>(this->geometry.normal(m));
    const S closing = dot(n, u),
            pressure = detail::hunt_crossley(S(gap), closing, law.stiffness, law.exponent, law.dissipation);
    const vec3<S> along = u - closing * n;
    using std::sqrt;
    const S smooth = S(sqrt(S(dot(along, along) + S(law.slip_speed * law.slip_speed))));
    const vec3<S> force = as<S>(pressure * n - S(S(law.friction) * pressure / smooth) * along);  // (1), (2)
    return detail::loads_at_contact<Dim>(m, force, as<S>(this->geometry.point(m)));
  }
};

}  // namespace core

namespace detail {
template <kind Dim, class Geometry, class A, class B>
constexpr auto compliant(const Geometry& g, const A& frame1, const B& frame2, const compliant_contact_parameters& p) {
  return connect(core::compliant_contact<Dim, Geometry>{{g, p}}, frame1, frame2);
}
}  // namespace detail

/// A compliant contact, in the plane, of a surface of frame1 with a circle of a radius, m (0: a point), about the
/// origin of frame2, or about the point `offset` of it, m:
///
///   compliant_contact_2D(ground, tip, half_space{}, 0.02,
///                        {.stiffness = 1e6, .dissipation = 0.5, .friction = 0.7, .slip_speed = 1e-3})
template <class A, class B, class Surface = contact_surface, entry Radius = double>
[[nodiscard]] constexpr auto compliant_contact_2D(const A& frame1, const B& frame2, const Surface& surface,
                                                  const Radius& radius, const compliant_contact_parameters& p) {
  return detail::compliant<kind::frame_2D>(detail::sphere_on<kind::frame_2D>(surface, as<double>(radius), {}), frame1,
                                           frame2, p);
}
template <class A, class B, class Surface = contact_surface, class Offset, entry Radius = double>
[[nodiscard]] constexpr auto compliant_contact_2D(const A& frame1, const B& frame2, const Surface& surface,
                                                  const Radius& radius, const compliant_contact_parameters& p,
                                                  const Offset& offset) {
  return detail::compliant<kind::frame_2D>(
      detail::sphere_on<kind::frame_2D>(surface, as<double>(radius), as<double>(detail::planar(offset))), frame1,
      frame2, p);
}
/// A compliant contact, in space, of a surface of frame1 with a sphere of a radius, m (0: a point), about the origin of
/// frame2, or about the point `offset` of it, m. Surfaces: `half_space`, `ball_surface`, `bowl_surface`,
/// `cylinder_surface`, `height_field`, `surface`.
template <class A, class B, class Surface = contact_surface, entry Radius = double>
[[nodiscard]] constexpr auto compliant_contact_3D(const A& frame1, const B& frame2, const Surface& surface,
                                                  const Radius& radius, const compliant_contact_parameters& p) {
  return detail::compliant<kind::frame_3D>(detail::sphere_on<kind::frame_3D>(surface, as<double>(radius), {}), frame1,
                                           frame2, p);
}
template <class A, class B, class Surface = contact_surface, class X, class Y, class Z, entry Radius = double>
[[nodiscard]] constexpr auto compliant_contact_3D(const A& frame1, const B& frame2, const Surface& surface,
                                                  const Radius& radius, const compliant_contact_parameters& p,
                                                  const vec3<X, Y, Z>& offset) {
  return detail::compliant<kind::frame_3D>(
      detail::sphere_on<kind::frame_3D>(surface, as<double>(radius), as<double>(offset)), frame1, frame2, p);
}
/// A compliant contact of a half space of frame1 with the rim of a disc about the origin of frame2, of a unit axis, in
/// axes of frame2, and a radius, m. A disc that lies flat is refused where it touches.
template <class A, class B, class X, class Y, class Z, entry Radius>
[[nodiscard]] constexpr auto compliant_disc_contact_3D(const A& frame1, const B& frame2, const half_space& surface,
                                                       const vec3<X, Y, Z>& axis, const Radius& radius,
                                                       const compliant_contact_parameters& p) {
  return detail::compliant<kind::frame_3D>(
      core::disc_geometry{surface.in<kind::frame_3D>(), as<double>(axis), as<double>(radius)}, frame1, frame2, p);
}

KTE_CALL(compliant_contact_2D, "(frame1, frame2, surface, radius, parameters[, offset])")
KTE_CALL(compliant_contact_3D, "(frame1, frame2, surface, radius, parameters[, offset])")
KTE_CALL(compliant_disc_contact_3D, "(frame1, frame2, surface, axis, radius, parameters)")

}  // namespace kte
