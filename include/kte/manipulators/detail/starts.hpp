#pragma once

#include <kte/dynamics/configuration_space.hpp>
#include <kte/manipulators/detail/goal_sums.hpp>

#include <cstdint>
#include <numbers>

namespace kte::detail {

/// Uniform random numbers in [0, 1), equal on all machines (splitmix64: Steele, Lea, Flood, OOPSLA 2014).
class even_numbers {
 public:
  explicit even_numbers(std::uint64_t seed) : state_(seed) {}
  double operator()() {
    std::uint64_t z = state_ += 0x9e3779b97f4a7c15u;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return static_cast<double>((z ^ (z >> 31)) >> 11) * 0x1p-53;
  }

 private:
  std::uint64_t state_;
};

template <class Arm, class X>
void clamp_to_limits(const Arm& arm, X& q) {
  const auto& limits = arm.limits();
  using S = typename X::Scalar;
  for_each_freedom_of(arm, [&](const freedom& f) {
    if (f.what != kind::gen) return;
    const auto i = static_cast<std::size_t>(f.v);
    q[f.q] = (std::min)((std::max)(S(q[f.q]), S(limits.lower[i])), S(limits.upper[i]));
  });
}

/// A random configuration within limits. Coordinates without limits are within half a turn, or pi metres, of `from`;
/// poses within half a turn and `away` metres.
template <class Arm, class X>
X somewhere(const Arm& arm, const X& from, double away, even_numbers& random) {
  using S = typename X::Scalar;
  const auto& limits = arm.limits();
  joint_vector<S, arm_dofs<Arm>> v = joint_vector<S, arm_dofs<Arm>>::Zero(static_cast<Eigen::Index>(dofs_of(arm)));
  X q = from;
  for_each_freedom_of(arm, [&](const freedom& f) {
    const auto i = static_cast<std::size_t>(f.v);
    if (f.what != kind::gen) {
      for (int k = 0; k < nv_of(f.what); ++k) {
        const bool turn = f.what == kind::rotation_3D || k >= nv_of(f.what) / 2 + (f.what == kind::pose_2D ? 1 : 0);
        v[f.v + k] = S((2 * random() - 1) * (turn ? std::numbers::pi : away));
      }
    } else {
      const double at = static_cast<double>(from[f.q]), half = std::numbers::pi;
      const bool finite = limits.upper[i] - limits.lower[i] < std::numeric_limits<double>::infinity();
      const double low = finite ? limits.lower[i] : (std::max)(limits.lower[i], at - half);
      const double high = finite ? limits.upper[i] : (std::min)(limits.upper[i], at + half);
      q[f.q] = S(low + random() * (high - low));
    }
  });
  q = integrate(arm, q, v, S(1));
  clamp_to_limits(arm, q);
  return q;
}

/// The size of a manipulator, m: the largest distance of a tool from the axes that rotate it, over some configurations;
/// 1 if nothing rotates.
template <class S, class Arm, class X>
S reach_of(const Arm& arm, const X& q) {
  even_numbers random(1);
  S most(0);
  for (int i = 0; i < 4; ++i) {
    const auto j = arm.getJacobianMatrix(somewhere(arm, q, 0, random));
    for (Eigen::Index k = 0; k < j.cols(); ++k)
      for (Eigen::Index r = 0; r < j.rows(); r += 6) {
        S vv(0), ww(0);
        for (Eigen::Index a = r; a < r + 3; ++a) vv += j(a, k) * j(a, k), ww += j(a + 3, k) * j(a + 3, k);
        if (ww > S(0.01)) most = (std::max)(most, S(vv / ww));
      }
  }
  using std::sqrt;
  return most > S(0) ? S(sqrt(most)) : S(1);
}

}  // namespace kte::detail
