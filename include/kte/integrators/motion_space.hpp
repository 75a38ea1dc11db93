#pragma once

#include <kte/detail/raise.hpp>
#include <kte/errors.hpp>

#include <Eigen/Core>

#include <concepts>
#include <functional>
#include <string>
#include <type_traits>

/// States that are not vectors: those with rotations. Integrators then work on displacements d from the state x at the
/// start of a step, which are vectors:
///
///   d' = rate of d at which the state x (+) d changes by f(t, x (+) d),   d(t) = 0          (1)
///   x1 = x (+) d(t + h)                                                                     (2)
///
/// Every one-step method is thus a method on the group, of the same order, and quaternions keep unit length:
/// Munthe-Kaas, High order Runge-Kutta methods on manifolds, Appl. Numer. Math. 29 (1999).
namespace kte {

namespace detail {
/// The right-hand side itself, also behind `std::ref`.
template <class F>
F& unwrapped(F& f) {
  return f;
}
template <class F>
F& unwrapped(const std::reference_wrapper<F>& f) {
  return f.get();
}
template <class F>
F& unwrapped(std::reference_wrapper<F>& f) {
  return f.get();
}
template <class F>
using unwrapped_type = std::remove_cvref_t<decltype(unwrapped(std::declval<F&>()))>;
/// Whether F is `std::cref` of a right-hand side that can only be called through `std::ref`.
template <class F, class S, class X>
inline constexpr bool changes_when_called = false;
template <class F, class S, class X>
inline constexpr bool changes_when_called<std::reference_wrapper<const F>, S, X> =
    !std::invocable<const F&, const S&, const X&> && std::invocable<F&, const S&, const X&>;
}  // namespace detail

/// A right-hand side f whose states are not vectors, such as those with rotations:
///
///   typename F::rate         what f(t, x) returns: a column vector of velocities
///   f.rates()                the size of these vectors
///   f.displace(x, d, out)    out = x (+) d, in (2)
///   f.pull_back(d, r)        the rate r of the state becomes that of d, in (1)
///   f.magnitudes(x, m)       for each number of d, the size of the state in its unit, for relative tolerances
///   f.rounding(x, d, out, r) optional: r = the part of d lost in the rounding of out, as a displacement from out
///
/// If states must also stay on a manifold, such as the closed loops of a mechanism, f has in addition
///
///   f.begin_step(x)          a step begins at x: chooses what stages and the end of the step go by
///   f.settle(x, d, out)      out = x (+) d, the end of a step or a state within it, is put on the manifold; d goes
///                            with it
///   f.settle_at(t)           optional: the time of the next calls of `begin_step` and `settle`, if the manifold moves
///   f.tangential(x, e)       what `settle` takes away of a displacement is taken out of an error estimate e
///   f.check_end(x, next)     optional: throws where a step of another length should end elsewhere than at `next`
///   f.singular_distance(x)   optional: the relative distance of x, where a step begins, from singular configurations
///
/// A right-hand side of vectors may have the same functions, with `settle(x, out)` instead, and with e in the numbers
/// of x (models/vector_form.hpp).
///
/// They throw `bad_argument` if this is not possible; a shorter step may succeed.
template <class F, class X>
concept moves_on_group = requires(const F& f, const X& x, X& out, const typename F::rate& d, typename F::rate& r) {
  { f.rates() } -> std::convertible_to<Eigen::Index>;
  f.displace(x, d, out);
  f.pull_back(d, r);
  f.magnitudes(x, r);
};

namespace detail {
/// Whether a right-hand side keeps states on a manifold.
template <class F, class X>
concept settles_states = moves_on_group<F, X> && requires(const F& f, const X& x, X& out, typename F::rate& d) {
  f.begin_step(x);
  f.settle(x, d, out);
  f.tangential(x, d);
};
/// Whether a right-hand side keeps states that are vectors on a manifold.
template <class F, class X>
concept settles_vectors = !moves_on_group<F, X> && requires(const F& f, const X& x, X& out) {
  f.begin_step(x);
  f.settle(x, out);
  f.tangential(x, out);
};
/// Whether a model has rigid contacts.
template <class F>
bool has_rigid_contacts(const F& f) {
  if constexpr (requires { f.contacts(); }) return f.contacts() > 0;
  return false;
}
/// Throws `bad_argument` if a right-hand side f keeps states on closed loops, or contacts closed, for `methods` that do
/// not.
template <class F>
void refuse_moving_on_loops(const F& f, const char* methods) {
  if (has_rigid_contacts(unwrapped(f)))
    raise<bad_argument>(std::string("kte: ") + methods +
                        " do not keep rigid contacts closed: use a one-step method of kte with kte::element_events");
  if constexpr (requires { unwrapped(f).has_loops(); })
    if (unwrapped(f).has_loops())
      raise<bad_argument>(std::string("kte: ") + methods +
                          " do not keep loops closed: use a one-step method of kte, or kte::vector_form");
}
template <class F, class X>
struct rate_type {
  using type = X;
};
template <class F, class X>
requires moves_on_group<F, X>
struct rate_type<F, X> {
  using type = typename F::rate;
};
/// Whether the states of a right-hand side F move on a group.
template <class F>
inline constexpr bool has_states_on_group = false;
template <class F>
requires requires { typename F::state; }
inline constexpr bool has_states_on_group<F> = moves_on_group<F, typename F::state>;
}  // namespace detail

/// The type of rates of states X under f, and of displacements: X itself for vectors.
template <class F, class X>
using rate_of = typename detail::rate_type<detail::unwrapped_type<F>, X>::type;

}  // namespace kte
