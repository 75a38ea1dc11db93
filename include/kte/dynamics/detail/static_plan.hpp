#pragma once

#include <kte/contract/joint.hpp>
#include <kte/math/dual_number.hpp>
#include <kte/static_chain/static_chain.hpp>
#include <kte/tree/plan.hpp>

#include <span>

/// The order of work on a static chain.
namespace kte::detail {

template <class Chain, std::size_t I>
using core_of = std::remove_cvref_t<decltype(std::declval<const Chain&>().template core<I>())>;

/// What `arrange` asks of a static chain.
template <class Chain>
struct static_connections {
  using wiring = typename Chain::wiring;
  struct element {
    std::span<const port> ports;
    bool stiff;
  };
  std::array<element, Chain::size> all = []<std::size_t... I>(std::index_sequence<I...>) {
    return std::array<element, Chain::size>{
        {{std::span<const port>(core_of<Chain, I>::ports), is_transmission<core_of<Chain, I>>}...}};
  }
  (std::make_index_sequence<Chain::size>{});
  constexpr std::size_t elements() const { return Chain::size; }
  constexpr std::span<const port> ports(std::size_t e) const { return all[e].ports; }
  constexpr int index(std::size_t e, std::size_t p) const { return wiring::slot(e, p); }
  constexpr bool stiff(std::size_t e) const { return all[e].stiff; }
  constexpr int count(kind k) const { return wiring::count(k); }
  constexpr int writer(kind k, int i) const { return wiring::writer(k, i); }
  constexpr std::size_t freedoms() const { return wiring::freedoms; }
  constexpr freedom freedom_at(std::size_t f) const { return wiring::table.free[f]; }
  constexpr int dofs() const { return wiring::dofs; }
};
template <class Chain>
struct static_lists {
  /// Rows are two a port at most: none has more than six, of three ports.
  template <class T>
  using list = short_list<T, 2 * Chain::wiring::ports + 2>;
};
template <class Chain>
inline constexpr auto static_plan = arrange<static_lists<Chain>::template list>(static_connections<Chain>{});

/// Whether algorithms are unrolled: not for scalars whose operations are functions, where loops over records
/// (dynamics/detail/static_loops.hpp) are as fast and compile in a tenth of the time
/// (docs/decisions/02-compile-time.md). Of dual numbers of those that are a few instructions: a small chain in dual
/// numbers, as variational integrators evaluate it, would else spend nine tenths of its time on making records.
template <class S>
inline constexpr bool is_a_few_instructions = std::is_floating_point_v<S> || requires {
  S::lanes;
};  // packs
template <class T, int N>
inline constexpr bool is_a_few_instructions<dual<T, N>> = is_a_few_instructions<T>;
template <class Chain, class S>
inline constexpr bool is_unrolled = unrolls_all<Chain::size>&& is_a_few_instructions<S>;
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
