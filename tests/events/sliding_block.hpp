#pragma once

#include <kte/events/events.hpp>

#include <cmath>
#include <limits>
#include <stdexcept>

/// One right-hand side for the tests of every solver, so that each solver is compiled once.
namespace kte::test {

inline constexpr double no_number = std::numeric_limits<double>::quiet_NaN();
inline constexpr double half_swing = 3.14159265358979323846 / 10;

/// A block of 1 kg on a spring of 100 N/m, with dry friction of 2 N, released at 1.03 m: it turns every pi / 10 s, each
/// time 0.04 m nearer. Things may be wrong from a time on.
struct block {
  enum trouble { none, not_a_number, refusal, singular, bad_reset, bad_event, shaken };
  trouble now = none;
  double from = 0.5;
  int direction = -1;
  bool by_sign =
      false;  ///< the direction is that of the speed: f jumps where it starts; differences for a Jacobian do too
};
using state = Eigen::Vector2d;
inline const state released(1.03, 0);
struct slides {
  const block* b;
  state operator()(double t, const state& x) const {
    if (t > b->from && b->now == block::not_a_number) return {no_number, no_number};
    if (t > b->from && b->now == block::refusal) throw bad_argument("kte: quaternion 'body' has length 0");
    if (t > b->from && b->now == block::singular) throw singular_mass_matrix("kte: coordinate 'q2' moves no mass");
    if (b->now == block::shaken) return {x[1], -100 * x[0] + 5 * std::sin(50 * t)};
    const int direction = !b->by_sign ? b->direction : x[1] > 0 ? 1 : x[1] < 0 ? -1 : 0;
    return {x[1], -100 * x[0] - 2 * direction};
  }
};
/// Shaken by a force, without friction, from t0 on.
inline state shaking(double t0, double t) {
  const double far = -1.0 / 480, a = 1.03 - far * std::sin(50 * t0), b = -5 * far * std::cos(50 * t0);
  const double c = std::cos(10 * (t - t0)), s = std::sin(10 * (t - t0));
  return {a * c + b * s + far * std::sin(50 * t), -10 * a * s + 10 * b * c + 50 * far * std::cos(50 * t)};
}
/// Until the first turn.
inline state sliding(double t) { return {0.02 + 1.01 * std::cos(10 * t), -10.1 * std::sin(10 * t)}; }

}  // namespace kte::test
