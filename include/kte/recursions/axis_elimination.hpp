#pragma once

#include <kte/engine/axes.hpp>
#include <kte/frames/articulated.hpp>
#include <kte/math/select.hpp>

#include <limits>

/// Axes of joints in articulated bodies (Featherstone 2008, section 7.3): their elimination from inertias, and their
/// accelerations. Axes are known by type here, by number in recursions/axis_elimination_by_number.hpp.
namespace kte::engine {

/// Articulated inertia I^A and bias force p^A of a body and all bodies beyond it: an acceleration a needs the wrench
/// I^A a + p^A.
template <class I, class W>
struct articulated_body {
  using geometry = articulated_body;
  I inertia;
  W bias;
};
template <class I, class W>
articulated_body(I, W) -> articulated_body<I, W>;
template <class I, class W, class J, class V>
KTE_INLINE constexpr auto operator+(const articulated_body<I, W>& a, const articulated_body<J, V>& b) {
  return articulated_body{a.inertia + b.inertia, a.bias + b.bias};
}

/// The factors of an axis s: U D^-1, u D^-1 and D^-1, with U = I^A s, D = s^T U + m, u = tau - s^T p^A, and a further
/// mass m on its coordinate.
template <class S>
struct axis_factors {
  wrench<vec3<S>, vec3<S>> gain;
  S rate, inverse;
};

/// A body with its articulated inertia, before an axis of its joint is eliminated.
template <class I, class W, class U, class G, class S>
struct axis_elimination {
  using geometry = axis_elimination;
  I inertia;
  W bias;
  U u;
  G gain;
  S rate;
};
template <class I, class W, class U, class G, class S>
axis_elimination(I, W, U, G, S) -> axis_elimination<I, W, U, G, S>;

/// The component of axis K if its elimination leaves no inertia along it; otherwise -1.
template <body_with_axes B, int K>
inline constexpr int eliminated_component = [] {
  using axis = std::remove_cvref_t<decltype(std::declval<const B&>().template axis<K>())>;
  return typed_constant<decltype(std::declval<const B&>().template mass<K>())> ? unit_axis<axis> : -1;
}();
/// The inertia or wrench with zeros for axis K and all later axes that are eliminated.
template <body_with_axes B, int K, class A>
KTE_INLINE constexpr auto without_axes(const A& a) {
  if constexpr (K == B::axes) {
    return a;
  } else {
    return without_axes<B, K + 1>(without<eliminated_component<B, K>>(a));
  }
}
/// I^A and p^A after the elimination of an axis s; `more` is added to p^A:
///
///   I' = I - U U^T D^-1,   p' = p + U u D^-1          (1)
///
/// Along a unit axis without a further mass, I' is exactly zero and p' is tau.
template <int K, body_with_axes B, class Y, class V, class S>
KTE_INLINE constexpr auto after_elimination(const B& b, const Y& y, const V& more, const S& force) {
  constexpr int n = eliminated_component<B, K>;
  const auto inertia = kte::detail::less_dyad(y.inertia, y.u, y.gain);
  const auto bias = (y.bias + more) + wrench{y.rate * y.u.force, y.rate * y.u.torque};
  if constexpr (n < 0) {
    return articulated_body{inertia, bias};
  } else {
    const auto s = b.template axis<K>();
    return articulated_body{without<n>(inertia), without<n>(bias) + wrench{force * s.linear, force * s.angular}};
  }
}
/// The threshold below which the inertia along an axis is only rounding error. `linear`, `angular`: the traces of the
/// two parts of I^A.
template <class S, class A, class I, class J>
KTE_INLINE constexpr S least_inertia(const A& s, const I& linear, const J& angular) {
  return S(16) * std::numeric_limits<S>::epsilon() *
         as<S>(dot(s.linear, s.linear) * linear + dot(s.angular, s.angular) * angular);
}
/// Notes the first axis without inertia; `first` is -1 before. d: the inertia along the axis.
template <class S>
KTE_INLINE constexpr void note(int& first, int axis, bool moves, const S&) {
  if (!moves) [[unlikely]]
    if (first < 0) first = axis;
}
/// Eliminates the axes of a joint from the last to the first. The first is left to `seen_by_parent`, which bodies on
/// bases do not need. `unmoved`: notes axes without inertia.
template <int K, body_with_axes B, class I, class W, class L, class A, class Force, class S, class Unmoved>
KTE_INLINE constexpr auto eliminate_axes(const B& b, const I& inertia, const W& bias, const L& linear, const A& angular,
                                         const Force& force, axis_factors<S>* factors, Unmoved& unmoved) {
  constexpr std::integral_constant<int, K> k{};
  const auto s = b.template axis<K>();
  const auto u = accelerating_wrench(inertia, s.linear, s.angular);
  const S d = as<S>(power(s, u) + b.template mass<K>());
  note(unmoved, b.first() + K, all(d > least_inertia<S>(s, linear, angular)), d);
  const S inverse = S(1) / d;
  const auto rate = inverse * (force(k) - power(s, bias));
  const wrench gain{inverse * u.force, inverse * u.torque};
  assign(factors[K].gain, gain);
  factors[K].rate = as<S>(rate), factors[K].inverse = inverse;
  const axis_elimination y{fresh(inertia), fresh(bias), fresh(u), fresh(gain), rate};
  if constexpr (K == 0) {
    return y;
  } else {
    const auto rest = after_elimination<K>(b, y, no_wrench, force(k));
    return eliminate_axes<K - 1>(b, rest.inertia, rest.bias, linear, angular, force, factors, unmoved);
  }
}
/// `eliminate_axes` if the joint is free to move; otherwise x unchanged.
template <body_with_axes B, class X, class Force, class S, class Unmoved>
KTE_INLINE constexpr auto eliminated(const B& b, const X& x, const Force& force, axis_factors<S>* factors,
                                     Unmoved& unmoved) {
  if constexpr (B::axes == 0 || never_free<B>) {
    return fresh(x);
  } else {
    const auto all_axes = [&]() KTE_INLINE_LAMBDA {
      return eliminate_axes<B::axes - 1>(b, x.inertia, x.bias, trace(x.inertia.linear), trace(x.inertia.angular), force,
                                         factors, unmoved);
    };
    if constexpr (B::always_free) {
      return all_axes();
    } else {
      dense<S, decltype(all_axes())> y{};
      if (b.free())
        assign(y, all_axes());
      else
        assign(y.inertia, x.inertia), assign(y.bias, x.bias);
      return y;
    }
  }
}
/// q_ddot = u D^-1 - (U D^-1)^T a',   a = a' + s q_ddot          (2)
///
/// Along a unit axis without a further mass the component of a is u D^-1 - (U D^-1)^T (the other components of a'),
/// whatever the component of a' is.
template <int K, class S, body_with_axes B, class A>
KTE_INLINE constexpr auto accelerated(const B& b, const axis_factors<S>* factors, const A& a, S* change) {
  if constexpr (K == B::axes) {
    return fresh(a);
  } else {
    constexpr int n = eliminated_component<B, K>;
    const auto s = b.template axis<K>();
    const S x = as<S>(factors[K].rate - power(without_axes<B, K>(a), factors[K].gain));
    change[K] = n < 0 ? x : as<S>(x - (dot(s.linear, a.linear) + dot(s.angular, a.angular)));
    return accelerated<K + 1>(b, factors, without<n>(a) + x * s, change);
  }
}

}  // namespace kte::engine
