#pragma once

#include <kte/dynamics/detail/tree.hpp>

/// The tree of joints of a static chain as numbers.
namespace kte::detail {

/// Of an element: its axes that are degrees of freedom, in the rows from the first on; the element that it stands on,
/// or -1.
struct joint_place {
  int row = 0, axes = 0, below = -1;
};
/// Of element I; of a joint that does not give way the axes are none.
template <class Chain, std::size_t I, bool GivesWay>
constexpr joint_place joint_place_of() {
  using core = core_of<Chain, I>;
  using wiring = typename Chain::wiring;
  joint_place p;
  if constexpr (is_transmission<core>) {
    p.below = wiring::writer(core::ports.back().what, wiring::slot(I, port_count<core> - 2));
    if constexpr (GivesWay) {
      p.row = wiring::template at<coordinate_kind<core>, wiring::slot(I, 0)>.v;
      p.axes = joint_dofs<core>;
    }
  }
  return p;
}

}  // namespace kte::detail
