#pragma once

#include <kte/math/quaternion.hpp>
#include <kte/math/rigid_body.hpp>

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <array>

namespace kte::detail {

/// The least mass, kg, and principal moment, kg m^2, of a moving body that MuJoCo accepts.
inline constexpr double least_in_mjcf = 1e-15;

/// A body by its principal moments and their axes.
struct mjcf_weight {
  double mass;
  vec3<> com;
  std::array<double, 3> moments;
  unit_quaternion<> axes{1, 0, 0, 0};

  /// Computed in long double: MuJoCo itself is accurate to about 1e-12.
  explicit mjcf_weight(const rigid_body<>& b)
      : mass(b.mass), com(b.com), moments{b.inertia.xx, b.inertia.yy, b.inertia.zz} {
    const auto& i = b.inertia;
    if (i.xy != 0 || i.xz != 0 || i.yz != 0) {
      using wide = long double;
      Eigen::Matrix<wide, 3, 3> all;
      all << wide(i.xx), wide(i.xy), wide(i.xz), wide(i.xy), wide(i.yy), wide(i.yz), wide(i.xz), wide(i.yz), wide(i.zz);
      const Eigen::SelfAdjointEigenSolver<Eigen::Matrix<wide, 3, 3>> modes(all);
      auto a = modes.eigenvectors();
      if (a.determinant() < 0) a.col(2) = -a.col(2);
      for (int k = 0; k < 3; ++k) moments[static_cast<std::size_t>(k)] = static_cast<double>(modes.eigenvalues()[k]);
      using row = vec3<wide>;
      axes = as<double>(to_quaternion(
          mat3<row>{row{a(0, 0), a(0, 1), a(0, 2)}, row{a(1, 0), a(1, 1), a(1, 2)}, row{a(2, 0), a(2, 1), a(2, 2)}}));
    }
    if (fault() <= 1e-13 * (largest() + mass * dot(com, com))) mend();  // rounding errors, also of moving the body
  }

  double largest() const { return *std::max_element(moments.begin(), moments.end()); }
  double least() const { return *std::min_element(moments.begin(), moments.end()); }
  /// The largest violation of the conditions of a physical body: C <= A + B, no moment below 0.
  double fault() const {
    const double sum = moments[0] + moments[1] + moments[2];
    return (std::max)({0.0, 0.0 - least(), largest() - (sum - largest())});
  }
  /// Replaces the moments by the nearest physical ones: a third of the excess of C over A + B is taken from C and added
  /// to A and to B.
  void mend() {
    for (auto& m : moments) m = (std::max)(m, 0.0);
    auto& c = *std::max_element(moments.begin(), moments.end());
    const double excess = c - (moments[0] + moments[1] + moments[2] - c);
    if (!(excess > 0)) return;
    double others = 0;
    for (auto& m : moments)
      if (&m != &c) m += excess / 3, others += m;
    c = others;
  }
  bool moves() const { return mass >= least_in_mjcf && least() >= least_in_mjcf; }
  void raise_to_least() {
    mass = (std::max)(mass, least_in_mjcf);
    for (auto& m : moments) m = (std::max)(m, least_in_mjcf);
  }
};

}  // namespace kte::detail
