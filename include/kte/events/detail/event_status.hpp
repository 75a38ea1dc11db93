#pragma once

#include <kte/events/detail/crossing_search.hpp>

namespace kte::detail {

/// The status of an event. A side is the sign of g, -1 or 1, or 0 if only the motion determines it.
template <class S>
struct event_status {
  S value{};     ///< g at the start of the step
  S noise{0};    ///< |g| up to this may be rounding, since the last crossing until g has left zero
  int side = 0;  ///< at the start of the step
  int from = 0;  ///< after a reset of a one-sided event: the side to which it must return; 0: none
  S last_reset{};
  bool has_reset = false, rested = false;
  int repeats = 0;  ///< resets in a row that time does not resolve

  int reached = 0;       ///< side at which the search has ended: at the end of the step, or before the crossing found
  S noise_there{0};      ///< `noise` at that time
  bool shared = false;   ///< whether its values are computed together with those of other events
  bool stuck = false;    ///< whether a reset did not send g back
  bool found = false;    ///< whether a crossing was found
  bool happens = false;  ///< whether it is the next crossing
  S time{}, next_noise{};
  S seen{};  ///< `time`, or for a crossing at the start of the step a time at which g is beyond zero

  /// At the end of a step, where g is y.
  void renew(const S& y) {
    value = y;
    side = sign_of(y, noise_there, reached);
    noise = sign_of(y, noise_there, 0) != 0 ? S(0) : noise_there;
    if (side != 0) from = 0;
  }
  /// At the end of a step that another event has ended.
  void renew_elsewhere(const S& y) {
    noise_there = noise;
    if (noise == S(0)) reached = 0;  // the state may have jumped
    renew(y);
  }
  /// After an event at this time, which may be another one: |y| up to `rounding`, if it is known, may be a zero. A
  /// reset may have replaced g by a function of another unit, so its noise before says nothing.
  void allow_rounding(const S& rounding, const S& y) {
    using std::abs;
    if (!(rounding > S(0))) return;
    if (happens)
      next_noise = rounding;
    else if (noise < rounding && abs(y) <= rounding)
      noise = rounding;
  }
  /// At its crossing, which has ended the step; g is y.
  void renew_at_crossing(const S& y) {
    noise = next_noise;
    value = y;
    side = sign_of(y, noise, 0);
  }
  /// At rest: g counts as zero.
  void renew_at_rest(const S& y) {
    using std::abs;
    next_noise = next_noise < 2 * abs(y) ? S(2 * abs(y)) : next_noise;
    renew_at_crossing(y);
  }
};

}  // namespace kte::detail
