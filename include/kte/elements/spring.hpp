#pragma once

#include <kte/contract/transmission.hpp>
#include <kte/kernels/polar.hpp>
#include <kte/math/select.hpp>

namespace kte {

namespace detail {

/// A force s limited to [-most, most]. A limit of 0, typed or not, means no limit. NaN stays NaN.
template <entry S, class Most>
KTE_INLINE constexpr auto limited(const S& s, const Most& most) {
  if constexpr (std::is_same_v<Most, zero_t> || std::is_same_v<S, zero_t>) {
    return s;
  } else {
    const auto f = as_number(s);
    using T = std::remove_const_t<decltype(f)>;
    const T m = as<T>(most);
    return select(m == T(0), f, select(f > m, m, select(f < T(-m), T(-m), f)));
  }
}
/// k d, limited in length.
template <class K, class X, class Y, class Z, class Most>
KTE_INLINE constexpr auto limited_pull(const K& k, const vec3<X, Y, Z>& d, const Most& most) {
  if constexpr (std::is_same_v<Most, zero_t>) {
    return k * d;
  } else {
    const auto length = to_polar(d).length;
    using T = std::remove_const_t<decltype(length)>;
    const T m = as<T>(most), stiffness = as<T>(k);
    const auto beyond = T(stiffness * length) > m;
    const T share = select(beyond, T(m / select(beyond, length, T(1))), stiffness);
    return select(m == T(0), stiffness, share) * d;
  }
}

/// The force f(x) on the first of two points at the distance vector d, on the line through them:
///
///   x = |d|,   F = f(x) d/x                                                      (1)
///
/// Where the points coincide, F is zero. If f(0) is zero, F is smooth there with the derivative f'(0), which is found
/// as f(h)/h at a tiny h; otherwise its direction jumps.
template <class X, class Y, class Z, class Law>
KTE_INLINE constexpr auto pull_along(const vec3<X, Y, Z>& d, const Law& law) {
  const auto [x, e] = to_polar(d);
  const auto f = law(x);
  auto force = f * e;  // (1)
  if constexpr (!std::is_same_v<std::remove_const_t<decltype(f)>, zero_t>) {
    using S = std::remove_const_t<decltype(x)>;
    const auto coincide = x == S(0);
    if (any(coincide)) [[unlikely]] {
      const S tiny(1e-30);
      force = force + select(both(coincide, as<S>(f) == S(0)), S(as<S>(law(tiny)) / tiny), S(0)) * d;
    }
  }
  return force;
}

/// The energy of a spring of stiffness k that is stretched by x, a number or a vector. With the limited force f:
///
///   V = k/2 x.x,  with saturation  V = f (|x| - f/(2k))          (1)
///
/// beyond saturation: f times the stretch, minus half the stretch at which it saturates.
template <class X, class Stiffness, class Most>
KTE_INLINE constexpr auto elastic_energy(const X& x, const Stiffness& k, const Most& most) {
  if constexpr (!entry<X>) {
    if constexpr (std::is_same_v<Most, zero_t>) {
      const auto work = as_number(dot(k * x, x));
      using S = std::remove_const_t<decltype(work)>;
      return S(S(0.5) * work);
    } else {
      return elastic_energy(to_polar(x).length, k, most);
    }
  } else {
    const auto f = as_number(limited(k * x, most));
    using S = std::remove_const_t<decltype(f)>;
    if constexpr (std::is_same_v<Most, zero_t>) {
      return S(S(0.5) * (f * x));
    } else {
      const S stiffness = as<S>(k);
      return S(f * (x - S(0.5) * (f / select(stiffness == S(0), S(1), stiffness))));
    }
  }
}

/// The distance of a force s from its limit: positive below, negative if limited, 1 without a limit.
template <entry F, class Most>
KTE_INLINE constexpr auto below_limit(const F& s, const Most& most) {
  const auto f = as_number(s);
  using T = std::remove_const_t<decltype(f)>;
  const T m = as<T>(most);
  return T(select(m == T(0), T(1), T(m - select(f < T(0), T(-f), f))));
}

/// A force f on the first of two frames, -f on the second, given in axes of the world, at their origins.
template <class A, class B, class F>
KTE_INLINE constexpr auto opposite_forces(const A& a, const B& b, const F& f) {
  return make_loads(wrench{transpose(a.rotation) * f, zero3{}}, wrench{-(transpose(b.rotation) * f), zero3{}});
}

}  // namespace detail

namespace core {

/// Parameters of a spring.
template <class Rest, class Stiffness, class Saturation>
struct spring_parameters {
  Rest rest_length;
  Stiffness stiffness;
  Saturation saturation;

  constexpr void check_force(const parameter_check& where) const {
    where.not_negative(stiffness, "stiffness must be finite and not negative");
    where.not_negative(saturation, "saturation must be finite and not negative");
  }
  template <class Self, class Visit>
  static constexpr void parameters(Self& self, Visit&& visit) {
    visit("rest_length", self.rest_length);
    visit("stiffness", self.stiffness);
    visit("saturation", self.saturation);
  }
};

/// A linear spring between two coordinates, of stiffness k and rest length L:
///
///   s = k (q_2 - q_1 - L)                               (1)
///   f_1 += s,  f_2 -= s                                 (2)
///
/// with |s| limited to the saturation force if there is one (zero: none).
template <class Rest, class Stiffness, class Saturation>
struct spring_gen : spring_parameters<Rest, Stiffness, Saturation> {
  static constexpr type_name type{"spring", kind::gen};
  static constexpr std::array<port, 2> ports{{{kind::gen, access::on, "anchor1"}, {kind::gen, access::on, "anchor2"}}};

