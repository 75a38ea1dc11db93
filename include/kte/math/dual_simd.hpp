#pragma once

#include <kte/detail/inline.hpp>

#include <bit>
#include <cstddef>
#include <type_traits>
#include <utility>

/// The derivatives of a dual number: storage, and arithmetic on all of them at once.
namespace kte {

namespace detail {

/// The number of stored numbers for N derivatives of type T. Floats and doubles are padded to whole vectors of 32
/// bytes, or to the next power of two if one vector holds them all. Neither size nor alignment depends on the CPU:
/// units compiled with different options can be linked, and any container can hold dual numbers.
template <class T>
constexpr std::size_t padded_lanes(std::size_t n) {
  if constexpr (std::is_same_v<T, double> || std::is_same_v<T, float>) {
    constexpr std::size_t whole = 32 / sizeof(T);
    return n < whole ? std::bit_ceil(n) : (n + whole - 1) / whole * whole;
  } else {
    return n;
  }
}

/// The number of derivatives per vector operation. The loop vectorizer of the compiler leaves the arrays in memory;
/// explicit vectors stay in registers between operations, at three times the speed.
template <class T>
constexpr std::size_t vector_lanes(std::size_t padded) {
  if constexpr (!std::is_same_v<T, double> && !std::is_same_v<T, float>) return 1;
#if defined(__AVX__)
  constexpr std::size_t longest = 32 / sizeof(T);
#elif defined(__GNUC__) || defined(__clang__)
  constexpr std::size_t longest = 16 / sizeof(T);
#else
  constexpr std::size_t longest = 1;
#endif
  return padded < longest ? padded : longest;
}

#if defined(__GNUC__) || defined(__clang__)
template <class T, std::size_t Lanes>
struct simd {
  using type [[gnu::vector_size(sizeof(T) * Lanes)]] = T;
  KTE_INLINE static type load(const T* p) {
    type v;
    __builtin_memcpy(&v, p, sizeof v);
    return v;
  }
  KTE_INLINE static void store(T* p, const type& v) { __builtin_memcpy(p, &v, sizeof v); }
};
#endif

}  // namespace detail

/// N derivatives, read by index: `size`, `data`, `begin`, `end` as of an array.
template <class T, int N>
class derivatives {
  static_assert(N > 0, "kte: a dual number has at least one derivative");
  static constexpr std::size_t padded = detail::padded_lanes<T>(std::size_t{N});
  static constexpr std::size_t at_a_time = detail::vector_lanes<T>(padded);

 public:
  using value_type = T;

  KTE_INLINE constexpr T& operator[](std::size_t i) { return d_[i]; }
  KTE_INLINE constexpr const T& operator[](std::size_t i) const { return d_[i]; }
  static constexpr std::size_t size() { return std::size_t{N}; }
  KTE_INLINE constexpr const T* data() const { return d_; }
  KTE_INLINE constexpr const T* begin() const { return d_; }
  KTE_INLINE constexpr const T* end() const { return d_ + N; }

  /// f(x, y, ...) for each derivative of x, y, ...; f accepts numbers and vectors.
  template <class F, class... X>
  KTE_INLINE static constexpr derivatives map(const F& f, const X&... x) {
    derivatives r;
    if constexpr (at_a_time > 1) {
      if (!__builtin_is_constant_evaluated()) {
        by_vectors(r, std::make_index_sequence<padded / at_a_time>{}, f, x...);
        return r;
      }
    }
    for (std::size_t i = 0; i < padded; ++i) r.d_[i] = T(f(x.d_[i]...));
    return r;
  }

 private:
  template <std::size_t... I, class F, class... X>
  KTE_INLINE static void by_vectors(derivatives& r, std::index_sequence<I...>, const F& f, const X&... x) {
    (one_vector<I * at_a_time>(r, f, x...), ...);
  }
  template <std::size_t At, class F, class... X>
  KTE_INLINE static void one_vector(derivatives& r, const F& f, const X&... x) {
    using v = detail::simd<T, at_a_time>;
    v::store(r.d_ + At, f(v::load(x.d_ + At)...));
  }

  T d_[padded];  // no std::array: see KTE_INLINE
};

}  // namespace kte
