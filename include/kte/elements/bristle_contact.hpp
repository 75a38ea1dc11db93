#pragma once

#include <kte/elements/compliant_contact.hpp>

namespace kte {

/// Parameters of a compliant contact with friction by bristles.
struct bristle_contact_parameters {
  double stiffness;            ///< k, N/m^p; positive
  double exponent = 1.5;       ///< p, not below 1: 1 linear, 1.5 Hertz
  double dissipation = 0;      ///< c, s/m; not negative
  double friction;             ///< coefficient mu, positive
  double slip_speed = 1e-3;    ///< v_s, m/s; positive
  double bristle_stiffness;    ///< sigma_0, 1/m; positive
  double bristle_damping = 0;  ///< sigma_1, s/m; not negative
};

namespace core {

/// A compliant contact that sticks: `compliant_contact` with bristles between the surfaces, deflected by z, m. These
/// are internal states, three numbers in axes of frame 1 in space, one along (n.y, -n.x) in the plane. With the part
/// z_t of z normal to n, in contact:
///
///   z_dot = u_t - sigma_0 |u_t| z/mu                                                          (1)
///   lambda_t = -lambda_n (sigma_0 z_t + sigma_1 z_dot/(1 + u_t.u_t/v_s^2))                    (2)
///
/// A body at rest stays within |z| <= mu/sigma_0; sliding has the friction mu lambda_n. Without contact z is constant,
/// and events of the element (`element_events`) set it to 0 where contact begins or ends. The system is stiff: its
/// rates are those of `compliant_contact`, about sqrt(sigma_0 lambda_n/m), and sigma_0 |u_t|/mu.
///
/// Canudas de Wit, Olsson, Astrom and Lischinsky, A new model for control of systems with friction, IEEE Trans.
/// Automatic Control 40 (1995), with a load and with damping that fades in sliding.
template <kind Dim, class Geometry>
struct bristle_contact : compliant_normal_force<Dim, Geometry, bristle_contact_parameters> {
  static constexpr type_name type{Geometry::bristle_name, Dim};
  static constexpr auto ports = [] {
    constexpr port first{Dim, access::on, "frame1"}, second{Dim, access::on, "frame2"};
    if constexpr (Dim == kind::frame_2D)
      return std::array<port, 3>{{first, second, {kind::internal, access::keep, "bristles"}}};
    else
      return std::array<port, 5>{{first,
                                  second,
                                  {kind::internal, access::keep, "bristles_x"},
                                  {kind::internal, access::keep, "bristles_y"},
                                  {kind::internal, access::keep, "bristles_z"}}};
  }();

  template <class A, class B, class... Z>
  KTE_INLINE constexpr auto z_dot(const A& a, const B& b, const Z&... z) const {
    const auto m = detail::motion_between(a, b);
    using S = std::remove_cvref_t<decltype(m.position.x + (detail::as_number(z) + ...))>;
    if (all(this->geometry.gap(m) > 0)) return rates(vec3<S>{}, vec3<S>{});
    const auto x = state_of<S>(m, z...);
    return rates(x.rate, x.axis);
  }
  template <class A, class B, class... Z>
  KTE_INLINE constexpr auto doForce(const A& a, const B& b, const Z&... z) const {
    const auto m = detail::motion_between(a, b);
    using S = std::remove_cvref_t<decltype(m.position.x + (detail::as_number(z) + ...))>;
    if (all(this->geometry.gap(m) > 0)) return detail::loads_at_contact<Dim>(m, vec3<S>{}, vec3<S>{});
    const auto x = state_of<S>(m, z...);
    const auto& law = this->p;
    const S pressure =
        detail::hunt_crossley(S(this->geometry.gap(m)), x.closing, law.stiffness, law.exponent, law.dissipation);
    const S fading = S(S(law.bristle_damping) / (S(1) + x.square / S(law.slip_speed * law.slip_speed)));
    const vec3<S> held =
        as<S>(S(law.bristle_stiffness) * across(x.bristles, x.normal) + fading * across(x.rate, x.normal));
    return detail::loads_at_contact<Dim>(m, as<S>(pressure * (x.normal - held)),
                                         as<S>(this->geometry.point(m)));  // (2)
  }
  /// New contacts begin without deflection.
  template <class A, class B, class... Z>
  constexpr auto switched(const A&, const B&, const Z&... z) const {
    return make_rates(std::remove_cvref_t<decltype(detail::as_number(z))>(0)...);
  }
  constexpr void check(const parameter_check& where) const {
    compliant_normal_force<Dim, Geometry, bristle_contact_parameters>::check(where);
    where.positive(this->p.friction, "friction must be finite and positive");
    where.positive(this->p.bristle_stiffness, "bristle_stiffness must be finite and positive");
    where.not_negative(this->p.bristle_damping, "bristle_damping must be finite and not negative");
  }
  template <class Self, class Visit>
  static constexpr void parameters(Self& self, Visit&& visit) {
    compliant_normal_force<Dim, Geometry, bristle_contact_parameters>::parameters(self, visit);
    visit("bristle_stiffness", self.p.bristle_stiffness), visit("bristle_damping", self.p.bristle_damping);
  }

