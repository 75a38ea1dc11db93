#pragma once

#include <kte/dynamics/detail/given.hpp>
#include <kte/dynamics/state_vectors.hpp>

namespace kte {

namespace detail {
/// The motion of a frame, from the elements on the way to it and no others.
template <class Types, kind K, int Slot, class Chain, class Given>
KTE_INLINE constexpr auto motion_of(const Chain& c, const Given& g);

template <class Types, std::size_t I, class Chain, class Given, std::size_t... P>
KTE_INLINE constexpr auto motion_by(const Chain& c, const Given& g, std::index_sequence<P...>) {
  if constexpr (writes_freely<core_of<Chain, I>>) {
    return Types::template written_freely<I>(
        c.template core<I>(), motion_of<Types, Types::template what<I, P>, Chain::wiring::slot(I, P)>(c, g)...);
  } else if constexpr (Types::template turns<I>) {
    return with_angle(c.template core<I>().doMotion(
        motion_of<Types, Types::template what<I, P>, Chain::wiring::slot(I, P)>(c, g)...));
  } else {
    return c.template core<I>().doMotion(
        motion_of<Types, Types::template what<I, P>, Chain::wiring::slot(I, P)>(c, g)...);
  }
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
  using types = local_types<Chain, std::remove_const_t<decltype(g)>>;
  const auto p = pose_of<S, Key::what>(motion_of < types, Key::what, slot < 0 ? 0 : slot > (c, g));
  const auto why = [&]() KTE_INLINE_LAMBDA {
    blame_signals<typename Chain::wiring>("where a frame stands", base);
    blame<typename Chain::wiring>("where a frame stands", at.q, same<zero_t>{}, same<zero_t>{}, "a");
  };
  if constexpr (Chain::wiring::table.signals == 0) {  // a turn by what was checked is one
    if constexpr (Key::what == kind::frame_2D) {
      const S numbers[]{p.position.x, p.position.y};
      check_result(numbers, 2, why);
    } else {
      const S numbers[]{p.position.x, p.position.y, p.position.z};
      check_result(numbers, 3, why);
    }
  } else if constexpr (Key::what == kind::frame_2D) {
    const S numbers[]{p.position.x, p.position.y, p.rotation.cos, p.rotation.sin};
    check_result(numbers, 4, why);
  } else {
    const auto& r = p.rotation;
    const S numbers[]{p.position.x, p.position.y, p.position.z, dot(r.x, r.x), dot(r.y, r.y), dot(r.z, r.z)};
    check_result(numbers, 6, why);
  }
  return p;
}
}  // namespace detail

/// Where a frame stands, relative to a base at the origin: rotation and position (m). Only the elements between the
/// base and the frame are evaluated, and only their poses. q as for `inverse_dynamics`.
template <class Gravity, class... E, indexable Q, key_type Frame>
auto forward_kinematics(const static_chain<Gravity, E...>& c, const Q& q, const Frame&) {
  using chain_type = static_chain<Gravity, E...>;
  using S = value_of<Q>;
  detail::check_configuration<chain_type>(q);
  const detail::configuration<S, typename chain_type::wiring, Q> at(q);
  return detail::pose_at<S, Frame>(c, at,
                                   detail::same_base{motion{zero3{}, no_rotation{}, skip{}, skip{}, skip{}, skip{}}});
}

/// The same at the positions of a state, in the axes in which its bases are given.
template <class Gravity, class... E, class S, key_type Frame>
auto forward_kinematics(const static_chain<Gravity, E...>& c, const chain_state<S, detail::wiring<E...>>& s,
                        const Frame&) {
  using namespace detail;
  using state = chain_state<S, wiring<E...>>;
  const auto q = positions(s);
  const configuration<S, wiring<E...>, std::remove_const_t<decltype(q)>> at(q);
  return pose_at<S, Frame>(c, at, base_of_state<state>{s});
}

}  // namespace kte
