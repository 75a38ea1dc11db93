#pragma once

#include <kte/events/detail/departure.hpp>
#include <kte/events/detail/quartic.hpp>
#include <kte/events/detail/root.hpp>
#include <kte/events/event.hpp>

namespace kte::detail {

/// Finds the first sign change of g, given at times along a step, including two sign changes between two times.
///
/// Each interval with values y_0 ... y_4 has a quartic through them. Its number of roots is at most the number of sign
/// changes of its Bernstein coefficients b_0 ... b_4, and differs from it by an even number; zero and one are therefore
/// certain. Otherwise the interval is halved, with new values of g. The error of the quartic is measured on the
/// interval of twice the length,
///
///   e = max |g - quartic through y_0, y_2, y_4, y_6, y_8|  at the values in between                     (1)
///
/// and a coefficient b_1, b_2, b_3 within e of zero has no sign. If g is smooth, halving reduces the error by a factor
/// of 32.
///
/// After a crossing, while g is within `noise` of zero, it has the sign of the side to which it goes.
template <class S>
class crossing_search {
 public:
  using values = std::array<S, 9>;

  /// side: the sign of g at the start, -1 or 1. depth: maximum number of bisections.
  crossing_search(crossing wanted, int side, const S& noise, int depth)
      : wanted_(wanted), side_(side), noise_(noise), depth_(depth) {}

  /// The first crossing in the given direction from a to b. y: g at a, a + (b - a) / 8, ..., b.
  template <class G>
  bool find(G&& g, const S& a, const S& b, const values& y) {
    using std::abs;
    for (const S& v : y) scale_ = abs(v) < scale_ ? scale_ : S(abs(v));
    return split(g, a, b, y, depth_);
  }
  /// Whether g leaves this side in the requested direction as time goes from a to b.
  bool is_wanted(bool forward) const {
    return wanted_ == crossing::both || (wanted_ == crossing::rising) == ((side_ < 0) == forward);
  }

  /// The sign of g at the end of the search: at b, or before the crossing.
  int side() const { return side_; }
  /// The time at which g has just left its side.
  const S& time() const { return time_; }
  /// This time, or where g has left zero to the other side a time at which it is there.
  const S& seen() const { return seen_; }
  /// The distance from zero that rounding may cause at this time.
  const S& next_noise() const { return next_noise_; }
  /// 0 once g has left zero.
  const S& noise() const { return noise_; }

  /// The time of value i of n.
  static S time_of(const S& a, const S& b, int i, int n) { return i == n ? b : S(a + (b - a) * S(i) / S(n)); }

 private:
  using five = std::array<S, 5>;
  enum class roots { none, one, unknown };

  template <class G>
  bool split(G& g, const S& a, const S& b, const values& y, int depth) {
    const S middle = time_of(a, b, 1, 2), e = quartic_misfit(y);  // (1)
    return search(g, a, middle, {y[0], y[1], y[2], y[3], y[4]}, e, depth) ||
           search(g, middle, b, {y[4], y[5], y[6], y[7], y[8]}, e, depth);
  }
  template <class G>
  bool search(G& g, const S& a, const S& b, const five& y, const S& e, int depth) {
    if (sign_of(y[0], noise_, 0) != 0) noise_ = S(0);  // g has left zero
    switch (count(y, e < noise_ ? noise_ : e)) {
      case roots::none:
        return false;
      case roots::one:
        return leave(g, a, b, y[0], y[4]);
      default:
        if (depth == 0 || intervals_ == 0) return walk(g, a, b, y);
        --intervals_;
        values finer;
        for (int i = 0; i < 9; ++i) finer[index(i)] = i % 2 == 0 ? y[index(i / 2)] : g(time_of(a, b, i, 8));
        return split(g, a, b, finer, depth - 1);
    }
  }
  /// Decides by the values alone.
  template <class G>
  bool walk(G& g, const S& a, const S& b, const five& y) {
    for (int i = 0; i < 4; ++i)
      if (sign_of(y[index(i + 1)], noise_, side_) != side_ &&
          leave(g, time_of(a, b, i, 4), time_of(a, b, i + 1, 4), y[index(i)], y[index(i + 1)]))
        return true;
    return false;
  }
  /// Locates the only crossing between a and b.
  template <class G>
  bool leave(G& g, const S& a, const S& b, const S& ya, const S& yb) {
    if (!is_wanted(a < b)) {
      side_ = -side_;
      return false;
    }
    const S s = S(side_);
    departure<S> from{side_, a};
    if (sign_of(ya, noise_, 0) == 0 && noise_ > S(0)) from = depart(g, a, b, noise_);  // just after a crossing
    const S fa = s * (from.time == a ? ya : g(from.time));
    const bool stays = fa > S(0) && from.side == side_;
    const auto root = stays ? find_sign_change([&](const S& t) { return S(s * g(t)); }, from.time, fa, b, S(s * yb))
                            : sign_change<S>{a, S(0), a, S(0)};
    time_ = root.after;
    seen_ = stays ? time_ : from.time;
    const S nearest = root.f_after == S(0) || root.f_before < -root.f_after ? S(-root.f_after) : root.f_before;
    next_noise_ = 8 * (nearest + std::numeric_limits<S>::epsilon() * scale_);
    return true;
  }

  /// Bounds for the number of roots of the quartic, where b_1 to b_3 within e of zero may have either sign.
  roots count(const five& y, const S& e) const {
    const auto b = inner_bernstein(y);
    bool crossed = false, doubt = false;
    int doubts = 0;
    for (int s : {sign_of(b[0], e, 0), sign_of(b[1], e, 0), sign_of(b[2], e, 0), sign_of(y[4], noise_, side_)}) {
      if (s == 0) {
        doubt = true;
        ++doubts;
      } else if (s != (crossed ? -side_ : side_)) {
        if (crossed) return roots::unknown;
        crossed = true;
        doubt = false;
      } else if (doubt) {
        return roots::unknown;
      }
    }
    return doubts == 3 ? roots::unknown : crossed ? roots::one : roots::none;
  }
  static std::size_t index(int i) { return static_cast<std::size_t>(i); }

  crossing wanted_;
  int side_;
  S noise_;
  int depth_;
  int intervals_ = 64;  ///< remaining bisections; bounds the work for a noisy g
  S time_{}, seen_{}, next_noise_{}, scale_{0};
};

}  // namespace kte::detail
