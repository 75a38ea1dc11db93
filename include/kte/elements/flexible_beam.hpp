#pragma once

#include <kte/elements/spring.hpp>
#include <kte/kernels/midway.hpp>
#include <kte/math/beam_section.hpp>

namespace kte {

namespace core {

/// A slender beam without mass between two frames, straight along x of both when they are at rest at a distance L: its
/// ends may move and turn by any amount, its strains stay small. From halfway between the frames (kernels/midway.hpp)
/// frame 2 is at d from frame 1, D = |d|, and turned by r; that is bending r_y, r_z and torsion r_x. The line of its
/// ends is turned from the axis x by an angle of which the double tangent of the half is
///
///   s_z = 2 d_y / (D + d_x),  s_y = -2 d_z / (D + d_x)                                                  (1)
///
/// which is bending to both sides, an S, that shear softens by f_z = 12 EI_z / (GA_y L^2), likewise f_y, 0 for stiff
/// shear. Bending shortens the line of the ends, so that the beam itself is strained by
///
///   e = (D - L)/L + (r_y^2 + r_z^2)/24 + s_y^2 / (10 (1 + f_y)^2) + s_z^2 / (10 (1 + f_z)^2)            (2)
///   V = L EA e^2 / 2 + (GJ r_x^2 + EI_y r_y^2 + EI_z r_z^2) / (2 L)
///         + 6/L (EI_y s_y^2 / (1 + f_y) + EI_z s_z^2 / (1 + f_z))                                       (3)
///
/// The loads are those of V. For small motions they are those of the linear beam, 12 EI/L^3 and so on; a force N along
/// the beam adds N L/12 and N L/5 to its stiffnesses in r and s, by which a pulled beam is stiff like a string and a
/// pushed one buckles. An end moment bends it to an arc of the exact angle. Equal ends: exchange of the frames changes
/// nothing. A chain of n beams errs as 1/n^4 where it is bent in a plane, as 1/n^2 in space.
///
/// At half a turn between the ends, r and with it the torque jumps to the other side, as of any spring of rotations. As
/// the line of the ends turns back onto the frames, d along -x, V grows without bound.
///
/// Crisfield, A consistent co-rotational formulation for non-linear, three-dimensional beam elements, Comp. Meth. Appl.
/// Mech. Eng. 81 (1990), for the idea.
template <kind Dim>
struct flexible_beam {
  static constexpr type_name type{"flexible_beam", Dim};
  static constexpr std::array<port, 2> ports{{{Dim, access::on, "anchor1"}, {Dim, access::on, "anchor2"}}};
  static constexpr bool reads_positions = true;
  using section_type = std::conditional_t<Dim == kind::frame_2D, planar_beam_section, beam_section>;

  double rest_length;
  section_type section;

  template <class A, class B>
  KTE_INLINE constexpr auto doForce(const A& a, const B& b) const {
    const auto m = detail::midway_between<Dim>(a, b);
    const auto x = shape_of(m);
    using S = std::remove_cvref_t<decltype(x.h)>;
    const S L = S(rest_length), N = S(section.EA) * x.e;
    const auto [y, z, twist] = stiffness<S>();
    const auto h = vec3{twist * m.r.x, S(y.r + N * L / S(12)) * m.r.y, S(z.r + N * L / S(12)) * m.r.z};
    const auto q_y = S(y.s + N * L * y.share / S(5)) * x.s_y;
    const auto q_z = S(z.s + N * L * z.share / S(5)) * x.s_z;
    const auto g = N * x.along + x.h * vec3{zero, q_z, -q_y} -
                   S(S(0.5) * x.h) * ((q_y * x.s_y + q_z * x.s_z) * (x.along + vec3{one, zero, zero}));
    return detail::midway_loads(m, g, h);
  }
  /// J
  template <class A, class B>
  KTE_INLINE constexpr auto potential_energy(const A& a, const B& b) const {
    const auto m = detail::midway_between<Dim>(a, b);
    const auto x = shape_of(m);
    using S = std::remove_cvref_t<decltype(x.h)>;
    const auto [y, z, twist] = stiffness<S>();
    const auto bent = twist * m.r.x * m.r.x + y.r * m.r.y * m.r.y + z.r * m.r.z * m.r.z;
    return S(S(0.5) * (S(rest_length) * S(section.EA) * x.e * x.e + bent + y.s * x.s_y * x.s_y + z.s * x.s_z * x.s_z));
  }
  constexpr void check(const parameter_check& where) const {
    where.positive(rest_length, "rest length must be finite and positive");
    parameters(*this, [&where](const char*, double x) {
      where.not_negative(x, "stiffnesses of the section must be finite and not negative");
    });
  }
  template <class Self, class Visit>
  static constexpr void parameters(Self& self, Visit&& visit) {
    auto& s = self.section;
    visit("rest_length", self.rest_length), visit("EA", s.EA);
    if constexpr (Dim == kind::frame_2D) {
      visit("EI", s.EI), visit("GA", s.GA);
    } else {
      visit("EI_y", s.EI_y), visit("EI_z", s.EI_z), visit("GJ", s.GJ), visit("GA_y", s.GA_y), visit("GA_z", s.GA_z);
    }
  }

