#pragma once

#include <kte/math/quaternion.hpp>

#include <Eigen/Dense>

#include <cstdint>
#include <random>

/// Random numbers, vectors and rotations for tests, the same on every platform, and the way from kte to Eigen.
namespace kte::test {

class draw {
 public:
  explicit draw(std::uint64_t seed) : engine_(seed) {}

  /// Uniform in [-1, 1).
  double number() { return static_cast<double>(static_cast<std::int64_t>(engine_())) * 0x1p-63; }
  /// A multiple of 1/64 in [-2, 2). Sums of products of up to five of these are exact, so that results may be compared
  /// by == whatever the compiler reorders or contracts.
  double dyadic() { return static_cast<double>(static_cast<int>(engine_() >> 56) - 128) / 64; }

  /// A vector, matrix or body of type T with dyadic numbers; typed constants draw themselves.
  template <class T>
  T exact() {
    if constexpr (typed_constant<T>) {
      return {};
    } else if constexpr (requires(T v) { v.xx; }) {
      return {exact<decltype(T::xx)>(), exact<decltype(T::xy)>(), exact<decltype(T::xz)>(),
              exact<decltype(T::yy)>(), exact<decltype(T::yz)>(), exact<decltype(T::zz)>()};
    } else if constexpr (requires(T v) { v.z; }) {
      return {exact<decltype(T::x)>(), exact<decltype(T::y)>(), exact<decltype(T::z)>()};
    } else {
      return dyadic();
    }
  }

  vec3<> vector() { return {number(), number(), number()}; }
  mat3<> matrix() { return {vector(), vector(), vector()}; }
  sym3<> symmetric() { return {number(), number(), number(), number(), number(), number()}; }

  /// Uniform over all rotations: a direction in four dimensions, by rejection from the cube.
  unit_quaternion<> rotation() {
    for (;;) {
      const double w = number(), x = number(), y = number(), z = number(), n = w * w + x * x + y * y + z * z;
      if (n <= 1 && n > 0.01) return normalized(w, x, y, z);
    }
  }

 private:
  std::mt19937_64 engine_;
};

template <class X, class Y, class Z>
Eigen::Vector3d eigen(const vec3<X, Y, Z>& v) {
  return {as<double>(v.x), as<double>(v.y), as<double>(v.z)};
}
template <class RX, class RY, class RZ>
Eigen::Matrix3d eigen(const mat3<RX, RY, RZ>& m) {
  Eigen::Matrix3d r;
  r << eigen(m.x).transpose(), eigen(m.y).transpose(), eigen(m.z).transpose();
  return r;
}
template <class... T>
Eigen::Matrix3d eigen(const sym3<T...>& m) {
  return eigen(full(m));
}

}  // namespace kte::test
