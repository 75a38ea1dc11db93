#pragma once

#include <kte/recursions/articulated_body.hpp>

/// Clusters in the articulated-body algorithm (Chignoli, Adrian, Kim, Wensing, Recursive rigid-body dynamics algorithms
/// for systems with kinematic loops, 2023): joints of several bodies i, moved by N independent rates y' of their base
/// b,
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

/// Adds a body to D, U, u, with its bias motion: `column` are its wrenches for each rate, of all bodies beyond it in
/// the cluster, and then added to those of what it stands on, `to`. rates(k): those of axis k by y'.
template <body B, class X, class M, class Rates, class S>
KTE_INLINE void add_to_cluster(const B& b, const X& x, const M& m, const Rates& rates, wrench<vec3<S>, vec3<S>>* column,
                               wrench<vec3<S>, vec3<S>>* to, const cluster_values<S>& c) {
  const std::size_t n = c.n;
  const auto with_axis = [&](int k, const auto& s) KTE_INLINE_LAMBDA {
    const S bias = as<S>(power(s, x.bias));
    for (std::size_t d = 0; d < n; ++d) {
      const S& ratio = rates(k)[d];
      c.force[d] -= ratio * bias;
      for (std::size_t e = 0; e < n; ++e) {
        const S mass = ratio * as<S>(power(s, column[e]));
        c.mass[d * n + e] += mass, c.mass[e * n + d] += mass;
      }
    }
  };
  const auto between = [&](int k, int l, const S& mass) KTE_INLINE_LAMBDA {
    for (std::size_t d = 0; d < n; ++d)
      for (std::size_t e = 0; e < n; ++e) c.mass[d * n + e] += rates(k)[d] * rates(l)[e] * mass;
  };
  const auto add = [&](int k, const auto& u) KTE_INLINE_LAMBDA {
    for (std::size_t d = 0; d < n; ++d) {
      const S& ratio = rates(k)[d];
      assign(column[d], column[d] + wrench{ratio * u.force, ratio * u.torque});
    }
  };
  if constexpr (body_with_axes<B>) {
    static_assert(B::axes == 1);
    const auto s = b.template axis<0>();
    with_axis(0, s);
    const auto u = accelerating_wrench(x.inertia, s.linear, s.angular);
    between(0, 0, as<S>(power(s, u)));
    add(0, u);
  } else {
    const int axes = b.axis_count();
    motion_vector<vec3<S>, vec3<S>> axis[6];
    wrench<vec3<S>, vec3<S>> own[6];
    for (int k = 0; k < axes; ++k) {
      S unit[6]{};
      unit[k] = S(1);
      assign(axis[k], b.along_axes(unit));
      assign(own[k], accelerating_wrench(x.inertia, axis[k].linear, axis[k].angular));
      with_axis(k, axis[k]);
    }
    for (int k = 0; k < axes; ++k)
      for (int l = 0; l < axes; ++l) between(k, l, as<S>(power(axis[k], own[l])));
    for (int k = 0; k < axes; ++k) add(k, own[k]);
  }
  const motion_vector a{b.in(m.centripetal) + m.linear, m.angular};
  for (std::size_t d = 0; d < n; ++d) {
    c.force[d] -= as<S>(power(a, column[d]));
    assign(to[d], to[d] + pulled_back(b, column[d]));
  }
}
/// As `add_to_cluster` for one rate y' and a joint of one axis with the rate `ratio` y', in numbers that no store can
/// change. `column` is not needed again.
template <body_with_axes B, class X, class M, class S>
KTE_INLINE void add_to_cluster_of_one(const B& b, const X& x, const M& m, const S& ratio,
                                      const wrench<vec3<S>, vec3<S>>& column, wrench<vec3<S>, vec3<S>>& to,
                                      const cluster_values<S>& c) {
  static_assert(B::axes == 1);
  const auto s = b.template axis<0>();
  const auto u = accelerating_wrench(x.inertia, s.linear, s.angular);
  wrench<vec3<S>, vec3<S>> sum = column;
  const S mass = as<S>(constant<2>{} * power(s, sum) + ratio * power(s, u));
  assign(sum, sum + wrench{ratio * u.force, ratio * u.torque});
  const motion_vector a{b.in(m.centripetal) + m.linear, m.angular};
  const S force = as<S>(ratio * power(s, x.bias) + power(a, sum));
  const auto carried = pulled_back(b, sum);
  c.mass[0] += ratio * mass, c.force[0] -= force;
  assign(to, to + carried);
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
