#pragma once

#include <kte/tree/memory.hpp>

/// Wrenches of many axes that go in along the tree together: of all bodies beyond one they stand in a row, so that
/// processors take four at a time.
namespace kte::tree {

/// f<4>(k) for k = first, first + 4 ..., then f<1>(k) for what is left up to `last`.
template <class F>
KTE_INLINE void by_fours(std::size_t first, std::size_t last, const F& f) {
  std::size_t k = first;
  for (; k + 4 <= last; k += 4) f.template operator()<4>(k);
  for (; k < last; ++k) f.template operator()<1>(k);
}

/// N numbers in a row, read before anything is written, so that they are taken at once.
template <std::size_t N, class S>
KTE_INLINE std::array<S, N> several(const S* x) {
  std::array<S, N> y;
  for (std::size_t c = 0; c < N; ++c) y[c] = x[c];
  return y;
}
template <std::size_t N, class S>
KTE_INLINE void store(const std::array<S, N>& y, S* x) {
  for (std::size_t c = 0; c < N; ++c) x[c] = y[c];
}

/// A wrench of every axis, by its components.
template <class S>
struct wrench_rows {
  S *fx, *fy, *fz, *tx, *ty, *tz;

  KTE_INLINE void set(std::size_t k, const dense_wrench<S>& w) const {
    fx[k] = w.force.x, fy[k] = w.force.y, fz[k] = w.force.z;
    tx[k] = w.torque.x, ty[k] = w.torque.y, tz[k] = w.torque.z;
  }
  /// To an origin from which the present one stands at `step`: torque += step x force.
  KTE_INLINE void shift(std::size_t first, std::size_t last, const vec3<S>& step) const {
    const vec3<S> p = step;
    by_fours(first, last, [this, &p]<std::size_t N>(std::size_t k) KTE_INLINE_LAMBDA {
      const auto x = several<N>(fx + k), y = several<N>(fy + k), z = several<N>(fz + k);
      auto u = several<N>(tx + k), v = several<N>(ty + k), w = several<N>(tz + k);
      for (std::size_t c = 0; c < N; ++c) u[c] += p.y * z[c] - p.z * y[c];
      for (std::size_t c = 0; c < N; ++c) v[c] += p.z * x[c] - p.x * z[c];
      for (std::size_t c = 0; c < N; ++c) w[c] += p.x * y[c] - p.y * x[c];
      store(u, tx + k), store(v, ty + k), store(w, tz + k);
    });
  }
  /// The power of N wrenches on the unit rate of an axis.
  template <std::size_t N>
  KTE_INLINE std::array<S, N> power(const world_axis<S>& s, bool turns, std::size_t k) const {
    const auto u = several<N>(tx + k), v = several<N>(ty + k), w = several<N>(tz + k);
    std::array<S, N> e;
    for (std::size_t c = 0; c < N; ++c) e[c] = s.angular.x * u[c] + s.angular.y * v[c] + s.angular.z * w[c];
    if (!turns) {
      const auto x = several<N>(fx + k), y = several<N>(fy + k), z = several<N>(fz + k);
      for (std::size_t c = 0; c < N; ++c) e[c] += s.linear.x * x[c] + s.linear.y * y[c] + s.linear.z * z[c];
    }
    return e;
  }
};
template <class S>
struct wrench_columns {
  std::vector<S> components;

  void resize(std::size_t axes) { components.resize(6 * axes); }
  wrench_rows<S> rows() {
    const std::size_t n = components.size() / 6;
    S* const c = components.data();
    return {c, c + n, c + 2 * n, c + 3 * n, c + 4 * n, c + 5 * n};
  }
};

}  // namespace kte::tree
