#pragma once

#include <kte/errors.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

namespace kte {

namespace detail {
/// Throws `bad_argument` unless `good`.
template <class S>
void check_bound(bool good, const char* what, const S& x) {
  if (!good) [[unlikely]]
    raise<bad_argument>(std::string("kte: bounds of a rate: ") + what + ", got " + number(static_cast<double>(x)));
}
template <class S>
void check_braking(const S& a, const S& dt) {
  check_bound(a >= S(0), "the acceleration must not be negative", a);
  check_bound(dt > S(0) && dt < std::numeric_limits<S>::infinity(), "the time of a step must be finite and above 0",
              dt);
}
}  // namespace detail

/// The largest rate from which a coordinate stops within the distance d, moving in steps q += v dt, where each step may
/// reduce v by a dt. Exact in discrete time, where sqrt(2 a d) is too large by up to a dt.
///
///   B(d) = a dt (x + n (n + 1)/2)/(n + 1),   x = d/(a dt^2),   n = floor((sqrt(1 + 8 x) - 1)/2)           (1)
///
/// n further steps follow the first: v dt + (v - a dt) dt + ... + (v - n a dt) dt = d. An infinite a gives d/dt, a = 0
/// gives 0. Throws `bad_argument` unless d >= 0, dt > 0, a >= 0.
template <class S>
[[nodiscard]] S stopping_rate(const S& d, const S& a, const S& dt) {
  using std::floor;
  using std::sqrt;
  detail::check_bound(d >= S(0), "a distance must not be negative", d), detail::check_braking(a, dt);
  const S most = std::numeric_limits<S>::infinity(), x = d / (a * dt * dt);
  if (a == most || !(x > S(0))) return d / dt;
  if (x == most) return sqrt(S(2) * a * d);
  const S n = floor((sqrt(S(1) + S(8) * x) - S(1)) / S(2));
  return a * dt * ((x + n * (n + S(1)) / S(2)) / (n + S(1)));
}

/// The allowed rates of a coordinate in the next step: from `lower` to `upper`.
template <class S>
struct rate_interval {
  S lower, upper;
  bool recovering;  ///< outside the limits, or too fast to keep them: brakes or returns with the largest acceleration
};

/// The bounds for a step q += v dt of a coordinate at q whose previous rate is v_now:
///
///   |v| <= rate,   |v - v_now| <= a dt,   -B(q - lower) <= v <= B(upper - q)                               (2)
///
/// Never empty: if one step satisfies (2), the next can. If (2) was violated before, the bounds contain only the
/// hardest braking; outside [lower, upper] only the fastest return that stops at the limit. Limits hold to rounding; q
/// + v dt stays within [lower, upper] exactly. Throws `bad_argument` unless q and v_now are finite, lower <= upper,
/// rate and a are not negative, and dt is finite and positive.
template <class S>
[[nodiscard]] rate_interval<S> rate_bounds(const S& q, const S& v_now, const S& lower, const S& upper, const S& rate,
                                           const S& a, const S& dt) {
  const S eps = std::numeric_limits<S>::epsilon();
  detail::check_bound(q - q == S(0), "the coordinate must be finite", q);
  detail::check_bound(v_now - v_now == S(0), "the rate before must be finite", v_now);
  detail::check_bound(lower <= upper, "lower must not be above upper", lower);
  detail::check_bound(rate >= S(0), "the limit of the rate must not be negative", rate);
  detail::check_braking(a, dt);
  // The largest rate towards a limit at distance d; beyond the limit, the rate back.
  const auto towards = [&](const S& border, const S& d) {
    if (d == std::numeric_limits<S>::infinity()) return rate;
    const S lost = S(4) * eps * (std::max)(std::abs(q), std::abs(border));  // in q + v dt
    if (d >= -lost) return (std::min)(rate, stopping_rate((std::max)(S(d - lost), S(0)), a, dt));
    return -(std::min)(rate, stopping_rate(S(-d), a, dt));
  };
  S up = towards(upper, S(upper - q)), down = -towards(lower, S(q - lower));
  const S hardest_down = v_now - a * dt, hardest_up = v_now + a * dt;
  S lost(0);  // rounding of rates, and of q
  if (a < std::numeric_limits<S>::infinity()) lost = S(64) * eps * (std::abs(v_now) + a * dt + std::abs(q) / dt);
  const bool too_fast_up = up<hardest_down - lost, too_fast_down = down> hardest_up + lost;
  const bool beyond = up < S(0) || down > S(0) || too_fast_up || too_fast_down;
  if (too_fast_up) up = hardest_down;
  if (too_fast_down) down = hardest_up;
  return {(std::min)((std::max)(hardest_down, down), up), (std::max)((std::min)(hardest_up, up), down), beyond};
}

}  // namespace kte
