#pragma once

#include <kte/recursions/axis_elimination.hpp>

/// The inverse of the mass matrix from articulated inertias, in innovations form (Rodriguez, Jain and Kreutz-Delgado,
/// Int. J. Robotics Research 10, 1991; Jain, Robot and Multibody Dynamics, 2011, section 7.2). A unit force on axis j
/// has the innovation e_ij on each axis i on its path to the base, and
///
///   (M^-1)_jk = sum_i e_ij D_i^-1 e_ik        over the axes i on both paths          (1)
///
/// No sum exceeds the geometric mean of two diagonal entries.
namespace kte::engine {

/// x as a number of the type of a force; as it is for typed forces.
template <class Force, class X>
KTE_INLINE constexpr auto innovation(const X& x) {
  if constexpr (typed_constant<Force>) {
    return x;
  } else {
    return static_cast<Force>(x);
  }
}
/// For a load W at a body and forces force(k) on the axes of its joint: the innovation of each axis, from the last on,
/// by put(k, e), and the remaining load:
///
///   e_k = f_k + s_k^T W,   W' = W - U_k D_k^-1 e_k          (2)
///
/// Works on S, or on several numbers at a time. Forces may be typed zeros.
template <int K, body_with_axes B, class W, class Force, class S, class Put>
KTE_INLINE constexpr auto load_beyond_axes(const B& b, const W& load, const Force& force,
                                           const axis_factors<S>* factors, const Put& put) {
  if constexpr (K < 0) {
    return load;
  } else {
    constexpr std::integral_constant<int, K> k{};
    constexpr int n = eliminated_component<B, K>;
    const auto s = b.template axis<K>();
    const auto f = force(k);
    const auto e = innovation<std::remove_const_t<decltype(f)>>(f + power(s, load));
    put(k, e);
    const wrench left{load.force - e * factors[K].gain.force, load.torque - e * factors[K].gain.torque};
    if constexpr (n < 0) {
      return load_beyond_axes<K - 1>(b, left, force, factors, put);
    } else {
      return load_beyond_axes<K - 1>(b, without<n>(left) - wrench{f * s.linear, f * s.angular}, force, factors, put);
    }
  }
}

}  // namespace kte::engine
