#pragma once

#include <kte/chain/element.hpp>
#include <kte/frames/motion.hpp>

#include <boost/hana/tuple.hpp>

namespace kte {

/// The loads an element puts on its input ports, in their order: a number for a coordinate (N or Nm, along it), a
/// wrench for a frame (at its origin, in its axes). Ports of kind `input` get none.
template <class... L>
using loads = boost::hana::tuple<L...>;

template <class... L>
KTE_INLINE constexpr auto make_loads(const L&... l) {
  return boost::hana::tuple<L...>{l...};
}

namespace detail {
/// A coordinate of which only the rate moves, by one: the motion it makes is the axis of the joint.
template <class C>
KTE_INLINE constexpr auto unit_rate(const C& c) {
  return coordinate{c.q, one, zero, c.cos, c.sin};
}
/// A coordinate without rates.
template <class C>
KTE_INLINE constexpr auto position_only(const C& c) {
  return coordinate{c.q, skip{}, skip{}, c.cos, c.sin};
}
/// The power of a wrench on a velocity.
template <class Motion, class F, class T>
KTE_INLINE constexpr auto power(const Motion& m, const wrench<F, T>& w) {
  return dot(m.velocity, w.force) + dot(m.ang_velocity, w.torque);
}
}  // namespace detail

/// A stiff connection between two frames: a link, a joint. A core that derives from it gives one function,
///
///   relative(coordinates...)   the motion of the end frame in the base frame                    (1)
///
/// and the passes follow from it:
///   doMotion   X_end = X_base * relative                     (compose, frames/motion.hpp)        (2)
///   doForce    the full wrench of the end goes to the base   (transmit, the same)                (3)
///              f = s . wrench, s the velocity that a unit rate of the coordinate makes           (4)
/// so that f is the force of virtual power on the coordinate, in any chain.
template <class Core>
struct transmission {
  /// A link.
  template <class Base>
  KTE_INLINE constexpr auto doMotion(const Base& base) const {
    return compose(base, core().relative());  // (2)
  }
  template <class Base, class Wrench>
  KTE_INLINE constexpr auto doForce(const Base&, const Wrench& end) const {
    return make_loads(transmit(core().relative(), end));  // (3)
  }
  /// A joint of one coordinate.
  template <class C, class Base>
  requires requires(const C& c) { c.q_dot; }
  KTE_INLINE constexpr auto doMotion(const C& c, const Base& base) const {
    return compose(base, core().relative(c));  // (2)
  }
  template <class C, class Base, class Wrench>
  KTE_INLINE constexpr auto doForce(const C& c, const Base&, const Wrench& end) const {
    return make_loads(detail::power(core().relative(detail::unit_rate(c)), end),  // (4)
                      transmit(core().relative(detail::position_only(c)), end));  // (3)
  }

 private:
  KTE_INLINE constexpr const Core& core() const { return static_cast<const Core&>(*this); }
};

}  // namespace kte
