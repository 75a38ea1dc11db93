#pragma once

#include <kte/manipulators/detail/six_axes.hpp>

namespace kte::detail {
template <class S>
raw_answers<S> wrist_and_three_axes(const arm_structure&, const rotation_matrix<S>&, const vec3<S>&,
                                    const free_angles<S>&) {
  return {};
}
template <class S>
raw_answers<S> parallel_and_two_axes(const arm_structure&, const rotation_matrix<S>&, const vec3<S>&,
                                     const free_angles<S>&) {
  return {};
}
}  // namespace kte::detail
