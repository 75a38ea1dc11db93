#pragma once

#include <kte/detail/inline.hpp>

#include <array>
#include <cmath>
#include <cstddef>
#include <type_traits>
#include <utility>

namespace kte {

/// Sine and cosine of one angle, rad.
template <class S>
KTE_INLINE constexpr void sincos(const S& angle, S& sine, S& cosine) {
  using std::cos;
  using std::sin;
  sine = sin(angle);
  cosine = cos(angle);
}

namespace detail {

#if defined(__GNUC__) || defined(__clang__)
#  define KTE_HAS_VECTORS 1

/// Four doubles, and four integers of the same size. The compiler maps them to the registers of the CPU. Not eight,
/// because 512-bit arithmetic within scalar code slows the scalar code down (docs/decisions/03-sincos.md).
using double4 = double __attribute__((vector_size(32)));
using int64x4 = long long __attribute__((vector_size(32)));

/// Above this angle the reduction below loses digits, and libm is used, as for infinity and NaN.
inline constexpr double largest_reduced_angle = 1e5;

/// Four sines and cosines at once, |x| <= largest_reduced_angle, absolute error below 2.3e-16.
///
///   k = round(2 x / pi),  r = x - k pi/2                                                       (1)
///   sin r = r + r^3 P(r^2),  cos r = 1 - r^2/2 + r^4 Q(r^2)   on |r| <= pi/4                   (2)
///   sin x, cos x = +-sin r, +-cos r, exchanged for odd k                                       (3)
///
/// pi/2 is subtracted in three parts, the first two of 33 bits, so that their products with k are exact (Cody and
/// Waite, Software Manual for the Elementary Functions, 1980). P and Q: the minimax coefficients of Moshier's Cephes
/// library.
KTE_INLINE void sincos4(const double4& x, double* sine, double* cosine) {
  constexpr double round_to_integer = 6755399441055744.0;  // 1.5 2^52: adding it leaves k in the low bits
  const double4 shifted = x * 0.63661977236758134308 + round_to_integer;
  const auto k = (int64x4)shifted;
  const double4 n = shifted - round_to_integer;
  const double4 r =
      ((x - n * 1.57079632673412561417e+00) - n * 6.07710050630396597660e-11) - n * 2.02226624879595063154e-21;  // (1)
  const double4 z = r * r;
  const double4 p =
      ((((1.58962301576546568060e-10 * z - 2.50507477628578072866e-8) * z + 2.75573136213857245213e-6) * z -
        1.98412698295895385996e-4) *
           z +
       8.33333333332211858878e-3) *
          z -
      1.66666666666666307295e-1;
  const double4 q =
      ((((-1.13585365213876817300e-11 * z + 2.08757008419747316778e-9) * z - 2.75573141792967388112e-7) * z +
        2.48015872888517045348e-5) *
           z -
       1.38888888888730564116e-3) *
          z +
      4.16666666666665929218e-2;
  const double4 s = p * (z * r) + r;  // (2)
  const double4 c = q * (z * z) + (1.0 - 0.5 * z);
  const int64x4 odd = (k & 1) != 0;  // (3)
  const double4 sin_x = odd ? c : s, cos_x = odd ? s : c;
  const auto signed_sin = (int64x4)sin_x ^ ((k & 2) << 62), signed_cos = (int64x4)cos_x ^ (((k + 1) & 2) << 62);
  __builtin_memcpy(sine, &signed_sin, sizeof signed_sin);
  __builtin_memcpy(cosine, &signed_cos, sizeof signed_cos);
}
/// Sines and cosines of any angles.
KTE_INLINE void sincos4(double a, double b, double c, double d, double* sine, double* cosine) {
  const auto in_range = [](double x) KTE_INLINE_LAMBDA { return std::fabs(x) <= largest_reduced_angle; };
  if (in_range(a) && in_range(b) && in_range(c) && in_range(d)) [[likely]]
    return sincos4(double4{a, b, c, d}, sine, cosine);
  const double x[]{a, b, c, d};
  for (std::size_t k = 0; k < 4; ++k) sincos(x[k], sine[k], cosine[k]);
}
#endif

}  // namespace detail

/// Sines and cosines of n angles, rad, four at a time as in `sincos_all`.
inline void sincos_each(const double* angle, double* sine, double* cosine, std::size_t n) {
  std::size_t i = 0;
#if defined(KTE_HAS_VECTORS) && !defined(KTE_SCALAR_SINCOS)
  for (const std::size_t whole = n / 4 * 4; i < whole; i += 4)
    detail::sincos4(angle[i], angle[i + 1], angle[i + 2], angle[i + 3], sine + i, cosine + i);
#endif
  for (; i < n; ++i) sincos(angle[i], sine[i], cosine[i]);
}

/// Sines and cosines of n angles, rad, in other scalars: one at a time.
template <class S>
void sincos_each(const S* angle, S* sine, S* cosine, std::size_t n) {
  for (std::size_t i = 0; i < n; ++i) sincos(angle[i], sine[i], cosine[i]);
}

/// Calls visit(i, sine, cosine) for each of n angles `angle(i)`, rad, computed four at a time. The angles stay in
/// registers: a load of four numbers just stored one by one would stall.
template <class S, class Angle, class Visit>
KTE_INLINE void sincos_each(std::size_t n, const Angle& angle, const Visit& visit) {
#if defined(KTE_HAS_VECTORS) && !defined(KTE_SCALAR_SINCOS)
  if constexpr (std::is_same_v<S, double>) {
    for (std::size_t i = 0; i < n; i += 4) {
      const std::size_t last = n - 1;
      double sine[4], cosine[4];
      detail::sincos4(angle(i), angle(i + 1 < n ? i + 1 : last), angle(i + 2 < n ? i + 2 : last),
                      angle(i + 3 < n ? i + 3 : last), sine, cosine);
      for (std::size_t k = 0; k < 4 && i + k < n; ++k) visit(i + k, sine[k], cosine[k]);
    }
    return;
  }
#endif
  for (std::size_t i = 0; i < n; ++i) {
    S sine, cosine;
    sincos(S(angle(i)), sine, cosine);
    visit(i, sine, cosine);
  }
}

/// Sines `sin` and cosines `cos` of the N angles of a chain. The arrays are `padded` to whole registers where `simd`.
template <class S, std::size_t N>
struct sines {
#if defined(KTE_HAS_VECTORS) && !defined(KTE_SCALAR_SINCOS)
  static constexpr bool simd = std::is_same_v<S, double> && N >= 3;
#else
  static constexpr bool simd = false;
#endif
  static constexpr std::size_t padded = simd ? (N + 3) / 4 * 4 : N + 1;
  std::array<S, padded> sin;
  std::array<S, padded> cos;
};

/// All sines and cosines of a chain; `angle(i)` returns angle i, rad. Doubles are computed four at a time, unless
/// KTE_SCALAR_SINCOS is defined; other scalars one at a time by their own `sin` and `cos`.
template <class S, std::size_t N, class Angle>
[[nodiscard]] KTE_INLINE sines<S, N> sincos_all(const Angle& angle) {
  if constexpr (N == 0) return sines<S, N>{};
  sines<S, N> r;
  if constexpr (sines<S, N>::simd) {
#if defined(KTE_HAS_VECTORS)
    // No loops: at -O2 they would not be unrolled, and angles would be written one by one and read four at a time.
    const auto at = [&]<std::size_t I>() KTE_INLINE_LAMBDA {
      if constexpr (I < N) {
        return angle(I);
      } else {
        return S(0);
      }
    };
    const auto by_four = [&]<std::size_t... I>(std::index_sequence<I...>) KTE_INLINE_LAMBDA {
      const int done[]{
          (detail::sincos4(detail::double4{at.template operator()<4 * I>(), at.template operator()<4 * I + 1>(),
                                           at.template operator()<4 * I + 2>(), at.template operator()<4 * I + 3>()},
                           r.sin.data() + 4 * I, r.cos.data() + 4 * I),
           0)...};
      (void)done;
    };
    const auto in_range = [&]<std::size_t... I>(std::index_sequence<I...>) KTE_INLINE_LAMBDA {
      return (1 & ... & int{std::fabs(angle(I)) <= detail::largest_reduced_angle}) != 0;
    };
    if (in_range(std::make_index_sequence<N>{})) [[likely]] {
      by_four(std::make_index_sequence<sines<S, N>::padded / 4>{});
      return r;
    }
#endif
  }
  if constexpr (!sines<S, N>::simd) r.sin[N] = r.cos[N] = S(0);  // avoids copying uninitialized numbers
  const auto one_by_one = [&]<std::size_t... I>(std::index_sequence<I...>) KTE_INLINE_LAMBDA {
    const int done[]{(sincos(angle(I), r.sin[I], r.cos[I]), 0)..., 0};
    (void)done;
  };
  one_by_one(std::make_index_sequence<N>{});
  return r;
}

}  // namespace kte
