#pragma once

#include <kte/events/events.hpp>
#include <kte/integrators/dormand_prince45.hpp>
#include <kte/integrators/runge_kutta4.hpp>

#include <algorithm>
#include <limits>
#include <random>

#include "catch.hpp"

/// An oscillator and a clock, whose events are known.
namespace kte::test::oscillating {

using scalar = Eigen::Matrix<double, 1, 1>;
inline constexpr double pi = 3.14159265358979323846, eps = std::numeric_limits<double>::epsilon();
inline constexpr auto oscillator = [](double, const Eigen::Vector2d& x) { return Eigen::Vector2d(x[1], -x[0]); };
inline constexpr auto clock = [](double, const scalar&) { return scalar(1.0); };
inline constexpr auto position = [](const auto&, const auto& x) { return x[0]; };

/// Steps of 1 s, events that depend on time alone: their times show how they are looked for.
inline auto in_long_steps(double t0 = 0) { return runge_kutta4(clock, t0, scalar(t0), 1.0); }
template <class G>
auto events_of(const G& g, double t_end, const event_settings& settings = {}) {
  auto solver = in_long_steps();
  return integrate(solver, t_end, events(event([g](double t, const scalar&) { return g(t); })).with(settings)).events;
}
/// A few ulp, for a g whose rounding is that of t.
inline bool is_at(double t, double exact) { return std::abs(t - exact) <= 8 * eps * std::abs(exact); }

}  // namespace kte::test::oscillating
