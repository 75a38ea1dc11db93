#pragma once

#include <kte/elements/spring.hpp>
#include <kte/math/quaternion.hpp>

namespace kte {

namespace detail {

/// Axis times angle of a rotation matrix, the angle in [0, pi], without a branch and without NaN for no rotation, also
/// in derivatives. With the quaternion q = (w, u) of R, 4 q q^T is made of sums of entries of R; its row of the largest
/// diagonal entry is a multiple of q that keeps all digits (Shepperd, J. Guidance and Control 1, 1978), and multiples
/// do not matter in
///
///   r = 2 atan2(|u|, w)/|u| u,  for u = 0  2/w u                    (1)
template <class RX, class RY, class RZ>
KTE_INLINE constexpr auto turn_of(const mat3<RX, RY, RZ>& rotation) {
  using std::atan2;
  using std::sqrt;
  using S =
      decltype(as_number(dot(rotation.x, rotation.x) + dot(rotation.y, rotation.y) + dot(rotation.z, rotation.z)));
  const auto m = as<S>(rotation);
  const S a = m.x.x, b = m.y.y, c = m.z.z;
  const S wx = m.z.y - m.y.z, wy = m.x.z - m.z.x, wz = m.y.x - m.x.y;
  const S xy = m.x.y + m.y.x, yz = m.y.z + m.z.y, zx = m.z.x + m.x.z;
  const S ww = S(1) + a + b + c, xx = S(1) + a - b - c, yy = S(1) + b - c - a, zz = S(1) + c - a - b;
  struct row {
    S diagonal, w;
    vec3<S> u;
  };
  const auto larger = [](const row& p, const row& other) KTE_INLINE_LAMBDA {
    const auto second = other.diagonal > p.diagonal;
    const auto of = [&second](const S& x, const S& y) KTE_INLINE_LAMBDA { return S(select(second, y, x)); };
    return row{of(p.diagonal, other.diagonal),
               of(p.w, other.w),
               {of(p.u.x, other.u.x), of(p.u.y, other.u.y), of(p.u.z, other.u.z)}};
  };
  const row largest = larger(larger(row{ww, ww, {wx, wy, wz}}, row{xx, wx, {xx, xy, zx}}),
                             larger(row{yy, wy, {xy, yy, yz}}, row{zz, wz, {zx, yz, zz}}));
  const S sign = select(largest.w < S(0), S(-1), S(1));  // of the two quaternions, the one with w >= 0
  const S w = sign * largest.w, square = dot(largest.u, largest.u);
  const auto none = square == S(0);
  const S n = sqrt(select(none, S(1), square));
  const S k = S(2) * sign * select(none, S(1), S(atan2(n, w))) / select(none, w, n);  // (1)
  return vec3<S>{k * largest.u.x, k * largest.u.y, k * largest.u.z};
}

/// The same of a rotation about z: an angle in [-pi, pi].
template <class C, class S>
KTE_INLINE constexpr auto turn_of(const rotation_2D<C, S>& r) {
  using std::atan2;
  using T = decltype(as_number(r.cos * r.cos + r.sin * r.sin));
  return vec3{zero, zero, T(atan2(as<T>(r.sin), as<T>(r.cos)))};
}

}  // namespace detail

namespace core {

/// A linear spring against the rotation of two frames against each other, of stiffness k and, in the plane, rest angle
/// L:
///
///   r = axis times angle of R_1^T R_2, in the plane that times a turn by -L          (1)
///   T_1 += k r,  T_2 -= k r                                                          (2)
///
/// limited to the saturation torque where there is one (zero: none); no force. r has the same components in the axes
/// of both frames. It is the shortest turn, in the plane an angle in [-pi, pi]: at half a turn from rest the torque
/// changes its sign, a jump by 2 pi k. The scalar needs an atan2; a pack without one does not compile.
template <kind Dim, class Stiffness, class Saturation, class Rest>
struct torsion_spring {
  static constexpr type_name type{"torsion_spring", Dim};
  static constexpr std::array<port, 2> ports{{{Dim, access::on, "anchor1"}, {Dim, access::on, "anchor2"}}};
  static constexpr bool reads_positions = true;

