#pragma once

#include <kte/robots/detail/mjcf_settings.hpp>
#include <kte/robots/detail/physical.hpp>

#include <Eigen/Eigenvalues>

namespace kte::detail {

/// Reads the <inertial> of a body, in the axes of the body.
inline rigid_body<> read_mjcf_inertial(const mjcf_settings& settings, const xml_item& written) {
  const auto x = settings.classes().cleaned(written);
  x.only({}, {"pos", "quat", "axisangle", "euler", "xyaxes", "zaxis", "mass", "diaginertia", "fullinertia"});
  rigid_body<> b{x.not_negative("mass"), {}, {}};
  if (x.has("fullinertia")) {
    const auto f = x.list("fullinertia");
    if (f.size() != 6) x.fail("fullinertia must have six numbers, got " + std::to_string(f.size()));
    b.inertia = {f[0], f[3], f[4], f[1], f[5], f[2]};  // from xx yy zz xy xz yz
  } else if (x.has("diaginertia")) {
    const auto i = x.vector("diaginertia");
    b.inertia = {i.x, 0, 0, i.y, 0, i.z};
  } else if (b.mass > 0) {
    x.warn("it has no diaginertia: its mass is that of a point");
  }
  return moved_body(settings.place(x), b);
}

/// The inertia with principal moments raised to at least `least`.
inline sym3<> with_least_moment(const sym3<>& i, double least) {
  Eigen::Matrix3d m;
  m << i.xx, i.xy, i.xz, i.xy, i.yy, i.yz, i.xz, i.yz, i.zz;
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> principal(m);
  if (principal.eigenvalues()[0] >= least) return i;
  const Eigen::Vector3d moments = principal.eigenvalues().cwiseMax(least);
  const Eigen::Matrix3d k = principal.eigenvectors() * moments.asDiagonal() * principal.eigenvectors().transpose();
  return {k(0, 0), k(0, 1), k(0, 2), k(1, 1), k(1, 2), k(2, 2)};
}

/// Applies the rules of the compiler to the bodies of these links, in this order: masses and principal moments are
/// raised to their minima (boundmass, boundinertia), unphysical moments become their mean (balanceinertia), and all are
/// scaled to the total mass (settotalmass).
inline void apply_mass_rules(const mjcf_mass_rules& rules, robot_description& d,
                             const std::vector<std::size_t>& bodies) {
  auto& links = d.links;
  if (rules.fuse && rules.any())
    d.warnings.push_back(
        {0,
         "<compiler>: fusestatic changes what settotalmass, boundmass and boundinertia count: it is not read",
         {},
         true});
  double total = 0;
  for (const auto index : bodies) {
    auto& l = links[index];
    if (!l.inertial && (rules.least_mass > 0 || rules.least_moment > 0)) {
      l.inertial.emplace();
      d.warnings.push_back({l.line, "body '" + l.name + "': it has no mass, and the least one at its origin", l.file});
    }
    if (!l.inertial) continue;
    auto& b = *l.inertial;
    b.mass = (std::max)(b.mass, rules.least_mass);
    if (rules.least_moment > 0) b.inertia = with_least_moment(b.inertia, rules.least_moment);
    if (rules.balance && !unphysical(b).empty()) {
      const double mean = (b.inertia.xx + b.inertia.yy + b.inertia.zz) / 3;
      b.inertia = {mean, 0, 0, mean, 0, mean};
    }
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
