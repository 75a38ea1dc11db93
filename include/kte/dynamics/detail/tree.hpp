#pragma once

#include <kte/contract/joint.hpp>
#include <kte/dynamics/detail/local_pass.hpp>
#include <kte/dynamics/detail/static_plan.hpp>

/// What the algorithms that run along the tree of joints of a chain ask of it.
namespace kte::detail {

/// Whether a chain is a tree of joints: only links and joints move frames, no coordinate follows another or moves two
/// joints.
template <class Chain>
inline constexpr bool is_tree_of_joints = static_plan<Chain>.tree;

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

/// The first joint or link with a `doForce` of its own; void where there is none.
template <class Chain>
constexpr auto find_own_loads() {
  constexpr std::size_t first = []<std::size_t... I>(std::index_sequence<I...>) {
    const bool plain[]{loads_by_relative<core_of<Chain, I>>..., false};
    std::size_t i = 0;
    while (plain[i]) ++i;
    return i;
  }
  (std::make_index_sequence<Chain::size>{});
  if constexpr (first < Chain::size)
    return std::type_identity<core_of<Chain, first>>{};
  else
    return std::type_identity<void>{};
}
/// Of algorithms that would leave that out.
template <class Chain, class Core = typename decltype(find_own_loads<Chain>())::type>
using check_loads_of = check_loads<Core, std::is_void_v<Core>>;

}  // namespace kte::detail
