#pragma once

#include <kte/dynamics/centroidal.hpp>
#include <kte/dynamics/energy.hpp>
#include <kte/dynamics/forward_dynamics.hpp>
#include <kte/dynamics/frame_motion.hpp>
#include <kte/elements/damper.hpp>
#include <kte/elements/inertia.hpp>
#include <kte/elements/prismatic_joint.hpp>
#include <kte/elements/revolute_joint.hpp>
#include <kte/elements/rigid_link.hpp>
#include <kte/elements/spherical_joint.hpp>
#include <kte/elements/spring.hpp>
#include <kte/math/eigen.hpp>
#include <kte/static_chain/layout.hpp>

#include "data/problems/error.hpp"

namespace kte::problems {

/// The motion of a mechanism as an equation of first order, for integrators that know nothing of rotations:
///
///   x = (q, v),  q' = v for numbers,  q' = q (0, w) / 2 for rotations,  v' = forward dynamics          (1)
///
/// without forces but those of the chain. By (1) quaternions keep their length; any length gives the same rotation.
///
/// A `Mechanism` has a `name`, a chain `model`, `start_q<S>()`, `start_v<S>()`, `t_end` (s), and `references` of
/// `output(q, v)`. References are for the decimals written; parameters of a chain are doubles, 9.81 is 5e-17 of itself
/// off, so no scalar gets closer than about 1e-16 times what a disturbance grows.
template <class Mechanism, class S = double>
struct equation_of_motion {
  using model_type = std::remove_cvref_t<decltype(Mechanism::model)>;
  static constexpr const char* name = Mechanism::name;
  static constexpr int nq = model_type::nq, nv = model_type::dofs, size = nq + nv;
  static constexpr long double t_end = Mechanism::t_end;
  using state = Eigen::Matrix<S, size, 1>;
  using configuration = joint_vector<S, nq>;
  using velocity = joint_vector<S, nv>;

  static state start() {
    state x;
    x << Mechanism::template start_q<S>(), Mechanism::template start_v<S>();
    return x;
  }
  static configuration q(const state& x) { return x.template head<nq>(); }
  static velocity v(const state& x) { return x.template tail<nv>(); }

  state operator()(const S&, const state& x) const {  // (1)
    const configuration at = q(x);
    const velocity rates = v(x);
    state f;
    for (const auto& e : places) {
      if (e.what == kind::gen) {
        f[e.q] = rates[e.v];
      } else {
        turn(at.template segment<4>(e.q), rates.template segment<3>(e.v), f.template segment<4>(e.q));
      }
    }
    f.template tail<nv>() = forward_dynamics(Mechanism::model, at, rates, velocity(velocity::Zero()));
    return f;
  }

  static auto output(const state& x) { return Mechanism::output(q(x), v(x)); }
  /// J
  static S energy(const state& x) {
    const auto e = kte::energy(Mechanism::model, q(x), v(x));
    return e.kinetic + e.potential;
  }
  /// Angular momentum about the origin of the base, in its axes, kg m^2/s.
  static Eigen::Matrix<S, 3, 1> angular_momentum(const state& x) {
    const auto h = centroidal_momentum(Mechanism::model, q(x), v(x));
    return to_eigen<S>(as<S>(h.angular + cross(centre_of_mass(Mechanism::model, q(x)).position, h.linear)));
  }

 private:
  static constexpr auto places = layout(Mechanism::model);
  static_assert([] {
    for (const auto& e : places)
      if (e.what != kind::gen && e.what != kind::rotation_3D) return false;
    return true;
  }());

  template <class Q, class W, class F>
  static void turn(const Q& r, const W& w, F&& f) {
    f[0] = -(r[1] * w[0] + r[2] * w[1] + r[3] * w[2]) / 2;
    f[1] = (r[0] * w[0] + r[2] * w[2] - r[3] * w[1]) / 2;
    f[2] = (r[0] * w[1] + r[3] * w[0] - r[1] * w[2]) / 2;
    f[3] = (r[0] * w[2] + r[1] * w[1] - r[2] * w[0]) / 2;
  }
};

}  // namespace kte::problems
