#pragma once

#include <kte/contract/holder.hpp>

#include <cstddef>

/// Elements that hold coordinates (contract/holder.hpp), in models. A model has
///   holders()                   where they are
///   needed_forces(t, x)         inverse dynamics at the accelerations of x: of what is held, the force that holds it
///   capacity(t, x, element)     how large that may be
namespace kte {

namespace detail {

/// An element that may hold a coordinate: the places of its rate and of its mode in a state x.
struct holder_place {
  std::size_t element;
  int row;  ///< among degrees of freedom
  int rate, mode;
};

/// What goes through zero where the mode changes: the rate of sliding; of what is held, with capacity F and force f,
///
///   F^2 - f^2          (1)
template <class Model, class T, class X>
auto mode_function(const Model& model, const T& t, const X& x, const holder_place& h) {
  using S = typename X::Scalar;
  const S z = x[h.mode];
  if (z == S(mode::held)) {
    const S most = model.capacity(t, x, h.element), force = model.needed_forces(t, x)[h.row];
    return S((most - force) * (most + force));
  }
  return z == S(mode::sliding) ? S(x[h.rate]) : S(z * x[h.rate]);
}
/// Lets go what is held by more than its capacity, the worst first.
template <class Model, class T, class X>
void release(const Model& model, const T& t, X& x) {
  using S = typename X::Scalar;
  using std::abs;
  for (;;) {
    const auto force = model.needed_forces(t, x);
    const holder_place* worst = nullptr;
    S excess(0);
    for (const auto& h : model.holders()) {
      if (x[h.mode] != S(mode::held)) continue;
      const S beyond = abs(force[h.row]) - S(model.capacity(t, x, h.element));
      if (beyond > excess) excess = beyond, worst = &h;
    }
    if (!worst) return;
    x[worst->mode] = S(force[worst->row] > S(0) ? mode::backward : mode::forward);
  }
}
/// At a zero of (1), or of the rate.
template <class Model, class T, class X>
void switch_mode(const Model& model, const T& t, X& x, const holder_place& h) {
  using S = typename X::Scalar;
  if (x[h.mode] == S(mode::held)) {
    x[h.mode] = S(model.needed_forces(t, x)[h.row] > S(0) ? mode::backward : mode::forward);
  } else {
    x[h.rate] = S(0);
    x[h.mode] = S(mode::held);
  }
  release(model, t, x);
}

}  // namespace detail

/// The state x with the modes of all that may hold a coordinate: where its rate is zero it is held, unless that takes
/// more than it can; else it slides as the rate says. For the start of a simulation; then events keep them:
///
///   const auto x = kte::settled(model, 0.0, model.make_x(q, v));
template <class Model, class T, class X>
X settled(const Model& model, const T& t, X x) {
  using S = typename X::Scalar;
  for (const auto& h : model.holders()) {
    const S rate = x[h.rate];
    x[h.mode] = S(rate > S(0) ? mode::forward : rate < S(0) ? mode::backward : mode::held);
  }
  detail::release(model, t, x);
  return x;
}

}  // namespace kte
