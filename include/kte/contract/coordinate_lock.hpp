#pragma once

#include <kte/contract/transmission.hpp>
#include <kte/math/select.hpp>

namespace kte {

/// What an element that may hold a coordinate keeps: a number, part of the state of models, that only events change.
namespace mode {
inline constexpr int sliding = 0;  ///< which way, says the rate: at the start
inline constexpr int forward = 1;  ///< slides on
inline constexpr int backward = -1;
inline constexpr int held = 2;  ///< rests, v' = 0
}  // namespace mode

/// An element that may hold a coordinate: dry friction, a brake, a lock. A core that derives from it has the coordinate
/// at its first port and its mode, an internal state, at its second, and gives
///
///   doForce(c, mode, ...)    the force while it slides, none while it holds                          (1)
///   capacity(c, mode, ...)   the largest force, N or Nm, by which it holds                            (2)
///
/// Forward dynamics then gives a held coordinate no acceleration, as hybrid dynamics does. In models events switch the
/// mode (`element_events`): where the rate of sliding goes through zero, the coordinate is held, unless that takes more
/// than (2); where holding takes more, it slides.
struct coordinate_lock {
  static constexpr bool locks_coordinate = true;

  template <class C, class Z, class... Others>
  KTE_INLINE static constexpr bool holds(const C&, const Z& mode, const Others&...) {
    return all(as<number<Z>>(mode) == number<Z>(mode::held));
  }
  template <class... Things>
  KTE_INLINE static constexpr auto z_dot(const Things&...) {
    return zero;
  }

 protected:
  /// In which to compute with things, of which some may be typed constants.
  template <class... X>
  using number = std::remove_cvref_t<decltype((detail::as_number(std::declval<X>()) + ...))>;
  /// 1 or -1, also of a mode that is none; at the start that of the rate.
  template <class S>
  KTE_INLINE static constexpr S direction(const S& mode, const S& rate) {
    const S by_rate = select(rate > S(0), S(1), S(select(rate < S(0), S(-1), S(0))));
    const S by_mode = select(mode < S(0), S(-1), S(select(mode == S(mode::sliding), by_rate, mode)));  // a NaN stays
    return select(mode > S(0), S(1), by_mode);
  }
  template <class S>
  KTE_INLINE static constexpr S unless_held(const S& mode, const S& force) {
    return select(mode == S(mode::held), S(0), force);
  }
};

}  // namespace kte
