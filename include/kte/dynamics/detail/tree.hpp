#pragma once

#include <kte/dynamics/detail/local_pass.hpp>
#include <kte/dynamics/detail/static_plan.hpp>
#include <kte/kernels/joint.hpp>

/// What the algorithms that run along the tree of joints of a chain ask of it.
namespace kte::detail {

/// Whether a chain is a tree of joints: only links and joints move frames, no coordinate follows another or moves two
/// joints.
template <class Chain>
inline constexpr bool is_tree_of_joints = static_plan<Chain>.tree;

/// Whether all elements that move frames are links and joints.
template <class Chain>
inline constexpr bool moves_frames_stiffly = [] {
  const static_connections<Chain> c;
  for (const auto& e : c.all)
    if (!e.stiff && e.ports.back().how == access::out && is_frame(e.ports.back().what)) return false;
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

}  // namespace kte::detail
