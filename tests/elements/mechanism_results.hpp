#pragma once

#include <kte/dynamics.hpp>
#include <kte/kte.hpp>

#include <algorithm>
#include <array>

#include "catch.hpp"
#include "chain/registered.hpp"
#include "random.hpp"

/// What the algorithms say of a mechanism, static or runtime, for comparisons of two that should be the same.
namespace kte::test {

/// At q, v and x, which are accelerations where forces are requested, and forces where accelerations are.
struct mechanism_results {
  std::array<Eigen::MatrixXd, 9> all;

  /// The largest difference of one of them, relative to its largest number or 1.
  double difference_from(const mechanism_results& o) const {
    double worst = 0;
    for (std::size_t i = 0; i < all.size(); ++i) {
      const double size = std::max(1.0, o.all[i].cwiseAbs().maxCoeff());
      for (Eigen::Index k = 0; k < all[i].size(); ++k)
        worst = worse(worst, std::fabs(all[i].data()[k] - o.all[i].data()[k]) / size);
    }
    return worst;
  }
};

inline mechanism_results results_of(const runtime_chain& c, const std::string& tip, const Eigen::VectorXd& q,
                                    const Eigen::VectorXd& v, const Eigen::VectorXd& x) {
  auto s = c.make_state();
  mechanism_results r;
  r.all[0] = inverse_dynamics(c, s, q, v, x), r.all[1] = mass_matrix(c, s), r.all[2] = mass_matrix_inverse(c, s);
  const auto& derived = inverse_dynamics_derivatives(c, s, q, v, x);
  r.all[3] = derived.by_q, r.all[4] = derived.by_v;
  r.all[5] = jacobian(c, s, tip);
  r.all[6] = to_eigen<double>(forward_kinematics(c, s, tip).position);
  r.all[7] = forward_dynamics(c, s, q, v, x);
  set_accelerations(s, x);
  c.doMotion(s), c.clearForce(s), c.doForce(s);
  r.all[8] = forces(s);
  return r;
}
template <class Gravity, class... E, class Tip>
mechanism_results results_of(const static_chain<Gravity, E...>& c, const Tip& tip, const Eigen::VectorXd& q,
                             const Eigen::VectorXd& v, const Eigen::VectorXd& x) {
  mechanism_results r;
  r.all[0] = inverse_dynamics(c, q, v, x), r.all[1] = mass_matrix(c, q), r.all[2] = mass_matrix_inverse(c, q);
  const auto derived = inverse_dynamics_derivatives(c, q, v, x);
  r.all[3] = derived.by_q, r.all[4] = derived.by_v;
  r.all[5] = jacobian(c, q, tip);
  r.all[6] = to_eigen<double>(forward_kinematics(c, q, tip).position);
  r.all[7] = forward_dynamics(c, q, v, x);
  auto s = make_state(c);
  set_positions(s, q), set_velocities(s, v), set_accelerations(s, x);
  c.doMotion(s), c.clearForce(s), c.doForce(s);
  r.all[8] = forces(s);
  return r;
}

/// A random motion of a chain; quaternions of any length.
struct some_motion {
  Eigen::VectorXd q, v, x;
  some_motion(int nq, int nv, random_numbers& random) : q(nq), v(nv), x(nv) {
    for (auto& e : q) e = random(2);
    for (auto& e : v) e = random(2);
    for (auto& e : x) e = random(5);
  }
};
/// The largest difference of two mechanisms at some motions.
template <class A, class B, class Tip>
double difference(const A& a, const B& b, const Tip& tip, unsigned seed) {
  random_numbers random(seed);
  const auto count = [](const auto& c) {
    if constexpr (requires { c.dofs(); }) {
      return std::pair(c.nq(), c.dofs());
    } else {
      return std::pair(c.nq, c.dofs);
    }
  };
  const auto name = [&tip](const auto& c) -> decltype(auto) {
    if constexpr (requires { c.dofs(); }) {
      return std::string(tip.name);
    } else {
      return (tip);
    }
  };
  double worst = 0;
  for (int round = 0; round < 5; ++round) {
    const auto [nq, nv] = count(a);
    const some_motion m(nq, nv, random);
    worst = worse(worst, results_of(a, name(a), m.q, m.v, m.x).difference_from(results_of(b, name(b), m.q, m.v, m.x)));
  }
  return worst;
}

}  // namespace kte::test
