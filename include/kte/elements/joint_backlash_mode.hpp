#pragma once

#include <kte/elements/joint_backlash.hpp>

namespace kte {

namespace core {

/// Backlash between two coordinates whose contacts begin and end at events, also with damping. With d = |x| - g/2 and s
/// = k d + c d', and x, g, k and c of `joint_backlash_gen`, the mode is one of
///
///   1, -1   x > 0, x < 0: teeth in contact, force s   until s = 0                           (1)
///   2, -2   no force, the teeth recover               until d = 0, or s = 0 again           (2)
///   0       as `joint_backlash_gen`, by the position: free, and at the start                (3)
template <class S>
struct joint_backlash_mode_gen {
  static constexpr type_name type{"joint_backlash_mode", kind::gen};
  static constexpr std::array<port, 3> ports{
      {{kind::gen, access::on, "anchor1"}, {kind::gen, access::on, "anchor2"}, {kind::internal, access::keep, "mode"}}};

  joint_backlash_gen<S> teeth;

  template <class C1, class C2, class Z>
  KTE_INLINE constexpr auto doForce(const C1& c1, const C2& c2, const Z& mode) const {
    const auto [x, rate, z] = numbers(c1, c2, mode);
    using T = std::remove_cvref_t<decltype(x)>;
    const T half = T(teeth.gap) / T(2), k(teeth.stiffness), c(teeth.damping);
    const T press = k * T(x - z * half) + c * rate, by_position = detail::stop_force(teeth.beyond(x), rate, k, c);
    const T force = select(z * z == T(1), press, T(select(z == T(0), by_position, T(press - press))));
    return make_loads(force, -force);
  }
  template <class... Things>
  KTE_INLINE static constexpr auto z_dot(const Things&...) {
    return zero;
  }
  template <class C1, class C2, class Z>
  KTE_INLINE constexpr auto potential_energy(const C1& c1, const C2& c2, const Z&) const {
    return teeth.potential_energy(c1, c2);
  }
  /// Zero where the mode changes: s of (1), -d s of (2), g/2 - |x| of (3).
  template <class C1, class C2, class Z>
  KTE_INLINE constexpr auto switching(const C1& c1, const C2& c2, const Z& mode) const {
    const auto [x, rate, z] = numbers(c1, c2, mode);
    using T = std::remove_cvref_t<decltype(x)>;
    const auto [d, s] = contact(x, rate, z);
    const T touch = as<T>(teeth.switching(c1, c2));
    return T(select(z == T(0), touch, T(select(z * z == T(1), s, T(-(d * s))))));
  }
  template <class C1, class C2, class Z>
  constexpr auto switched(const C1& c1, const C2& c2, const Z& mode) const {
    const auto [x, rate, z] = numbers(c1, c2, mode);
    using T = std::remove_cvref_t<decltype(x)>;
    const bool play = teeth.gap > S(0);
    if (z == T(0)) {
      const bool outward = play ? x * rate > T(0) : rate != T(0);
      return T(!outward ? 0 : rate > T(0) ? 1 : -1);
    }
    const auto [d, s] = contact(x, rate, z);
    const T side(z > T(0) ? 1 : -1);
    if (d > T(0)) return z * z == T(1) ? T(2 * side) : s < T(0) ? z : side;
    return play ? T(0) : T(-side);  // without play the other teeth touch at once
  }
  constexpr void check(const parameter_check& where) const { teeth.check(where); }
  template <class Self, class Visit>
  static constexpr void parameters(Self& self, Visit&& visit) {
    joint_backlash_gen<S>::parameters(self.teeth, visit);
  }

 private:
  template <class T>
  struct play_and_mode {
    T x, rate, z;
  };
  template <class C1, class C2, class Z>
  KTE_INLINE static constexpr auto numbers(const C1& c1, const C2& c2, const Z& mode) {
    using T = std::remove_cvref_t<decltype(detail::as_number(c2.q - c1.q) + detail::as_number(c2.q_dot - c1.q_dot) +
                                           detail::as_number(mode))>;
    return play_and_mode<T>{as<T>(c2.q - c1.q), as<T>(c2.q_dot - c1.q_dot), as<T>(mode)};
  }
  template <class T>
  struct pressed_by {
    T d, s;
  };
  /// d and s of the teeth on the side of the mode.
  template <class T>
  KTE_INLINE constexpr pressed_by<T> contact(const T& x, const T& rate, const T& z) const {
    const T side = select(z < T(0), T(-1), T(1)), d = side * x - T(teeth.gap) / T(2);
    return {d, T(T(teeth.stiffness) * d + T(teeth.damping) * side * rate)};
  }
};

}  // namespace core

/// `joint_backlash_gen` with an internal state `mode` that holds which teeth are in contact, so that contacts begin and
/// end at events also with damping (`element_events`). Without events it is `joint_backlash_gen`. The initial mode is
/// 0.
template <class Q1, class Q2, class Z, entry S>
[[nodiscard]] constexpr auto joint_backlash_mode_gen(const Q1& anchor1, const Q2& anchor2, const Z& mode, const S& gap,
                                                     const S& stiffness, const S& damping) {
  return connect(core::joint_backlash_mode_gen<S>{{gap, stiffness, damping}}, anchor1, anchor2, mode);
}

KTE_CALL(joint_backlash_mode_gen, "(anchor1, anchor2, mode, gap, stiffness, damping)")

}  // namespace kte
