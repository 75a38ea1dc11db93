#pragma once

#include <kte/manipulators/detail/six_axes.hpp>

namespace kte::detail {

/// Two or three parallel axes, optionally with a slide along them (planar arms, SCARA). w is the point on the last of
/// three axes; for two axes, that of the tool:
///
///   q1, q2:  R(h, q1)(p12 + R(h, q2) p23) = w - p1, normal to h
///   d = h.(position - that at d = 0);   q3 = angle of the tool about h - q1 - q2          (1)
template <class S>
raw_answers<S> planar_and_slide(const arm_structure& s, const rotation_matrix<S>& R, const vec3<S>& position,
                                const joint_turns<S>& seed) {
  std::array<std::size_t, 3> turn{};
  std::size_t turning = 0, slide = arm_geometry::most;
  for (std::size_t i = 0; i < static_cast<std::size_t>(s.arm.n); ++i) {
    if (s.arm.slides[i])
      slide = i;
    else if (turning < 3)
      turn[turning++] = i;
  }
  const auto point = [&](std::size_t k) -> const vec3<>& { return s.arm.point[turn[k]]; };
  const vec3<>&h = s.arm.axis[0], tip = turning == 3 ? point(2) : s.arm.tool.position;
  const vec3<S> w = position - R * as<S>(transpose(s.arm.tool.rotation) * (s.arm.tool.position - tip));
  const auto q12 = triangle(h, as<S>(normal_part(point(1) - point(0), h)), as<S>(normal_part(tip - point(1), h)),
                            normal_to(h, vec3<S>(w - as<S>(point(0)))), seed.at(turn[0]));
  raw_answers<S> out;
  for (const bool down : {false, true}) {
    raw_answer<S> x{};
    const auto t1 = down ? q12.t2.minus : q12.t2.plus, t2 = down ? q12.t3.minus : q12.t3.plus;
    x.turn.put(turn[0], t1), x.turn.put(turn[1], t2);
    if (slide < arm_geometry::most) x.slide = dot(as<S>(h), vec3<S>(w - as<S>(tip)));
    if (turning == 3) {
      const vec3<> v = any_normal(h);
      const auto whole = subproblem1(h, as<S>(v), vec3<S>(R * as<S>(transpose(s.arm.tool.rotation) * v)));
      x.turn.put(turn[2], whole - t1 - t2);
    }
    x.free = free_if<S>(q12.t2.free, 1u << turn[0]);
    out.add(x, down ? elbow_bit : 0u, static_cast<std::size_t>(s.arm.n));
  }
  return out;
}

}  // namespace kte::detail
