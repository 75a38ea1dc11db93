#pragma once

#include <kte/math/plain_scalar.hpp>

#include <array>
#include <cstddef>
#include <type_traits>

namespace kte {

/// A rational number `num`/`den`, so that a tableau is exact in every scalar.
struct ratio {
  long long num = 0;
  long long den = 1;

  friend constexpr bool operator==(const ratio&, const ratio&) = default;
};

/// The entries of a row of a tableau, one per stage.
template <std::size_t Stages>
using tableau_row = std::array<ratio, Stages>;

namespace detail {

/// A ratio as a scalar, divided once.
template <class S, ratio R>
S coefficient() {
  if constexpr (std::is_floating_point_v<S>) {
    constexpr S value = S(R.num) / S(R.den);
    return value;
  } else if constexpr (is_pack<S>) {
    return S(coefficient<typename S::value_type, R>());
  } else {
    static const S value = S(R.num) / S(R.den);
    return value;
  }
}

/// The time of a stage; exactly `end` for the last one.
template <class S, ratio C>
S stage_time(const S& t, const S& h, const S& end) {
  if constexpr (C == ratio{1, 1}) {
    return end;
  } else {
    return S(t + coefficient<S, C>() * h);
  }
}

template <std::size_t N>
constexpr bool zero_from(const tableau_row<N>& w, std::size_t i) {
  while (i < N && w[i].num == 0) ++i;
  return i == N;
}

template <std::size_t N>
constexpr bool equal_from(const tableau_row<N>& v, const tableau_row<N>& w, std::size_t i) {
  while (i < N && v[i] == w[i]) ++i;
  return i == N;
}

/// w_1 k_1 + w_2 k_2 + ... without terms of weight zero, as one Eigen expression without temporaries.
template <auto Weights, std::size_t I = 0, class X, std::size_t N>
auto combination(const std::array<X, N>& k) {
  using S = typename X::Scalar;
  if constexpr (Weights[I].num == 0) {
    return combination<Weights, I + 1>(k);
  } else if constexpr (zero_from(Weights, I + 1)) {
    return coefficient<S, Weights[I]>() * k[I];
  } else {
    return coefficient<S, Weights[I]>() * k[I] + combination<Weights, I + 1>(k);
  }
}

/// (v_1 - w_1) k_1 + (v_2 - w_2) k_2 + ... without terms of weight zero, as one Eigen expression.
template <auto V, auto W, std::size_t I = 0, class X, std::size_t N>
auto difference(const std::array<X, N>& k) {
  using S = typename X::Scalar;
  const auto term = [&] { return S(coefficient<S, V[I]>() - coefficient<S, W[I]>()) * k[I]; };
  if constexpr (V[I] == W[I]) {
    return difference<V, W, I + 1>(k);
  } else if constexpr (I + 1 == N || equal_from(V, W, I + 1)) {
    return term();
  } else {
    return term() + difference<V, W, I + 1>(k);
  }
}

}  // namespace detail
}  // namespace kte
