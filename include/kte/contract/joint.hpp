#pragma once

#include <kte/contract/transmission.hpp>
#include <kte/detail/unroll.hpp>
#include <kte/frames/articulated.hpp>

#include <type_traits>

/// The properties of elements that the composite-rigid-body algorithm uses, for static and runtime chains.
namespace kte::detail {

/// The kind of the coordinates of a joint, and the number of its degrees of freedom; 0 for a link.
template <class Core>
inline constexpr kind coordinate_kind = Core::ports[0].what;
template <class Core>
inline constexpr int joint_dofs = coordinates_of<Core> > 1 ? int{coordinates_of<Core>} : nv_of(coordinate_kind<Core>);
/// A core with a mass on its first port.
template <class Core, class S>
inline constexpr bool has_mass = requires(const Core& c) {
  c.template mass<S>();
};

/// The wrench that accelerates a composite inertia by the velocity of `m` per second.
template <class M, class H, class J, class Motion>
KTE_INLINE constexpr auto accelerating_wrench(const composite<M, H, J>& b, const Motion& m) {
  return kte::accelerating_wrench(b, m.velocity, m.ang_velocity);
}

/// The motion of a joint at its coordinate, or at a tuple of its coordinates.
template <class Core, class C>
KTE_INLINE constexpr auto relative_at(const Core& core, const C& c) {
  return core.relative(c);
}
template <class Core, class... C>
constexpr auto relative_at(const Core& core, const std::tuple<C...>& c) {
  return std::apply([&core](const auto&... x) { return core.relative(x...); }, c);
}
/// Coordinates without rates.
template <class... C>
constexpr auto position_only(const std::tuple<C...>& c) {
  return std::apply([](const auto&... x) { return std::tuple{position_only(x)...}; }, c);
}
/// Axis n of a joint at coordinate c: the motion at its unit rate.
template <int N, class Core, class C>
KTE_INLINE constexpr auto axis_of(const Core& core, const C& c) {
  return core.relative(unit_rate<coordinate_kind<Core>, N>(c));
}
template <int N, class Core, class... C>
constexpr auto axis_of(const Core& core, const std::tuple<C...>& c) {
  return axis_among<std::size_t{N}>(core, c, std::make_index_sequence<sizeof...(C)>{});
}
/// The tuple of f<K>() for each coordinate K of a joint.
template <class Core, class F>
constexpr auto tuple_of_coordinates(const F& f) {
  return [&f]<std::size_t... K>(std::index_sequence<K...>) { return std::tuple{f.template operator()<K>()...}; }
  (std::make_index_sequence<coordinates_of<Core>>{});
}

}  // namespace kte::detail
