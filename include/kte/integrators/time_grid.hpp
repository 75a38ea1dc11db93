#pragma once

#include <kte/errors.hpp>
#include <kte/integrators/detail/packet_sum.hpp>
#include <kte/math/plain_scalar.hpp>
#include <kte/math/select.hpp>

#include <Eigen/Core>

#include <cmath>
#include <limits>
#include <string>

namespace kte {

/// Evenly spaced times at which an observer is called: `solver.integrate(10, every(0.001), observer)`.
template <class S>
struct every {
  S spacing;                ///< s; positive, also for integration backward in time
  bool event_rows = false;  ///< whether the observer is also called before and after events

  constexpr explicit every(const S& s) : spacing(s) {}
  /// Also calls the observer with the states before and after each event that acts, both at its time.
  [[nodiscard]] constexpr every with_event_rows() const {
    every all = *this;
    all.event_rows = true;
    return all;
  }
};

namespace detail {

/// Whether x is neither infinite nor NaN, for any scalar; for a pack, in all lanes.
template <class S>
constexpr bool is_finite(const S& x) {
  return all(x - x == S(0));
}

/// Whether all numbers of a vector or matrix are finite.
template <class M>
bool all_finite(const Eigen::MatrixBase<M>& x) {
  using S = typename M::Scalar;
  S sum(0);
  for (Eigen::Index j = 0; j < x.cols(); ++j) sum += sum_by_packets(x.col(j) * S(0));
  return all(sum == S(0));
}

/// Checks a time or a setting that must be finite, or finite and positive. Throws `bad_argument` with its name and
/// value.
template <class S>
void check_finite(const S& x, const char* name) {
  if (!is_finite(x)) [[unlikely]]
    raise<bad_argument>(std::string("kte: ") + name + " must be finite, got " + number(as_double(x)));
}
template <class S>
void check_positive(const S& x, const char* name) {
  if (!(x > S(0) && is_finite(x))) [[unlikely]]
    raise<bad_argument>(std::string("kte: ") + name + " must be finite and positive, got " + number(as_double(x)));
}
template <class S>
void check_not_negative(const S& x, const char* name) {
  if (!(x >= S(0) && is_finite(x))) [[unlikely]]
    raise<bad_argument>(std::string("kte: ") + name + " must be finite and not negative, got " + number(as_double(x)));
}

}  // namespace detail

/// The times from a start to an end, a spacing h apart, in either direction:
///
///   t_i = start + i h  for i < n,   t_n = end              (1)
///   n = ceil(|end - start| / h - slack / h)                (2)
///   slack = 4 eps max(|start|, |end|)                      (3)
///
/// Times are multiples of h, not sums, so that rounding errors do not accumulate. The last interval is shorter if h
/// does not divide the whole. A remainder below the slack is added to the previous interval by (2).
template <class S>
class time_grid {
 public:
  time_grid() = default;
  /// Throws `bad_argument` for a spacing that is not positive, or too small for times of this size.
  time_grid(const S& t_start, const S& t_end, const S& spacing, const char* name) : start_(t_start), end_(t_end) {
    using std::abs;
    using std::ceil;
    detail::check_positive(spacing, name);
    if (t_end == t_start) return;
    step_ = t_end < t_start ? S(-spacing) : spacing;
    const S slack =
        4 * std::numeric_limits<S>::epsilon() * (abs(t_start) < abs(t_end) ? abs(t_end) : abs(t_start));  // (3)
    const auto count = ceil(detail::value_part(S((abs(S(t_end - t_start)) - slack) / spacing)));          // (2)
    if (spacing <= slack || !(count < 1e15)) [[unlikely]]
      detail::raise<bad_argument>(std::string("kte: ") + name + " " + detail::number(detail::as_double(spacing)) +
                                  " is too small to go from " + detail::number(detail::as_double(t_start)) + " to " +
                                  detail::number(detail::as_double(t_end)));
    intervals_ = count < 1 ? 1 : static_cast<long long>(count);
  }

  /// n of (2); 0 if start and end are equal.
  long long intervals() const { return intervals_; }
  /// t_i of (1).
  S operator[](long long i) const { return i < intervals_ ? S(start_ + S(i) * step_) : end_; }

 private:
  S start_{}, end_{}, step_{};
  long long intervals_ = 0;
};

}  // namespace kte
