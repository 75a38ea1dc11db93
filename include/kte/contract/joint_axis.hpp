#pragma once

#include <kte/frames/motion.hpp>

#include <cstddef>

namespace kte::detail {

/// An axis of a joint: the motion at its unit rate, m and rad, or a derivative of this motion.
template <class S>
struct joint_axis {
  vec3<S> linear, angular;
};
/// The number of axes and derivatives of axes of a joint with n coordinates: s_k is at k, ds_k/dq_j at n + n k + j, and
/// on request the second derivative by q_j and q_i at n + n^2 + n^2 k + n j + i.
constexpr std::size_t count_of_axes(int n, bool second) {
  const auto count = static_cast<std::size_t>(n);
  return count + count * count + (second ? count * count * count : 0);
}

}  // namespace kte::detail
