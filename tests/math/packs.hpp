#pragma once

#include <kte/math/pack.hpp>

#include <array>
#include <cmath>

#include "random.hpp"

/// Packs of all lengths.
namespace kte::test {

template <class F>
void for_all_packs(const F& f) {
  const auto sizes = [&]<class T>(T) {
    f.template operator()<pack<T, 1>>();
    f.template operator()<pack<T, 2>>();
    f.template operator()<pack<T, 4>>();
    f.template operator()<pack<T, 8>>();
    f.template operator()<pack<T, 16>>();
  };
  sizes(float{});
  sizes(double{});
}

template <class P>
using lanes_of = std::array<typename P::value_type, static_cast<std::size_t>(P::lanes)>;

template <class P>
P random_pack(random_numbers& random, double size) {
  lanes_of<P> x;
  for (auto& lane : x) lane = static_cast<typename P::value_type>(random(size));
  return P::load(x.data());
}

/// Whether bits are equal; NaN equals NaN.
template <class T>
bool same(T a, T b) {
  return std::isnan(a) ? std::isnan(b) : a == b && std::signbit(a) == std::signbit(b);
}

template <class P, class F>
bool each(const P& result, const F& of_lane) {
  for (std::size_t i = 0; i < std::size_t{P::lanes}; ++i)
    if (!same<typename P::value_type>(result[i], of_lane(i))) return false;
  return true;
}

}  // namespace kte::test
