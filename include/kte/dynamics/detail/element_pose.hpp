#pragma once

#include <kte/dynamics/forward_kinematics.hpp>

namespace kte::detail {

/// Joint or link I where its coordinate is, without rates.
template <std::size_t I, class Chain, class Given>
KTE_INLINE constexpr auto element_pose(const Chain& c, const Given& g) {
  using types = local_types<Chain, Given>;
  using core_t = typename types::template core<I>;
  const auto m = [&]() KTE_INLINE_LAMBDA {
    if constexpr (coordinates_of<core_t> == 0)
      return c.template core<I>().relative();
    else
      return c.template core<I>().relative(
          position_only(motion_of<types, coordinate_kind<core_t>, Chain::wiring::slot(I, 0)>(c, g)));
  }();
  return pose{m.rotation, m.position};
}

}  // namespace kte::detail