  template <class C1, class C2>
  KTE_INLINE constexpr auto doForce(const C1& c1, const C2& c2) const {
    const auto s = detail::limited(this->stiffness * stretch(c1, c2), this->saturation);  // (1)
    return make_loads(s, -s);                                                             // (2)
  }
  /// J
  template <class C1, class C2>
  KTE_INLINE constexpr auto potential_energy(const C1& c1, const C2& c2) const {
    return detail::elastic_energy(stretch(c1, c2), this->stiffness, this->saturation);
  }
  /// Zero where it saturates.
  template <class C1, class C2>
  KTE_INLINE constexpr auto switching(const C1& c1, const C2& c2) const {
    return detail::below_limit(this->stiffness * stretch(c1, c2), this->saturation);
  }
  constexpr void check(const parameter_check& where) const {
    where.finite(this->rest_length, "rest length must be finite");
    this->check_force(where);
  }

 private:
  template <class C1, class C2>
  KTE_INLINE constexpr auto stretch(const C1& c1, const C2& c2) const {
    return (c2.q - c1.q) - this->rest_length;
  }
};

/// A linear spring between the origins of two frames, of stiffness k and rest length L:
///
///   d = p_2 - p_1,  D = |d|,  e = d/D                   (1)
///   F_1 += k (D - L) e,  F_2 -= k (D - L) e             (2)
///
/// limited to the saturation force, if any (zero: none); no torque. With rest length 0, F = k d is smooth everywhere;
/// with a typed zero it also needs no square root. Otherwise the direction is undefined if the origins coincide, and
/// the force is then zero.
template <kind Dim, class Rest, class Stiffness, class Saturation>
struct spring : spring_parameters<Rest, Stiffness, Saturation> {
  static constexpr type_name type{"spring", Dim};
  static constexpr std::array<port, 2> ports{{{Dim, access::on, "anchor1"}, {Dim, access::on, "anchor2"}}};
  static constexpr bool reads_positions = true;

  template <class A, class B>
  KTE_INLINE constexpr auto doForce(const A& a, const B& b) const {
    const auto d = b.position - a.position;
    if constexpr (std::is_same_v<Rest, zero_t>) {
      return detail::opposite_forces(a, b, detail::limited_pull(this->stiffness, d, this->saturation));
    } else {
      return detail::opposite_forces(a, b, detail::pull_along(d, [this](const auto& D) {  // (1)
                                       return detail::limited(this->stiffness * (D - this->rest_length),
                                                              this->saturation);
                                     }));  // (2)
    }
  }
  /// J
  template <class A, class B>
  KTE_INLINE constexpr auto potential_energy(const A& a, const B& b) const {
    const auto d = b.position - a.position;
    if constexpr (std::is_same_v<Rest, zero_t>) {
      return detail::elastic_energy(d, this->stiffness, this->saturation);
    } else {
      return detail::elastic_energy(detail::to_polar(d).length - this->rest_length, this->stiffness, this->saturation);
    }
  }
  /// Zero where it saturates.
  template <class A, class B>
  KTE_INLINE constexpr auto switching(const A& a, const B& b) const {
    const auto stretch = detail::to_polar(b.position - a.position).length - this->rest_length;
    return detail::below_limit(this->stiffness * stretch, this->saturation);
  }
  constexpr void check(const parameter_check& where) const {
    where.not_negative(this->rest_length, "rest length must be finite and not negative");
    this->check_force(where);
  }
};

}  // namespace core

/// A spring between two coordinates: rest length (m, rad), stiffness (N/m, Nm/rad), and optionally the force at which
/// it saturates (N, Nm).
template <class Q1, class Q2, entry Rest, entry Stiffness, entry Saturation = zero_t>
[[nodiscard]] constexpr auto spring_gen(const Q1& anchor1, const Q2& anchor2, const Rest& rest_length,
                                        const Stiffness& stiffness, const Saturation& saturation = {}) {
  using core_type =
      core::spring_gen<decltype(real(rest_length)), decltype(real(stiffness)), decltype(real(saturation))>;
  return connect(core_type{{real(rest_length), real(stiffness), real(saturation)}}, anchor1, anchor2);
}
/// A spring between the origins of two frames in the plane: rest length (m; `zero` for none), stiffness (N/m), and
/// optionally the force at which it saturates (N).
template <class F1, class F2, entry Rest, entry Stiffness, entry Saturation = zero_t>
[[nodiscard]] constexpr auto spring_2D(const F1& anchor1, const F2& anchor2, const Rest& rest_length,
                                       const Stiffness& stiffness, const Saturation& saturation = {}) {
  using core_type =
      core::spring<kind::frame_2D, decltype(real(rest_length)), decltype(real(stiffness)), decltype(real(saturation))>;
  return connect(core_type{{real(rest_length), real(stiffness), real(saturation)}}, anchor1, anchor2);
}
/// A spring between the origins of two frames in space: rest length, m (`zero` for none), stiffness, N/m, and
/// optionally the force at which it saturates, N.
template <class F1, class F2, entry Rest, entry Stiffness, entry Saturation = zero_t>
[[nodiscard]] constexpr auto spring_3D(const F1& anchor1, const F2& anchor2, const Rest& rest_length,
                                       const Stiffness& stiffness, const Saturation& saturation = {}) {
  using core_type =
      core::spring<kind::frame_3D, decltype(real(rest_length)), decltype(real(stiffness)), decltype(real(saturation))>;
  return connect(core_type{{real(rest_length), real(stiffness), real(saturation)}}, anchor1, anchor2);
}

KTE_CALL(spring_gen, "(anchor1, anchor2, rest_length, stiffness[, saturation])")
KTE_CALL(spring_2D, "(anchor1, anchor2, rest_length, stiffness[, saturation])")
KTE_CALL(spring_3D, "(anchor1, anchor2, rest_length, stiffness[, saturation])")

}  // namespace kte
