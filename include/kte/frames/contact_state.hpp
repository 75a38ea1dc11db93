#pragma once

#include <kte/math/vec.hpp>

#include <cstddef>

namespace kte {

/// The mode of a contact.
enum class contact_mode : unsigned char {
  open,    ///< apart
  sticks,  ///< touches at rest; also rolling
  slides   ///< touches and slides
};

/// The state of a contact of a body B with the surface of a frame A, in axes of A. `gap`, `slip` and `point` are those
/// of the last doMotion.
///   gap         m, negative inside
///   slip        m/s, velocity of the material point of B relative to A
///   point       m, where the force acts
///   force       N, on B; the opposite acts on A at the same point
///   direction   unit vector of sliding, or zero
///   mode        a `contact_mode` as a number; -2: open, and ignored by `only_if`
template <class Scalar = double>
struct contact_state {
  Scalar gap{};
  vec3<Scalar> slip{};
  vec3<Scalar> point{};
  vec3<Scalar> force{};
  vec3<Scalar> direction{};
  Scalar mode{};
};

namespace detail {
/// Numbers of a contact among the internal states of a model: its mode, and the direction in which it slides.
inline constexpr int numbers_of_contact = 4;
/// The mode number of contacts in the states of time stepping, whose steps open and close contacts themselves: they
/// count as open, inside their surfaces too, and have no events.
inline constexpr double stepped_mode = -1;
/// The mode number of an open contact that passes through its surface, because its `only_if` is false.
inline constexpr double passing_mode = -2;
/// Writes the mode to the numbers of x from `first` on; reads it.
template <class S, class X, class I>
constexpr void put_mode(const contact_state<S>& of, I first, X& x) {
  x[first] = of.mode, x[first + 1] = of.direction.x, x[first + 2] = of.direction.y, x[first + 3] = of.direction.z;
}
template <class S, class X, class I>
constexpr void read_mode(const X& x, I first, contact_state<S>& to) {
  to.mode = x[first] > S(1.5) ? S(2) : x[first] > S(0.5) ? S(1) : x[first] < S(-1.5) ? S(passing_mode) : S(0);
  to.direction = {x[first + 1], x[first + 2], x[first + 3]};
}
}  // namespace detail

/// The mode of a contact.
template <class S>
[[nodiscard]] constexpr contact_mode mode_of(const contact_state<S>& x) {
  return x.mode == S(1) ? contact_mode::sticks : x.mode == S(2) ? contact_mode::slides : contact_mode::open;
}
/// The mode of a contact in a lane of packs.
template <class S>
requires(S::lanes > 0) [[nodiscard]] contact_mode mode_of(const contact_state<S>& x, std::size_t lane) {
  return mode_of(contact_state<>{.mode = static_cast<double>(x.mode[lane])});
}

}  // namespace kte
