#pragma once

#include <kte/detail/raise.hpp>
#include <kte/errors.hpp>
#include <kte/math/vec.hpp>

#include <array>
#include <cstddef>
#include <limits>

/// Points of capsules and boxes about an origin, m.
namespace kte::detail {

/// The ends of the axis of a capsule; `half`: half the axis.
constexpr std::array<vec3<>, 2> ends_of(const vec3<>& half) { return {half, -half}; }
/// Rejects half a length of a box that is not finite and positive.
constexpr void check_half(double half) {
  const auto text = [half] {
    return "kte: half the lengths of a box must be finite and positive, got " + number(half);
  };
  require<bad_parameter>(half > 0 && half <= (std::numeric_limits<double>::max)(), text,
                         "half the lengths of a box must be finite and positive", half);
}
/// The corners of a rectangle, counterclockwise from x, y > 0; `h`: half its lengths.
constexpr std::array<vec3<>, 4> corners_2D(const vec3<>& h) {
  check_half(h.x), check_half(h.y);
  return {{{h.x, h.y, 0}, {-h.x, h.y, 0}, {-h.x, -h.y, 0}, {h.x, -h.y, 0}}};
}
/// The corners of a box, in the order of the binary numbers zyx, 0 for the negative side; `h`: half its lengths.
constexpr std::array<vec3<>, 8> corners_3D(const vec3<>& h) {
  check_half(h.x), check_half(h.y), check_half(h.z);
  std::array<vec3<>, 8> all{};
  for (std::size_t k = 0; k < 8; ++k) all[k] = {k & 1 ? h.x : -h.x, k & 2 ? h.y : -h.y, k & 4 ? h.z : -h.z};
  return all;
}

}  // namespace kte::detail
