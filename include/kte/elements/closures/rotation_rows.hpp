#pragma once

#include <kte/contract/closure.hpp>
#include <kte/frames/motion.hpp>
#include <kte/math/principal_moments.hpp>

/// Rows of closures that hold axes and rotations, with their derivatives along a motion m of B in A.
namespace kte::detail {

/// u . R t of an axis u of A and an axis t of B, and its derivatives:
///
///   u . R t,   u . R (w x t),   u . R (al x t + w x (w x t))          (1)
struct cosine {
  template <class M, class U, class T>
  KTE_INLINE constexpr auto operator()(const M& m, const U& u, const T& t) const {
    return dot(u, m.rotation * t);
  }
};
struct cosine_dot {
  template <class M, class U, class T>
  KTE_INLINE constexpr auto operator()(const M& m, const U& u, const T& t) const {
    return dot(u, m.rotation * cross(m.ang_velocity, t));
  }
};
struct cosine_ddot {
  template <class M, class U, class T>
  KTE_INLINE constexpr auto operator()(const M& m, const U& u, const T& t) const {
    const auto& w = m.ang_velocity;
    return dot(u, m.rotation * (cross(m.ang_acceleration, t) + cross(w, cross(w, t))));
  }
};

/// Half of the axial vector of R by any of these, the axis of a turn times its sine:
///
///   (z.Ry - y.Rz, x.Rz - z.Rx, y.Rx - x.Ry) / 2          (2)
template <class Row, class M>
KTE_INLINE constexpr auto half_axial(const M& m, const Row& c) {
  constexpr auto x = axis::x;
  constexpr auto y = axis::y;
  constexpr auto z = axis::z;
  return vec3{half(c(m, z, y) - c(m, y, z)), half(c(m, x, z) - c(m, z, x)), half(c(m, y, x) - c(m, x, y))};
}

/// Two unit vectors normal to a unit axis, and to each other.
struct normals {
  vec3<> first, second;
};
constexpr normals normals_of(const vec3<>& n) {
  const auto size = [](double x) { return x < 0 ? -x : x; };
  const vec3<> across = size(n.x) <= size(n.y) && size(n.x) <= size(n.z) ? vec3<>{1, 0, 0}
                        : size(n.y) <= size(n.z)                         ? vec3<>{0, 1, 0}
                                                                         : vec3<>{0, 0, 1};
  const vec3<> u = cross(across, n);
  const double squared = dot(u, u);
  if (!(squared > 0)) return {};  // no axis, which its element refuses
  const vec3<> first = constexpr_sqrt(1 / squared) * u;
  return {first, cross(n, first)};
}

/// A closure whose core has rows_at(m, p, row): its rows for the position p, where row(m, u, t) is u . R t; for their
/// rates and accelerations p_dot and p_ddot, where row(m, u, t) is the derivative of that.
template <class Core>
struct rotation_closure : closure<Core> {
  template <class M>
  constexpr auto residual(const M& m) const {
    return core().rows_at(m, m.position, cosine{});
  }
  template <class M>
  constexpr auto residual_dot(const M& m) const {
    return core().rows_at(m, m.rotation * m.velocity, cosine_dot{});
  }
  template <class M>
  constexpr auto residual_ddot(const M& m) const {
    return core().rows_at(m, m.rotation * m.acceleration, cosine_ddot{});
  }

 private:
  constexpr const Core& core() const { return static_cast<const Core&>(*this); }
};

}  // namespace kte::detail