 private:
  template <class S>
  struct contact_state {
    S closing, square;  ///< g_dot, u_t.u_t
    vec3<S> normal, axis, bristles, rate;
  };
  template <class S>
  KTE_INLINE static constexpr vec3<S> across(const vec3<S>& v, const vec3<S>& n) {
    return as<S>(v - dot(n, v) * n);
  }
  template <class S, class M, class... Z>
  KTE_INLINE constexpr contact_state<S> state_of(const M& m, const Z&... z) const {
    contact_state<S> x{};
    x.normal = as<S>(this->geometry.normal(m));
    x.axis = {x.normal.y, S(-x.normal.x), S(0)};
    if constexpr (Dim == kind::frame_2D)
      x.bristles = as<S>((as<S>(z) * ...) * x.axis);
    else
      x.bristles = vec3<S>{as<S>(z)...};
    const auto u = as<S>(this->geometry.slip(m));
    x.closing = dot(x.normal, u);
    const auto along = across(u, x.normal);
    x.square = dot(along, along);
    const S speed = detail::to_polar(along).length, k = S(this->p.bristle_stiffness / this->p.friction);
    x.rate = as<S>(along - S(k * speed) * x.bristles);  // (1)
    return x;
  }
  template <class S>
  KTE_INLINE static constexpr auto rates(const vec3<S>& rate, [[maybe_unused]] const vec3<S>& axis) {
    if constexpr (Dim == kind::frame_2D)
      return make_rates(S(dot(rate, axis)));
    else
      return make_rates(rate.x, rate.y, rate.z);
  }
};

}  // namespace core

namespace detail {
template <kind Dim, class Geometry, class A, class B, class... Z>
constexpr auto bristled(const Geometry& g, const bristle_contact_parameters& p, const A& frame1, const B& frame2,
                        const Z&... bristles) {
  return connect(core::bristle_contact<Dim, Geometry>{{g, p}}, frame1, frame2, bristles...);
}
}  // namespace detail

/// A compliant contact in the plane with friction by bristles, whose deflection is the internal state `bristles`:
///
///   bristle_contact_2D(ground, tip, hairs, half_space{}, 0.02,
///                      {.stiffness = 1e6, .dissipation = 0.5, .friction = 0.7, .bristle_stiffness = 1e4,
///                       .bristle_damping = 30.0})
template <class A, class B, class Z, class Surface, entry Radius>
[[nodiscard]] constexpr auto bristle_contact_2D(const A& frame1, const B& frame2, const Z& bristles,
                                                const Surface& surface, const Radius& radius,
                                                const bristle_contact_parameters& p) {
  return detail::bristled<kind::frame_2D>(detail::sphere_on<kind::frame_2D>(surface, as<double>(radius), {}), p, frame1,
                                          frame2, bristles);
}
template <class A, class B, class Z, class Surface, class Offset, entry Radius>
[[nodiscard]] constexpr auto bristle_contact_2D(const A& frame1, const B& frame2, const Z& bristles,
                                                const Surface& surface, const Radius& radius,
                                                const bristle_contact_parameters& p, const Offset& offset) {
  return detail::bristled<kind::frame_2D>(
      detail::sphere_on<kind::frame_2D>(surface, as<double>(radius), as<double>(detail::planar(offset))), p, frame1,
      frame2, bristles);
}
/// A compliant contact in space with friction by bristles, whose deflection is three internal states.
template <class A, class B, class ZX, class ZY, class ZZ, class Surface, entry Radius>
[[nodiscard]] constexpr auto bristle_contact_3D(const A& frame1, const B& frame2, const ZX& bristles_x,
                                                const ZY& bristles_y, const ZZ& bristles_z, const Surface& surface,
                                                const Radius& radius, const bristle_contact_parameters& p) {
  return detail::bristled<kind::frame_3D>(detail::sphere_on<kind::frame_3D>(surface, as<double>(radius), {}), p, frame1,
                                          frame2, bristles_x, bristles_y, bristles_z);
}
template <class A, class B, class ZX, class ZY, class ZZ, class Surface, class X, class Y, class Z, entry Radius>
[[nodiscard]] constexpr auto bristle_contact_3D(const A& frame1, const B& frame2, const ZX& bristles_x,
                                                const ZY& bristles_y, const ZZ& bristles_z, const Surface& surface,
                                                const Radius& radius, const bristle_contact_parameters& p,
                                                const vec3<X, Y, Z>& offset) {
  return detail::bristled<kind::frame_3D>(
      detail::sphere_on<kind::frame_3D>(surface, as<double>(radius), as<double>(offset)), p, frame1, frame2, bristles_x,
      bristles_y, bristles_z);
}

KTE_CALL(bristle_contact_2D, "(frame1, frame2, bristles, surface, radius, parameters[, offset])")
KTE_CALL(bristle_contact_3D,
         "(frame1, frame2, bristles_x, bristles_y, bristles_z, surface, radius, parameters[, offset])")

}  // namespace kte
