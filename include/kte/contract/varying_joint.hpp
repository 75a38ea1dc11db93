#pragma once

#include <kte/contract/joint.hpp>
#include <kte/contract/joint_axis.hpp>
#include <kte/math/dual.hpp>

#include <array>

/// Joints whose axes depend on their coordinates: the motion subspace S(q) of Featherstone 2008, section 3.5, and dS/dt
/// in the axes of the end, from dS/dq.
namespace kte::detail {

/// Axis K of a joint in numbers of type D.
template <std::size_t K, class D, class Core, std::size_t N>
joint_axis<D> axis_in(const Core& core, const std::array<D, N>& q) {
  const auto c = [&q]<std::size_t... I>(std::index_sequence<I...>) {
    using std::cos;
    using std::sin;
    return std::tuple{coordinate{q[I], zero, zero, D(cos(q[I])), D(sin(q[I]))}...};
  }
  (std::make_index_sequence<N>{});
  const auto s = axis_among<K>(core, c, std::make_index_sequence<N>{});
  return {as<D>(s.velocity), as<D>(s.ang_velocity)};
}
/// Applies f to each component of a vector.
template <class V, class F>
constexpr auto each_component(const V& v, const F& f) {
  return vec3{f(v.x), f(v.y), f(v.z)};
}
template <class D, class F>
constexpr auto each_component(const joint_axis<D>& s, const F& f) {
  using S = decltype(f(s.linear.x));
  return joint_axis<S>{each_component(s.linear, f), each_component(s.angular, f)};
}

/// The pose of the end of a joint in its base at coordinates q, and its axes with their derivatives.
template <class S, class Core>
pose<mat3<vec3<S>>, vec3<S>> place_varying_joint(const Core& core, const S* q, joint_axis<S>* axes, bool second) {
  constexpr std::size_t n = coordinates_of<Core>;
  using D = dual<S, int{n}>;
  using E = dual<D, int{n}>;
  std::array<S, n> at;
  std::array<D, n> first;
  std::array<E, n> twice;
  for (std::size_t k = 0; k < n; ++k) {
    at[k] = q[k], first[k] = seeded<int{n}>(q[k], int(k)), twice[k] = seeded<int{n}>(first[k], int(k));
  }
  const auto put = [&]<std::size_t K>() {
    const joint_axis<D> s = axis_in<K>(core, first);
    axes[K] = each_component(s, [](const D& x) { return x.value; });
    for (std::size_t j = 0; j < n; ++j)
      axes[n + n * K + j] = each_component(s, [j](const D& x) { return x.derivative[j]; });
    if (!second) return;
    const joint_axis<E> e = axis_in<K>(core, twice);
    for (std::size_t j = 0; j < n; ++j)
      for (std::size_t i = 0; i < n; ++i)
        axes[n + n * n + n * n * K + n * j + i] =
            each_component(e, [j, i](const E& x) { return x.derivative[j].derivative[i]; });
  };
  return [&]<std::size_t... K>(std::index_sequence<K...>) {
    using std::cos;
    using std::sin;
    (put.template operator()<K>(), ...);
    const auto x = core.relative(coordinate{at[K], skip{}, skip{}, S(cos(at[K])), S(sin(at[K]))}...);
    return pose<mat3<vec3<S>>, vec3<S>>{as<S>(matrix(x.rotation)), as<S>(x.position)};
  }
  (std::make_index_sequence<n>{});
}

}  // namespace kte::detail
