#pragma once

#include <kte/detail/inline.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <type_traits>
#include <utility>

/// Contiguous numbers with common arithmetic, usually as many as fit into a register. Not packs (math/pack.hpp), which
/// are scalars with all functions; this compiles faster.
namespace kte::tree {

/// How many numbers of type S fit into a register; 1 for most scalars.
template <class S>
inline constexpr std::size_t register_lanes = 1;
#if defined(__GNUC__) || defined(__clang__)
#  ifdef __AVX__
inline constexpr std::size_t register_bytes = 32;
#  else
inline constexpr std::size_t register_bytes = 16;
#  endif
template <>
inline constexpr std::size_t register_lanes<double> = register_bytes / sizeof(double);
template <>
inline constexpr std::size_t register_lanes<float> = register_bytes / sizeof(float);
#endif

/// N numbers without a register.
template <class S, std::size_t N>
struct numbers {
  std::array<S, N> n;

  KTE_INLINE S& operator[](int i) { return n[static_cast<std::size_t>(i)]; }
  KTE_INLINE const S& operator[](int i) const { return n[static_cast<std::size_t>(i)]; }
  KTE_INLINE numbers& operator+=(const numbers& b) { return *this = *this + b; }
  KTE_INLINE friend numbers operator+(const numbers& a, const numbers& b) {
    return each([&](int i) { return S(a[i] + b[i]); });
  }
  KTE_INLINE friend numbers operator-(const numbers& a, const numbers& b) {
    return each([&](int i) { return S(a[i] - b[i]); });
  }
  KTE_INLINE friend numbers operator*(const numbers& a, const numbers& b) {
    return each([&](int i) { return S(a[i] * b[i]); });
  }
  KTE_INLINE friend numbers operator*(const S& a, const numbers& b) {
    return each([&](int i) { return S(a * b[i]); });
  }
  KTE_INLINE friend numbers operator*(const numbers& a, const S& b) { return b * a; }

 private:
  template <class F>
  KTE_INLINE static numbers each(const F& f) {
    numbers x;
    for (int i = 0; i < static_cast<int>(N); ++i) x[i] = f(i);
    return x;
  }
};
/// `type` has +, -, * with itself and with S, and [] unless it is a single number. Pass it by reference, because not
/// all processors pass it in a register.
template <class S, std::size_t N = register_lanes<S>>
struct simd_of {
  using type = numbers<S, N>;
  static constexpr std::size_t count = N;
};
template <class S>
struct simd_of<S, 1> {
  using type = S;
  static constexpr std::size_t count = 1;
};
template <class S, std::size_t N>
requires(N > 1 && register_lanes<S> > 1) struct simd_of<S, N> {
  typedef S type __attribute__((vector_size(N * sizeof(S))));
  static constexpr std::size_t count = N;
};
template <class S, std::size_t N = register_lanes<S>>
using simd = typename simd_of<S, N>::type;

/// The most numbers in a register: this many numbers before and after a row may be read and written.
inline constexpr std::size_t most_lanes = 8;

/// Simd: simd<S, N>, or S itself.
template <class S, class Simd>
KTE_INLINE void load(Simd& x, const S* from) {
  if constexpr (std::is_same_v<Simd, S>)
    x = *from;
  else if constexpr (requires { x.n; })
    std::copy_n(from, x.n.size(), x.n.data());
  else
    std::memcpy(&x, from, sizeof x);
}
template <class S, class Simd>
KTE_INLINE void store(const Simd& x, S* to) {
  if constexpr (std::is_same_v<Simd, S>)
    *to = x;
  else
    std::memcpy(to, &x, sizeof x);
}
/// One lane of a register. A number is blended in, because a separate store would have to reach memory before the
/// register can be loaded.
template <class S>
class simd_lane {
  static constexpr int count = static_cast<int>(simd_of<S>::count);

 public:
  explicit simd_lane(int i) {
    if constexpr (count > 1) {
      using integer = std::conditional_t<sizeof(S) == 8, std::int64_t, std::int32_t>;
      static constexpr auto ones = [] {
        std::array<integer, 2 * count> x{};
        x[count] = -1;
        return x;
      }();
      std::memcpy(&mask_, ones.data() + count - i, sizeof mask_);
    }
  }
  KTE_INLINE void put(simd<S>& x, const S& number) const {
    if constexpr (count > 1)
      x = mask_ ? simd<S>{} + number : x;
    else
      x = number;
  }

 private:
  decltype(std::declval<simd<S>>() < std::declval<simd<S>>()) mask_{};
};
/// Calls f(k) for registers that end at number `last` of a row, or n, 2 n ... before it, down to `first`, in ascending
/// order; the first register may begin before `first`.
template <class S, class F>
KTE_INLINE void for_each_simd_to(int last, int first, const F& f) {
  constexpr int n = static_cast<int>(simd_of<S>::count);
  for (int k = last - (last - first + n - 1) / n * n; k < last; k += n) f(k);
}
/// Calls f(k) for registers from number `first` of a row to `last`; the last register may extend beyond `last`.
template <class S, class F>
KTE_INLINE void for_each_simd(int first, int last, const F& f) {
  for (int k = first; k < last; k += static_cast<int>(simd_of<S>::count)) f(k);
}

}  // namespace kte::tree
