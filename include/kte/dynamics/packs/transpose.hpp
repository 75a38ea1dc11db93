#pragma once

#include <kte/detail/shuffles.hpp>
#include <kte/detail/unroll.hpp>
#include <kte/math/pack.hpp>

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <utility>

/// Converts states, each with contiguous numbers, to packs with one number of all states, and back. Done number by
/// number, this took half as long as inverse dynamics of a robot with seven joints.
namespace kte::batch::detail {

using kte::detail::unroll;

#if defined(KTE_HAS_SHUFFLES)

template <class T, std::size_t W>
struct vector_of {
  typedef T type __attribute__((vector_size(W * sizeof(T))));
};
template <class T, std::size_t W>
using vector = typename vector_of<T, W>::type;

/// Squares of L x L numbers, transposed in registers of W lanes, with W/L squares side by side.
template <class T, std::size_t W, std::size_t L>
struct squares {
  using V = vector<T, W>;
  using lanes = std::make_index_sequence<W>;

  /// Loads from rows with a distance of `row` numbers: v[j] has rows j, j + L, j + 2 L ...
  KTE_INLINE static void load(const T* p, std::size_t row, std::array<V, L>& v) {
    unroll<L>([&]<std::size_t J>() KTE_INLINE_LAMBDA { v[J] = joined<W>(p + J * row, row); });
  }
  KTE_INLINE static void store(const std::array<V, L>& v, T* p, std::size_t row) {
    unroll<L>([&]<std::size_t J>() KTE_INLINE_LAMBDA { parted<W>(v[J], p + J * row, row); });
  }
  /// Transposes by Eklundh's method (IEEE Trans. Computers C-21, 1972): exchanges off-diagonal blocks of size 1, 2, 4
  /// ...
  KTE_INLINE static void transpose(std::array<V, L>& v) { exchange<1>(v); }

 private:
  template <std::size_t M>
  KTE_INLINE static vector<T, M> joined(const T* p, std::size_t row) {
    if constexpr (M == L) {
      vector<T, M> v;
      std::memcpy(&v, p, sizeof v);
      return v;
    } else {
      return all_of<M>(joined<M / 2>(p, row), joined<M / 2>(p + M / 2 * row, row), std::make_index_sequence<M>{});
    }
  }
  template <std::size_t M, class H, std::size_t... I>
  KTE_INLINE static vector<T, M> all_of(const H& a, const H& b, std::index_sequence<I...>) {
    return __builtin_shufflevector(a, b, I...);
  }
  template <std::size_t M, class H>
  KTE_INLINE static void parted(const H& v, T* p, std::size_t row) {
    if constexpr (M == L) {
      std::memcpy(p, &v, sizeof v);
    } else {
      using half = std::make_index_sequence<M / 2>;
      parted<M / 2>(from<0>(v, half{}), p, row);
      parted<M / 2>(from<M / 2>(v, half{}), p + M / 2 * row, row);
    }
  }
  template <std::size_t First, class H, std::size_t... I>
  KTE_INLINE static auto from(const H& v, std::index_sequence<I...>) {
    return __builtin_shufflevector(v, v, (First + I)...);
  }
  template <std::size_t H>
  KTE_INLINE static void exchange(std::array<V, L>& v) {
    if constexpr (H < L) {
      unroll<L>([&]<std::size_t J>() KTE_INLINE_LAMBDA { exchange_rows<H, J>(v, lanes{}); });
      exchange<2 * H>(v);
    }
  }
  template <std::size_t H, std::size_t J, std::size_t... I>
  KTE_INLINE static void exchange_rows(std::array<V, L>& v, std::index_sequence<I...>) {
    if constexpr ((J & H) == 0) {
      const V a = v[J], b = v[J + H];
      v[J] = __builtin_shufflevector(a, b, ((I & H) == 0 ? I : W + I - H)...);
      v[J + H] = __builtin_shufflevector(a, b, ((I & H) == 0 ? I + H : W + I)...);
    }
  }
};

/// Columns first, first + L ... of N. The last square is moved left to end at N.
template <class P, std::size_t N>
struct columns {
  using T = typename P::value_type;
  static constexpr std::size_t w = sizeof(typename P::register_type) / sizeof(T);
  static constexpr std::size_t l = (std::min)(std::bit_floor(N), w);
  using square = squares<T, w, l>;
  static constexpr std::size_t all_squares = (N + l - 1) / l;
  static constexpr std::size_t start(std::size_t i) { return (std::min)(i * l, N - l); }

  KTE_INLINE static void load(const T* states, std::size_t reg, P* x) {
    unroll<all_squares>([&]<std::size_t I>() KTE_INLINE_LAMBDA {
      std::array<typename square::V, l> v;
      square::load(states + reg * w * N + start(I), N, v);
      square::transpose(v);
      unroll<l>([&]<std::size_t J>() KTE_INLINE_LAMBDA { x[start(I) + J].in_register(reg) = v[J]; });
    });
  }
  KTE_INLINE static void store(const P* x, std::size_t reg, T* states) {
    unroll<all_squares>([&]<std::size_t I>() KTE_INLINE_LAMBDA {
      std::array<typename square::V, l> v;
      unroll<l>([&]<std::size_t J>() KTE_INLINE_LAMBDA { v[J] = x[start(I) + J].in_register(reg); });
      square::transpose(v);
      square::store(v, states + reg * w * N + start(I), N);
    });
  }
};

template <class P>
inline constexpr bool by_squares = sizeof(typename P::register_type) > sizeof(typename P::value_type);
#else
template <class P>
inline constexpr bool by_squares = false;
#endif

/// Converts N numbers of each of P::lanes states to N packs, and back.
template <std::size_t N, class P>
KTE_INLINE void gather(const typename P::value_type* states, P* x) {
#if defined(KTE_HAS_SHUFFLES)
  if constexpr (N > 0 && by_squares<P>) {
    return unroll(typename P::registers{},
                  [&]<std::size_t R>() KTE_INLINE_LAMBDA { columns<P, N>::load(states, R, x); });
  }
#endif
  for (std::size_t k = 0; k < std::size_t{P::lanes}; ++k)
    for (std::size_t i = 0; i < N; ++i) x[i].set(k, states[k * N + i]);
}
template <std::size_t N, class P>
KTE_INLINE void scatter(const P* x, typename P::value_type* states) {
#if defined(KTE_HAS_SHUFFLES)
  if constexpr (N > 0 && by_squares<P>) {
    return unroll(typename P::registers{},
                  [&]<std::size_t R>() KTE_INLINE_LAMBDA { columns<P, N>::store(x, R, states); });
  }
#endif
  for (std::size_t k = 0; k < std::size_t{P::lanes}; ++k)
    for (std::size_t i = 0; i < N; ++i) states[k * N + i] = x[i][k];
}

}  // namespace kte::batch::detail
