#pragma once

#include <kte/elements/spring.hpp>

namespace kte {

namespace core {

/// The parameters of a damper.
template <class Damping>
struct damper_parameters {
  Damping damping;

  constexpr void check(const parameter_check& where) const {
    where.not_negative(damping, "damping must be finite and not negative");
  }
  template <class Self, class Visit>
  static constexpr void parameters(Self& self, Visit&& visit) {
    visit("damping", self.damping);
  }
};

/// A linear damper between two coordinates, of damping c, N s/m or Nm s/rad:
///
///   s = c (q_dot_2 - q_dot_1)           (1)
///   f_1 += s,  f_2 -= s                 (2)
template <class Damping>
struct damper_gen : damper_parameters<Damping> {
  static constexpr type_name type{"damper", kind::gen};
  static constexpr std::array<port, 2> ports{{{kind::gen, access::on, "anchor1"}, {kind::gen, access::on, "anchor2"}}};

  template <class C1, class C2>
  KTE_INLINE constexpr auto doForce(const C1& c1, const C2& c2) const {
    const auto s = this->damping * (c2.q_dot - c1.q_dot);  // (1)
    return make_loads(s, -s);                              // (2)
  }
};

/// A linear damper between the origins of two frames, of damping c, N s/m, along the line through them:
///
///   d = p_2 - p_1,  D = |d|,  e_i = R_i^T d/D           (1)
///   D_dot = e_2 . v_2 - e_1 . v_1                       (2)
///   F_1 += c D_dot e_1,  F_2 -= c D_dot e_2             (3)
///
/// There is no torque. Where the origins coincide, the line is undefined and the force is zero.
template <kind Dim, class Damping>
struct damper : damper_parameters<Damping> {
  static constexpr type_name type{"damper", Dim};
  static constexpr std::array<port, 2> ports{{{Dim, access::on, "anchor1"}, {Dim, access::on, "anchor2"}}};
  static constexpr bool reads_positions = true;

  template <class A, class B>
  KTE_INLINE constexpr auto doForce(const A& a, const B& b) const {
    const auto e = detail::to_polar(b.position - a.position).direction;
    const auto e_1 = transpose(a.rotation) * e, e_2 = transpose(b.rotation) * e;   // (1)
    const auto s = this->damping * (dot(e_2, b.velocity) - dot(e_1, a.velocity));  // (2)
    return make_loads(wrench{s * e_1, zero3{}}, wrench{-(s * e_2), zero3{}});      // (3)
  }
};

}  // namespace core

/// A damper between two coordinates: damping, N s/m or Nm s/rad.
template <class Q1, class Q2, entry Damping>
[[nodiscard]] constexpr auto damper_gen(const Q1& anchor1, const Q2& anchor2, const Damping& damping) {
  return connect(core::damper_gen<decltype(real(damping))>{{real(damping)}}, anchor1, anchor2);
}
/// A damper between the origins of two frames in the plane: damping, N s/m.
template <class F1, class F2, entry Damping>
[[nodiscard]] constexpr auto damper_2D(const F1& anchor1, const F2& anchor2, const Damping& damping) {
  return connect(core::damper<kind::frame_2D, decltype(real(damping))>{{real(damping)}}, anchor1, anchor2);
}
/// A damper between the origins of two frames in space: damping, N s/m.
template <class F1, class F2, entry Damping>
[[nodiscard]] constexpr auto damper_3D(const F1& anchor1, const F2& anchor2, const Damping& damping) {
  return connect(core::damper<kind::frame_3D, decltype(real(damping))>{{real(damping)}}, anchor1, anchor2);
}

KTE_CALL(damper_gen, "(anchor1, anchor2, damping)")
KTE_CALL(damper_2D, "(anchor1, anchor2, damping)")
KTE_CALL(damper_3D, "(anchor1, anchor2, damping)")

}  // namespace kte
