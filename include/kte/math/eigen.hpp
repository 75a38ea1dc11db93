#pragma once

#include <kte/math/rotation_2D.hpp>

#include <Eigen/Core>

/// Small vectors and matrices to and from Eigen.
namespace kte {

/// The vector or matrix as one of Eigen, of scalar S.
template <class S = double, class X, class Y, class Z>
[[nodiscard]] Eigen::Matrix<S, 3, 1> to_eigen(const vec3<X, Y, Z>& v) {
  return {as<S>(v.x), as<S>(v.y), as<S>(v.z)};
}
template <class S = double, class X, class Y>
[[nodiscard]] Eigen::Matrix<S, 2, 1> to_eigen(const vec2<X, Y>& v) {
  return {as<S>(v.x), as<S>(v.y)};
}
template <class S = double, class RX, class RY, class RZ>
[[nodiscard]] Eigen::Matrix<S, 3, 3> to_eigen(const mat3<RX, RY, RZ>& m) {
  Eigen::Matrix<S, 3, 3> e;
  e << as<S>(m.x.x), as<S>(m.x.y), as<S>(m.x.z), as<S>(m.y.x), as<S>(m.y.y), as<S>(m.y.z), as<S>(m.z.x), as<S>(m.z.y),
      as<S>(m.z.z);
  return e;
}
template <class S = double, class... T>
[[nodiscard]] Eigen::Matrix<S, 3, 3> to_eigen(const sym3<T...>& m) {
  return to_eigen<S>(full(m));
}

/// A vector of Eigen with 3 entries as a `vec3`.
template <class V>
requires(V::SizeAtCompileTime == 3) vec3<typename V::Scalar> to_vec3(const V& v) { return {v[0], v[1], v[2]}; }
/// A 3x3 matrix of Eigen as a `mat3`.
template <class M>
requires(M::SizeAtCompileTime == 9) mat3<vec3<typename M::Scalar>> to_mat3(const M& m) {
  return {{m(0, 0), m(0, 1), m(0, 2)}, {m(1, 0), m(1, 1), m(1, 2)}, {m(2, 0), m(2, 1), m(2, 2)}};
}

}  // namespace kte
