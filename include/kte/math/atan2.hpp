#pragma once

#include <kte/math/sincos.hpp>

namespace kte {

namespace detail {
#if defined(KTE_HAS_VECTORS)
/// Angles of several directions (x, y), rad, in [-pi, pi], absolute error below 4e-16; 0 at the origin. V: a vector of
/// doubles. With m, M the smaller and the larger of |x|, |y|:
///
///   r = m/M,  or (m - M)/(m + M) where m/M > tan(pi/8)                                         (1)
///   atan r = r + r^3 P(r^2)  on |r| <= tan(pi/8)                                               (2)
///   angle = +-(k pi/4 +- atan r)                                                               (3)
///
/// P: minimax (Remez), relative error of (2) 3.4e-17. Multiples of pi/4 in two parts.
template <class V>
KTE_INLINE void atan2_of(const V& y, const V& x, V& angle) {
  typedef long long integers __attribute__((vector_size(sizeof(V))));
  constexpr long long sign = 1ll << 63;
  const auto ax = (V)((integers)x & ~sign), ay = (V)((integers)y & ~sign);
  const integers steep = ay > ax, back = (integers)x < 0;
  const V least = steep ? ax : ay, most = steep ? ay : ax;
  const integers halved = least > 0.41421356237309504880 * most;
  const V none{}, one = none + 1.0, two = none + 2.0, four = none + 4.0;
  const V over = halved ? least - most : least, under = halved ? least + most : most;
  const V r = over / (under == 0.0 ? one : under), z = r * r;  // (1)
  const V p = ((((((((2.12800712090911e-02 * z - 4.360819718318247e-02) * z + 5.693162927047609e-02) * z -
                    6.641245918799904e-02) *
                       z +
                   7.690083322618335e-02) *
                      z -
                  9.090783526988254e-02) *
                     z +
                 1.1111106703529275e-01) *
                    z -
                1.428571419652744e-01) *
                   z +
               1.9999999999104695e-01) *
                  z -
              3.333333333333022e-01;
  const V atan = p * (z * r) + r;  // (2)
  // k, and whether atan r is subtracted from k pi/4 or added to it
  const V first = halved ? one : none, within = steep ? two - first : first;
  const V k = back ? four - within : within;
  const auto signed_atan = (V)((integers)atan ^ ((steep ^ back) & sign));
  const V t = k * 7.85398163397448278999e-01 + (k * 3.06161699786838301793e-17 + signed_atan);
  angle = (V)((integers)t ^ ((integers)y & sign));  // (3)
}
#endif
}  // namespace detail

/// The angle of a direction, atan2(y, x), rad.
template <class S>
KTE_INLINE constexpr S angle_of(const S& y, const S& x) {
  using std::atan2;
  return atan2(y, x);
}
#if defined(KTE_HAS_VECTORS) && !defined(KTE_SCALAR_SINCOS)
/// Of doubles as in `atan2_each`. Not inlined, because g++ 12 fails on some functions that contain it (segmentation
/// fault in "slp"); calls whose result is not used disappear.
[[gnu::const, gnu::noinline]] inline double angle_of(double y, double x) {
  using double2 = double __attribute__((vector_size(16)));
  double2 t;
  detail::atan2_of(double2{y, y}, double2{x, x}, t);
  return t[0];
}
#endif

/// Angles of n directions, atan2(y, x), rad. The numbers must be finite. Four are computed at a time, as in
/// `sincos_each`.
inline void atan2_each(const double* y, const double* x, double* angle, std::size_t n) {
  std::size_t i = 0;
#if defined(KTE_HAS_VECTORS) && !defined(KTE_SCALAR_SINCOS)
  for (const std::size_t whole = n / 4 * 4; i < whole; i += 4) {
    detail::double4 t;
    detail::atan2_of(detail::double4{y[i], y[i + 1], y[i + 2], y[i + 3]},
                     detail::double4{x[i], x[i + 1], x[i + 2], x[i + 3]}, t);
    __builtin_memcpy(angle + i, &t, sizeof t);
  }
#endif
  for (; i < n; ++i) angle[i] = std::atan2(y[i], x[i]);
}

/// Angles in other scalars, one at a time; packs of doubles as many at a time as fit their registers.
template <class S>
void atan2_each(const S* y, const S* x, S* angle, std::size_t n) {
  using std::atan2;
#if defined(KTE_HAS_VECTORS) && !defined(KTE_SCALAR_SINCOS)
  if constexpr (requires { typename S::register_type; }) {
    if constexpr (std::is_same_v<typename S::value_type, double> && sizeof(typename S::register_type) > 8) {
      for (std::size_t i = 0; i < n; ++i)
        for (std::size_t k = 0; k < S::registers::size(); ++k)
          detail::atan2_of(y[i].in_register(k), x[i].in_register(k), angle[i].in_register(k));
      return;
    }
  }
#endif
  for (std::size_t i = 0; i < n; ++i) angle[i] = atan2(y[i], x[i]);
}

}  // namespace kte
