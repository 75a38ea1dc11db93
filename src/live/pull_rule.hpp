#pragma once

#include <kte/view/page_pull.hpp>
#include <kte/view/scene.hpp>

#include <optional>

namespace kte::live {

/// What pages may pull, and how: the point and the target are finite and not far away, and the stiffness is that by
/// which the mass m of the mechanism would swing at w = 9 rad/s, as where a page simulates:
///
///   k = m w^2,  c = 2 d m w,  d = 0.4          (1)
class pull_rule {
 public:
  explicit pull_rule(const scene& s) : reach_(1000 * s.size) {
    for (const auto& b : s.bodies) mass_ += b.mass > 0 ? b.mass : 0;
    if (!(mass_ > 0)) mass_ = 1;
    names_.resize(s.frames.size());
    for (const int i : s.pulls) names_[static_cast<std::size_t>(i)] = s.frames[static_cast<std::size_t>(i)].name;
  }
  /// Of number `frame` of the scene; none if this frame cannot be pulled, or the points are too far away.
  std::optional<page_pull> pull(std::size_t frame, const vec3<>& point, const vec3<>& target) const {
    if (frame >= names_.size() || names_[frame].empty()) return std::nullopt;
    for (const double x : {point.x, point.y, point.z, target.x, target.y, target.z})
      if (!(x >= -reach_ && x <= reach_)) return std::nullopt;
    constexpr double w = 9, d = 0.4;
    return page_pull{names_[frame], point, target, mass_ * w * w, 2 * d * mass_ * w};  // (1)
  }

 private:
  std::vector<std::string> names_;  ///< of all frames; empty: not to be pulled
  double mass_ = 0, reach_;         ///< kg, m
};

}  // namespace kte::live
