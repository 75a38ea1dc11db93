#pragma once

#include <kte/dynamics/centre_of_mass.hpp>
#include <kte/dynamics/forward_kinematics.hpp>
#include <kte/dynamics/frame_motion.hpp>
#include <kte/dynamics/state_vectors.hpp>
#include <kte/dynamics/unrolled/mass_properties.hpp>
#include <kte/runtime_chain.hpp>

#include <vector>

/// The composite inertia of a frame's subtree, for static and runtime chains: the bodies on the frame and all bodies
/// that joints and links carry from it. For the frame that a joint moves, this is the subtree of the joint.
namespace kte {

/// A composite inertia: mass, kg, first moment m c, kg m, and inertia, kg m^2, about the origin of a frame and in its
/// axes.
template <class S>
using dense_composite_inertia = composite<S, vec3<S>, sym3<S>>;

namespace detail {
template <class S, class M, class H, class I, class Diagnose = too_large>
dense_composite_inertia<S> checked_composite(const composite<M, H, I>& b, const Diagnose& why = {"a mass"}) {
  const dense_composite_inertia<S> x{as<S>(b.mass), as<S>(b.moment), as<S>(b.inertia)};
  const auto& [m, h, i] = x;
  const S all[]{m, h.x, h.y, h.z, i.xx, i.xy, i.xz, i.yy, i.yz, i.zz};
  check_result(all, 10, why);
  return x;
}
}  // namespace detail

/// The composite inertia of the subtree of a frame, about its origin and in its axes: the sum over links and joints R,
/// p, from the tips on, of `transported` (math/rigid_body.hpp).
template <class Gravity, class... E, indexable Q, key_type Frame>
[[nodiscard]] auto subtree_inertia(const static_chain<Gravity, E...>& c, const Q& q, const Frame&) {
  using namespace detail;
  using chain_type = static_chain<Gravity, E...>;
  using S = value_of<Q>;
  static_assert(sizeof(check_bodies_of<chain_type>) > 0);
  const auto x = checked_arguments<chain_type>(q);
  const given g{x.at, same<skip>{}, same<skip>{}, base_of_nothing};
  using motion_type = unrolled_motion<chain_type, std::remove_const_t<decltype(g)>>;
  using bodies_type = typed_bodies<S, motion_type, axes_of_joints<chain_type>>;
  const motion_type m(c, g);
  const bodies_type bodies(m);
  return checked_composite<S>(engine::composite_inertia_of<frame_place<Frame::what, frame_slot<Frame, chain_type>()>>(
      engine::unrolled<bodies_type>{bodies}));
}

namespace detail {
/// The centre of mass c = h/m of a subtree whose frame is at R, p, in axes of the base.
template <class S, class R, class P>
mass_centre<S> centre_in_base(const dense_composite_inertia<S>& b, const pose<R, P>& at) {
  const vec3<S> c = divided_by_mass<S>(b.mass, b.moment);
  if constexpr (requires { at.position.z; })
    return {b.mass, as<S>(at.position + at.rotation * c)};
  else
    return {b.mass, as<S>(in_plane(at.position) + at.rotation * c)};
}
}  // namespace detail

/// The mass of the subtree of a frame, kg, and its centre, m, in axes of the base. Throws `bad_argument` for a mass of
/// zero.
template <class Gravity, class... E, indexable Q, key_type Frame>
[[nodiscard]] auto carried_mass_centre(const static_chain<Gravity, E...>& c, const Q& q, const Frame& frame) {
  return detail::centre_in_base(subtree_inertia(c, q, frame), forward_kinematics(c, q, frame));
}

// ---- runtime chains

namespace detail {
/// For each frame, in the plane and in space: whether it belongs to the subtree of `from`.
inline std::array<std::vector<char>, 2> carried_frames(const topology& t, const runtime_frame& from) {
  std::array<std::vector<char>, 2> carried{std::vector<char>(static_cast<std::size_t>(t.count(kind::frame_2D))),
                                           std::vector<char>(static_cast<std::size_t>(t.count(kind::frame_3D)))};
  const auto at = [&carried](kind k, int i) -> char& {
    return carried[k == kind::frame_2D ? 0 : 1][static_cast<std::size_t>(i)];
  };
  at(from.what, from.index) = 1;
  for (const auto& e : t.elements) {  // a parent comes before its children
    if (!e.rigid) continue;
    const std::size_t end = e.ports.size() - 1;
    if (at(e.ports[end - 1].what, e.index[end - 1])) at(e.ports[end].what, e.index[end]) = 1;
  }
  return carried;
}
/// As `subtree_inertia`, for positions that have been checked.
template <class S>
dense_composite_inertia<S> subtree_inertia_of(const runtime_chain& c, basic_runtime_state<S>& s,
                                              const runtime_frame& x) {
  using number = typename basic_runtime_state<S>::parameter;
  const auto& f = s.tree().body_tree;
  const auto& place = f.frame(x.what, x.index);
  place_bodies(runtime_elements{c}, s);
  const auto carried = carried_frames(c.wiring(), x);
  const tree::dense_pose<S> here{as<S>(place.at.rotation), as<S>(place.at.position)};
  dense_composite_inertia<S> sum{};
  for (const auto& e : c.wiring().elements) {
    const kind k = e.ports[0].what;
    if (e.rigid || !is_frame(k) || !carried[k == kind::frame_2D ? 0 : 1][static_cast<std::size_t>(e.index[0])])
      continue;
    const auto n = e.element->numbers();
    if (n.is != part::body && n.is != part::weight) continue;
    const auto in_number = as_numbers<number>(n);
    const auto own = n.is == part::body ? checked_composite<number>(to_composite(in_number.body)) : in_number.weight;
    tree::dense_pose<S> at;
    (void)tree::pose_in_base(f, s.work, f.frame(k, e.index[0]), at, place.slot);
    const auto seen = plain_pose<S>(compose(inverse(here), at));
    const auto b = transported(seen.rotation, seen.position,
                               dense_composite_inertia<S>{S(own.mass), as<S>(own.moment), as<S>(own.inertia)});
    sum = {sum.mass + b.mass, as<S>(sum.moment + b.moment), as<S>(sum.inertia + b.inertia)};
  }
  return checked_composite<S>(sum, diagnose_state{"a mass", s});
}
}  // namespace detail

template <class S>
dense_composite_inertia<S> subtree_inertia(const runtime_chain& c, basic_runtime_state<S>& s,
                                           const name_or_handle& frame) {
  detail::check_regular_tree(c, s), detail::refuse_distributed_masses(c, s);
  const auto x = detail::find_frame(c, frame);
  detail::check_positions(s);
  return detail::subtree_inertia_of(c, s, x);
}
template <class S>
mass_centre<S> carried_mass_centre(const runtime_chain& c, basic_runtime_state<S>& s, const name_or_handle& frame) {
  const auto b = subtree_inertia(c, s, frame);
  return detail::centre_in_base(b, forward_kinematics(c, s, frame));
}
// The composite inertia of a frame's subtree at q, which is stored in the state.
template <class S, indexable Q>
dense_composite_inertia<S> subtree_inertia(const runtime_chain& c, basic_runtime_state<S>& s, const Q& q,
                                           const name_or_handle& frame) {
  detail::check_regular_tree(c, s), (void)detail::find_frame(c, frame);
  return detail::take(c, s, q).call([&] { return subtree_inertia(c, s, frame); });
}
template <class S, indexable Q>
mass_centre<S> carried_mass_centre(const runtime_chain& c, basic_runtime_state<S>& s, const Q& q,
                                   const name_or_handle& frame) {
  detail::check_regular_tree(c, s), (void)detail::find_frame(c, frame);
  return detail::take(c, s, q).call([&] { return carried_mass_centre(c, s, frame); });
}

}  // namespace kte
