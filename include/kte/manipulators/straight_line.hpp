#pragma once

#include <kte/manipulators/pose_error.hpp>

#include <array>

namespace kte {

/// A path between two poses: the origin moves on a straight line, the rotation about one axis at constant rate (slerp),
/// the shorter way.
///
///   p(s) = p_0 + s d,   R(s) = exp(s [w]x) R_0,   (d, w) = pose_error(x_0, x_1)                      (1)
///
/// The twist, in axes of the world at the origin, is s' (d, w). Throws what `pose_error` throws.
template <class S = double>
class straight_line {
 public:
  template <class R0, class P0, class R1, class P1>
  straight_line(const pose<R0, P0>& from, const pose<R1, P1>& to)
      : rotation_(as<S>(detail::quaternion_of(from.rotation))),
        position_(as<S>(from.position)),
        way_(pose_error(from, to).template cast<S>()) {
    const std::array<S, 3> start{position_.x, position_.y, position_.z};
    detail::check_finite(start, 3, "kte: the start of a straight line is not finite");
    detail::check_finite(way_, 6, "kte: the difference of the poses of a straight line is not finite");
  }

  /// The pose at s in [0, 1]; outside, the path is extended. Throws `bad_argument` if s or the pose is not finite.
  pose<mat3<vec3<S>>, vec3<S>> operator()(const S& s) const {
    const vec3<S> d{way_[0], way_[1], way_[2]}, w{S(s * way_[3]), S(s * way_[4]), S(s * way_[5])};
    const pose<mat3<vec3<S>>, vec3<S>> x{matrix(to_quaternion(w) * rotation_), position_ + s * d};  // (1)
    const auto& [R, p] = x;
    const std::array<S, 6> numbers{p.x, p.y, p.z, R.x.x, R.y.y, R.z.z};
    detail::check_finite(numbers, 6, "kte: a straight line: the pose at s is not finite: s is not, or is too large");
    return x;
  }
  /// The difference (d, w) of the poses, m, rad, in axes of the world: the twist at s' = 1.
  [[nodiscard]] const Eigen::Matrix<S, 6, 1>& way() const { return way_; }

 private:
  unit_quaternion<S> rotation_;
  vec3<S> position_;
  Eigen::Matrix<S, 6, 1> way_;
};
template <class R0, class P0, class R1, class P1>
straight_line(const pose<R0, P0>&, const pose<R1, P1>&) -> straight_line<double>;

}  // namespace kte
