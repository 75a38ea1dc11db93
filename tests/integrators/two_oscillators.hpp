#pragma once

#include <Eigen/Core>

#include <algorithm>
#include <cmath>

#include "digits50.hpp"

/// A pendulum and a linear oscillator, at any precision.
namespace kte::test {

using real50 = digits50;
template <class S>
using state = Eigen::Matrix<S, 2, 1>;

inline constexpr auto pendulum = []<class S>(const S&, const state<S>& x) {  // 0.5 m, 9.81 m/s^2
  using std::sin;
  return state<S>(x[1], S(-S(981) / S(50)) * sin(x[0]));
};
inline constexpr auto oscillator = []<class S>(const S&, const state<S>& x) { return state<S>(x[1], -x[0]); };
template <class S>
state<S> horizontal() {
  using std::acos;
  return {acos(S(0)), S(0)};
}
/// Angles of the pendulum from hanging after 1, 10 and 50 s, released at rest from the horizontal.
inline const real50 theta1("-1.31124604230103985440444713");
inline constexpr double theta10 = 1.55012648485020447245734549, theta50 = 1.05858217161372911808916728;

/// A solver whose tolerances never bind and whose first proposal is long: every `integrate` is one step.
template <template <class, class> class Method, class F>
auto one_step_solver(const F& f, const state<real50>& x0) {
  Method<F, state<real50>> solver(f, real50(0), x0, {.absolute = 1e30, .relative = 1e30});
  solver.integrate(100);
  solver.restart(0, x0, keep_step);
  return solver;
}
/// The largest error of the oscillator within one step of length h, of both components.
template <template <class, class> class Method>
real50 error_within_step(const real50& h) {
  const real50 start = 0.3;
  auto solver = one_step_solver<Method>(oscillator, state<real50>(cos(start), -sin(start)));
  solver.integrate(h);
  real50 most = 0;
  for (int i = 1; i < 16; ++i) {
    const real50 t = h * i / 16;
    const state<real50> x = solver.interpolate(t);
    for (const real50& d : {real50(x[0] - cos(real50(start + t))), real50(x[1] + sin(real50(start + t)))})
      most = worse(most, real50(abs(d)));
  }
  return most;
}
inline double slope(const real50& coarse, const real50& fine) {
  return static_cast<double>(log(coarse / fine)) / 0.6931471805599453;
}

}  // namespace kte::test
