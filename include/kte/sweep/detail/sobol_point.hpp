#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <iterator>

/// Sobol's sequence of points that fill a cube evenly.
namespace kte::detail {

/// The primitive polynomial of a dimension, without its first and last coefficient, its degree, and the first direction
/// numbers: S. Joe and F. Y. Kuo, Constructing Sobol sequences with better two-dimensional projections, SIAM J. Sci.
/// Comput. 30 (2008), their table `new-joe-kuo-6`. The first dimension has none.
struct sobol_polynomial {
  int degree;
  unsigned inner;
  std::array<unsigned, 7> first;
};
inline constexpr sobol_polynomial sobol_polynomials[]{
    {1, 0, {1}},
    {2, 1, {1, 3}},
    {3, 1, {1, 3, 1}},
    {3, 2, {1, 1, 1}},
    {4, 1, {1, 1, 3, 3}},
    {4, 4, {1, 3, 5, 13}},
    {5, 2, {1, 1, 5, 5, 17}},
    {5, 4, {1, 1, 5, 5, 5}},
    {5, 7, {1, 1, 7, 11, 19}},
    {5, 11, {1, 1, 5, 1, 1}},
    {5, 13, {1, 1, 1, 3, 11}},
    {5, 14, {1, 3, 5, 5, 31}},
    {6, 1, {1, 3, 3, 9, 7, 49}},
    {6, 13, {1, 1, 1, 15, 21, 21}},
    {6, 16, {1, 3, 1, 13, 27, 49}},
    {6, 19, {1, 1, 1, 15, 7, 5}},
    {6, 22, {1, 3, 1, 15, 13, 25}},
    {6, 25, {1, 1, 5, 5, 19, 61}},
    {7, 1, {1, 3, 7, 11, 23, 15, 103}},
    {7, 4, {1, 3, 7, 13, 13, 15, 69}},
};
/// The largest number of dimensions.
inline constexpr std::size_t sobol_dimensions = 1 + std::size(sobol_polynomials);

/// The direction numbers of a dimension, as fractions of 2^32:
///
///   v_k = m_k 2^(32 - k),   m_k = 2 a_1 m_(k-1) ^ ... ^ 2^(s-1) a_(s-1) m_(k-s+1) ^ 2^s m_(k-s) ^ m_(k-s)      (1)
constexpr std::array<std::uint32_t, 32> sobol_directions(std::size_t dimension) {
  std::array<std::uint32_t, 32> v{};
  for (unsigned k = 0; k < 32; ++k) {
    if (dimension == 0) {
      v[k] = std::uint32_t{1} << (31 - k);
      continue;
    }
    const auto& p = sobol_polynomials[dimension - 1];
    const auto s = static_cast<unsigned>(p.degree);
    if (k < s) {
      v[k] = p.first[k] << (31 - k);
    } else {
      v[k] = v[k - s] ^ (v[k - s] >> s);
      for (unsigned j = 1; j < s; ++j)
        if (p.inner >> (s - 1 - j) & 1) v[k] ^= v[k - j];
    }
  }
  return v;
}
/// Coordinate `dimension` of point i < 2^32 in Gray code order, in [0, 1).
constexpr double sobol_coordinate(std::uint64_t i, const std::array<std::uint32_t, 32>& directions) {
  std::uint32_t x = 0;
  for (std::uint64_t gray = i ^ (i >> 1); gray != 0; gray &= gray - 1)
    x ^= directions[static_cast<std::size_t>(std::countr_zero(gray))];
  return static_cast<double>(x) * 0x1p-32;
}

}  // namespace kte::detail
