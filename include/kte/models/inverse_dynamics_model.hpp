#pragma once

#include <kte/dynamics/derivatives.hpp>
#include <kte/dynamics/momentum.hpp>

namespace kte {

/// A chain as a model for controllers that compute forces from motions. It derives from the chain, so that all
/// algorithms accept it and it can be an element of larger chains.
///
///   kte::inverse_dynamics_model arm(chain);
///   auto tau = arm.computeForces(q, v, a);
///
/// Arguments and units are those of `inverse_dynamics`.
template <class Chain>
class inverse_dynamics_model : public Chain {
 public:
  explicit constexpr inverse_dynamics_model(const Chain& c) : Chain(c) {}

  /// The generalized forces for the accelerations a, N and Nm: inverse dynamics (RNEA).
  template <indexable Q, indexable V, indexable A>
  [[nodiscard]] auto computeForces(const Q& q, const V& v, const A& a) const {
    return inverse_dynamics(chain(), q, v, a);
  }
  /// The generalized forces and their derivatives by q, v and a.
  template <indexable Q, indexable V, indexable A>
  [[nodiscard]] auto computeForcesAndDerivatives(const Q& q, const V& v, const A& a) const {
    return inverse_dynamics_derivatives(chain(), q, v, a);
  }
  /// The mass matrix M.
  template <indexable Q>
  [[nodiscard]] auto getMassMatrix(const Q& q) const {
    return mass_matrix(chain(), q);
  }
  /// M and its time derivative at the velocities v, by dual numbers, exact to rounding.
  template <indexable Q, indexable V>
  [[nodiscard]] auto getMassMatrixAndDerivative(const Q& q, const V& v) const {
    using S = value_of<Q>;
    using matrix = joint_matrix<S, Chain::dofs>;
    const auto both = mass_matrix(chain(), detail::moving_along(chain(), q, v));
    return std::pair<matrix, matrix>{both.unaryExpr([](const auto& x) { return x.value; }),
                                     both.unaryExpr([](const auto& x) { return x.derivative[0]; })};
  }

  [[nodiscard]] constexpr const Chain& chain() const { return *this; }
};
template <class Gravity, class... E>
inverse_dynamics_model(const static_chain<Gravity, E...>&) -> inverse_dynamics_model<static_chain<Gravity, E...>>;

}  // namespace kte
