#pragma once

#include <kte/recursions/articulated_body.hpp>

/// Clusters in the articulated-body algorithm (Chignoli, Adrian, Kim, Wensing, Recursive rigid-body dynamics algorithms
/// for systems with kinematic loops, 2023): joints of several bodies i, moved by N independent rates y' of their base b,
///
///   a_i = X_i a_b + Psi_i y'' + c_i,   Psi_i = sum of the axes before i, each times its rate by y'
///   D = sum Psi_i^T I_i Psi_i,   U = sum X_i^T I_i Psi_i,   u = G^T tau - sum Psi_i^T (p_i + I_i c_i)          (1)
///   I' = sum X_i^T I_i X_i - U D^-1 U^T,   p' = sum X_i^T (p_i + I_i c_i) + U D^-1 u                           (2)
///   y'' = D^-1 (u - U^T a_b)                                                                                   (3)
///
/// Bodies of clusters are those of joints whose accelerations are given, by the bias G_dot y' of their coordinates; so
/// sums over bodies are made on the way inward as ever, and with them a wrench for each independent rate.
namespace kte::engine {

/// What a cluster needs on the way: N of each, of D N^2, row by row.
template <class S>
struct cluster_values {
  std::size_t n;
  wrench<vec3<S>, vec3<S>>* load;  ///< U, about the origin of the base
  wrench<vec3<S>, vec3<S>>* gain;  ///< U D^-1
  S *mass, *force;                 ///< D, u; then factors of D, and D^-1 u
};

/// s_k of the axes of a joint.
template <body B, class S>
KTE_INLINE auto numbered_axis(const B& b, [[maybe_unused]] int k) {
  if constexpr (body_with_axes<B>) {
    return b.template axis<0>();
  } else {
    S unit[6]{};
    unit[k] = S(1);
    return b.along_axes(unit);
  }
}
template <body B>
KTE_INLINE int count_of_axes(const B& b) {
  if constexpr (body_with_axes<B>)
    return B::axes;
  else
    return b.axis_count();
}
/// Adds a body to D, U, u, with its bias motion: `column` are its wrenches for each rate, of all bodies beyond it in the cluster, and then
/// added to those of what it stands on, `to`. ratios(k): pairs of a number of y' and the rate of axis k by it.
template <body B, class X, class M, class S, class Ratios>
KTE_INLINE void add_to_cluster(const B& b, const X& x, const M& m, const Ratios& ratios,
                               wrench<vec3<S>, vec3<S>>* column,
                               wrench<vec3<S>, vec3<S>>* to, const cluster_values<S>& c) {
  const int axes = count_of_axes(b);
  wrench<vec3<S>, vec3<S>> own[6];
  for (int k = 0; k < axes; ++k) {
    const auto s = numbered_axis<B, S>(b, k);
    assign(own[k], accelerating_wrench(x.inertia, s.linear, s.angular));
  }
  for (int k = 0; k < axes; ++k) {
    const auto s = numbered_axis<B, S>(b, k);
    const S bias = as<S>(power(s, x.bias));
    ratios(k, [&](std::size_t d, const S& ratio) KTE_INLINE_LAMBDA {
      c.force[d] -= ratio * bias;
      for (std::size_t e = 0; e < c.n; ++e) {
        const S mass = ratio * as<S>(power(s, column[e]));
        c.mass[d * c.n + e] += mass, c.mass[e * c.n + d] += mass;
      }
      for (int l = 0; l < axes; ++l) {
        const S mass = ratio * as<S>(power(s, own[l]));
        ratios(l, [&](std::size_t e, const S& factor) KTE_INLINE_LAMBDA { c.mass[d * c.n + e] += factor * mass; });
      }
    });
  }
  for (int k = 0; k < axes; ++k)
    ratios(k, [&](std::size_t d, const S& ratio) KTE_INLINE_LAMBDA {
      column[d] = {column[d].force + ratio * own[k].force, column[d].torque + ratio * own[k].torque};
    });
  const motion_vector a{b.in(m.centripetal) + m.linear, m.angular};
  for (std::size_t d = 0; d < c.n; ++d) {
    c.force[d] -= as<S>(power(a, column[d]));
    const auto w = pulled_back(b, column[d]);
    to[d] = {as<S>(to[d].force + w.force), as<S>(to[d].torque + w.torque)};
  }
}
/// (2): what the base of a cluster carries, after sums over its bodies.
template <class I, class W, class S>
KTE_INLINE auto less_cluster(const articulated_body<I, W>& sum, const cluster_values<S>& c) {
  dense<S, articulated_body<I, W>> x;
  assign(x, sum);
  for (std::size_t d = 0; d < c.n; ++d) {
    x.inertia = kte::detail::less_dyad(x.inertia, c.load[d], c.gain[d]);
    x.bias = {x.bias.force + c.force[d] * c.load[d].force, x.bias.torque + c.force[d] * c.load[d].torque};
  }
  return x;
}
/// (3), for number d of y''.
template <class A, class S>
KTE_INLINE S cluster_acceleration(const A& base, const cluster_values<S>& c, std::size_t d) {
  return c.force[d] - as<S>(dot(c.gain[d].force, base.acceleration) + dot(c.gain[d].torque, base.ang_acceleration));
}

}  // namespace kte::engine
