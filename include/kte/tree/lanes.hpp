#pragma once

#include <kte/detail/inline.hpp>

#include <cstddef>
#include <cstring>
#include <type_traits>

/// As many numbers of a row as a register of the processor takes at once. Not packs (math/pack.hpp), which are scalars
/// of their own with all that scalars can: this costs nothing to compile.
namespace kte::tree {

/// `type` has +, -, * with itself and with S; of most scalars it is one number.
template <class S>
struct lanes_of {
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
struct lanes_of<double> {
  typedef double type __attribute__((vector_size(KTE_REGISTER)));
  static constexpr std::size_t count = sizeof(type) / sizeof(double);
};
template <>
struct lanes_of<float> {
  typedef float type __attribute__((vector_size(KTE_REGISTER)));
  static constexpr std::size_t count = sizeof(type) / sizeof(float);
};
#  undef KTE_REGISTER
#endif
template <class S>
using lanes = typename lanes_of<S>::type;

/// The most numbers that stand in a register: so many may be read and written beyond the end of a row.
inline constexpr std::size_t most_lanes = 8;

/// Lane: lanes<S>, or S itself.
template <class S, class Lane>
KTE_INLINE void load(Lane& x, const S* from) {
  if constexpr (std::is_same_v<Lane, S>)
    x = *from;
  else
    std::memcpy(&x, from, sizeof x);
}
template <class S, class Lane>
KTE_INLINE void store(const Lane& x, S* to) {
  if constexpr (std::is_same_v<Lane, S>)
    *to = x;
  else
    std::memcpy(to, &x, sizeof x);
}
template <class S>
KTE_INLINE void put_first(lanes<S>& x, const S& number) {
  if constexpr (lanes_of<S>::count == 1)
    x = number;
  else
    x[0] = number;
}
/// f(k) for every register from number `first` of a row up to `last`, the last of them perhaps beyond it.
template <class S, class F>
KTE_INLINE void by_lanes(int first, int last, const F& f) {
  for (int k = first; k < last; k += static_cast<int>(lanes_of<S>::count)) f(k);
}

}  // namespace kte::tree
