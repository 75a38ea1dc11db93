#pragma once

#include <kte/math/sincos.hpp>

namespace kte {

namespace detail {
#if defined(KTE_HAS_VECTORS)
/// Four angles of directions (x, y) at once, rad, in [-pi, pi], absolute error below 4e-16; 0 at the origin. With m, M
/// the smaller and the larger of |x|, |y|:
///
///   r = m/M,  or (m - M)/(m + M) where m/M > tan(pi/8)                                         (1)
///   atan r = r + r^3 P(r^2)  on |r| <= tan(pi/8)                                               (2)
///   angle = +-(k pi/4 +- atan r)                                                               (3)
///
/// P: minimax (Remez), relative error of (2) 3.4e-17. Multiples of pi/4 in two parts.
KTE_INLINE void atan2_4(const double4& y, const double4& x, double* angle) {
  constexpr long long sign = 1ll << 63;
  const auto ax = (double4)((int64x4)x & ~sign), ay = (double4)((int64x4)y & ~sign);
  const int64x4 steep = ay > ax, back = (int64x4)x < 0;
  const double4 least = steep ? ax : ay, most = steep ? ay : ax;
  const int64x4 halved = least > 0.41421356237309504880 * most;
  const double4 over = halved ? least - most : least, under = halved ? least + most : most;
  const double4 r = over / (under == 0.0 ? double4{1, 1, 1, 1} : under), z = r * r;  // (1)
  const double4 p = ((((((((2.12800712090911e-02 * z - 4.360819718318247e-02) * z + 5.693162927047609e-02) * z -
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
  const double4 atan = p * (z * r) + r;  // (2)
  // k, and whether atan r is taken from k pi/4 or added to it
  const double4 none{}, one = none + 1.0, two = none + 2.0, four = none + 4.0;
  const double4 first = halved ? one : none, within = steep ? two - first : first;
  const double4 k = back ? four - within : within;
  const double4 signed_atan = (double4)((int64x4)atan ^ ((steep ^ back) & sign));
  const double4 t = k * 7.85398163397448278999e-01 + (k * 3.06161699786838301793e-17 + signed_atan);
  const auto with_sign = (int64x4)t ^ ((int64x4)y & sign);  // (3)
  __builtin_memcpy(angle, &with_sign, sizeof with_sign);
}
#endif
}  // namespace detail

/// Angles of n directions, atan2(y, x), rad, of finite numbers: four at a time as sines are (`sincos_each`).
inline void atan2_each(const double* y, const double* x, double* angle, std::size_t n) {
  std::size_t i = 0;
#if defined(KTE_HAS_VECTORS) && !defined(KTE_SCALAR_SINCOS)
  for (const std::size_t fours = n / 4 * 4; i < fours; i += 4)
    detail::atan2_4(detail::double4{y[i], y[i + 1], y[i + 2], y[i + 3]},
                    detail::double4{x[i], x[i + 1], x[i + 2], x[i + 3]}, angle + i);
#endif
  for (; i < n; ++i) angle[i] = std::atan2(y[i], x[i]);
}

/// Of other scalars, one by one.
template <class S>
void atan2_each(const S* y, const S* x, S* angle, std::size_t n) {
  using std::atan2;
  for (std::size_t i = 0; i < n; ++i) angle[i] = atan2(y[i], x[i]);
}

}  // namespace kte
