#pragma once

#include <kte/math/dual_number.hpp>

#include <cstddef>

namespace kte {
template <class D>
struct out_of_line;
}

namespace kte::detail {

/// Whether a scalar is a pack of numbers.
template <class T>
inline constexpr bool is_pack = requires {
  T::lanes;
};

/// The arithmetic type of a scalar: for packs and dual numbers that of one of their numbers.
template <class S>
struct plain_scalar_of {
  using type = S;
};
template <class S>
requires(is_pack<S>) struct plain_scalar_of<S> : plain_scalar_of<typename S::value_type> {
};
template <class T, int N>
struct plain_scalar_of<dual<T, N>> : plain_scalar_of<T> {};
template <class S>
using plain_scalar = typename plain_scalar_of<S>::type;

/// A number without its derivatives.
template <class S>
constexpr const S& value_part(const S& x) {
  return x;
}
template <class T, int N>
constexpr const auto& value_part(const dual<T, N>& x);
template <class D>
constexpr const auto& value_part(const out_of_line<D>& x) {
  return value_part(x.number);
}
template <class T, int N>
constexpr const auto& value_part(const dual<T, N>& x) {
  return value_part(x.value);
}
/// The plain value for messages; of a pack the first lane that is not finite, otherwise the first one.
template <class S>
constexpr double as_double(const S& x) {
  if constexpr (is_pack<S>) {
    for (std::size_t i = 0; i < std::size_t{S::lanes}; ++i)
      if (x[i] - x[i] != 0) return as_double(x[i]);
    return as_double(x[0]);
  } else {
    return static_cast<double>(value_part(x));
  }
}

/// The scalar of time and of step sizes, for states of scalars S: that of one lane for packs, whose lanes have a common
/// time.
template <class S>
struct time_scalar_of {
  using type = S;
};
template <class S>
requires(is_pack<S>) struct time_scalar_of<S> {
  using type = typename S::value_type;
};
template <class S>
using time_scalar = typename time_scalar_of<S>::type;
/// The largest number of all lanes; NaN if one of them is.
template <class S>
constexpr const S& largest_lane(const S& x) {
  return x;
}
template <class S>
requires(is_pack<S>) constexpr typename S::value_type largest_lane(const S& x) {
  auto most = x[0];
  for (std::size_t i = 1; i < std::size_t{S::lanes}; ++i)
    if (!(x[i] <= most)) most = most != most ? most : x[i];
  return most;
}

}  // namespace kte::detail
