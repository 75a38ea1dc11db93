#pragma once

#include <kte/dynamics/detail/local_pass.hpp>
#include <kte/kernels/joint.hpp>

/// What the algorithms that run along the tree of joints of a chain ask of it.
namespace kte::detail {

/// Unrolled code grows faster than the number of joints. Beyond this size every element has functions of its own
/// instead, on plain numbers (docs/decisions/02-compile-time.md).
template <class Chain>
inline constexpr bool is_unrolled = Chain::size <= 48;

/// Whether a chain is a tree of joints: only links and joints move frames, no coordinate follows another or moves two
/// joints.
template <class Chain>
inline constexpr bool is_tree_of_joints = [] {
  using wiring = typename Chain::wiring;
  constexpr auto& t = wiring::table;
  constexpr auto elements = []<std::size_t... I>(std::index_sequence<I...>) {
    return std::array<std::array<bool, 2>, sizeof...(I)>{{{is_transmission<typename Chain::template core_type<I>>,
                                                           has_output<typename Chain::template core_type<I>>}...}};
  }
  (std::make_index_sequence<Chain::size>{});
  for (const auto& [stiff, writes] : elements)
    if (writes && !stiff) return false;
  for (std::size_t f = 0; f < wiring::freedoms; ++f) {
    int joints = 0;
    int p = t.reader[static_cast<std::size_t>(t.free[f].what)][static_cast<std::size_t>(t.free[f].slot)];
    for (; p >= 0; p = t.previous[static_cast<std::size_t>(p)])
      joints += elements[static_cast<std::size_t>(t.element[static_cast<std::size_t>(p)])][0];
    if (joints > 1) return false;
  }
  return true;
}();

/// Whether element I is a joint whose coordinate is a degree of freedom.
template <class Chain, std::size_t I, class Core = typename Chain::template core_type<I>>
inline constexpr bool gives_way = [] {
  if constexpr (is_transmission<Core>) {
    return coordinates_of<Core> == 1 &&
           Chain::wiring::template is_free<coordinate_kind<Core>, Chain::wiring::slot(I, 0)>;
  } else {
    return false;
  }
}();

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
