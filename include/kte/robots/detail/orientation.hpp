#pragma once

#include <kte/math/vec.hpp>

#include <array>
#include <cmath>
#include <cstddef>

namespace kte::detail {

/// An exact sum of doubles: numbers that do not overlap, the smallest first (Shewchuk, Adaptive precision
/// floating-point arithmetic and fast robust geometric predicates, Discrete and Computational Geometry 18, 1997).
class exact_sum {
 public:
  void add(double x) {
    std::size_t kept = 0;
    for (std::size_t i = 0; i < size_; ++i) {
      const double sum = x + parts_[i], part = sum - x;
      const double rest = (x - (sum - part)) + (parts_[i] - part);
      if (rest != 0) parts_[kept++] = rest;
      x = sum;
    }
    if (x != 0) parts_[kept++] = x;
    size_ = kept;
  }
  void add_product(double x, double y, double z) {
    const double high = x * y;
    for (const double part : {high, std::fma(x, y, -high)}) {
      const double product = part * z;
      add(product), add(std::fma(part, z, -product));
    }
  }
  /// The largest part, which has the sign of the sum.
  double largest() const { return size_ == 0 ? 0 : parts_[size_ - 1]; }

 private:
  std::array<double, 96> parts_;
  std::size_t size_ = 0;
};

/// A number with the sign of the determinant of b - a, c - a, d - a: positive where d is on the side of the plane from
/// which a, b, c run counterclockwise, 0 only where the determinant is 0. Exact if no product of three numbers
/// underflows. In doubles the error of the determinant is below (7 + 56 e) e times the determinant with all signs
/// positive, e = 2^-53 (Shewchuk); only below this bound is it computed exactly.
inline double orientation(const vec3<>& a, const vec3<>& b, const vec3<>& c, const vec3<>& d) {
  const vec3<> u = b - a, v = c - a, w = d - a;
  const double yz = v.y * w.z, zy = v.z * w.y, zx = v.z * w.x, xz = v.x * w.z, xy = v.x * w.y, yx = v.y * w.x;
  const double det = u.x * (yz - zy) + u.y * (zx - xz) + u.z * (xy - yx);
  const double size = std::abs(u.x) * (std::abs(yz) + std::abs(zy)) + std::abs(u.y) * (std::abs(zx) + std::abs(xz)) +
                      std::abs(u.z) * (std::abs(xy) + std::abs(yx));
  if (std::abs(det) > 8.9e-16 * size) return det;
  exact_sum sum;
  const auto add = [&](double sign, const vec3<>& p, const vec3<>& q, const vec3<>& r) {
    sum.add_product(sign * p.x, q.y, r.z), sum.add_product(-sign * p.x, q.z, r.y);
    sum.add_product(sign * p.y, q.z, r.x), sum.add_product(-sign * p.y, q.x, r.z);
    sum.add_product(sign * p.z, q.x, r.y), sum.add_product(-sign * p.z, q.y, r.x);
  };
  add(1, b, c, d), add(-1, a, c, d), add(1, a, b, d), add(-1, a, b, c);
  return sum.largest();
}

}  // namespace kte::detail
