#pragma once

#include <array>
#include <cstddef>

namespace kte::detail {

/// The coefficients of p(r x + o) in powers of x.
inline std::array<double, 5> of_linear(const std::array<double, 5>& p, double r, double o) {
  std::array<double, 5> y{};
  for (std::size_t k = p.size(); k-- > 0;) {  // y <- y (r x + o) + p_k
    for (std::size_t i = y.size(); i-- > 0;) y[i] = o * y[i] + (i > 0 ? r * y[i - 1] : 0);
    y[0] += p[k];
  }
  return y;
}

}  // namespace kte::detail
