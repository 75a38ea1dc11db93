#pragma once

#include <kte/errors.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

namespace kte {

/// A point of a profile along a path: s in [0, 1], and its derivatives s_dot, 1/s, and s_ddot, 1/s^2.
template <class S>
struct path_point {
  S s, s_dot, s_ddot;
};

/// Limits along a path of length 1: `rate`, `acceleration` and `jerk`; infinite (`none`) where there is no limit.
template <class S>
struct path_limits {
  static constexpr S none = std::numeric_limits<S>::infinity();
  S rate = none, acceleration = none, jerk = none;
};

namespace detail {
/// Throws `bad_argument` for limits that are NaN, negative or 0.
template <class S>
void check_path_limits(const path_limits<S>& limits) {
  const auto check = [](const S& x, const char* which) {
    if (!(x > S(0)))
      raise<bad_argument>(std::string("kte: the limit of ") + which + " along a path must be above 0, got " +
                          number(static_cast<double>(x)));
  };
  check(limits.rate, "rate"), check(limits.acceleration, "acceleration"), check(limits.jerk, "jerk");
}
/// Throws `bad_argument` for a time that is NaN.
template <class S>
const S& checked_time(const S& t) {
  if (!(t == t)) raise<bad_argument>("kte: the time along a path is NaN");
  return t;
}
}  // namespace detail

/// The fastest profile from rest to rest within a rate u and an acceleration a: a trapezoid of rates, or a triangle.
///
///   t_a = min(u/a, sqrt(1/a)),   T = t_a + 1/(a t_a)                                             (1)
///   s = a t^2/2,  a t_a (t - t_a/2),  1 - a (T - t)^2/2
///
/// At rest before the start and after the end. Throws `bad_argument` for limits that are not positive, without a limit
/// of acceleration, for a duration that is not finite, and for a time that is NaN.
template <class S = double>
class trapezoidal_profile {
 public:
  explicit trapezoidal_profile(const path_limits<S>& limits) : a_(limits.acceleration) {
    using std::sqrt;
    const S most = std::numeric_limits<S>::infinity();
    detail::check_path_limits(limits);
    if (a_ == most) detail::raise<bad_argument>("kte: a trapezoidal motion needs limits of acceleration");
    ramp_ = (std::min)(S(limits.rate / a_), S(sqrt(S(1) / a_)));
    duration_ = ramp_ + S(1) / (a_ * ramp_);  // (1)
    if (!(duration_ < most))
      detail::raise<bad_argument>("kte: a trapezoidal motion takes infinitely long: a limit is too small");
  }
  [[nodiscard]] S duration() const { return duration_; }
  path_point<S> operator()(const S& time) const {
    const S t = (std::min)((std::max)(detail::checked_time(time), S(0)), duration_), left = duration_ - t;
    if (t < ramp_) return {a_ * t * t / S(2), a_ * t, a_};
    if (left < ramp_) return {S(1) - a_ * left * left / S(2), a_ * left, left > S(0) ? S(-a_) : S(0)};
    return {a_ * ramp_ * (t - ramp_ / S(2)), a_ * ramp_, S(0)};
  }

 private:
  S a_, ramp_, duration_;
};

/// A profile from rest to rest with continuous acceleration, x = t/T:
///
///   s = 10 x^3 - 15 x^4 + 6 x^5,   max s' = 15/8/T,  max s'' = 10/sqrt(3)/T^2,  max s''' = 60/T^3      (2)
///
/// in the shortest time within limits, or longer; at rest before and after. Throws `bad_argument` for limits that are
/// not positive, without a duration, and for a time that is NaN.
template <class S = double>
class quintic_profile {
 public:
  explicit quintic_profile(const path_limits<S>& limits, const S& at_least = S(0)) {
    using std::cbrt;
    using std::sqrt;
    detail::check_path_limits(limits);
    if (!(at_least >= S(0)))
      detail::raise<bad_argument>("kte: the least duration of a quintic motion must not be negative, got " +
                                  detail::number(static_cast<double>(at_least)));
    const S shortest = (std::max)({S(S(1.875) / limits.rate), S(sqrt(S(10) / sqrt(S(3)) / limits.acceleration)),
                                   S(cbrt(S(60) / limits.jerk))});  // (2)
    duration_ = (std::max)(shortest, at_least);
    if (!(duration_ > S(0)) || !(duration_ < std::numeric_limits<S>::infinity()))
      detail::raise<bad_argument>("kte: a quintic motion needs a duration, or limits that give a finite one");
  }
  [[nodiscard]] S duration() const { return duration_; }
  path_point<S> operator()(const S& time) const {
    const S T = duration_, x = (std::min)((std::max)(S(detail::checked_time(time) / T), S(0)), S(1)), y = S(1) - x;
    return {x * x * x * (S(10) - x * (S(15) - S(6) * x)), S(30) * x * x * y * y / T, S(60) * x * y * (y - x) / (T * T)};
  }

 private:
  S duration_;
};

}  // namespace kte
