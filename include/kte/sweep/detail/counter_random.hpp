#pragma once

#include <cmath>
#include <cstdint>

/// Random numbers as functions of a seed and two indices, so that every case of a sweep is known without the others.
namespace kte::detail {

/// The output function of the generator splitmix64: a permutation of 64-bit numbers that mixes all bits.
constexpr std::uint64_t mixed(std::uint64_t x) {
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9U;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebU;
  return x ^ (x >> 31);
}
/// A number in (0, 1), a multiple of 2^-53 plus 2^-54, for a seed, a case and a column.
constexpr double uniform_number(std::uint64_t seed, std::uint64_t index, std::uint64_t column) {
  constexpr std::uint64_t step = 0x9e3779b97f4a7c15U;
  const std::uint64_t stream = mixed(mixed(seed + step) ^ mixed((column + 1) * step));
  return (static_cast<double>(mixed(stream + (index + 1) * step) >> 11) + 0.5) * 0x1p-53;
}

/// The x at which the cumulative normal distribution is p, 0 < p < 1: Newton's and Halley's corrections
///
///   e = (erfc(-x / sqrt 2) / 2 - p) sqrt(2 pi) exp(x^2 / 2),   x -= e / (1 + x e / 2)                (1)
///
/// from (26.2.23) of Abramowitz and Stegun, whose error is below 4.5e-4.
inline double inverse_normal(double p) {
  if (p > 0.5) return -inverse_normal(1 - p);
  const double t = std::sqrt(-2 * std::log(p));
  double x = (2.515517 + t * (0.802853 + t * 0.010328)) / (1 + t * (1.432788 + t * (0.189269 + t * 0.001308))) - t;
  for (int i = 0; i < 2; ++i) {
    const double e = (std::erfc(-x * 0.70710678118654752) / 2 - p) * 2.5066282746310002 * std::exp(x * x / 2);
    x -= e / (1 + x * e / 2);
  }
  return x;
}

}  // namespace kte::detail
