#pragma once

#include <kte/contract/coordinate_lock.hpp>
#include <kte/errors.hpp>

#include <Eigen/Core>

#include <cmath>
#include <cstddef>
#include <limits>

/// Elements that lock coordinates (contract/coordinate_lock.hpp), in models. A model has
///   locks()                   the elements that may lock a coordinate
///   computeStateRate(t, x), velocity_count()
///   needed_forces(t, x)       inverse dynamics at the accelerations of x; for a locked coordinate, its holding force
///   capacity(t, x, element)   the largest holding force
///   capacity(t, x, element)     how large that may be
namespace kte {

namespace detail {

/// An element that may lock a coordinate: the positions of its rate and of its mode in a state x.
struct lock_place {
  std::size_t element;
  int row;  ///< among degrees of freedom
  int rate, mode;
};

/// The first element that locks the same coordinate. It keeps the mode for all of them, and has the events.
template <class Model>
lock_place leader(const Model& model, const lock_place& h) {
  for (const auto& other : model.locks())
    if (other.row == h.row) return other;
  return h;
}
/// The sum of the capacities of all elements that lock the coordinate of h.
template <class Model, class T, class X>
auto capacity_of_row(const Model& model, const T& t, const X& x, const lock_place& h) {
  typename X::Scalar most(0);
  for (const auto& other : model.locks())
    if (other.row == h.row) most += model.capacity(t, x, other.element);
  return most;
}
template <class Model, class X>
void set_mode(const Model& model, X& x, const lock_place& h, int m) {
  for (const auto& other : model.locks())
    if (other.row == h.row) x[other.mode] = typename X::Scalar(m);
}
/// The function that passes through zero where the mode changes: for a sliding coordinate its rate; for a locked
/// coordinate, with capacity F and holding force f,
///
///   F^2 - f^2          (1)
///
/// It is never zero: at the limit the coordinate is still locked, and events only detect functions that were nonzero
/// before.
template <class Model, class T, class X>
auto mode_function(const Model& model, const T& t, const X& x, const lock_place& h) {
  using S = typename X::Scalar;
  if (leader(model, h).element != h.element) return S(1);
  const S z = x[h.mode];
  if (z == S(mode::held)) {
    const S most = capacity_of_row(model, t, x, h), force = model.needed_forces(t, x)[h.row];
    const S spare((most - force) * (most + force));
    return spare == S(0) ? S(4 * (std::numeric_limits<S>::min)()) : spare;
  }
  return z == S(mode::sliding) ? S(x[h.rate]) : S(z * x[h.rate]);
}
/// Releases a locked coordinate in the direction of its holding force.
template <class Model, class X, class Forces>
void let_go(const Model& model, X& x, const lock_place& h, const Forces& needed) {
  set_mode(model, x, h, needed[h.row] > typename X::Scalar(0) ? mode::backward : mode::forward);
}
/// Makes the mode of a coordinate at rest consistent: releases it if the holding force exceeds the capacity, locks it
/// if it would slide against its own friction. Returns whether the mode has changed.
template <class Model, class T, class X>
bool mend_mode(const Model& model, const T& t, X& x, const lock_place& h) {
  using S = typename X::Scalar;
  using std::abs;
  const auto beyond = [&](const auto& needed) { return abs(S(needed[h.row])) > capacity_of_row(model, t, x, h); };
  const S z = x[h.mode];
  if (z == S(mode::held)) {
    const auto needed = model.needed_forces(t, x);  // NOLINT(performance-unnecessary-copy-initialization): overwritten
    if (!beyond(needed)) return false;
    let_go(model, x, h, needed);
    return true;
  }
  if (x[h.rate] != S(0)) return false;
  const S onward = z * S(model.computeStateRate(t, x)[model.velocity_count() + h.row]);
  if (!(onward < S(0))) return false;
  set_mode(model, x, h, mode::held);
  const auto needed = model.needed_forces(t, x);
  if (beyond(needed)) let_go(model, x, h, needed);
  return x[h.mode] != z;
}
/// Changes modes of coordinates at rest until all are consistent, always the first inconsistent one (the least-index
/// rule of Murty, Linear Complementarity, 1988, section 3.2, which terminates). One change can affect the forces of the
/// others.
template <class Model, class T, class X>
void find_modes(const Model& model, const T& t, X& x) {
  const auto next = [&] {
    for (const auto& h : model.locks())
      if (leader(model, h).element == h.element && mend_mode(model, t, x, h)) return true;
    return false;
  };
  const std::size_t n = model.locks().size(), most = n < 10 ? std::size_t{2} << 2 * n : std::size_t{2} << 20;
  for (std::size_t i = 0; next(); ++i)
    if (i == most) raise<no_solution>("kte: no consistent set of sticking and sliding joints exists: friction jams");
}
/// Switches the mode at a zero of (1), or of the rate.
template <class Model, class T, class X>
void switch_mode(const Model& model, const T& t, X& x, const lock_place& h) {
  using S = typename X::Scalar;
  if (x[h.mode] == S(mode::held)) {
    const auto& needed = model.needed_forces(t, x);
    let_go(model, x, h, needed);
  } else {
    x[h.rate] = S(0);
    set_mode(model, x, h, mode::held);
  }
  find_modes(model, t, x);
}

/// At the start of an integration, or after a manual change of an input, a parameter or the state: makes the mode
/// consistent. Returns whether it was not.
template <class Model, class T, class X>
bool mend_at_start(const Model& model, const T& t, X& x, const lock_place& h) {
  using S = typename X::Scalar;
  const S rate = x[h.rate];
  if (x[h.mode] != S(mode::held) && x[h.mode] * rate < S(0))
    set_mode(model, x, h, rate > S(0) ? mode::forward : mode::backward);
  else if (!mend_mode(model, t, x, h))
    return false;
  find_modes(model, t, x);
  return true;
}
/// Makes the modes of other elements consistent. `switched`: x after an event. A mode of 0 does not depend on the
/// motion and is always consistent.
template <class X, class Switched>
bool mend_internals(const Switched& switched, X& x, Eigen::Index first, Eigen::Index end) {
  using S = typename X::Scalar;
  bool wrong = false;
  for (Eigen::Index i = first; i < end; ++i)
    if (x[i] != S(0) && x[i] != switched[i]) x[i] = switched[i], wrong = true;
  return wrong;
}

}  // namespace detail

/// The state x with consistent modes of all rigid contacts, after impacts if they approach, and of all elements that
/// may lock a coordinate. A coordinate at rest is locked, unless the holding force exceeds the capacity; otherwise it
/// slides in the direction of its rate. Use it at the start of a simulation; events then switch the modes:
///
///   const auto x = kte::settled(model, 0.0, model.make_x(q, v));
template <class Model, class T, class X>
[[nodiscard]] X settled(const Model& model, const T& t, X x) {
  using S = typename X::Scalar;
  for (const auto& h : model.locks()) {
    const S rate = x[h.rate];
    x[h.mode] = S(rate > S(0) ? mode::forward : rate < S(0) ? mode::backward : mode::held);
  }
  detail::find_modes(model, t, x);
  if constexpr (requires { model.resolve_contacts(t, x); })
    if (model.contacts() > 0) (void)model.resolve_contacts(t, x);
  return x;
}

}  // namespace kte
