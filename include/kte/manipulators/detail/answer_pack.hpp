#pragma once

#include <kte/math/pack_functions.hpp>
#include <kte/math/plain_scalar.hpp>

namespace kte::detail {

/// The number of solutions of an arm that are computed together, and their type: doubles and floats four at a time in a
/// pack, other scalars one at a time. Packs of poses already have one pose per lane.
template <class S>
struct answer_pack {
  using type = S;
  static constexpr std::size_t count = 1;
};
template <class S>
requires std::is_same_v<S, double> || std::is_same_v<S, float>
struct answer_pack<S> {
  using type = pack<S, 4>;
  static constexpr std::size_t count = 4;
};
/// Loads one register from, or stores it to, rows of solutions, which are padded to full registers.
template <class S>
typename answer_pack<S>::type load_pack(const S* x) {
  if constexpr (answer_pack<S>::count == 1)
    return *x;
  else
    return answer_pack<S>::type::load(x);
}
template <class S>
void store_pack(const typename answer_pack<S>::type& x, S* to) {
  if constexpr (answer_pack<S>::count == 1)
    *to = x;
  else
    x.store(to);
}

/// A T; for packs one T per lane.
template <class S, class T>
struct one_for_each_lane {
  using type = T;
};
template <class S, class T>
requires is_pack<S>
struct one_for_each_lane<S, T> {
  using type = std::array<T, std::size_t{S::lanes}>;
};
template <class S, class T>
using for_each_lane = typename one_for_each_lane<S, T>::type;

}  // namespace kte::detail
