#pragma once

#include <kte/contract/core_in_scalar.hpp>
#include <kte/contract/transmission.hpp>

#include <limits>

namespace kte {

namespace core {

/// The inertia of a rigid body of mass m, centre of mass c and inertia I about c, fixed to a frame (Newton-Euler):
///
///   a_c = a + al x c + w x (w x c)                       (1)
///   F -= m a_c                                           (2)
///   T -= I al + w x (I w) + c x (m a_c)                  (3)
template <kind Dim, class Mass, class Com, class Inertia>
struct inertia {
  static constexpr type_name type{"inertia", Dim};
  static constexpr std::array<port, 1> ports{{{Dim, access::in, "frame"}}};
  static constexpr const char* arguments = "body";
  static constexpr bool is_rigid_body = true;

  rigid_body<Mass, Com, Inertia> body;
  decltype(to_composite(rigid_body<Mass, Com, Inertia>{})) at_origin;  ///< the inertia about the origin of the frame

  inertia() = default;
  constexpr explicit inertia(const rigid_body<Mass, Com, Inertia>& b) : body(b), at_origin(composite_of(b)) {}

  template <class Frame>
  KTE_INLINE constexpr auto doForce(const Frame& x) const {
    const auto& [m, c, J, published] = body;
    const auto& w = x.ang_velocity;
    const auto& al = x.ang_acceleration;
    const auto a_c = plus_cross(plus_cross(x.acceleration, al, c), w, cross(w, c));  // (1)
    const auto f = (-m) * a_c;                                                       // (2)
    return make_loads(wrench{f, -plus_cross(plus_cross(J * al, w, J * w), f, c)});   // (3)
  }
  template <class Frame>
  KTE_INLINE constexpr auto kinetic_energy(const Frame& x) const {
    return kinetic_energy_of_body(body, x.velocity, x.ang_velocity);
  }
  /// The mass for the composite-rigid-body algorithm in scalars S. Scalars of more than double precision recompute it
  /// from the parameters.
  template <class S>
  KTE_INLINE constexpr auto mass() const {
    if constexpr (std::numeric_limits<S>::digits <= std::numeric_limits<double>::digits) {
      return at_origin;
    } else {
      return to_composite(lifted<S>(body));
    }
  }

  constexpr void check(const parameter_check& where) const {
    where.not_negative(body.mass, "mass must be finite and not negative");
    where.finite(body.com, "centre of mass must be finite");
    if (body.published) {
      where.finite(body.inertia, "inertia must be finite");
    } else if constexpr (Dim == kind::frame_2D) {
      where.not_negative(body.inertia.zz, "inertia must be finite and not negative");
    } else {
      where.physical(body);
    }
  }
  template <class Self, class Visit>
  static constexpr void parameters(Self& self, Visit&& visit) {
    visit("mass", self.body.mass);
    visit("com", self.body.com);
    visit("inertia", self.body.inertia);
    visit("as_published", self.body.published);
    if constexpr (!std::is_const_v<Self>) self.at_origin = to_composite(self.body);
  }

 private:
  static constexpr decltype(at_origin) composite_of(const rigid_body<Mass, Com, Inertia>& b) {
#if defined(__clang__)  // clang stops at arithmetic that gives NaN; `check` handles NaN
    if constexpr (!detail::has_packs_or_duals<rigid_body<Mass, Com, Inertia>>)
      if (std::is_constant_evaluated()) {
        parameter_check::breach broken;
        const parameter_check numbers{type, ports, {}, broken};
        numbers.finite(b.mass, ""), numbers.finite(b.com, ""), numbers.finite(b.inertia, "");
        if (broken.rule) return {};
      }
#endif
    return to_composite(b);
  }
};

/// The inertia of a coordinate, m in kg or kg m^2: f -= m q_ddot.
template <class Mass>
struct inertia_gen {
  static constexpr type_name type{"inertia", kind::gen};
  static constexpr std::array<port, 1> ports{{{kind::gen, access::in, "coordinate"}}};
  static constexpr bool is_rigid_body = true;

  Mass m;

  template <class C>
  KTE_INLINE constexpr auto doForce(const C& c) const {
    return make_loads((-m) * c.q_ddot);
  }
  /// m q_dot^2 / 2,  J
  template <class C>
  KTE_INLINE constexpr auto kinetic_energy(const C& c) const {
    return detail::half(m * (c.q_dot * c.q_dot));
  }
  template <class S>
  KTE_INLINE constexpr auto mass() const {
    return m;
  }

  constexpr void check(const parameter_check& where) const {
    where.not_negative(m, "mass must be finite and not negative");
  }
  template <class Self, class Visit>
  static constexpr void parameters(Self& self, Visit&& visit) {
    visit("mass", self.m);
  }
};

}  // namespace core

/// A rigid body in the plane, fixed to `frame`: `point_mass(1.0)`, `planar_body(2.0, 0.1)`.
template <class F, class M, class C, class I>
[[nodiscard]] constexpr auto inertia_2D(const F& frame, const rigid_body<M, C, I>& body) {
  return connect(core::inertia<kind::frame_2D, M, C, I>(body), frame);
}
/// A rigid body in space, fixed to `frame`: `rigid_body{mass, com, inertia}`, `point_mass(1.0)`. Its inertia must be
/// physically realizable: no principal moment exceeds the sum of the other two by more than 1e-9 of m |com|^2 + tr
/// inertia. `rigid_body{...}.as_published()` is not checked for this.
template <class F, class M, class C, class I>
[[nodiscard]] constexpr auto inertia_3D(const F& frame, const rigid_body<M, C, I>& body) {
  return connect(core::inertia<kind::frame_3D, M, C, I>(body), frame);
}
/// The inertia of a coordinate, kg or kg m^2.
template <class Q, variable M>
[[nodiscard]] constexpr auto inertia_gen(const Q& coordinate, const M& mass) {
  const auto m = real(mass);
  return connect(core::inertia_gen<std::remove_const_t<decltype(m)>>{m}, coordinate);
}

KTE_CALL(inertia_gen, "(coordinate, mass)")
KTE_CALL(inertia_2D, "(frame, body); a body is kte::point_mass(1.0) or kte::planar_body(2.0, 0.1)")
KTE_CALL(inertia_3D, "(frame, body); a body is kte::point_mass(1.0) or kte::rigid_body{mass, com, inertia}")

}  // namespace kte
