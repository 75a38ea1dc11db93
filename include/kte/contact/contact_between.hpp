#pragma once

#include <kte/contract/closure.hpp>

namespace kte::detail {

/// The scalar of the motion of a frame: that of its numbers, or double if all are typed constants.
template <class M>
KTE_INLINE constexpr auto scalar_of_motion(const M& m) {
  const auto r = matrix(m.rotation);
  const auto& [p, v, w] = std::tie(m.position, m.velocity, m.ang_velocity);
  return as_number(p.x + p.y + p.z + v.x + v.y + v.z + w.x + w.y + w.z + r.x.x + r.x.y + r.x.z + r.y.x + r.y.y + r.y.z +
                   r.z.x + r.z.y + r.z.z);
}
/// The motion of frame B relative to frame A in plain numbers, without accelerations.
template <class A, class B>
KTE_INLINE constexpr auto motion_between(const A& a, const B& b) {
  const auto still = [](const auto& x) KTE_INLINE_LAMBDA {
    return motion{x.position, x.rotation, x.velocity, x.ang_velocity, skip{}, skip{}};
  };
  const auto m = relative(still(a), still(b));
  using S = std::remove_cvref_t<decltype(scalar_of_motion(m))>;
  return closing_motion<S>{
      as<S>(m.position), as<S>(matrix(m.rotation)), as<S>(m.velocity), as<S>(m.ang_velocity), {}, {}};
}
/// The loads of a force lambda on B at the point c, and of -lambda on A at the same point; both in axes of A, from the
/// motion of B relative to A. Their power is lambda.u, with the velocity u of the point of B relative to that of A.
template <kind Dim, class M, class S>
KTE_INLINE constexpr auto loads_at_contact(const M& m, const vec3<S>& lambda, const vec3<S>& c) {
  const auto back = transpose(m.rotation);
  const wrench<vec3<S>, vec3<S>> on_a{-lambda, -cross(c, lambda)};
  const wrench<vec3<S>, vec3<S>> on_b{back * lambda, back * cross(c - m.position, lambda)};
  return make_loads(in_space_of<Dim>(on_a), in_space_of<Dim>(on_b));
}

}  // namespace kte::detail
