#pragma once

#include <kte/dynamics/frame_motion.hpp>
#include <kte/dynamics/unrolled/other_loads.hpp>

/// Frames written by elements other than joints and links, in algorithms that carry bodies from tips to bases of a
/// static chain. Frames with a given motion act as bases; others may not carry bodies.
namespace kte::detail {

/// For each element: whether the frame that it writes, or its subtree, has a body, and whether this frame is
/// independent of coordinates.
template <class Chain>
struct frames_written {
  static constexpr auto table = [] {
    struct {
      std::array<bool, Chain::size + 1> carries{}, rests{};
    } t;
    const static_connections<Chain> c;
    constexpr auto bodies = []<std::size_t... I>(std::index_sequence<I...>) {
      return std::array<bool, Chain::size + 1>{is_body<core_of<Chain, I>>...};
    }
    (std::make_index_sequence<Chain::size>{});
    for (std::size_t e = 0; e < Chain::size; ++e) {
      const auto ports = c.ports(e);
      if (ports.back().how != access::out || !is_frame(ports.back().what)) continue;
      t.rests[e] = true;
      for (std::size_t p = 0; p + 1 < ports.size(); ++p) {
        const int writer = ports[p].what == kind::internal ? -1 : c.writer(ports[p].what, c.index(e, p));
        if (is_coordinate(ports[p].what) || (writer >= 0 && !t.rests[static_cast<std::size_t>(writer)]))
          t.rests[e] = false;
      }
    }
    for (std::size_t e = Chain::size; e-- > 0;) {
      const auto ports = c.ports(e);
      const bool writes = ports.back().how == access::out;
      if (!bodies[e] && !(writes && t.carries[e])) continue;
      for (std::size_t p = 0; p + writes < ports.size(); ++p)
        if (is_frame(ports[p].what))
          if (const int writer = c.writer(ports[p].what, c.index(e, p)); writer >= 0)
            t.carries[static_cast<std::size_t>(writer)] = true;
    }
    return t;
  }();
};

/// Whether an element moves a frame by signals or internal states.
template <class Core>
inline constexpr bool takes_a_motion = writes_freely<Core>&& is_frame(Core::ports.back().what) && [] {
  for (const auto& p : Core::ports)
    if (is_signal(p.what)) return true;
  return false;
}();
/// Whether element I writes a frame with bodies that acts as a base. All inputs are zero, so it is at rest.
template <class Chain, std::size_t I>
inline constexpr bool is_given_base = takes_a_motion<core_of<Chain, I>>&& frames_written<Chain>::table.rests[I] &&
                                      frames_written<Chain>::table.carries[I];
/// Whether body algorithms may skip element I, which is neither joint, link nor body.
template <class Chain, std::size_t I>
inline constexpr bool may_be_passed_over =
    !writes_freely<core_of<Chain, I>> || !is_frame(core_of<Chain, I>::ports.back().what) ||
    !frames_written<Chain>::table.carries[I] || is_given_base<Chain, I>;

/// The elements that write such frames, as an index_sequence.
template <class Chain, class Elements = std::make_index_sequence<Chain::size>>
struct given_bases;
template <class Chain, std::size_t... I>
struct given_bases<Chain, std::index_sequence<I...>>
    : numbers_where<std::array<bool, sizeof...(I) + 1>{is_given_base<Chain, I>...}> {};

/// A core that replaces a skipped element.
template <class Chain, std::size_t I>
struct pass_over {
  static_assert(may_be_passed_over<Chain, I>,
                "kte: a body stands on a frame that follows others, or beyond one; this algorithm needs what moves "
                "bodies by coordinates to be a kte::transmission");
};

/// The elements of a chain in a body algorithm.
template <class Chain, class Elements = std::make_index_sequence<Chain::size>>
struct passed_over;
template <class Chain, std::size_t... I>
struct passed_over<Chain, std::index_sequence<I...>> {
  static_assert(((sizeof(pass_over<Chain, I>) > 0) && ...));
};

/// Bases at rest: with the quantities that joints and links read (`few`), or all quantities if elements of rare shapes
/// may read positions (`whole`).
template <class Chain, class Few, class Whole = decltype(base_at_rest)>
KTE_INLINE constexpr auto rest_base_of(const Few& few, const Whole& whole = base_at_rest) {
  if constexpr (Chain::common) {
    return few;
  } else {
    return whole;
  }
}

}  // namespace kte::detail