 private:
  template <class S>
  KTE_INLINE constexpr auto stiffness() const {
    return detail::beam_stiffness<S>(detail::in_space(section), rest_length);
  }
  /// h = 2 / (D + d_x), d/D, (1), (2)
  template <class S, class Along, class Y, class Z>
  struct shape {
    S h;
    Along along;
    Y s_y;
    Z s_z;
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
    const auto s_y = -(h * m.d.z);
    const auto s_z = h * m.d.y;  // (1)
    const S e = (D - L) / L + (m.r.y * m.r.y + m.r.z * m.r.z) / S(24) +
                (y.share * s_y * s_y + z.share * s_z * s_z) / S(10);  // (2)
    return shape<S, std::remove_cvref_t<decltype(along)>, std::remove_const_t<decltype(s_y)>,
                 std::remove_const_t<decltype(s_z)>>{h, along, s_y, s_z, e};
  }
};

}  // namespace core

/// A flexible beam between two frames in the plane, along x of both at rest: rest length (m), stiffness of its section.
///
///   flexible_beam_2D(wall, tip, 0.5, {.EA = 1e6, .EI = 20.0})
template <class F1, class F2>
constexpr auto flexible_beam_2D(const F1& anchor1, const F2& anchor2, double rest_length,
                                const planar_beam_section& section) {
  return connect(core::flexible_beam<kind::frame_2D>{rest_length, section}, anchor1, anchor2);
}
/// The same in space.
template <class F1, class F2>
constexpr auto flexible_beam_3D(const F1& anchor1, const F2& anchor2, double rest_length, const beam_section& section) {
  return connect(core::flexible_beam<kind::frame_3D>{rest_length, section}, anchor1, anchor2);
}

KTE_CALL(flexible_beam_2D, "(anchor1, anchor2, rest_length, section); a section is {.EA = 1e6, .EI = 20.0}")
KTE_CALL(flexible_beam_3D,
         "(anchor1, anchor2, rest_length, section); a section is {.EA = .., .EI_y = .., .EI_z = .., .GJ = ..}")

namespace detail {
/// How model files make them.
struct flexible_beam_family {
  template <class Add>
  static void add_to(const Add& add) {
    add(
        "flexible_beam_2D",
        [](const auto& x) {
          return flexible_beam_2D(x.name("anchor1"), x.name("anchor2"), x.number("rest_length"),
                                  {x.number("EA"), x.number("EI"), x.number("GA")});
        },
        "rest_length, {EA, EI, GA}");
    add(
        "flexible_beam_3D",
        [](const auto& x) {
          return flexible_beam_3D(
              x.name("anchor1"), x.name("anchor2"), x.number("rest_length"),
              {x.number("EA"), x.number("EI_y"), x.number("EI_z"), x.number("GJ"), x.number("GA_y"), x.number("GA_z")});
        },
        "rest_length, {EA, EI_y, EI_z, GJ, GA_y, GA_z}");
  }
};
}  // namespace detail

}  // namespace kte
