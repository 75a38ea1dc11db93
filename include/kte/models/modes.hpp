#pragma once

#include <kte/contract/coordinate_lock.hpp>
#include <kte/errors.hpp>

#include <Eigen/Core>

#include <cmath>
#include <cstddef>
#include <limits>

/// Elements that hold coordinates (contract/coordinate_lock.hpp), in models. A model has
///   locks()                   where they are
///   computeStateRate(t, x), velocity_count()
///   needed_forces(t, x)         inverse dynamics at the accelerations of x: of what is held, the force that holds it
///   capacity(t, x, element)     how large that may be
namespace kte {

namespace detail {

/// An element that may hold a coordinate: the places of its rate and of its mode in a state x.
struct lock_place {
  std::size_t element;
  int row;  ///< among degrees of freedom
  int rate, mode;
};

/// The first that holds the same coordinate: it keeps the mode for all of them, and has the events.
template <class Model>
lock_place leader(const Model& model, const lock_place& h) {
  for (const auto& other : model.locks())
    if (other.row == h.row) return other;
  return h;
}
/// By how much all that hold the coordinate of h can hold it together.
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
/// The function that goes through zero where the mode changes: the rate of sliding; for a locked coordinate, with
/// capacity F and force f,
///
///   F^2 - f^2          (1)
///
/// but not zero: at the limit it is still locked, and an event detects only functions that were not zero before.
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
/// Lets what is held go the way in which it is pulled.
template <class Model, class X, class Forces>
void let_go(const Model& model, X& x, const lock_place& h, const Forces& needed) {
  set_mode(model, x, h, needed[h.row] > typename X::Scalar(0) ? mode::backward : mode::forward);
}
/// Whether the mode of a coordinate without rate is not what happens; then it is changed: what is held by more than is
/// there is let go, and what would be carried against its own friction is held.
template <class Model, class T, class X>
bool mend_mode(const Model& model, const T& t, X& x, const lock_place& h) {
  using S = typename X::Scalar;
  using std::abs;
  const auto beyond = [&](const auto& needed) { return abs(S(needed[h.row])) > capacity_of_row(model, t, x, h); };
  const S z = x[h.mode];
  if (z == S(mode::held)) {
    const auto needed = model.needed_forces(t, x);
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
/// Changes modes of what has no rate until all are as things happen: always the first that is not (the least-index rule
/// of Murty, Linear Complementarity, 1988, section 3.2, which ends). What one does changes what the others need.
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
/// At a zero of (1), or of the rate.
template <class Model, class T, class X>
void switch_mode(const Model& model, const T& t, X& x, const lock_place& h) {
  using S = typename X::Scalar;
  if (x[h.mode] == S(mode::held)) {
    const auto needed = model.needed_forces(t, x);
    let_go(model, x, h, needed);
  } else {
    x[h.rate] = S(0);
    set_mode(model, x, h, mode::held);
  }
  find_modes(model, t, x);
}

/// Where an integration begins, after an input, a parameter or the state has been changed by hand: the mode becomes
/// what happens, where it is not. Says whether it was not.
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
/// The same of what other elements keep: `switched` is what x would be after an event. A mode of 0 tells nothing of
/// what happens, and is never wrong.
template <class X, class Switched>
bool mend_internals(const Switched& switched, X& x, Eigen::Index first, Eigen::Index end) {
  using S = typename X::Scalar;
  bool wrong = false;
  for (Eigen::Index i = first; i < end; ++i)
    if (x[i] != S(0) && x[i] != switched[i]) x[i] = switched[i], wrong = true;
  return wrong;
}

}  // namespace detail

/// The state x with consistent modes of all elements that may lock a coordinate: a coordinate at rest is locked, unless
/// the holding force exceeds the capacity; else it slides in the direction of its rate. For the start of a simulation;
/// then events switch the modes:
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
  return x;
}

}  // namespace kte