  Stiffness stiffness;
  Saturation saturation;
  Rest rest_angle;

  template <class A, class B>
  KTE_INLINE constexpr auto doForce(const A& a, const B& b) const {
    const auto t = detail::limited_pull(stiffness, turn(a.rotation, b.rotation), saturation);
    return make_loads(wrench{zero3{}, t}, wrench{zero3{}, -t});  // (2)
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
    where.finite(rest_angle, "rest angle must be finite");
  }
  template <class Self, class Visit>
  static constexpr void parameters(Self& self, Visit&& visit) {
    visit("stiffness", self.stiffness);
    visit("saturation", self.saturation);
    if constexpr (Dim == kind::frame_2D) visit("rest_angle", self.rest_angle);
  }

 private:
  template <class A, class B>
  KTE_INLINE constexpr auto turn(const A& a, const B& b) const {  // (1)
    if constexpr (Dim == kind::frame_3D) {
      return detail::turn_of(transpose(matrix(a)) * matrix(b));
    } else {
      const auto r = transpose(a) * b * rotation_2D{one, zero};
      if constexpr (std::is_same_v<Rest, zero_t>) {
        return detail::turn_of(r);
      } else {
        using S = decltype(detail::turn_of(r).z);
        return detail::turn_of(r * transpose(rotation_by(as<S>(rest_angle))));
      }
    }
  }
};

}  // namespace core

/// A torsion spring between two frames in the plane: stiffness (Nm/rad), and optionally the torque at which it
/// saturates (Nm; `zero` for none) and the angle of the second frame relative to the first at rest (rad).
template <class F1, class F2, entry Stiffness, entry Saturation = zero_t, entry Rest = zero_t>
constexpr auto torsion_spring_2D(const F1& anchor1, const F2& anchor2, const Stiffness& stiffness,
                                 const Saturation& saturation = {}, const Rest& rest_angle = {}) {
  using core_type = core::torsion_spring<kind::frame_2D, decltype(real(stiffness)), decltype(real(saturation)),
                                         decltype(real(rest_angle))>;
  return connect(core_type{real(stiffness), real(saturation), real(rest_angle)}, anchor1, anchor2);
}
/// A torsion spring between two frames in space, at rest where their axes are parallel: stiffness (Nm/rad), and
/// optionally the torque at which it saturates (Nm).
template <class F1, class F2, entry Stiffness, entry Saturation = zero_t>
constexpr auto torsion_spring_3D(const F1& anchor1, const F2& anchor2, const Stiffness& stiffness,
                                 const Saturation& saturation = {}) {
  using core_type = core::torsion_spring<kind::frame_3D, decltype(real(stiffness)), decltype(real(saturation)), zero_t>;
  return connect(core_type{real(stiffness), real(saturation), zero}, anchor1, anchor2);
}

KTE_CALL(torsion_spring_2D, "(anchor1, anchor2, stiffness[, saturation[, rest_angle]])")
KTE_CALL(torsion_spring_3D, "(anchor1, anchor2, stiffness[, saturation])")

namespace detail {
/// How model files make them.
struct torsion_spring_family {
  template <class Add>
  static void add_to(const Add& add) {
    add("torsion_spring_2D", [](const auto& x) {
      return torsion_spring_2D(x.name("anchor1"), x.name("anchor2"), x.number("stiffness"), x.number("saturation"),
                               x.number("rest_angle"));
    });
    add("torsion_spring_3D", [](const auto& x) {
      return torsion_spring_3D(x.name("anchor1"), x.name("anchor2"), x.number("stiffness"), x.number("saturation"));
    });
  }
};
}  // namespace detail

}  // namespace kte
