#pragma once

#include <kte/events/events.hpp>

#include <Eigen/Core>

#include <cmath>

/// A ball that bounces, whose solution has a closed form.
namespace kte::test::bouncing {

using ball_state = Eigen::Vector2d;

/// A ball falls from 5 m at 10 m/s^2: it hits the ground at 1 s with 10 m/s. With restitution e flights last 2 e,
/// 2 e^2, ...
inline const ball_state dropped(5, 0);
inline constexpr auto fall = [](double, const ball_state& x) { return ball_state(x[1], -10); };
inline constexpr auto height = [](const auto&, const auto& x) { return x[0]; };
inline constexpr auto speed = [](const auto&, const auto& x) { return x[1]; };
inline auto bounce(double e) {
  return [e](double, ball_state& x) { x = {0, -e * x[1]}; };
}
inline auto ground(double e) { return event(height, crossing::falling).reset(bounce(e)); }
/// The time of impact n, from 0.
inline double impact(double e, int n) { return 1 + 2 * e * (1 - std::pow(e, n)) / (1 - e); }
inline double height_at(double e, double t) {
  if (t <= 1) return 5 - 5 * t * t;
  int n = 0;
  while (n < 200 && impact(e, n + 1) <= t) ++n;
  const double s = t - impact(e, n);
  return 10 * std::pow(e, n + 1) * s - 5 * s * s;
}

}  // namespace kte::test::bouncing
