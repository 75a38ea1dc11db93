#pragma once

#include <kte/elements/spring.hpp>
#include <kte/kernels/relative_turn.hpp>

namespace kte {

namespace core {

/// A linear spring of stiffness k against the relative rotation of two frames, at rest where frame 2 has the rotation
/// R_0 in frame 1; in the plane an angle:
///
///   r = rotation vector of R_1^T R_2 R_0^T                                           (1)
///   T_1 += k r,  T_2 -= k R_0^T r                                                    (2)
///
/// The torque is limited to the saturation torque, if any (zero: none); there is no force. r is the shortest rotation,
/// in the plane an angle in [-pi, pi]: at half a turn from rest the torque jumps by 2 pi k and changes its sign. The
/// scalar type needs an atan2.
template <kind Dim, class Stiffness, class Saturation, class Rest>
struct torsion_spring {
  static constexpr type_name type{"torsion_spring", Dim};
  static constexpr std::array<port, 2> ports{{{Dim, access::on, "anchor1"}, {Dim, access::on, "anchor2"}}};
  static constexpr bool reads_positions = true;

  Stiffness stiffness;
  Saturation saturation;
  Rest rest;  ///< an angle in the plane, a rotation in space

  template <class A, class B>
  KTE_INLINE constexpr auto doForce(const A& a, const B& b) const {
    const auto t = detail::limited_pull(stiffness, turn(a.rotation, b.rotation), saturation);
    if constexpr (Dim == kind::frame_3D) {
      return make_loads(wrench{zero3{}, t}, wrench{zero3{}, -(transpose(rest) * t)});  // (2)
    } else {
      return make_loads(wrench{zero3{}, t}, wrench{zero3{}, -t});
    }
  }
  /// J
  template <class A, class B>
  KTE_INLINE constexpr auto potential_energy(const A& a, const B& b) const {
    return detail::elastic_energy(turn(a.rotation, b.rotation), stiffness, saturation);
  }
  /// Zero where it saturates.
  template <class A, class B>
  KTE_INLINE constexpr auto switching(const A& a, const B& b) const {
    return detail::below_limit(stiffness * detail::to_polar(turn(a.rotation, b.rotation)).length, saturation);
  }
  constexpr void check(const parameter_check& where) const {
    where.not_negative(stiffness, "stiffness must be finite and not negative");
    where.not_negative(saturation, "saturation must be finite and not negative");
    if constexpr (Dim == kind::frame_3D) {
      where.rotation(rest, "rest rotation must be a rotation");
    } else {
      where.finite(rest, "rest angle must be finite");
    }
  }
  template <class Self, class Visit>
  static constexpr void parameters(Self& self, Visit&& visit) {
    visit("stiffness", self.stiffness);
    visit("saturation", self.saturation);
    if constexpr (Dim == kind::frame_2D) {
      visit("rest_angle", self.rest);
    } else if constexpr (!std::is_same_v<Rest, no_rotation>) {
      visit("rest_rotation", self.rest);
    }
  }

 private:
  template <class A, class B>
  KTE_INLINE constexpr auto turn(const A& a, const B& b) const {  // (1)
    const auto r = detail::relative_rotation<Dim>(a, b);
    if constexpr (Dim == kind::frame_3D) {
      return detail::turn_of(r * matrix(transpose(rest)));
    } else if constexpr (std::is_same_v<Rest, zero_t>) {
      return detail::turn_of(r);
    } else {
      using S = decltype(detail::turn_of(r).z);
      return detail::turn_of(r * transpose(rotation_by(as<S>(rest))));
    }
  }
};

}  // namespace core

/// A torsion spring between two frames in the plane: stiffness (Nm/rad), and optionally the torque at which it
/// saturates (Nm; `zero` for none) and the angle of the second frame relative to the first at rest (rad).
template <class F1, class F2, entry Stiffness, entry Saturation = zero_t, entry Rest = zero_t>
[[nodiscard]] constexpr auto torsion_spring_2D(const F1& anchor1, const F2& anchor2, const Stiffness& stiffness,
                                               const Saturation& saturation = {}, const Rest& rest_angle = {}) {
  using core_type = core::torsion_spring<kind::frame_2D, decltype(real(stiffness)), decltype(real(saturation)),
                                         decltype(real(rest_angle))>;
  return connect(core_type{real(stiffness), real(saturation), real(rest_angle)}, anchor1, anchor2);
}
/// A torsion spring between two frames in space: stiffness (Nm/rad), and optionally the torque at which it saturates
/// (Nm; `zero` for none) and the rotation of the second frame in the first at rest (a matrix, a quaternion,
/// `quarter_turn_x`; none if their axes are parallel).
template <class F1, class F2, entry Stiffness, entry Saturation = zero_t, class Rest = no_rotation>
[[nodiscard]] constexpr auto torsion_spring_3D(const F1& anchor1, const F2& anchor2, const Stiffness& stiffness,
                                               const Saturation& saturation = {}, const Rest& rest_rotation = {}) {
  using core_type = core::torsion_spring<kind::frame_3D, decltype(real(stiffness)), decltype(real(saturation)), Rest>;
  return connect(core_type{real(stiffness), real(saturation), rest_rotation}, anchor1, anchor2);
}

KTE_CALL(torsion_spring_2D, "(anchor1, anchor2, stiffness[, saturation[, rest_angle]])")
KTE_CALL(torsion_spring_3D, "(anchor1, anchor2, stiffness[, saturation[, rest_rotation]])")

}  // namespace kte
