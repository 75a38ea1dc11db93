#pragma once

#include <kte/contract/transmission.hpp>
#include <kte/kernels/relative_turn.hpp>
#include <kte/math/plain_scalar.hpp>
#include <kte/math/sincos.hpp>

#include <cmath>
#include <limits>

/// Two frames viewed from the frame halfway between them, which prefers neither: the basis of beams and bushings.
namespace kte::detail {

/// Functions of half a rotation by the vector r of length t, smooth at t = 0. Below t^2 = eps^(1/4) they are evaluated
/// by their series, whose omitted terms are below the last digit of the results. At that point the loss by cancellation
/// is as small, eps^(1/8) in derivatives.
///
///   s = sin(t/2)/t,  c = cos(t/2),  k = (1 - 1/(2 s))/t^2                                   (1)
template <class S>
struct half_turn_functions {
  S s, c, k;
};
template <class S>
KTE_INLINE constexpr auto half_turn_functions_of(const S& tt) {
  using std::sqrt;
  using plain = plain_scalar<S>;
  const plain limit = sqrt(sqrt(std::numeric_limits<plain>::epsilon()));
  const auto tiny = tt < S(limit);
  const S t = sqrt(select(tiny, S(1), tt));
  S sine, cosine;
  sincos(S(t / S(2)), sine, cosine);
  const auto series = [&tt](double a, double b, double c, double d) KTE_INLINE_LAMBDA {
    return S(S(1) / S(a) + tt * (S(1) / S(b) + tt * (S(1) / S(c) + tt / S(d))));
  };
  return half_turn_functions<S>{select(tiny, series(2, -48, 3840, -645120), S(sine / t)),
                                select(tiny, series(1, -8, 384, -46080), cosine),
                                select(tiny, S(-(S(1) / S(24) + tt * (S(7) / S(5760) + tt * (S(31) / S(967680))))),
                                       S((S(1) - t / (S(2) * sine)) / select(tiny, S(1), tt)))};
}

/// The pose of frame 2 in frame 1 is R_1^T (p_2 - p_1) and the rotation vector r of R_1^T R_2. Half of this rotation,
/// from frame 1, gives the midway frame M. In axes of M
///
///   H = exp [r/2]x,   d = H^T R_1^T (p_2 - p_1)                                             (2)
///
/// and with u_i, h_i the virtual displacements and rotations of the two frames in these axes, n = r/t,
///
///   dr = B (h_2 - h_1),   B = n n^T + (t/2)/sin(t/2) (1 - n n^T)                            (3)
///   h_M = (h_1 + h_2)/2 - tan(t/4)/2 n x (h_2 - h_1)                                        (4)
///   dd = u_2 - u_1 - h_M x d                                                                (5)
///
/// r has equal components in axes of all three frames. At half a turn it jumps to the opposite vector.
template <class D, class R, class S>
struct midway {
  D d;
  R r;
  half_turn_functions<S> half;

  /// H v: from axes of frame 2 to those of M, from M to frame 1.
  template <class V>
  KTE_INLINE constexpr auto forth(const V& v) const {
    const auto x = cross(r, v);
    return v + half.s * x + S(half.s * half.s / (S(1) + half.c)) * cross(r, x);
  }
  /// H^T v: from axes of frame 1 to those of M, from M to frame 2.
  template <class V>
  KTE_INLINE constexpr auto back(const V& v) const {
    const auto x = cross(r, v);
    return v - half.s * x + S(half.s * half.s / (S(1) + half.c)) * cross(r, x);
  }
  /// B v of (3): to rates of r, and as B is symmetric, from what acts on r.
  template <class V>
  KTE_INLINE constexpr auto stretched(const V& v) const {
    return S(S(1) / (S(2) * half.s)) * v + (half.k * dot(r, v)) * r;
  }
  /// tan(t/4)/2 n
  KTE_INLINE constexpr auto lag() const { return S(half.s / (S(2) * (S(1) + half.c))) * r; }
};
template <kind Dim, class A, class B>
KTE_INLINE constexpr auto midway_between(const A& a, const B& b) {
  const auto r = turn_of(relative_rotation<Dim>(a.rotation, b.rotation));
  const auto half = half_turn_functions_of(as_number(dot(r, r)));
  const auto p = transpose(a.rotation) * (b.position - a.position);
  using S = std::remove_const_t<decltype(half.s)>;
  const midway<std::remove_const_t<decltype(p)>, std::remove_const_t<decltype(r)>, S> in_frame_1{p, r, half};
  const auto d = in_frame_1.back(p);  // (2)
  return midway<std::remove_const_t<decltype(d)>, std::remove_const_t<decltype(r)>, S>{d, r, half};
}

/// The loads on two frames, at their origins in their own axes, of an element that resists d and r by g and h, the
/// gradients of a potential or forces with this power. By (3) to (5)
///
///   F_2 = -F_1 = -g,   T_1 = c/2 + m,  T_2 = c/2 - m,   c = d x g,  m = B h + c x tan(t/4)/2 n          (6)
///
/// in axes of M. Forces and moments balance.
template <class M, class G, class H>
KTE_INLINE constexpr auto midway_loads(const M& m, const G& g, const H& h) {
  const auto c = cross(m.d, g);
  const auto bent = plus_cross(m.stretched(h), c, m.lag());
  using S = std::remove_cvref_t<decltype(m.half.s)>;
  const auto shared = S(0.5) * c;
  return make_loads(wrench{m.forth(g), m.forth(shared + bent)}, wrench{-m.back(g), m.back(shared - bent)});
}

/// The rates of d and r, from the rates of the frames in their own axes.
template <class D, class R>
struct midway_rates {
  D d;
  R r;
};
template <class M, class A, class B>
KTE_INLINE constexpr auto midway_rates_of(const M& m, const A& a, const B& b) {
  using S = std::remove_cvref_t<decltype(m.half.s)>;
  const auto w_1 = m.back(a.ang_velocity);
  const auto w_2 = m.forth(b.ang_velocity);
  const auto between = w_2 - w_1;
  const auto w = S(0.5) * (w_1 + w_2) - cross(m.lag(), between);                // (4)
  const auto d = plus_cross(m.forth(b.velocity) - m.back(a.velocity), m.d, w);  // (5)
  const auto r = m.stretched(between);                                          // (3)
  return midway_rates<std::remove_const_t<decltype(d)>, std::remove_const_t<decltype(r)>>{d, r};
}

}  // namespace kte::detail
