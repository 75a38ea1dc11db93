#pragma once

#include <kte/elements/spring.hpp>

namespace kte {

namespace detail {
/// A force as a function of the length, and its energy as another function.
template <class Force, class Energy>
struct force_and_energy : Force {
  Energy energy_of;

  constexpr force_and_energy(const Force& force, const Energy& energy) : Force(force), energy_of(energy) {}
  template <class T>
  KTE_INLINE constexpr auto integral(const T& length) const {
    return energy_of(length);
  }
};
}  // namespace detail

namespace core {

/// A spring between two coordinates whose force is any function f of its length x,
///
///   x = q_2 - q_1,  s = f(x),   f_1 += s,  f_2 -= s              (1)
///
/// or between the origins of two frames, on the line through them:
///
///   d = p_2 - p_1,  x = |d|,  e = d/x,   F_1 += f(x) e,  F_2 -= f(x) e          (2)
///
/// Positive f pulls. Where the origins coincide, the force is zero, and smooth if f(0) = 0. V is the integral of f,
/// if the law has one.
template <kind Dim, class Law>
struct law_spring {
  static constexpr type_name type{"law_spring", Dim};
  static constexpr std::array<port, 2> ports{{{Dim, access::on, "anchor1"}, {Dim, access::on, "anchor2"}}};
  static constexpr bool reads_positions = is_frame(Dim);
  static constexpr bool holds_code = true;

  Law law;

  template <class A, class B>
  KTE_INLINE constexpr auto doForce(const A& a, const B& b) const {
    if constexpr (Dim == kind::gen) {
      const auto s = law(detail::as_number(b.q - a.q));
      return make_loads(s, -s);  // (1)
    } else {
      return detail::opposite_forces(a, b, detail::pull_along(b.position - a.position, law));  // (2)
    }
  }
  /// J
  template <class A, class B>
  requires requires(const Law& l) { l.integral(1.0); }
  KTE_INLINE constexpr auto potential_energy(const A& a, const B& b) const {
    if constexpr (Dim == kind::gen) {
      return law.integral(detail::as_number(b.q - a.q));
    } else {
      return law.integral(detail::to_polar(b.position - a.position).length);
    }
  }
  constexpr void check(const parameter_check&) const {}
  template <class Self, class Visit>
  static constexpr void parameters(Self&, Visit&&) {}
};

}  // namespace core

namespace detail {
template <class Force>
constexpr const Force& spring_law(const Force& force) {
  return force;
}
template <class Force, class Energy>
constexpr auto spring_law(const Force& force, const Energy& energy) {
  return force_and_energy<Force, Energy>(force, energy);
}
/// Accepts a force, or a force and its energy.
template <kind Dim, class A, class B, class... Law>
constexpr auto connect_law_spring(const A& anchor1, const B& anchor2, const Law&... law) {
  using law_type = std::remove_cvref_t<decltype(spring_law(law...))>;
  return connect(core::law_spring<Dim, law_type>{spring_law(law...)}, anchor1, anchor2);
}
template <class... Law>
inline constexpr bool is_spring_law = sizeof...(Law) == 1 || sizeof...(Law) == 2;
}  // namespace detail

/// A spring between two coordinates, by your function of the length, m or rad: the force, N or Nm, and optionally the
/// energy, J, its integral. The function must accept numbers of any type, such as dual numbers for derivatives:
///
///   law_spring_gen(q1, q2, [](const auto& x) { return 5.0 * x + 2.0 * x * x * x; })
///
/// A chain with it cannot be saved.
template <class Q1, class Q2, class... Law>
requires detail::is_spring_law<Law...>
constexpr auto law_spring_gen(const Q1& anchor1, const Q2& anchor2, const Law&... law) {
  return detail::connect_law_spring<kind::gen>(anchor1, anchor2, law...);
}
/// A spring by a function between the origins of two frames in the plane.
template <class F1, class F2, class... Law>
requires detail::is_spring_law<Law...>
constexpr auto law_spring_2D(const F1& anchor1, const F2& anchor2, const Law&... law) {
  return detail::connect_law_spring<kind::frame_2D>(anchor1, anchor2, law...);
}
/// A spring by a function between the origins of two frames in space.
template <class F1, class F2, class... Law>
requires detail::is_spring_law<Law...>
constexpr auto law_spring_3D(const F1& anchor1, const F2& anchor2, const Law&... law) {
  return detail::connect_law_spring<kind::frame_3D>(anchor1, anchor2, law...);
}

KTE_CALL(law_spring_gen, "(anchor1, anchor2, force[, energy]); both are functions of the length")
KTE_CALL(law_spring_2D, "(anchor1, anchor2, force[, energy]); both are functions of the length")
KTE_CALL(law_spring_3D, "(anchor1, anchor2, force[, energy]); both are functions of the length")

}  // namespace kte
