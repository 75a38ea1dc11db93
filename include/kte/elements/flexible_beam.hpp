#pragma once

#include <kte/elements/spring.hpp>
#include <kte/kernels/midway.hpp>
#include <kte/math/beam_section.hpp>

namespace kte {

namespace core {

/// A slender massless beam between two frames, along the x axes of both at its ends, straight at rest with length L.
/// Its ends may move and rotate by any amount; its strains are small. In axes halfway between the frames
/// (kernels/midway.hpp), frame 2 is at d from frame 1, with D = |d|, and rotated by r: bending r_y, r_z and torsion
/// r_x. The line between its ends makes an angle with the axis x, measured as twice the tangent of half the angle (1).
/// Part of it is due to a helix of uniform bending and torsion (2). The rest is
///
///   s_z = 2 d_y / (D + d_x) - r_x r_y / 24,  s_y = -2 d_z / (D + d_x) + r_x r_z / 24         (1), (2)
///
/// S-shaped bending, and shear: f_z = 12 EI_z / (GA_y L^2), likewise f_y; 0 if rigid in shear.
/// With K = diag(GJ, EI_y, EI_z), curvature varies along the beam by -12 c/L^2 about its mean rho/L, where
///
///   rho = r - r_0 + r x c                                                                     (3)
///   e = (D - L)/L + (r_y^2 + r_z^2)/24 + s_y^2 / (10 (1 + f_y)^2) + s_z^2 / (10 (1 + f_z)^2)  (4)
///   V = L EA e^2 / 2 + rho . K rho / (2 L) + 6/L c . K c
///         + 6/L (EI_y (s_y - c_y)^2 / f_y + EI_z (s_z - c_z)^2 / f_z)                         (5)
///
/// and c minimizes V without its e term, which is a linear equation. In the plane c = s_z/(1 + f_z). r_0 is r at rest,
/// for a beam that is an arc or a helix at rest; its length is then L, up to a strain of about |r_0|^4/2000.
///
/// The loads are the gradients of V. For small motions they are those of the linear beam, 12 EI/L^3 and so on. An axial
/// force N adds N L/12 and N L/5 to the stiffnesses in r and s, so a tensioned beam is stiff like a string and a
/// compressed one buckles. An end moment bends the beam to an arc of the exact angle. Exchanging the frames changes
/// nothing. The error of n beams in series is proportional to 1/n^4.
///
/// At half a turn between the ends, r and the torque jump, as for any rotational spring. As the line between the ends
/// turns back onto the frames, with d along -x, V grows without bound.
///
/// (1) to (3) are the first terms of the Magnus series of a rod of linearly varying curvature
/// (docs/decisions/19-beams.md). The approach is that of Crisfield, A consistent co-rotational formulation for
/// non-linear, three-dimensional beam elements, Comp. Meth. Appl. Mech. Eng. 81 (1990).
template <kind Dim>
struct flexible_beam {
  static constexpr type_name type{"flexible_beam", Dim};
  static constexpr std::array<port, 2> ports{{{Dim, access::on, "anchor1"}, {Dim, access::on, "anchor2"}}};
  static constexpr const char* arguments = Dim == kind::frame_2D
                                               ? "rest_length, {EA, EI, GA}, rest_turn"
                                               : "rest_length, {EA, EI_y, EI_z, GJ, GA_y, GA_z}, rest_turn";
  static constexpr bool reads_positions = true;
  static constexpr std::array<std::string_view, 1> optional_parameters{"rest_turn"};
  using section_type = std::conditional_t<Dim == kind::frame_2D, planar_beam_section, beam_section>;

  using turn_type = std::conditional_t<Dim == kind::frame_2D, double, vec3<>>;

  double rest_length;
  section_type section;
  turn_type rest_turn{};  ///< r_0

