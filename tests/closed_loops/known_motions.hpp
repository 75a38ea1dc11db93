#pragma once

#include <kte/math/dual.hpp>

#include <functional>

#include "catch.hpp"
#include "closed_loops/mechanisms.hpp"

/// Mechanisms of one degree of freedom whose positions are known in closed form, and what their motions must be.
namespace kte::test::loops {

/// A number with its first and second derivative by y.
using second = dual<dual<double, 1>, 1>;
inline second seeded_twice(double y) {
  second x(dual<double, 1>{y});
  x.value.derivative[0] = 1, x.derivative[0] = dual<double, 1>(1.0);
  return x;
}
inline double at(const second& x) { return x.value.value; }
inline double slope(const second& x) { return x.value.derivative[0]; }
inline double curvature(const second& x) { return x.derivative[0].derivative[0]; }

/// A mass at a point of the world; of no weight: a moment of inertia with its angle as x.
struct moving_mass {
  double mass;
  second x, y, z{};
  bool weighs = true;
};
inline moving_mass turning(double inertia, const second& angle) { return {inertia, angle, second{}, second{}, false}; }

/// All coordinates and masses by the first coordinate y. Gravity of 9.81 m/s^2 acts along -y of the world:
///
///   m y'' = tau - n y'^2 - g sum m_i h_i',   m = sum m_i p_i' . p_i',   n = sum m_i p_i' . p_i''          (1)
struct known_motion {
  runtime_chain chain;
  std::function<std::vector<second>(const second&)> coordinates;
  std::function<std::vector<moving_mass>(const second&)> masses;

  double acceleration(double y, double rate, double tau = 0) const {
    double m = 0, force = tau;
    for (const auto& p : masses(seeded_twice(y))) {
      m += p.mass * (slope(p.x) * slope(p.x) + slope(p.y) * slope(p.y) + slope(p.z) * slope(p.z));
      force -= p.mass * rate * rate *
               (slope(p.x) * curvature(p.x) + slope(p.y) * curvature(p.y) + slope(p.z) * curvature(p.z));
      if (p.weighs) force -= p.mass * 9.81 * slope(p.y);
    }
    return force / m;
  }
  vector q(double y) const {
    return each(y, [](const second& x) { return at(x); });
  }
  vector v(double y, double rate) const {
    return each(y, [rate](const second& x) { return rate * slope(x); });
  }
  vector a(double y, double rate, double acceleration) const {
    return each(y, [=](const second& x) { return acceleration * slope(x) + rate * rate * curvature(x); });
  }
  /// y and its rate at time t.
  Eigen::Vector2d after(double y, double rate, double t) const {
    const auto f = [this](double, const Eigen::Vector2d& x) { return Eigen::Vector2d(x[1], acceleration(x[0], x[1])); };
    prince_dormand87 solver(f, 0.0, Eigen::Vector2d(y, rate), {.absolute = 1e-14, .relative = 1e-14});
    solver.integrate(t);
    return solver.state();
  }
  /// The largest difference of q from that of its first coordinate, but for full turns.
  double off_branch(const vector& at) const {
    double most = 0;
    const vector on = q(at[0]);
    for (Eigen::Index i = 0; i < on.size(); ++i)
      most = (std::max)(most, std::abs(std::remainder(at[i] - on[i], 2 * pi)));
    return most;
  }

 private:
  template <class Of>
  vector each(double y, const Of& of) const {
    const auto all = coordinates(seeded_twice(y));
    vector x(static_cast<Eigen::Index>(all.size()));
    for (Eigen::Index i = 0; i < x.size(); ++i) x[i] = of(all[static_cast<std::size_t>(i)]);
    return x;
  }
};

/// Checks accelerations, forces and derivatives at y against (1), to `rounding` of the largest acceleration.
inline void check_dynamics(const known_motion& k, const std::string& leading, double y, double rate, double rounding) {
  const auto& c = k.chain;
  auto s = c.make_state();
  const vector q = k.q(y), v = k.v(y, rate), tau = 2.5 * vector::Unit(c.dofs(), 0);
  CHECK((consistent_velocities(c, s, q, v) - v).cwiseAbs().maxCoeff() < 1e-13 * v.cwiseAbs().maxCoeff());
  const vector a = constrained_dynamics(c, s, q, v, tau).a, expected = k.a(y, rate, k.acceleration(y, rate, 2.5));
  const double size = expected.cwiseAbs().maxCoeff();
  CHECK((a - expected).cwiseAbs().maxCoeff() < rounding * size);
  CHECK(inverse_dynamics(c, s, q, v, a, actuated(leading))[0] == within(2.5, 10 * rounding * size));
  const auto by = actuated_dynamics_derivatives(c, s, q, v, tau, actuated(leading));
  const auto difference = [](const auto& f) {  // of fourth order
    const double h = 1e-3;
    return (8 * (f(h) - f(-h)) - (f(2 * h) - f(-2 * h))) / (12 * h);
  };
  const double of_q = difference([&](double d) { return k.acceleration(y + d, rate, 2.5); });
  const double of_v = difference([&](double d) { return k.acceleration(y, rate + d, 2.5); });
  CHECK(by.by_q(0, 0) == within(of_q, 1e-7 * (1 + size)));
  CHECK(by.by_v(0, 0) == within(of_v, 1e-9 * (1 + size)));
}
/// Simulates to t; y there must be that of (1) within `error`, all coordinates on their branch, and the loops closed.
inline void check_motion(const known_motion& k, double y, double rate, double t, double tolerance, double error) {
  const auto& c = k.chain;
  auto s = c.make_state();
  const manipulator_dynamics_model<runtime_chain> model(c);
  prince_dormand87 solver(std::cref(model), 0.0, model.make_x(k.q(y), k.v(y, rate)),
                          {.absolute = tolerance, .relative = tolerance});
  double off = 0, gap = 0;
  solver.integrate(t, every(t / 40), [&](double, const vector& x) {
    const vector q = x.head(c.nq());
    off = (std::max)(off, k.off_branch(q)), gap = (std::max)(gap, kte::loops(c, s, q).gap);
  });
  CHECK(solver.state()[0] == within(k.after(y, rate, t)[0], error));
  CHECK(off < 1e-7);  // rounding over the distance from a singular configuration
  CHECK(gap < 1e-13);
}

}  // namespace kte::test::loops
