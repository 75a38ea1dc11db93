#pragma once

#include <kte/math/dual_number.hpp>

namespace kte::detail {

/// What a scalar calculates with: of packs and of numbers with derivatives that of one of their numbers.
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

}  // namespace kte::detail