  template <class A, class B>
  KTE_INLINE constexpr auto doForce(const A& a, const B& b) const {
    const auto m = detail::midway_between<Dim>(a, b);
    const auto x = shape_of(m);
    using S = std::remove_cvref_t<decltype(x.h)>;
    const S NL = S(section.EA) * x.e * S(rest_length);
    const auto [y, z, twist] = stiffness<S>();
    const auto q_y = x.to_sides.y + S(NL * y.bent * y.bent / S(5)) * x.s_y;
    const auto q_z = x.to_sides.z + S(NL * z.bent * z.bent / S(5)) * x.s_z;
    const auto h = plus_cross(x.moment, x.varying, x.moment) + S(NL / S(12)) * vec3{zero, m.r.y, m.r.z} +
                   twisted(S(S(1) / S(24)), m.r, vec3{zero, q_y, q_z});
    const auto g = S(NL / S(rest_length)) * x.along + x.h * vec3{zero, q_z, -q_y} -
                   S(S(0.5) * x.h) * ((q_y * x.chord_y + q_z * x.chord_z) * (x.along + vec3{one, zero, zero}));
    return detail::midway_loads(m, g, h);
  }
  /// J
  template <class A, class B>
  KTE_INLINE constexpr auto potential_energy(const A& a, const B& b) const {
    const auto m = detail::midway_between<Dim>(a, b);
    const auto x = shape_of(m);
    using S = std::remove_cvref_t<decltype(x.h)>;
    const auto [y, z, twist] = stiffness<S>();
    const auto& c = x.varying;
    const auto varying = S(12) * vec3{twist * c.x, y.r * c.y, z.r * c.z};
    return S(S(0.5) * (S(rest_length) * S(section.EA) * x.e * x.e + dot(x.mean, x.moment) + dot(c, varying) +
                       (x.s_y - c.y) * x.to_sides.y + (x.s_z - c.z) * x.to_sides.z));
  }
  constexpr void check(const parameter_check& where) const {
    where.positive(rest_length, "rest length must be finite and positive");
    visit_section(section, [&where](const char*, double x) {
      where.not_negative(x, "stiffnesses of the section must be finite and not negative");
    });
    where.finite(rest_turn, "rest turn must be finite");
  }
  template <class Self, class Visit>
  static constexpr void parameters(Self& self, Visit&& visit) {
    visit("rest_length", self.rest_length);
    visit_section(self.section, visit);
    visit("rest_turn", self.rest_turn);
  }

