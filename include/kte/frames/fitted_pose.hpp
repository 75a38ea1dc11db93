#pragma once

#include <kte/errors.hpp>
#include <kte/frames/inverse.hpp>
#include <kte/math/quaternion.hpp>

#include <Eigen/LU>
#include <Eigen/SVD>

#include <span>
#include <string>

namespace kte {

namespace detail {
/// The rigid motion x -> R x + p that takes points a_i nearest to b_i, and rotations A_i nearest to B_i:
///
///   minimise  sum |b_i - R a_i - p|^2 + w sum |B_i - R A_i|_F^2 / 2          (1)
///   R is the rotation nearest to  H = sum (b_i - b)(a_i - a)^T + w/2 sum B_i A_i^T,   p = b - R a          (2)
///
/// a and b the means; of H = U S V^T it is U diag(1, 1, det U V^T) V^T (Kabsch, Acta Crystallographica A 32, 1976; with
/// the determinant: Umeyama, IEEE Transactions on Pattern Analysis and Machine Intelligence 13, 1991).
class fitted_motion {
 public:
  void add(const vec3<>& a, const vec3<>& b) {
    const Eigen::Vector3d x(a.x, a.y, a.z), y(b.x, b.y, b.z);
    if (count_++ == 0) first_from_ = x, first_to_ = y;  // differences keep digits of points that are far away
    const Eigen::Vector3d u = x - first_from_, v = y - first_to_;
    h_ += v * u.transpose(), from_ += u, to_ += v;
  }
  void add(const mat3<vec3<>>& a, const mat3<vec3<>>& b, double weight) {
    const mat3<vec3<>> m = as<double>(b * transpose(a));
    Eigen::Matrix3d r;
    r << m.x.x, m.x.y, m.x.z, m.y.x, m.y.y, m.y.z, m.z.x, m.z.y, m.z.z;
    h_ += weight / 2 * r;
  }
  /// In the plane turns are about z.
  pose<mat3<vec3<>>, vec3<>> motion(bool in_plane = false) const {
    const double n = count_ > 0 ? count_ : 1;
    const Eigen::Vector3d a = from_ / n, b = to_ / n;
    const Eigen::Matrix3d h = h_ - n * b * a.transpose();
    Eigen::Matrix3d r;
    if (in_plane) {
      const double x = h(0, 0) + h(1, 1), y = h(1, 0) - h(0, 1), size = std::hypot(x, y);
      const double c = size > 0 ? x / size : 1, s = size > 0 ? y / size : 0;
      r << c, -s, 0, s, c, 0, 0, 0, 1;
    } else {
      const Eigen::JacobiSVD<Eigen::Matrix3d> svd(h, Eigen::ComputeFullU | Eigen::ComputeFullV);
      const double sign = (svd.matrixU() * svd.matrixV().transpose()).determinant() < 0 ? -1 : 1;
      r = svd.matrixU() * Eigen::Vector3d(1, 1, sign).asDiagonal() * svd.matrixV().transpose();
    }
    const Eigen::Vector3d p = first_to_ + b - r * (first_from_ + a);
    return {{{r(0, 0), r(0, 1), r(0, 2)}, {r(1, 0), r(1, 1), r(1, 2)}, {r(2, 0), r(2, 1), r(2, 2)}},
            {p[0], p[1], p[2]}};
  }

 private:
  Eigen::Matrix3d h_ = Eigen::Matrix3d::Zero();
  Eigen::Vector3d from_ = Eigen::Vector3d::Zero(), to_ = from_, first_from_ = from_, first_to_ = from_;
  int count_ = 0;
};
}  // namespace detail

/// The pose that fits points of a body, m, to their measured positions, m, in the least-squares sense (1). `body` and
/// `measured` are in the same order. The result is a rotation, never a reflection. Three points that are not on a line
/// determine the pose; with fewer, the result is one of several. Throws `bad_argument` for lists of different length,
/// for empty lists and for numbers that are not finite.
[[nodiscard]] inline pose<unit_quaternion<double>, vec3<>> fitted_pose(std::span<const vec3<>> body,
                                                                       std::span<const vec3<>> measured) {
  if (body.empty() || body.size() != measured.size())
    detail::raise<bad_argument>(
        "kte: fitted_pose needs as many points of the body as were measured, and one at least: " +
        std::to_string(body.size()) + " and " + std::to_string(measured.size()));
  detail::fitted_motion fit;
  for (std::size_t i = 0; i < body.size(); ++i) {
    const vec3<> still = 0.0 * (body[i] + measured[i]);
    if (!(dot(still, still) == 0))
      detail::raise<bad_argument>("kte: fitted_pose: point " + std::to_string(i + 1) + " is not finite");
    fit.add(body[i], measured[i]);
  }
  const auto [r, p] = fit.motion();
  return {to_quaternion(r), p};
}

}  // namespace kte
