#pragma once

#include <kte/contract/joint.hpp>
#include <kte/frames/articulated.hpp>

/// How the axes of a joint divide the motions of its end: what moves along a coordinate axis is the joint's alone. Told
/// by typed constants, so that what an axis takes away is exactly nothing, and no arithmetic.
namespace kte::detail {

/// The sum of squares of a typed vector; any large number if it has run-time entries.
template <class T>
inline constexpr int typed_square = 1000;
template <int N>
inline constexpr int typed_square<constant<N>> = N* N;
template <class X, class Y, class Z>
inline constexpr int typed_square<vec3<X, Y, Z>> = typed_square<X> + typed_square<Y> + typed_square<Z>;

/// Typed factors for the components of motions and wrenches: zero along the axes, one elsewhere. `exact` if all axes
/// are coordinate axes; otherwise all are one.
template <class Linear, class Angular, bool Exact>
struct axis_split {
  static constexpr bool exact = Exact;
  static constexpr Linear linear{};
  static constexpr Angular angular{};
  /// Whether the joint leaves anything of component i: linear x, y, z, angular x, y, z.
  static constexpr std::array<bool, 6> leaves{
      !std::is_same_v<decltype(Linear::x), zero_t>,  !std::is_same_v<decltype(Linear::y), zero_t>,
      !std::is_same_v<decltype(Linear::z), zero_t>,  !std::is_same_v<decltype(Angular::x), zero_t>,
      !std::is_same_v<decltype(Angular::y), zero_t>, !std::is_same_v<decltype(Angular::z), zero_t>};
  static constexpr bool leaves_nothing = leaves == std::array<bool, 6>{};
};
using no_split = axis_split<vec3<one_t>, vec3<one_t>, false>;

template <class A, class B>
KTE_INLINE constexpr auto each_times(const A& a, const B& b) {
  return vec3{a.x * b.x, a.y * b.y, a.z * b.z};
}
template <class V, class W, class A, class B, bool Exact>
KTE_INLINE constexpr auto split_off(axis_split<A, B, Exact> s) {
  if constexpr (Exact && typed_square<V> + typed_square<W> == 1) {
    const auto square = [](auto v) { return vec3{one - v.x * v.x, one - v.y * v.y, one - v.z * v.z}; };
    const auto l = each_times(s.linear, square(V{}));
    const auto a = each_times(s.angular, square(W{}));
    return axis_split<std::remove_const_t<decltype(l)>, std::remove_const_t<decltype(a)>, true>{};
  } else {
    return no_split{};
  }
}
/// For axes 0, 1, ... of a joint at a coordinate of type C.
template <class Core, class C, int N = 0, class Split = axis_split<vec3<one_t>, vec3<one_t>, true>>
constexpr auto split_of(Split s = {}) {
  if constexpr (N == joint_dofs<Core>) {
    return s;
  } else {
    using axis =
        decltype(std::declval<const Core&>().relative(unit_rate<coordinate_kind<Core>, N>(std::declval<const C&>())));
    constexpr auto next = split_off<decltype(axis::velocity), decltype(axis::ang_velocity)>(Split{});
    return split_of<Core, C, N + 1>(next);
  }
}

// ---- the part of things that is not the joint's
template <class... T, class K>
KTE_INLINE constexpr auto masked(const sym3<T...>& m, const K& k) {
  return sym3{k.x * k.x * m.xx, k.x * k.y * m.xy, k.x * k.z * m.xz,
              k.y * k.y * m.yy, k.y * k.z * m.yz, k.z * k.z * m.zz};
}
template <class Split, class M, class H, class J>
KTE_INLINE constexpr auto rest(Split s, const articulated<M, H, J>& b) {
  const auto& k = s.linear;
  const auto& h = b.coupling;
  return articulated{
      masked(b.linear, k),
      mat3{k.x * each_times(s.angular, h.x), k.y * each_times(s.angular, h.y), k.z * each_times(s.angular, h.z)},
      masked(b.angular, s.angular)};
}
template <class Split, class F, class T>
KTE_INLINE constexpr auto rest(Split s, const wrench<F, T>& w) {
  return wrench{each_times(s.linear, w.force), each_times(s.angular, w.torque)};
}

}  // namespace kte::detail
