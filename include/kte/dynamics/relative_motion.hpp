#pragma once

#include <kte/dynamics/detail/relative_motion.hpp>
#include <kte/runtime_chain.hpp>

/// The pose and motion of a frame B relative to a frame A of the same chain, static or runtime. Position is in axes of
/// A, rates are in axes of B (the convention of frames/motion.hpp). Planar frames are returned as spatial frames.
namespace kte {

// ---- static chains

/// The pose of frame B in frame A: R = R_A^T R_B, p = R_A^T (p_B - p_A), m. Only the elements between them are
/// evaluated. For runtime chains with elements that have more than the data of a body node use `relative_motion`.
template <class Gravity, class... E, indexable Q, key_type B, key_type A>
[[nodiscard]] auto relative_pose(const static_chain<Gravity, E...>& c, const Q& q, const B&, const A&) {
  using namespace detail;
  using chain_type = static_chain<Gravity, E...>;
  using S = value_of<Q>;
  const auto x = checked_arguments<chain_type>(q);
  const given g{x.at, same<skip>{}, same<skip>{}, base_with_pose};
  if constexpr (moved_by_joints<chain_type, A> && moved_by_joints<chain_type, B>)
    return plain_pose<S>(pose_in_frame<branch_of<chain_type, A>, branch_of<chain_type, B>>(c, g));
  else
    return plain_pose<S>(compose(inverse(plain_pose<S>(motion_at<A>(c, g))), plain_pose<S>(motion_at<B>(c, g))));
}
/// The motion of frame B relative to frame A: `relative` of the motions of both (frames/inverse.hpp).
template <class Gravity, class... E, indexable Q, indexable V, indexable X, key_type B, key_type A>
[[nodiscard]] auto relative_motion(const static_chain<Gravity, E...>& c, const Q& q, const V& v, const X& a, const B&,
                                   const A&) {
  using namespace detail;
  using chain_type = static_chain<Gravity, E...>;
  using S = value_of<Q>;
  const auto x = checked_arguments<chain_type>(q, v, a);
  const given g{x.at, x.v, x.a, base_at_rest};
  return checked_motion(in_numbers<S>(motion_at<A>(c, g)), in_numbers<S>(motion_at<B>(c, g)), x.diagnosis("a motion"));
}
/// The Jacobian of the motion of B relative to A, in axes of B: the velocity and angular velocity of `relative_motion`
/// are J v. Joints that move both have columns of zeros; those of joints between the base and A are subtracted.
template <class Gravity, class... E, indexable Q, key_type B, key_type A>
[[nodiscard]] auto relative_jacobian(const static_chain<Gravity, E...>& c, const Q& q, const B&, const A&) {
  using namespace detail;
  using chain_type = static_chain<Gravity, E...>;
  using S = value_of<Q>;
  const auto x = checked_arguments<chain_type>(q);
  const given g{x.at, same<skip>{}, same<skip>{}, base_with_pose};
  static_assert(moved_by_joints<chain_type, A> && moved_by_joints<chain_type, B>,
                "kte: this algorithm supports only frames that joints and links move, not frames that follow others");
  using a = branch_of<chain_type, A>;
  using b = branch_of<chain_type, B>;
  using pass = unrolled_jacobian<S, chain_type, std::remove_const_t<decltype(g)>>;
  typename pass::matrix_type j;
  pass columns(c, g, j);
  columns.template inward<b, common_length<a, b>>();
  columns.template inward<a, common_length<a, b>, a::length>(pose_in_frame<a, b>(c, g), minus_one);
  return j;
}

// ---- runtime chains, with the bases of the state

template <class S>
pose<mat3<vec3<S>>, vec3<S>> relative_pose(const runtime_chain& c, basic_runtime_state<S>& s, const name_or_handle& b,
                                           const name_or_handle& a) {
  detail::check_motion(c, s);
  const auto of = detail::find_frame(c, b), in = detail::find_frame(c, a);
  detail::check_positions(s);
  return detail::relative_pose_of(c, s, of, in);
}
template <class S, indexable Q>
requires(!names_something<Q>) pose<mat3<vec3<S>>, vec3<S>> relative_pose(const runtime_chain& c,
                                                                         basic_runtime_state<S>& s, const Q& q,
                                                                         const name_or_handle& b,
                                                                         const name_or_handle& a) {
  detail::check_motion(c, s);
  const auto of = detail::find_frame(c, b), in = detail::find_frame(c, a);
  return detail::take(c, s, q).call([&] { return detail::relative_pose_of(c, s, of, in); });
}
template <class S>
dense_motion<S> relative_motion(const runtime_chain& c, basic_runtime_state<S>& s, const name_or_handle& b,
                                const name_or_handle& a) {
  c.check(s);
  const auto of = detail::find_frame(c, b), in = detail::find_frame(c, a);
  detail::check_state_velocities(s);
  return detail::relative_motion_of(c, s, of, in);
}
template <class S, indexable Q, indexable V, indexable X>
dense_motion<S> relative_motion(const runtime_chain& c, basic_runtime_state<S>& s, const Q& q, const V& v, const X& x,
                                const name_or_handle& b, const name_or_handle& a) {
  const auto of = detail::find_frame(c, b), in = detail::find_frame(c, a);
  return detail::take(c, s, q, v, x).call([&] { return detail::relative_motion_of(c, s, of, in); });
}
template <class S>
basic_runtime_jacobian<S> relative_jacobian(const runtime_chain& c, basic_runtime_state<S>& s, const name_or_handle& b,
                                            const name_or_handle& a) {
  detail::check_motion(c, s);
  const auto of = detail::find_frame(c, b), in = detail::find_frame(c, a);
  detail::check_positions(s);
  return detail::relative_jacobian_of(c, s, of, in);
}
template <class S, indexable Q>
requires(!names_something<Q>) basic_runtime_jacobian<S> relative_jacobian(const runtime_chain& c,
                                                                          basic_runtime_state<S>& s, const Q& q,
                                                                          const name_or_handle& b,
                                                                          const name_or_handle& a) {
  detail::check_motion(c, s);
  const auto of = detail::find_frame(c, b), in = detail::find_frame(c, a);
  return detail::take(c, s, q).call([&] { return detail::relative_jacobian_of(c, s, of, in); });
}

}  // namespace kte
