#pragma once

#include <kte/dynamics/forward_kinematics.hpp>
#include <kte/dynamics/jacobian_rate.hpp>

/// The algorithms of dynamics/relative_motion.hpp.
namespace kte {

/// The motion of a frame in another frame, as numbers.
template <class S>
using dense_motion = motion<vec3<S>, mat3<vec3<S>>, vec3<S>, vec3<S>, vec3<S>, vec3<S>>;

namespace detail {
template <class S, class M>
dense_motion<S> in_numbers(const M& m) {
  return {as<S>(m.position),     as<S>(matrix(m.rotation)), as<S>(m.velocity),
          as<S>(m.ang_velocity), as<S>(m.acceleration),     as<S>(m.ang_acceleration)};
}
template <class S, class Diagnose = too_large>
dense_motion<S> checked_motion(const dense_motion<S>& a, const dense_motion<S>& b, const Diagnose& why = {"a motion"}) {
  const dense_motion<S> x = in_numbers<S>(relative(a, b));
  for (const auto* v : {&x.position, &x.velocity, &x.ang_velocity, &x.acceleration, &x.ang_acceleration}) {
    const S all[]{v->x, v->y, v->z};
    check_result(all, 3, why);
  }
  return x;
}

/// The number of elements that two branches share, from the base on.
template <class A, class B>
inline constexpr std::size_t common_length = [] {
  std::size_t n = 0;
  while (n < A::length && n < B::length && A::elements[n] == B::elements[n]) ++n;
  return n;
}();
template <class Chain, class Frame>
inline constexpr bool moved_by_joints = moves_rigidly<Chain, Frame::what, frame_slot<Frame, Chain>()>;
template <class Chain, class Frame>
using branch_of = branch<Chain, Frame::what, frame_slot<Frame, Chain>()>;
/// The pose of the end of a branch in the end of its element N - 1.
template <class Branch, std::size_t N, class Chain, class Given>
KTE_INLINE constexpr auto pose_beyond(const Chain& c, const Given& g) {
  if constexpr (N == Branch::length) {
    return pose{no_rotation{}, zero3{}};
  } else {
    return compose(element_pose<Branch::elements[N]>(c, g), pose_beyond<Branch, N + 1>(c, g));
  }
}
/// The pose of B in A. Only the elements between them are evaluated.
template <class A, class B, class Chain, class Given>
KTE_INLINE constexpr auto pose_in_frame(const Chain& c, const Given& g) {
  constexpr std::size_t n = common_length<A, B>;
  return compose(inverse(pose_beyond<A, n>(c, g)), pose_beyond<B, n>(c, g));
}
// ---- runtime chains

/// The pose of B in A, from the bodies between them; call `place_bodies` first. `common`: the last common slot.
template <class S>
tree::dense_pose<S> pose_between(const runtime_chain& c, basic_runtime_state<S>& s, const runtime_frame& b,
                                 const runtime_frame& a, int common) {
  if (common < 0) return plain_pose<S>(compose(inverse(pose_of(c, s, a)), pose_of(c, s, b)));
  const auto& f = s.tree().body_tree;
  tree::dense_pose<S> x, y;
  (void)tree::pose_in_base(f, s.work, f.frame(a.what, a.index), x, common);
  (void)tree::pose_in_base(f, s.work, f.frame(b.what, b.index), y, common);
  return plain_pose<S>(compose(inverse(x), y));
}
template <class S>
int common_slot_of(const basic_runtime_state<S>& s, const runtime_frame& b, const runtime_frame& a) {
  const auto& f = s.tree().body_tree;
  const int of = f.frame(b.what, b.index).slot, in = f.frame(a.what, a.index).slot;
  return of < 0 || in < 0 ? -1 : tree::common_slot(f, in, of);  // frames that follow others have no slot
}
/// As `relative_pose`, for positions that have been checked.
template <class S>
tree::dense_pose<S> relative_pose_of(const runtime_chain& c, basic_runtime_state<S>& s, const runtime_frame& b,
                                     const runtime_frame& a) {
  place_bodies(runtime_elements{c}, s);
  return pose_between(c, s, b, a, common_slot_of(s, b, a));
}
template <class S>
dense_motion<S> relative_motion_of(const runtime_chain& c, basic_runtime_state<S>& s, const runtime_frame& b,
                                   const runtime_frame& a) {
  static_assert(goes_through_passes<S>);
  move(c.wiring(), s, a), move(c.wiring(), s, b);
  const auto all = [](const auto& m) { return in_numbers<S>(m); };
  return checked_motion(with_motion(s, a, all), with_motion(s, b, all), diagnose_state{"a motion", s});
}
/// As `relative_jacobian`, for positions that have been checked.
template <class S>
basic_runtime_jacobian<S> relative_jacobian_of(const runtime_chain& c, basic_runtime_state<S>& s,
                                               const runtime_frame& b, const runtime_frame& a) {
  const auto& t = s.tree();
  const auto& f = t.body_tree;
  const auto &at_a = f.frame(a.what, a.index), &at_b = f.frame(b.what, b.index);
  refuse_following(c, s, a), refuse_following(c, s, b);
  const int common = common_slot_of(s, b, a);
  place_bodies(runtime_elements{c}, s);
  const auto seen =
      compose(tree::dense_pose<S>{as<S>(at_a.at.rotation), as<S>(at_a.at.position)}, pose_between(c, s, b, a, common));
  const tree::frame_place<S> b_on_a{at_a.slot, plain_pose<S>(seen)};  // B as a frame of the body of A
  basic_runtime_jacobian<S> j = basic_runtime_jacobian<S>::Zero(6, t.plan.coordinates);
  const auto add = [&](const S& sign) {
    return [&j, &f, sign](int k, const tree::direction<S>& u, const tree::direction<S>& w) {
      tree::put_column<true, S>(j.col(f.row[static_cast<std::size_t>(k)]).data(), sign * u, sign * w);
    };
  };
  tree::dense_pose<S> y;
  (void)tree::jacobian_columns(f, s.work, at_b, y, add(S(1)), common);
  (void)tree::jacobian_columns(f, s.work, b_on_a, y, add(S(-1)), common);
  return folded(c, s, std::move(j));
}
}  // namespace detail

}  // namespace kte
