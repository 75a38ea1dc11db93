#pragma once

#include <kte/contract/transmission.hpp>
#include <kte/math/select.hpp>

namespace kte {

/// The mode of an element that may lock a coordinate: a number, part of the state of models, that only events change.
namespace mode {
inline constexpr int sliding = 0;    ///< the initial mode; the rate gives the direction
inline constexpr int forward = 1;    ///< slides at positive rate
inline constexpr int backward = -1;  ///< slides at negative rate
inline constexpr int held = 2;       ///< locked, v' = 0
}  // namespace mode

/// An element that may lock a coordinate: dry friction, a brake, a lock. A core that derives from it has the coordinate
/// at its first port and its mode, an internal state, at its second, and has
///
///   doForce(c, mode, ...)    the force while the coordinate slides, zero while it is locked          (1)
///   capacity(c, mode, ...)   the largest holding force, N or Nm                                      (2)
///
/// Forward dynamics gives a locked coordinate no acceleration, like hybrid dynamics. In models, events switch the mode
/// (`element_events`). When the rate of a sliding coordinate passes through zero, it is locked, unless the holding
/// force would exceed (2). When the holding force exceeds (2), it slides.
struct coordinate_lock {
  /// Declares to the algorithms that the element may lock a coordinate.
  static constexpr bool locks_coordinate = true;

  /// Whether a mode is that of a locked coordinate.
  template <class C, class Z, class... Others>
  KTE_INLINE static constexpr bool holds(const C&, const Z& mode, const Others&...) {
    return all(as<number<Z>>(mode) == number<Z>(mode::held));
  }
  /// The rate of the mode: zero, because only events change it.
  template <class... Things>
  KTE_INLINE static constexpr auto z_dot(const Things&...) {
    return zero;
  }

 protected:
  /// The scalar of arithmetic with the arguments; some may be typed constants.
  template <class... X>
  using number = std::remove_cvref_t<decltype((detail::as_number(std::declval<X>()) + ...))>;
  /// The direction of sliding, 1 or -1; for the initial mode that of the rate. Defined for invalid modes too.
  template <class S>
  KTE_INLINE static constexpr S direction(const S& mode, const S& rate) {
    const S by_rate = select(rate > S(0), S(1), S(select(rate < S(0), S(-1), S(0))));
    const S by_mode = select(mode < S(0), S(-1), S(select(mode == S(mode::sliding), by_rate, mode)));  // NaN stays NaN
    return select(mode > S(0), S(1), by_mode);
  }
  template <class S>
  KTE_INLINE static constexpr S unless_held(const S& mode, const S& force) {
    return select(mode == S(mode::held), S(0), force);
  }
};

}  // namespace kte
