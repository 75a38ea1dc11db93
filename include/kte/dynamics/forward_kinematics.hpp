#ifndef KTE_FORWARD_KINEMATICS_HPP
#define KTE_FORWARD_KINEMATICS_HPP

#include <kte/dynamics/state_vectors.hpp>
#include <kte/dynamics/unrolled/given.hpp>

namespace kte {

namespace detail {
/// The motion of a frame. Only the elements between base and frame are evaluated.
template <class Types, kind K, int Slot, class Chain, class Given>
KTE_INLINE constexpr auto motion_of(const Chain& c, const Given& g);

template <class Types, std::size_t I, class Chain, class Given, std::size_t... P>
KTE_INLINE constexpr auto motion_by(const Chain& c, const Given& g, std::index_sequence<P...>) {
  return Types::template moved<I>(c.template core<I>(),
                                  motion_of<Types, Types::template what<I, P>, Chain::wiring::slot(I, P)>(c, g)...);
}
template <class Types, kind K, int Slot, class Chain, class Given>
KTE_INLINE constexpr auto motion_of(const Chain& c, const Given& g) {
  constexpr int writer = Types::template writer<K, Slot>;
  if constexpr (writer < 0) {
    return Types::template given<K, Slot>(g);
  } else {
    return motion_by<Types, std::size_t{writer}>(c, g, typename Types::template inputs<std::size_t{writer}>{});
  }
}
/// The coordinate of joint I; a tuple for several.
template <std::size_t I, class Chain, class Given>
KTE_INLINE constexpr auto coordinate_of_joint_at(const Chain& c, const Given& g) {
  using types = flow_types<Chain, Given>;
  using core_t = typename types::template core<I>;
  if constexpr (coordinates_of < core_t >> 1) {
    return tuple_of_coordinates<core_t>(
        [&]<std::size_t K>() { return motion_of<types, kind::gen, Chain::wiring::slot(I, K)>(c, g); });
  } else {
    return motion_of<types, coordinate_kind<core_t>, Chain::wiring::slot(I, 0)>(c, g);
  }
}
/// The pose of joint or link I at the given coordinates, without rates.
template <std::size_t I, class Chain, class Given>
KTE_INLINE constexpr auto element_pose(const Chain& c, const Given& g) {
  const auto& core = c.template core<I>();
  if constexpr (coordinates_of < std::remove_cvref_t < decltype(core) >>> 0) {
    const auto m = relative_at(core, position_only(coordinate_of_joint_at<I>(c, g)));
    return pose{m.rotation, m.position};
  } else {
    const auto m = core.relative();
    return pose{m.rotation, m.position};
  }
}
template <class S, kind K, class M>
KTE_INLINE constexpr auto pose_of(const M& m) {
  if constexpr (K == kind::frame_2D) {
    return pose{as<S>(m.rotation * rotation_2D{one, zero}), planar_part<S>(m.position)};
  } else {
    return pose{as<S>(matrix(m.rotation)), as<S>(m.position)};
  }
}
template <class S, class Key, class Chain, class Positions, class Base>
KTE_INLINE auto pose_at(const Chain& c, const Positions& at, const Base& base) {
  constexpr int slot = Chain::wiring::template find<Key>();
  static_assert(slot >= 0, "kte: this chain has no frame of this name");
  at.check();
  const auto g = given{at, same<skip>{}, same<skip>{}, base};
  using types = flow_types<Chain, std::remove_const_t<decltype(g)>>;
  const auto p = pose_of<S, Key::what>(motion_of < types, Key::what, slot < 0 ? 0 : slot > (c, g));
  const auto why = [&]() KTE_INLINE_LAMBDA {
    diagnose_signals<typename Chain::wiring>("where a frame stands", base);
    diagnose<typename Chain::wiring>("where a frame stands", at.q, same<zero_t>{}, same<zero_t>{}, "a");
  };
  const auto check = [&why](const auto&... x) KTE_INLINE_LAMBDA {
    const S numbers[]{x...};
    check_result(numbers, sizeof...(x), why);
  };
  const auto& [r, position] = p;
  if constexpr (Chain::wiring::table.signals == 0) {  // a rotation that was checked stays one
    if constexpr (Key::what == kind::frame_2D)
      check(position.x, position.y);
    else
      check(position.x, position.y, position.z);
  } else if constexpr (Key::what == kind::frame_2D) {
    check(position.x, position.y, r.cos, r.sin);
  } else {
    check(position.x, position.y, position.z, dot(r.x, r.x), dot(r.y, r.y), dot(r.z, r.z));
  }
  return p;
}
}  // namespace detail

/// The pose of a frame: rotation and position, m. Only the elements between the base and the frame are evaluated.
///
///   forward_kinematics(c, q, elbow)          of a static chain, relative to a base at the origin
///   forward_kinematics(c, s, q, "elbow")     of a runtime chain, in axes of the world, with the bases of the state s;
///   planar frames are returned as spatial frames
///   forward_kinematics(c, s, elbow)          of both, at the positions of a state, in axes of the world
///
/// Arguments and errors are those of `inverse_dynamics`; an unknown frame name throws `unknown_name`. For all frames at
/// once see dynamics/frame_motion.hpp.
template <class Gravity, class... E, indexable Q, key_type Frame>
[[nodiscard]] auto forward_kinematics(const static_chain<Gravity, E...>& c, const Q& q, const Frame&) {
  using chain_type = static_chain<Gravity, E...>;
  using S = value_of<Q>;
  detail::check_configuration<chain_type>(q);
  const detail::configuration<S, typename chain_type::wiring, Q> at(q);
  return detail::pose_at<S, Frame>(c, at,
                                   detail::same_base{motion{zero3{}, no_rotation{}, skip{}, skip{}, skip{}, skip{}}});
}

template <class Gravity, class... E, class S, key_type Frame>
[[nodiscard]] auto forward_kinematics(const static_chain<Gravity, E...>& c,
                                      const chain_state<S, detail::wiring<E...>>& s, const Frame&) {
  using namespace detail;
  using state = chain_state<S, wiring<E...>>;
  const auto q = positions(s);
  const configuration<S, wiring<E...>, std::remove_const_t<decltype(q)>> at(q);
  return pose_at<S, Frame>(c, at, base_of_state<state>{s});
}

}  // namespace kte

