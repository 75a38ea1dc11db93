#pragma once

#include <kte/integrators/time_grid.hpp>

#include <algorithm>
#include <chrono>
#include <concepts>
#include <limits>
#include <utility>

namespace kte {

/// Reports the progress of a simulation at intervals of the wall clock. Call it in an observer, or pass it as one:
///
///   kte::progress report(0.0, 10.0, [](double fraction, double elapsed, double left) { ... });
///   solver.integrate(10.0, report);
///
/// calls back with
///
///   fraction   (t - t_start) / (t_end - t_start), within 0 and 1; time may run backward
///   elapsed    s of the wall clock since it was made
///   left       elapsed (1 - fraction) / fraction, s: the remaining time at the present speed; infinite at 0
///
/// at most once per interval, and once at the end. It does not allocate; most calls only read the clock.
template <class Callback, class Clock = std::chrono::steady_clock>
requires std::invocable<Callback&, double, double, double>
class progress {
 public:
  /// Throws `bad_argument` for times that are not finite, or a negative interval.
  progress(double t_start, double t_end, Callback callback,
           std::chrono::duration<double> interval = std::chrono::milliseconds(500))
      : start_(t_start), end_(t_end), interval_(interval), callback_(std::move(callback)) {
    detail::check_finite(t_start, "start time");
    detail::check_finite(t_end, "end time");
    if (!(interval.count() >= 0))
      detail::raise<bad_argument>("kte: interval of progress must not be negative, got " +
                                  detail::number(interval.count()));
  }

  /// To be called at time t, s, of the simulation; further arguments of an observer are ignored.
  template <class T, class... More>
  void operator()(const T& t, const More&...) {
    if (done_) return;
    const auto now = Clock::now();
    const double fraction = fraction_at(static_cast<double>(t));
    done_ = fraction == 1;
    if (!done_ && now - last_ < interval_) return;
    last_ = now;
    const double elapsed = std::chrono::duration<double>(now - began_).count();
    const double left = fraction > 0 ? elapsed * (1 - fraction) / fraction : std::numeric_limits<double>::infinity();
    callback_(fraction, elapsed, left);
  }

 private:
  double fraction_at(double t) const {
    if (start_ == end_) return 1;
    const double f = (t - start_) / (end_ - start_);
    return f > 0 ? (std::min)(f, 1.0) : 0;  // also 0 for NaN
  }

  double start_, end_;
  std::chrono::duration<double> interval_;
  Callback callback_;
  typename Clock::time_point began_ = Clock::now(), last_ = began_;
  bool done_ = false;
};

}  // namespace kte
