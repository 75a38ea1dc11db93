#pragma once

#include <kte/contract/transmission.hpp>

namespace kte {

namespace core {

/// The inertia of a straight uniform bar of mass m between the origins of two frames: the velocity along it is that of
/// its ends, linear in between, and the consistent mass matrix follows (Cook, Malkus, Plesha, Concepts and Applications
/// of Finite Element Analysis, section 13.3):
///
///   T = m/6 (v_1.v_1 + v_1.v_2 + v_2.v_2) + sum w_i . J w_i / 2          (1)
///   F_1 = -m/6 (2 a_1 + a_2),  F_2 = -m/6 (a_1 + 2 a_2)   in common axes (2)
///   T_i = -J al_i - w_i x J w_i                                          (3)
///
/// J: the rotary inertia of each half, in axes of its end. It may be nothing where the ends do not turn freely.
template <kind Dim, class Mass, class Inertia>
struct inertial_beam {
  static constexpr type_name type{"inertial_beam", Dim};
  static constexpr std::array<port, 2> ports{{{Dim, access::on, "anchor1"}, {Dim, access::on, "anchor2"}}};
  static constexpr bool reads_positions = true;
  static constexpr bool spreads_mass = true;

  Mass mass;
  Inertia inertia;

  template <class A, class B>
  KTE_INLINE constexpr auto mass_loads(const A& x, const B& y) const {
    return make_loads(wrench{force(x, y), -(inertia * x.ang_acceleration)},
                      wrench{force(y, x), -(inertia * y.ang_acceleration)});
  }
  template <class A, class B>
  KTE_INLINE constexpr auto doForce(const A& x, const B& y) const {
    return make_loads(wrench{force(x, y), torque(x)}, wrench{force(y, x), torque(y)});
  }
  template <class A, class B>
  KTE_INLINE constexpr auto kinetic_energy(const A& x, const B& y) const {
    const auto other = transpose(x.rotation) * (y.rotation * y.velocity);
    return sixth() * (dot(x.velocity, x.velocity) + dot(x.velocity, other) + dot(y.velocity, y.velocity)) +
           detail::half(dot(x.ang_velocity, inertia * x.ang_velocity) + dot(y.ang_velocity, inertia * y.ang_velocity));
  }
  template <class A, class B>
  KTE_INLINE constexpr auto first_moment(const A& x, const B& y) const {
    return detail::half(mass) * (x.position + y.position);
  }
  constexpr void check(const parameter_check& where) const {
    where.not_negative(mass, "mass must be finite and not negative");
    where.finite(inertia, "inertia must be finite");
  }
  template <class Self, class Visit>
  static constexpr void parameters(Self& self, Visit&& visit) {
    visit("mass", self.mass), visit("inertia", self.inertia);
  }

 private:
  KTE_INLINE constexpr auto sixth() const { return detail::half(mass) / decltype(detail::half(mass))(3); }
  /// (2), on x.
  template <class A, class B>
  KTE_INLINE constexpr auto force(const A& x, const B& y) const {
    const auto other = transpose(x.rotation) * (y.rotation * y.acceleration);
    return (-sixth()) * (x.acceleration + x.acceleration + other);
  }
  template <class A>
  KTE_INLINE constexpr auto torque(const A& x) const {
    return -plus_cross(inertia * x.ang_acceleration, x.ang_velocity, inertia * x.ang_velocity);  // (3)
  }
};

}  // namespace core

/// The inertia of a uniform bar between two frames in the plane: its mass, kg, and on request the rotary inertia of
/// each half, kg m^2, at its end.
template <class F1, class F2, variable M, entry J = zero_t>
constexpr auto inertial_beam_2D(const F1& anchor1, const F2& anchor2, const M& mass, const J& inertia = {}) {
  const auto m = real(mass);
  const sym3 about{zero, zero, zero, zero, zero, real(inertia)};
  return connect(
      core::inertial_beam<kind::frame_2D, std::remove_const_t<decltype(m)>, std::remove_const_t<decltype(about)>>{
          m, about},
      anchor1, anchor2);
}
/// The same in space; the rotary inertia of each half in axes of its end.
template <class F1, class F2, variable M, class Inertia = decltype(diagonal(zero, zero, zero))>
constexpr auto inertial_beam_3D(const F1& anchor1, const F2& anchor2, const M& mass, const Inertia& inertia = {}) {
  const auto m = real(mass);
  return connect(core::inertial_beam<kind::frame_3D, std::remove_const_t<decltype(m)>, Inertia>{m, inertia}, anchor1,
                 anchor2);
}

KTE_CALL(inertial_beam_2D, "(anchor1, anchor2, mass[, inertia])")
KTE_CALL(inertial_beam_3D, "(anchor1, anchor2, mass[, inertia])")

namespace detail {
/// How model files make them.
struct inertial_beam_family {
  template <class Add>
  static void add_to(const Add& add) {
    add(
        "inertial_beam_2D",
        [](const auto& x) {
          const auto i = x.symmetric("inertia");
          if (i.xx != 0 || i.xy != 0 || i.xz != 0 || i.yy != 0 || i.yz != 0) x.fail("has inertia out of the plane");
          return inertial_beam_2D(x.name("anchor1"), x.name("anchor2"), x.number("mass"), i.zz);
        },
        "mass, inertia.zz");
    add("inertial_beam_3D", [](const auto& x) {
      return inertial_beam_3D(x.name("anchor1"), x.name("anchor2"), x.number("mass"), x.symmetric("inertia"));
    });
  }
};
}  // namespace detail

}  // namespace kte
