#pragma once

#include <kte/contract/joint.hpp>
#include <kte/detail/numbers_where.hpp>
#include <kte/detail/unroll.hpp>
#include <kte/math/dual_number.hpp>
#include <kte/static_chain/connections.hpp>
#include <kte/static_chain/static_chain.hpp>
#include <kte/tree/plan.hpp>

/// The order of evaluation of a static chain.
namespace kte::detail {

template <class Chain>
inline constexpr auto static_plan =
    arrange<static_lists<typename Chain::wiring>::template list>(static_connections<Chain>{});

/// Whether algorithms are unrolled. Scalars whose operations are functions use loops over body nodes
/// (dynamics/looped/static_chains.hpp), which are as fast and compile in a tenth of the time
/// (docs/decisions/02-compile-time.md). Dual numbers of machine scalars are unrolled, because a small chain, as
/// variational integrators evaluate it, would spend nine tenths of its time on building its tree. Chains that only the
/// loops support are not unrolled (static_chain/connections.hpp).
template <class S>
inline constexpr bool is_a_few_instructions = std::is_floating_point_v<S> || requires {
  S::lanes;
};  // packs
template <class T, int N>
inline constexpr bool is_a_few_instructions<dual<T, N>> = is_a_few_instructions<T>;
template <class Chain, class S>
inline constexpr bool is_unrolled = Chain::unrolled&& is_a_few_instructions<S>;
template <class Chain, class S>
inline constexpr bool has_unrolled_passes = unrolls_passes<Chain::size>&& is_a_few_instructions<S>;

/// The external items of kind K that are not degrees of freedom, as an index_sequence.
template <class Wiring, kind K>
inline constexpr auto is_given = [] {
  std::array<bool, std::size_t{Wiring::count(K)} + 1> is{};
  for (int s = 0; s < Wiring::count(K); ++s)
    is[static_cast<std::size_t>(s)] =
        Wiring::writer(K, s) < 0 && !(is_coordinate(K) && Wiring::freedom_of(K, s).what == K);
  return is;
}();
template <class Wiring, kind K>
using given_things = typename numbers_where<is_given<Wiring, K>>::type;

/// Calls f<K, Slot>() for every frame that no element writes.
template <class Wiring, class F>
KTE_INLINE void for_each_base(const F& f) {
  unroll(given_things<Wiring, kind::frame_2D>{},
         [&f]<std::size_t I>() KTE_INLINE_LAMBDA { f.template operator()<kind::frame_2D, int{I}>(); });
  unroll(given_things<Wiring, kind::frame_3D>{},
         [&f]<std::size_t I>() KTE_INLINE_LAMBDA { f.template operator()<kind::frame_3D, int{I}>(); });
}
/// none + the sum of f<K, Slot>() over these frames.
template <class Wiring, class X, class F>
KTE_INLINE constexpr auto sum_over_bases(const X& none, const F& f) {
  return [&]<std::size_t... P, std::size_t... Q>(std::index_sequence<P...>, std::index_sequence<Q...>)
      KTE_INLINE_LAMBDA {
    return (none + ... + f.template operator()<kind::frame_2D, int{P}>()) +
           (none + ... + f.template operator()<kind::frame_3D, int{Q}>());
  }
  (given_things<Wiring, kind::frame_2D>{}, given_things<Wiring, kind::frame_3D>{});
}

}  // namespace kte::detail