#endif

// ---- runtime chains (kte/runtime_chain.hpp)

#if defined(KTE_RUNTIME_CHAINS) && !defined(KTE_FORWARD_KINEMATICS_OF_RUNTIME_CHAINS)
#define KTE_FORWARD_KINEMATICS_OF_RUNTIME_CHAINS

#include <kte/dynamics/runtime/frames.hpp>
#include <kte/dynamics/runtime/refused_calls.hpp>
#include <kte/tree/jacobian.hpp>

namespace kte {

namespace detail {
/// As `forward_kinematics`, for positions that have been checked.
template <class S>
pose<mat3<vec3<S>>, vec3<S>> pose_of(const runtime_chain& c, basic_runtime_state<S>& s, const runtime_frame& x) {
  const auto& f = s.tree().body_tree;
  const auto& place = f.frame(x.what, x.index);
  if constexpr (std::is_same_v<S, double>)
    if (s.tree().moves_unknown || place.slot < 0) [[unlikely]] {
      move(c.wiring(), s, x);
      return with_motion(s, x, [](const auto& m) { return plain_pose<S>(m); });
    }
  if constexpr (!std::is_same_v<S, double>) refuse_following(c, s, x);
  place_ancestors(runtime_elements{c}, s, place.slot);
  tree::dense_pose<S> seen;
  const int base = tree::pose_in_base(f, s.work, place, seen);
  tree::dense_pose<S> in_world = seen;
  for_each_base(s, [&](const auto& m, std::size_t slot) {
    if (static_cast<int>(slot) == base) in_world = compose(plain_pose<S>(m), seen);
  });
  return in_world;
}
/// Throws `bad_argument` if the pose of a frame is not finite, which signals and bases in the state can cause.
template <class S, class Pose>
const Pose& checked_pose(const basic_runtime_state<S>& s, const Pose& m, kind k, int frame) {
  const auto r = matrix(m.rotation);
  const S numbers[]{as<S>(m.position.x),  as<S>(m.position.y),  as<S>(m.position.z),
                    as<S>(dot(r.x, r.x)), as<S>(dot(r.y, r.y)), as<S>(dot(r.z, r.z))};
  check_result(numbers, 6, [&] {
    const std::string& name = s.made_for()->names[static_cast<std::size_t>(k)][static_cast<std::size_t>(frame)];
    diagnose(("where frame '" + name + "' stands").c_str(), s);
  });
  return m;
}
}  // namespace detail

template <class S>
pose<mat3<vec3<S>>, vec3<S>> forward_kinematics(const runtime_chain& c, basic_runtime_state<S>& s,
                                                const name_or_handle& frame) {
  c.check(s);
  const auto x = detail::find_frame(c, frame);
  detail::check_positions(s);
  return detail::checked_pose(s, detail::pose_of(c, s, x), x.what, x.index);
}
template <class S, indexable Q>
pose<mat3<vec3<S>>, vec3<S>> forward_kinematics(const runtime_chain& c, basic_runtime_state<S>& s, const Q& q,
                                                const name_or_handle& frame) {
  const auto x = detail::find_frame(c, frame);
  return detail::take<detail::keeping::if_needed>(c, s, q).call(
      [&] { return detail::checked_pose(s, detail::pose_of(c, s, x), x.what, x.index); });
}

#ifdef KTE_EXTERN
namespace detail {
KTE_EXTERN template pose<mat3<vec3<>>, vec3<>> pose_of(const runtime_chain&, runtime_state&, const runtime_frame&);
}
#endif

}  // namespace kte

#endif
