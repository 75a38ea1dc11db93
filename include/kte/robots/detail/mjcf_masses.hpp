#pragma once

#include <kte/robots/detail/mjcf_settings.hpp>
#include <kte/robots/detail/physical.hpp>

#include <Eigen/Eigenvalues>

namespace kte::detail {

/// An inertia whose principal moments are at least so large.
inline sym3<> with_least_moment(const sym3<>& i, double least) {
  Eigen::Matrix3d m;
  m << i.xx, i.xy, i.xz, i.xy, i.yy, i.yz, i.xz, i.yz, i.zz;
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> principal(m);
  if (principal.eigenvalues()[0] >= least) return i;
  const Eigen::Vector3d moments = principal.eigenvalues().cwiseMax(least);
  const Eigen::Matrix3d k = principal.eigenvectors() * moments.asDiagonal() * principal.eigenvectors().transpose();
  return {k(0, 0), k(0, 1), k(0, 2), k(1, 1), k(1, 2), k(2, 2)};
}

/// What the compiler's rules make of the bodies of these links: moments that no matter has become their
/// mean (balanceinertia), masses and principal moments are at least so large (boundmass, boundinertia), and all are
/// multiplied so that masses add up (settotalmass).
inline void apply_mass_rules(const mjcf_mass_rules& rules, std::vector<robot_link>& links,
                             const std::vector<std::size_t>& bodies) {
  double total = 0;
  for (const auto index : bodies) {
    auto& l = links[index];
    if (!l.inertial && (rules.least_mass > 0 || rules.least_moment > 0)) l.inertial.emplace();
    if (!l.inertial) continue;
    auto& b = *l.inertial;
    if (rules.balance && !unphysical(b).empty()) {
      const double mean = (b.inertia.xx + b.inertia.yy + b.inertia.zz) / 3;
      b.inertia = {mean, 0, 0, mean, 0, mean};
    }
    b.mass = std::max(b.mass, rules.least_mass);
    if (rules.least_moment > 0) b.inertia = with_least_moment(b.inertia, rules.least_moment);
    total += b.mass;
  }
  if (!(rules.total > 0) || !(total > 0)) return;
  const double k = rules.total / total;
  for (const auto index : bodies) {
    if (!links[index].inertial) continue;
    auto& b = *links[index].inertial;
    const auto& i = b.inertia;
    b.mass *= k, b.inertia = {k * i.xx, k * i.xy, k * i.xz, k * i.yy, k * i.yz, k * i.zz};
  }
}

}  // namespace kte::detail
