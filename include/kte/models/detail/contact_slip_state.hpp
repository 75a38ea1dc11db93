#pragma once

#include <cstddef>

/// What the decision at an event makes of the slip of a contact, and what a check of its forces makes of that:
///
///   state \ finding   stops      exceeds    others hold
///   as_found          stops      slips      as_found
///   slips             stops      slips      slips
///   stops             holds      restarts   holds
///   restarts          holds      restarts   holds
///   holds             holds      rests      holds
///   rests             rests      rests      rests
///
/// States only go forward in the order of the enumeration, so decisions end.
namespace kte::detail {

enum class slip_state {
  as_found,  ///< as the friction problem says
  slips,     ///< slides, because sticking would exceed friction
  stops,     ///< has no velocity, because it would stop at once; sticks or slides as the friction problem says
  restarts,  ///< has no velocity, but slides, because sticking would exceed friction
  holds,     ///< sticks, because it would not move
  rests      ///< slides, but does not move: sticking would exceed friction
};
enum class slip_finding {
  stops,       ///< it slides, but stops at once
  exceeds,     ///< it sticks, but its force exceeds friction
  others_hold  ///< another contact begins to hold
};

constexpr slip_state next_state(slip_state of, slip_finding found) {
  using enum slip_state;
  constexpr slip_state table[][3]{{stops, slips, as_found}, {stops, slips, slips}, {holds, restarts, holds},
                                  {holds, restarts, holds}, {holds, rests, holds}, {rests, rests, rests}};
  return table[static_cast<std::size_t>(of)][static_cast<std::size_t>(found)];
}
/// Whether its velocity is put to zero.
constexpr bool is_stopped(slip_state s) { return s >= slip_state::stops; }
/// Whether it slides in a direction found by the check of its forces, where it would stick.
constexpr bool is_sliding(slip_state s) {
  return s == slip_state::slips || s == slip_state::restarts || s == slip_state::rests;
}

}  // namespace kte::detail
