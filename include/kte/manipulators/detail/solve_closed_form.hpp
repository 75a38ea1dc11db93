#pragma once

#include <kte/manipulators/detail/newton_step.hpp>
#include <kte/manipulators/detail/planar_axes.hpp>
#include <kte/manipulators/detail/quartic_axes.hpp>
#include <kte/manipulators/detail/srs_axes.hpp>

namespace kte::detail {

template <class S>
using plain_pose_of = pose<rotation_matrix<S>, vec3<S>>;

/// The pose of the tool at t, by joint of the arm: products of exponentials.
template <class S>
plain_pose_of<S> tool_pose(const arm_geometry& arm, const std::array<S, arm_geometry::most>& t) {
  std::array<S, arm_geometry::most> sine, cosine;
  const auto n = static_cast<std::size_t>(arm.n);
  sincos_each(t.data(), sine.data(), cosine.data(), n);
  plain_pose_of<S> x{as<S>(arm.tool.rotation), as<S>(arm.tool.position)};
  for (std::size_t i = n; i-- > 0;) {
    const vec3<S> h = as<S>(arm.axis[i]);
    if (arm.slides[i]) {
      x.position = x.position + t[i] * h;
    } else {
      const vec3<S> o = as<S>(arm.point[i]);
      const auto r = as<S>(rotation_about(h, cosine[i], sine[i]));
      x = {r * x.rotation, vec3<S>(o + r * vec3<S>(x.position - o))};
    }
  }
  return x;
}

/// m and rad between two poses: with F the norm of Frobenius, the angle is 2 asin(F(R1 - R2) / sqrt 8).
template <class S>
struct pose_gap {
  S position, rotation;
};
template <class S>
pose_gap<S> gap_between(const plain_pose_of<S>& a, const plain_pose_of<S>& b) {
  using std::asin;
  using std::sqrt;
  const vec3<S> d = a.position - b.position;
  const auto m = as<S>(a.rotation - b.rotation);
  const S half = sqrt(S((dot(m.x, m.x) + dot(m.y, m.y) + dot(m.z, m.z)) / S(8)));
  return {sqrt(dot(d, d)), half < S(1) ? S(S(2) * asin(half)) : half_turn<S>()};
}

/// What the formulas work on: the turn of all joints of `arm` together, and where the origin of the last is.
template <class S>
struct arm_goal {
  rotation_matrix<S> R;
  vec3<S> position;
};
template <class S>
arm_goal<S> goal_of(const arm_structure& s, const plain_pose_of<S>& x) {
  const rotation_matrix<S> R = x.rotation * as<S>(transpose(s.arm.tool.rotation));
  return {R, x.position - R * as<S>(s.arm.tool.position - s.p(s.arm.n - 1))};
}

/// All answers of an arm, by joint of `original`. `extra` is the arm angle, or the value of the joint that is held.
template <class S>
raw_answers<S> solve_closed_form(const arm_structure& s, plain_pose_of<S> x, const free_angles<S>& seed,
                                 const S& extra) {
  const auto wanted = x;
  if (s.held >= 0) {
    const auto i = static_cast<std::size_t>(s.held);
    const auto back = inverse(joint_pose<S>(s.original, i, angle_of(extra)));
    const plain_pose_of<S> tool{as<S>(s.original.tool.rotation), as<S>(s.original.tool.position)};
    x = i == 0 ? compose(back, x) : compose(x, compose(inverse(tool), compose(back, tool)));
  }
  if (s.backwards) x = inverse(x);
  const int last = s.arm.n - 1;
  const auto joint = [&](int k) {
    return static_cast<std::size_t>((s.backwards ? last - k : k) + (s.held == 0 ? 1 : 0));
  };
  free_angles<S> start;
  for (int k = 0; k <= last; ++k) start.t[std::size_t(k)] = S(s.sign[std::size_t(k)]) * seed.t[joint(k)];

  const auto [R, p] = goal_of(s, x);
  auto out = [&s, &x, &start, &extra, &R = R, &p = p]() -> raw_answers<S> {
    switch (s.form) {
      case closed_form::wrist_parallel:
        return wrist_and_parallel(s, R, p, start);
      case closed_form::parallel_meeting:
        return parallel_and_meeting(s, R, p, start);
      case closed_form::wrist_general:
        return wrist_and_three_axes(s, R, p, start);
      case closed_form::parallel_general:
        return parallel_and_two_axes(s, R, p, start);
      case closed_form::srs:
        return shoulder_and_wrist(s, R, p, extra, start);
      case closed_form::planar:
      case closed_form::scara:
        return planar_and_slide(s, x.rotation, x.position, start);
      default:
        return {};
    }
  }();
  for (std::size_t a = 0; a < out.size; ++a) {
    const auto t = out.all[a];
    auto& y = out.all[a];
    y.t = {}, y.free = 0;
    for (int k = 0; k <= last; ++k) {
      const S q = S(s.sign[std::size_t(k)]) * t.t[std::size_t(k)];
      y.t[joint(k)] = s.arm.slides[std::size_t(k)] ? q : wrapped(q);
      if (t.free >> k & 1u) y.free |= 1u << joint(k);
    }
    if (s.held >= 0) y.t[static_cast<std::size_t>(s.held)] = extra;
    // Roots of equations of degree four may be worse than rounding.
    if (s.form == closed_form::wrist_general || s.form == closed_form::parallel_general)
      for (int k = 0; k < 2; ++k) {
        const auto gap = gap_between(tool_pose(s.original, y.t), wanted);
        const double least = 8 * double_of(std::numeric_limits<S>::epsilon());
        if (!(double_of(gap.position) > least * s.reach || double_of(gap.rotation) > least)) break;
        newton_step(s.original, s.held == 0 ? 1u : 0u, wanted, y.t);
      }
  }
  return out;
}

}  // namespace kte::detail
