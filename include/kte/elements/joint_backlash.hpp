#pragma once

#include <kte/contract/transmission.hpp>
#include <kte/kernels/force_laws.hpp>

namespace kte {

namespace core {

/// Backlash between two coordinates: a gap g between teeth of stiffness k and damping c.
///
///   x = q_2 - q_1,   d = x - g/2 for x > g/2,  x + g/2 for x < -g/2,  else 0          (1)
///   s = k d + c x_dot in contact, limited so that teeth do not pull                    (2)
///   f_1 += s,  f_2 -= s                                                               (3)
template <class S>
struct joint_backlash_gen {
  static constexpr type_name type{"joint_backlash", kind::gen};
  static constexpr std::array<port, 2> ports{{{kind::gen, access::on, "anchor1"}, {kind::gen, access::on, "anchor2"}}};

  S gap, stiffness, damping;

  template <class C1, class C2>
  KTE_INLINE constexpr auto doForce(const C1& c1, const C2& c2) const {
    const auto x = play(c1, c2);
    using T = std::remove_const_t<decltype(x)>;
    const T force = detail::stop_force(beyond(x), as<T>(c2.q_dot - c1.q_dot), T(stiffness), T(damping));  // (2)
    return make_loads(force, -force);                                                                     // (3)
  }
  /// J
  template <class C1, class C2>
  KTE_INLINE constexpr auto potential_energy(const C1& c1, const C2& c2) const {
    const auto d = beyond(play(c1, c2));
    using T = std::remove_const_t<decltype(d)>;
    return T(T(0.5) * stiffness * d * d);
  }
  /// Zero at |x| = g/2: where teeth come into contact, and without damping where they separate.
  template <class C1, class C2>
  KTE_INLINE constexpr auto switching(const C1& c1, const C2& c2) const {
    const auto x = play(c1, c2);
    using T = std::remove_const_t<decltype(x)>;
    return T(select(T(gap) > T(0), T(T(gap) / T(2) - select(x < T(0), T(-x), x)), x));
  }
  constexpr void check(const parameter_check& where) const {
    where.not_negative(gap, "gap must be finite and not negative");
    where.not_negative(stiffness, "stiffness must be finite and not negative");
    where.not_negative(damping, "damping must be finite and not negative");
  }
  template <class Self, class Visit>
  static constexpr void parameters(Self& self, Visit&& visit) {
    visit("gap", self.gap), visit("stiffness", self.stiffness), visit("damping", self.damping);
  }
  /// d of (1).
  template <class T>
  KTE_INLINE constexpr T beyond(const T& x) const {
    const T half(gap / S(2));
    return detail::beyond(x, T(-half), half);
  }

 private:
  template <class C1, class C2>
  KTE_INLINE static constexpr auto play(const C1& c1, const C2& c2) {
    return detail::as_number(c2.q - c1.q);
  }
};

}  // namespace core

/// Backlash between two coordinates: gap, m or rad, stiffness of the teeth, N/m or Nm/rad, and damping in contact, N
/// s/m or Nm s/rad.
template <class Q1, class Q2, entry S>
[[nodiscard]] constexpr auto joint_backlash_gen(const Q1& anchor1, const Q2& anchor2, const S& gap, const S& stiffness,
                                                const S& damping) {
  return connect(core::joint_backlash_gen<S>{gap, stiffness, damping}, anchor1, anchor2);
}

KTE_CALL(joint_backlash_gen, "(anchor1, anchor2, gap, stiffness, damping)")

}  // namespace kte
