#pragma once

#include <kte/detail/inline.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <type_traits>
#include <utility>

/// As many contiguous numbers as fit into a register. Not packs (math/pack.hpp), which are scalars with all functions;
/// this compiles faster.
namespace kte::tree {

/// `type` has +, -, * with itself and with S; for most scalars it is a single number.
template <class S>
struct simd_of {
  using type = S;
  static constexpr std::size_t count = 1;
};
#if defined(__GNUC__) || defined(__clang__)
#  ifdef __AVX__
#    define KTE_REGISTER 32
#  else
#    define KTE_REGISTER 16
#  endif
template <>
struct simd_of<double> {
  typedef double type __attribute__((vector_size(KTE_REGISTER)));
  static constexpr std::size_t count = sizeof(type) / sizeof(double);
};
template <>
struct simd_of<float> {
  typedef float type __attribute__((vector_size(KTE_REGISTER)));
  static constexpr std::size_t count = sizeof(type) / sizeof(float);
};
#  undef KTE_REGISTER
#endif
template <class S>
using simd = typename simd_of<S>::type;

/// The most numbers in a register: this many numbers before and after a row may be read and written.
inline constexpr std::size_t most_lanes = 8;

/// Simd: simd<S>, or S itself.
template <class S, class Simd>
KTE_INLINE void load(Simd& x, const S* from) {
  if constexpr (std::is_same_v<Simd, S>)
    x = *from;
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
