#pragma once

#include <kte/manipulators/box_quadratic_program.hpp>
#include <kte/manipulators/detail/starts.hpp>

#include <tuple>

namespace kte::detail {

template <class Goals, class At, class Sum>
void add_goals(const Goals& goals, const At& at, Sum& sum) {
  std::apply([&](const auto&... goal) { (goal.add_to(at, sum), ...); }, goals);
}
template <class S, class Goals, class At>
S half_squares(const Goals& goals, const At& at) {
  sum_of_squares<S> sum;
  add_goals(goals, at, sum);
  return sum.half;
}

/// The box of steps from a configuration: limits, and at most 1 rad for coordinates that rotate a tool.
template <class At, class V>
void put_box(const At& at, V& lower, V& upper) {
  using S = typename At::scalar;
  for (Eigen::Index k = 0; k < lower.size(); ++k) {
    S turns(0);
    for (Eigen::Index r = 0; r < at.jacobian.rows(); ++r)
      if (r % 6 > 2) turns += at.jacobian(r, k) * at.jacobian(r, k);
    upper[k] = turns > S(1e-6) ? S(1) : std::numeric_limits<S>::infinity(), lower[k] = -upper[k];
  }
  const auto& limits = at.arm.limits();
  for_each_freedom_of(at.arm, [&](const freedom& f) {
    if (f.what != kind::gen) return;
    const auto i = static_cast<std::size_t>(f.v);
    lower[f.v] = (std::min)((std::max)(lower[f.v], S(S(limits.lower[i]) - at.q[f.q])), S(0));
    upper[f.v] = (std::max)((std::min)(upper[f.v], S(S(limits.upper[i]) - at.q[f.q])), S(0));
  });
}

/// The step of (1) of `descend` in the box, and its predicted decrease.
template <class S, int N>
struct promised_step {
  joint_vector<S, N> d;
  S less;     ///< decrease of half the squares
  bool held;  ///< some coordinate stays at its limit
};
template <class At, class S, int N>
promised_step<S, N> best_step(const At& at, const normal_equations<S, N>& eq, const S& mu) {
  const Eigen::Index n = eq.g.size();
  joint_matrix<S, N> h(n, n);
  joint_vector<S, N> lower(n), upper(n);
  for (Eigen::Index i = 0; i < n; ++i)
    for (Eigen::Index j = 0; j <= i; ++j) h(i, j) = h(j, i) = i == j ? S(eq.h(i, i) + mu) : eq.h(i, j);
  put_box(at, lower, upper);
  const auto least = minimise_in_box(h, eq.g, lower, upper);
  promised_step<S, N> step{least.x, S(0), false};
  for (Eigen::Index i = 0; i < n; ++i) {
    S hd(0);
    for (Eigen::Index j = 0; j < n; ++j) hd += h(i, j) * step.d[j];
    step.less += step.d[i] * (eq.g[i] - (hd - mu * step.d[i]) / S(2));
    step.held |= least.at[i] != 0 && step.d[i] == S(0);
  }
  return step;
}
template <class At, class D>
auto stepped(const At& at, const D& d) {
  typename At::configuration q = integrate(at.arm, at.q, d, typename At::scalar(1));
  clamp_to_limits(at.arm, q);
  return q;
}

struct descent {
  int iterations;
  bool done, held;
};

/// Levenberg-Marquardt in the tangent space of the configuration: steps
///
///   minimize  |J d - e|_W^2 + mu |d|^2  within limits,   mu = lambda |e|_W^2                       (1)
///
/// with mu that vanishes with the errors (Sugihara, IEEE Trans. Robotics 27, 2011), and lambda by the gain ratio of the
/// step within limits and Nielsen's rule (Madsen, Nielsen, Tingleff: Methods for Non-Linear Least Squares Problems,
/// 2004). It ends when done() holds, when the predicted decrease of a step is below `stall` of the sum, when the sum
/// has not halved in `patience` steps, or after `most` steps.
template <class At, class Goals, class Done>
descent descend(At& at, const Goals& goals, int most, int patience, double stall, const Done& done) {
  using S = typename At::scalar;
  descent out{0, done(), false};
  S half = half_squares<S>(goals, at), lambda(S(0.01)), nu(2);
  S before = half;
  int next = patience;
  typename At::configuration from = at.q;
  for (bool moved = true; !out.done && out.iterations < most;) {
    at.differentiate();
    normal_equations<S, At::n> eq(static_cast<Eigen::Index>(dofs_of(at.arm)));
    add_goals(goals, at, eq);
    for (moved = false; !moved && out.iterations < most;) {
      if (out.iterations >= next) {
        if (half > S(0.5) * before) return out;
        before = half, next += patience;
      }
      ++out.iterations;
      look_for_interruption();
      const auto step = best_step(at, eq, S(lambda * S(2) * half));  // (1)
      out.held = step.held;
      if (!(step.less > S(stall) * half)) return out;
      from = at.q;
      at.move(stepped(at, step.d));
      const S now = half_squares<S>(goals, at), gain = (half - now) / step.less;
      moved = gain > S(1e-4);
      if (moved) {
        const S k = S(2) * gain - S(1);
        lambda *= (std::max)(S(S(1) / S(3)), S(S(1) - k * k * k)), nu = S(2);
        half = now, out.done = done();
      } else {
        at.move(from), lambda *= nu, nu *= S(2);
      }
    }
  }
  return out;
}

}  // namespace kte::detail
