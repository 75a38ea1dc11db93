#pragma once

#include <kte/detail/no_value.hpp>
#include <kte/detail/unroll.hpp>
#include <kte/engine/values.hpp>
#include <kte/frames/motion.hpp>

#include <concepts>
#include <utility>

/// What a recursion sees of a mechanism: bodies, one at a time, each in its present position on its parent.
namespace kte::engine {

/// A motion vector (Featherstone 2008, section 2.2): an axis of a joint, or its rate or acceleration along its axes. At
/// the origin of a body and in its axes.
template <class V, class W>
struct motion_vector {
  using geometry = motion_vector;
  V linear;
  W angular;
};
template <class V, class W>
motion_vector(V, W) -> motion_vector<V, W>;

template <class A, class B, class C, class D>
KTE_INLINE constexpr auto operator+(const motion_vector<A, B>& x, const motion_vector<C, D>& y) {
  return motion_vector{x.linear + y.linear, x.angular + y.angular};
}
template <entry X, class A, class B>
KTE_INLINE constexpr auto operator*(const X& k, const motion_vector<A, B>& x) {
  return motion_vector{k * x.linear, k * x.angular};
}
/// s^T f: the power of a wrench on a motion.
template <class M, class F, class T>
requires requires(const M& s) { s.linear, s.angular; }
KTE_INLINE constexpr auto power(const M& s, const wrench<F, T>& w) {
  return dot(s.linear, w.force) + dot(s.angular, w.torque);
}

/// A body in its present position. R turns its axes to those of its parent; S is the motion subspace of its joint.
///   scalar                of its position
///   first()               the place of the first axis of its joint among the axes of all bodies
///   along_axes(x)         S x, a motion vector in axes of the body; x[0] ... belong to the axes of the joint
///   powers_along(w, put)  put(k, s_k^T w) for each axis k of the joint
///   each_axis(f)          f(k, s_k) for each axis k of the joint; left out where axes are known one by one, below
///   in(u), out(u)         R^T u, R u
///   bias(rate)            dS/dt q_dot, dS/dt in axes of the body; left out where axes are constant in it
///   position()            of its origin from that of its parent, in axes of the parent, m
/// What is fixed to it has
///   inertia()             a rigid_body
///   composite()           the same about the origin
template <class B>
concept body = requires(const B& b, const vec3<typename B::scalar>& u) {
  { b.first() } -> std::convertible_to<int>;
  b.in(u), b.out(u), b.position();
};
/// A body whose axes are known one by one, with the compiler.
///   axes         their number; none of a rigid link
///   axis<k>()    s_k; its entries may be typed constants
///   mass<k>()    on its coordinate alone, kg or kg m^2
///   free()       whether the joint is free to move; otherwise its acceleration is given
///   always_free  whether that is known
///   out(a)       R A R^T of matrices
template <class B>
concept body_with_axes = body<B> && requires(const B& b) {
  { B::axes } -> std::convertible_to<int>;
  { B::always_free } -> std::convertible_to<bool>;
  { b.free() } -> std::convertible_to<bool>;
} &&(B::axes == 0 || requires(const B& b) { b.template axis<0>(), b.template mass<0>(); });

/// Whether a joint is not free to move by its type.
template <class B>
inline constexpr bool never_free = false;
template <body_with_axes B>
requires requires { requires B::never_free; }
inline constexpr bool never_free<B> = true;

/// S x
template <int K = 0, body_with_axes B, class S>
KTE_INLINE constexpr auto sum_along_axes(const B& b, const S* x) {
  if constexpr (K + 1 == B::axes) {
    return x[K] * b.template axis<K>();
  } else {
    return x[K] * b.template axis<K>() + sum_along_axes<K + 1>(b, x);
  }
}
/// put(k, s_k^T w) for the axes from K to End - 1
template <int K, int End, body_with_axes B, class W, class Put>
KTE_INLINE constexpr void each_power(const B& b, const W& w, const Put& put) {
  if constexpr (K < End) {
    put(K, power(b.template axis<K>(), w));
    each_power<K + 1, End>(b, w, put);
  }
}
template <body_with_axes B, class W, class Put>
KTE_INLINE constexpr void each_power(const B& b, const W& w, const Put& put) {
  each_power<0, B::axes>(b, w, put);
}
/// f(k, s_k) for each axis k of the joint. Where axes are types, k is one too.
template <body B, class F>
KTE_INLINE constexpr void each_axis(const B& b, const F& f) {
  if constexpr (body_with_axes<B>) {
    detail::unroll<B::axes>([&]<int K>()
                                KTE_INLINE_LAMBDA { f(std::integral_constant<int, K>{}, b.template axis<K>()); });
  } else {
    b.each_axis(f);
  }
}
/// dS/dt q_dot
template <body B, class S>
KTE_INLINE constexpr auto bias_along_axes(const B& b, const S* rate) {
  if constexpr (requires { b.bias(rate); }) {
    return b.bias(rate);
  } else {
    return motion_vector{zero3{}, zero3{}};
  }
}
/// The wrench at the origin of a body seen from its parent: f = R f, n = R n + p x f.
template <body B, class W>
KTE_INLINE constexpr auto pulled_back(const B& b, const W& w) {
  const auto f = b.out(w.force);
  return wrench{fresh(f), plus_cross(b.out(w.torque), b.position(), f)};
}

using detail::no_value;
/// Values of all bodies that are one, a typed constant.
template <class Value>
struct kept_constant {
  template <body B>
  KTE_INLINE constexpr Value of(int) const {
    return {};
  }
  template <body B>
  KTE_INLINE constexpr Value of(const B&) const {
    return {};
  }
  template <class Part>
  KTE_INLINE constexpr Value at(const Part&) const {
    return {};
  }
};

}  // namespace kte::engine
