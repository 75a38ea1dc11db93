#pragma once

#include <kte/math/squares.hpp>
#include <kte/math/vec.hpp>

#include <cmath>
#include <type_traits>

namespace kte::detail {

/// The length of a vector and its direction: a unit vector, or 0 for the zero vector. Neither these nor their
/// derivatives are NaN for the zero vector.
template <class Length, class Direction>
struct polar {
  Length length;
  Direction direction;
};
template <class X, class Y, class Z>
KTE_INLINE constexpr auto to_polar(const vec3<X, Y, Z>& d) {
  using std::sqrt;
  const auto square = as_number(dot(d, d));
  using S = std::remove_const_t<decltype(square)>;
  using result = polar<S, std::remove_const_t<decltype(S() * d)>>;
  if (keeps_digits(square)) [[likely]] {
    const S length = sqrt(square);
    return result{length, S(S(1) / length) * d};
  }
  const S k = scale_for_squares(square);
  const auto u = k * d;
  const S n = as_number(dot(u, u));
  const auto none = n == S(0);
  const S length = sqrt(select(none, S(1), n));
  return result{select(none, S(0), S(length / k)), S(S(1) / length) * (select(none, S(1), k) * d)};
}

}  // namespace kte::detail
