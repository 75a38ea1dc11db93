#pragma once

#include <kte/math/dual_number.hpp>

namespace kte::detail {

/// The arithmetic type of a scalar: for packs and dual numbers that of one of their numbers.
template <class S>
struct plain_scalar_of {
  using type = S;
};
template <class S>
requires requires { S::lanes; }
struct plain_scalar_of<S> : plain_scalar_of<typename S::value_type> {};
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
constexpr const auto& value_part(const dual<T, N>& x) {
  return value_part(x.value);
}
/// The plain value for messages.
template <class S>
constexpr double as_double(const S& x) {
  return static_cast<double>(value_part(x));
}

}  // namespace kte::detail
