#pragma once

#include <kte/contract/joint.hpp>
#include <kte/math/dual_number.hpp>
#include <kte/static_chain/connections.hpp>
#include <kte/static_chain/static_chain.hpp>
#include <kte/tree/plan.hpp>

/// The order of work on a static chain.
namespace kte::detail {

template <class Chain>
inline constexpr auto static_plan =
    arrange<static_lists<typename Chain::wiring>::template list>(static_connections<Chain>{});

/// Whether algorithms are unrolled: not for scalars whose operations are functions, where loops over records
/// (dynamics/detail/static_loops.hpp) are as fast and compile in a tenth of the time
/// (docs/decisions/02-compile-time.md). Of dual numbers of those that are a few instructions: a small chain in dual
/// numbers, as variational integrators evaluate it, would else spend nine tenths of its time on making records. Nor of
/// chains that have what only those loops know (static_chain/connections.hpp).
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

/// f<K, Slot>() for every frame that no element writes.
template <class Wiring, class F>
KTE_INLINE void for_each_base(const F& f) {
  const auto one = [&f]<kind K, int Slot>() KTE_INLINE_LAMBDA {
    if constexpr (Wiring::writer(K, Slot) < 0) f.template operator()<K, Slot>();
    return 0;
  };
  const auto all =
      [&one]<int... P, int... Q>(std::integer_sequence<int, P...>, std::integer_sequence<int, Q...>) KTE_INLINE_LAMBDA {
    const int done[]{one.template operator()<kind::frame_2D, P>()..., one.template operator()<kind::frame_3D, Q>()...,
                     0};
    (void)done;
  };
  all(std::make_integer_sequence<int, Wiring::count(kind::frame_2D)>{},
      std::make_integer_sequence<int, Wiring::count(kind::frame_3D)>{});
}

}  // namespace kte::detail
