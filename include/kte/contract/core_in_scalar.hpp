#pragma once

#include <kte/contract/element_core.hpp>
#include <kte/math/plain_scalar.hpp>
#include <kte/math/quaternion.hpp>
#include <kte/math/rigid_body.hpp>

#include <array>
#include <concepts>
#include <initializer_list>
#include <limits>
#include <type_traits>
#include <vector>

/// Cores with parameters in another scalar: `core_in<S>(core)`.
namespace kte::detail {

/// A number that is not a whole number or a truth value: double, a pack, a dual number, a multiprecision number.
template <class T>
inline constexpr bool is_real_number = is_pack<T> || is_dual<T> ||
                                       (std::numeric_limits<T>::is_specialized && !std::numeric_limits<T>::is_integer);

/// The type T with all numbers replaced by S. Typed constants, lists and functions are unchanged.
template <class T, class S>
struct with_scalar {
  using type = T;
};
template <class T, class S>
requires is_real_number<T>
struct with_scalar<T, S> {
  using type = S;
};
template <template <class...> class T, class... A, class S>
requires(!is_real_number<T<A...>>) struct with_scalar<T<A...>, S> {
  using type = T<typename with_scalar<A, S>::type...>;
};
template <template <kind, class...> class T, kind K, class... A, class S>
struct with_scalar<T<K, A...>, S> {
  using type = T<K, typename with_scalar<A, S>::type...>;
};
template <class T, class A, class S>
struct with_scalar<std::vector<T, A>, S> {
  using type = std::vector<T, A>;
};
template <class T, class S>
using in_scalar = typename with_scalar<T, S>::type;

/// Whether a core has parameters that are packs or dual numbers, which do not convert to double.
template <class Core>
inline constexpr bool has_packs_or_duals = is_pack<Core> || is_dual<Core>;
template <template <class...> class T, class... A>
requires(!is_pack<T<A...>>) inline constexpr bool has_packs_or_duals<T<A...>> = (has_packs_or_duals<A> || ...);
template <template <kind, class...> class T, kind K, class... A>
inline constexpr bool has_packs_or_duals<T<K, A...>> = (has_packs_or_duals<A> || ...);

constexpr std::size_t most_lanes(std::initializer_list<std::size_t> all) {
  std::size_t most = 1;
  for (const auto n : all) most = n > most ? n : most;
  return most;
}
/// The number of lanes of the packs in a core; 1 if there are none.
template <class Core>
inline constexpr std::size_t lanes_in = 1;
template <class T>
requires(is_pack<T>) inline constexpr std::size_t lanes_in<T> = std::size_t{T::lanes};
template <class T, int N>
inline constexpr std::size_t lanes_in<dual<T, N>> = lanes_in<T>;
template <template <class...> class T, class... A>
requires(!is_pack<T<A...>>) inline constexpr std::size_t lanes_in<T<A...>> = most_lanes({lanes_in<A>...});
template <template <kind, class...> class T, kind K, class... A>
inline constexpr std::size_t lanes_in<T<K, A...>> = most_lanes({lanes_in<A>...});

/// Converts a number to S.
template <class S>
struct to_scalar {
  template <class T>
  constexpr S operator()(const T& x) const {
    return S(x);
  }
};
/// One lane of a pack, without derivatives, as a number of type S.
template <class S>
struct to_lane {
  std::size_t lane;
  template <class T>
  constexpr S operator()(const T& x) const {
    if constexpr (is_pack<T>) {
      return S(x[lane]);
    } else if constexpr (is_dual<T>) {
      return (*this)(x.value);
    } else {
      return S(x);
    }
  }
};

/// to = convert(from), number by number.
template <class T, class S, class F>
constexpr void convert_numbers(const T& from, S& to, const F& convert) {
  if constexpr (is_real_number<T>) {
    to = convert(from);
  } else if constexpr (std::is_same_v<T, S>) {
    to = from;
  } else if constexpr (requires { from.xx; }) {
    convert_numbers(from.xx, to.xx, convert), convert_numbers(from.xy, to.xy, convert);
    convert_numbers(from.xz, to.xz, convert), convert_numbers(from.yy, to.yy, convert);
    convert_numbers(from.yz, to.yz, convert), convert_numbers(from.zz, to.zz, convert);
  } else if constexpr (requires { from.cos; }) {
    convert_numbers(from.cos, to.cos, convert), convert_numbers(from.sin, to.sin, convert);
  } else {
    if constexpr (requires { from.w; }) convert_numbers(from.w, to.w, convert);
    convert_numbers(from.x, to.x, convert), convert_numbers(from.y, to.y, convert);
    convert_numbers(from.z, to.z, convert);
  }
}

/// The core with its parameters converted to S.
template <class S, class Core, class Convert>
constexpr auto converted(const Core& core, const Convert& convert) {
  using to_core = in_scalar<Core, S>;
  if constexpr (std::is_same_v<to_core, Core>) {
    return core;
  } else {
    static_assert(core_in_files<Core> && core_in_files<to_core>,
                  "kte: an element with numbers in its type, but without `parameters` and a default constructor, "
                  "cannot be rebuilt in another scalar");
    to_core to{};
    int i = 0;
    to_core::parameters(to, [&](const char*, auto& y) {
      int j = 0;
      Core::parameters(core, [&](const char*, const auto& x) {
        if constexpr (std::is_same_v<in_scalar<std::remove_cvref_t<decltype(x)>, S>, std::remove_cvref_t<decltype(y)>>)
          if (j == i) convert_numbers(x, y, convert);
        ++j;
      });
      ++i;
    });
    return to;
  }
}

}  // namespace kte::detail
