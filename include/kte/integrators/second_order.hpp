#pragma once

#include <kte/integrators/integrator.hpp>

namespace kte {

/// The number n of velocities in the rates r = (v, a, z') of a state, for methods that treat positions and velocities
/// differently: the first n rates are v, the next n are accelerations; x has the numbers v after its positions.
///
/// n is f.velocity_count() if f has it, as `manipulator_dynamics_model` does. Otherwise it is half of the number of
/// rates, and there are no internal states z.
template <class F, class Rate>
[[nodiscard]] Eigen::Index velocities_in(const F& f, const Rate& r) {
  if constexpr (requires { f.velocity_count(); }) {
    return f.velocity_count();
  } else {
    if (r.size() % 2 != 0) [[unlikely]]
      detail::raise<bad_argument>("kte: this method needs a state of positions and their rates; of " +
                                  std::to_string(r.size()) + " numbers they cannot be halves");
    return r.size() / 2;
  }
}

/// The right-hand side that `second_order` returns.
template <class G>
class second_order_system {
 public:
  /// Accelerations depend on positions only: one evaluation a step is enough for `stormer_verlet`.
  static constexpr bool accelerations_ignore_velocities = true;

  explicit second_order_system(G g) : g_(std::move(g)) {}

  template <class T, class X>
  X operator()(const T& t, const X& x) {
    const Eigen::Index n = x.size() / 2;
    X r(x.size());
    r.head(n) = x.tail(n);
    r.tail(n) = g_(t, x.head(n));
    return r;
  }

 private:
  G g_;
};

/// A system q'' = g(t, q), independent of velocities, as a right-hand side: x = (q, v), x' = (v, g(t, q)).
///
///   kte::stormer_verlet solver(kte::second_order(g), 0.0, x0, 0.01);
///
/// g(t, q): q is a view of the first half of x; g returns a vector of the same size.
template <class G>
[[nodiscard]] second_order_system<G> second_order(G g) {
  return second_order_system<G>(std::move(g));
}

}  // namespace kte