 private:
  template <class Section, class Visit>
  static constexpr void visit_section(Section& s, Visit&& visit) {
    visit("EA", s.EA);
    if constexpr (Dim == kind::frame_2D) {
      visit("EI", s.EI), visit("GA", s.GA);
    } else {
      visit("EI_y", s.EI_y), visit("EI_z", s.EI_z), visit("GJ", s.GJ), visit("GA_y", s.GA_y), visit("GA_z", s.GA_z);
    }
  }
  template <class S>
  KTE_INLINE constexpr auto stiffness() const {
    return detail::beam_stiffness<S>(detail::in_space(section), rest_length);
  }
  KTE_INLINE constexpr auto at_rest() const {
    if constexpr (Dim == kind::frame_2D) {
      return vec3{zero, zero, rest_turn};
    } else {
      return rest_turn;
    }
  }
  /// k (-(r x q)_x, (r x q)_y, (r x q)_z): the derivatives of q . (2) by r.
  template <class S, class R, class Q>
  KTE_INLINE static constexpr auto twisted(const S& k, const R& r, const Q& q) {
    const auto c = cross(r, q);
    return vec3{-(k * c.x), k * c.y, k * c.z};
  }
  /// h = 2 / (D + d_x), d/D, the chord by (1), s, c, rho, moments K rho / L, dV/ds without e, e
  template <class S, class Along, class C_y, class C_z, class Y, class Z, class C, class Rho, class Q>
  struct shape {
    S h;
    Along along;
    C_y chord_y;
    C_z chord_z;
    Y s_y;
    Z s_z;
    C varying;
    Rho mean, moment;
    Q to_sides;
    S e;
  };
  template <class M>
  KTE_INLINE constexpr auto shape_of(const M& m) const {
    const auto [D, along] = detail::to_polar(m.d);
    using S = std::remove_cvref_t<decltype(m.half.s + D)>;
    const auto [y, z, twist] = stiffness<S>();
    if (!all(D + m.d.x != S(0))) [[unlikely]]
      detail::raise<bad_argument>(std::string("kte: ").append(type) +
                                  ": its ends stand in one place, or its chord points backward");
    const S L = S(rest_length), h = S(2) / (D + m.d.x);
    const auto chord_y = -(h * m.d.z);
    const auto chord_z = h * m.d.y;  // (1)
    const auto s_y = chord_y + S(S(1) / S(24)) * (m.r.x * m.r.z);
    const auto s_z = chord_z - S(S(1) / S(24)) * (m.r.x * m.r.y);  // (2)
    const auto c = varying(m.r, vec3{zero, y.bent * s_y, z.bent * s_z}, y, z, twist);
    const auto mean = plus_cross(m.r - at_rest(), m.r, c);  // (3)
    const vec3 moment{twist * mean.x, y.r * mean.y, z.r * mean.z};
    const auto to_sides = cross(moment, m.r) + S(12) * vec3{twist * c.x, y.r * c.y, z.r * c.z};
    const auto s_y_bent = y.bent * s_y;
    const auto s_z_bent = z.bent * s_z;
    const S e = (D - L) / L + (m.r.y * m.r.y + m.r.z * m.r.z) / S(24) +
                (s_y_bent * s_y_bent + s_z_bent * s_z_bent) / S(10);  // (4)
    return shape<S, std::remove_cvref_t<decltype(along)>, std::remove_const_t<decltype(chord_y)>,
                 std::remove_const_t<decltype(chord_z)>, std::remove_const_t<decltype(s_y)>,
                 std::remove_const_t<decltype(s_z)>, std::remove_const_t<decltype(c)>,
                 std::remove_const_t<decltype(mean)>, std::remove_const_t<decltype(to_sides)>>{
        h, along, chord_y, chord_z, s_y, s_z, c, mean, moment, to_sides, e};
  }
  /// The c that minimizes V: (1 + C G) c = c_0 - C (K (r - r_0) x r)/L, with c_0 the c without moments, C its
  /// compliance to moments, and G = [r]^T K [r]/L.
  template <class R, class C, class Y, class S>
  KTE_INLINE constexpr auto varying(const R& r, const C& c, const Y& y, const Y& z, const S& twist) const {
    if constexpr (Dim == kind::frame_2D) {
      return c;
    } else {
      const S give = section.GJ > 0 ? S(S(1) / (S(12) * twist)) : S(0);
      const auto u = r - at_rest();
      const auto moment = cross(vec3{twist * u.x, y.r * u.y, z.r * u.z}, r);
      const vec3 right{-(give * moment.x), c.y - y.give * moment.y, c.z - z.give * moment.z};
      const S xy = z.r * r.x * r.y, xz = y.r * r.x * r.z, yz = twist * r.y * r.z;
      const vec3 of_x{S(S(1) + give * (y.r * r.z * r.z + z.r * r.y * r.y)), S(-(give * xy)), S(-(give * xz))};
      const vec3 of_y{S(-(y.give * xy)), S(S(1) + y.give * (twist * r.z * r.z + z.r * r.x * r.x)), S(-(y.give * yz))};
      const vec3 of_z{S(-(z.give * xz)), S(-(z.give * yz)), S(S(1) + z.give * (twist * r.y * r.y + y.r * r.x * r.x))};
      const auto across = cross(of_y, of_z);
      const S share = S(1) / dot(of_x, across);
      return share * (right.x * across + right.y * cross(of_z, of_x) + right.z * cross(of_x, of_y));
    }
  }
};

}  // namespace core

/// A flexible beam between two frames in the plane, along x of both at its ends: rest length, m, stiffness of its
/// section, and optionally, for a beam that is an arc at rest, the angle from end to end, rad.
///
///   flexible_beam_2D(wall, tip, 0.5, {.EA = 1e6, .EI = 20.0})
template <class F1, class F2, entry Turn = zero_t>
[[nodiscard]] constexpr auto flexible_beam_2D(const F1& anchor1, const F2& anchor2, double rest_length,
                                              const planar_beam_section& section, const Turn& rest_turn = {}) {
  return connect(core::flexible_beam<kind::frame_2D>{rest_length, section, as<double>(rest_turn)}, anchor1, anchor2);
}
/// A flexible beam between two frames in space, along x of both at its ends: rest length, m, stiffness of its section,
/// and optionally, for a beam that is an arc or a helix at rest, the rotation vector from end to end, rad:
/// `along_z(0.1)`.
template <class F1, class F2, class X = double, class Y = X, class Z = Y>
[[nodiscard]] constexpr auto flexible_beam_3D(const F1& anchor1, const F2& anchor2, double rest_length,
                                              const beam_section& section, const vec3<X, Y, Z>& rest_turn = {}) {
  return connect(core::flexible_beam<kind::frame_3D>{rest_length, section, as<double>(rest_turn)}, anchor1, anchor2);
}

KTE_CALL(flexible_beam_2D,
         "(anchor1, anchor2, rest_length, section[, rest_turn]); a section is {.EA = 1e6, .EI = 20.0}")
KTE_CALL(flexible_beam_3D,
         "(anchor1, anchor2, rest_length, section[, rest_turn]); a section is {.EA = .., .EI_y = .., .EI_z = .., .GJ = "
         "..}")

}  // namespace kte
