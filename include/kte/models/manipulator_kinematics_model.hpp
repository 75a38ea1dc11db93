#pragma once

#include <kte/dynamics/configuration_space.hpp>
#include <kte/dynamics/frame_motion.hpp>
#include <kte/dynamics/jacobian.hpp>

namespace kte {

/// A chain with its tools, the frames of interest: their poses, Jacobians and motions. It derives from the chain, so
/// that all algorithms accept it and it can be an element of larger chains.
///
///   kte::manipulator_kinematics_model arm(chain, tool);
///   auto [R, p] = arm.getDependentPoses(q)[0];
///
/// Jacobians and motions are in world axes, linear rows before angular ones, one frame after the other, like
/// `jacobian(c, q, frame, in_world_axes)`.
template <class Chain, key_type... Frames>
class manipulator_kinematics_model : public Chain {
  static_assert(sizeof...(Frames) > 0, "kte: a kinematics model needs a frame that depends on the joints");
  static_assert(((Chain::wiring::template find<Frames>() >= 0) && ...), "kte: this chain has no frame of this name");
  static constexpr int n = Chain::dofs, rows = 6 * static_cast<int>(sizeof...(Frames));

 public:
  explicit constexpr manipulator_kinematics_model(const Chain& c, const Frames&...) : Chain(c) {}

  /// The names of the tools.
  static constexpr std::array<std::string_view, sizeof...(Frames)> tools() { return {Frames::name...}; }
  /// The poses of the tools in the base.
  template <indexable Q>
  [[nodiscard]] auto getDependentPoses(const Q& q) const {
    return std::array{forward_kinematics(chain(), q, Frames{})...};
  }
  /// The Jacobian J of the tools, 6 rows for each.
  template <indexable Q>
  [[nodiscard]] auto getJacobianMatrix(const Q& q) const {
    Eigen::Matrix<value_of<Q>, rows, n> j;
    int row = 0;
    ((j.template middleRows<6>(row) = jacobian(chain(), q, Frames{}, in_world_axes), row += 6), ...);
    return j;
  }
  /// J and its time derivative at the velocities v, by dual numbers, exact to rounding. The accelerations of the tools
  /// are J a + dJ/dt v.
  template <indexable Q, indexable V>
  [[nodiscard]] auto getJacobianMatrixAndDerivative(const Q& q, const V& v) const {
    using matrix = Eigen::Matrix<value_of<Q>, rows, n>;
    const auto both = getJacobianMatrix(detail::moving_along(chain(), q, v));
    const std::pair<matrix, matrix> all{both.unaryExpr([](const auto& x) { return x.value; }),
                                        both.unaryExpr([](const auto& x) { return x.derivative[0]; })};
    check(all.second.data(), static_cast<std::size_t>(rows * n), "a rate", q, v);
    return all;
  }
  /// Velocities of the frames: J v.
  template <indexable Q, indexable V>
  [[nodiscard]] auto getDependentVelocities(const Q& q, const V& v) const {
    check_size<n>(v, "v");
    joint_vector<value_of<Q>, n> rates;
    for (std::size_t i = 0; i < std::size_t{n}; ++i) rates[static_cast<Eigen::Index>(i)] = v[i];
    const Eigen::Matrix<value_of<Q>, rows, 1> all(getJacobianMatrix(q) * rates);
    check(all, std::size_t{rows}, "a velocity", q, v);
    return all;
  }
  /// Accelerations of the frames, classical, without gravity: J a + dJ/dt v.
  template <indexable Q, indexable V, indexable A>
  [[nodiscard]] auto getDependentAccelerations(const Q& q, const V& v, const A& a) const {
    using S = value_of<Q>;
    Eigen::Matrix<S, rows, 1> all;
    int row = 0;
    const auto add = [&](const auto& frame) {
      const auto x = frame_acceleration(chain(), q, v, a, frame);
      const auto R = as<S>(matrix(forward_kinematics(chain(), q, frame).rotation));
      const vec3<S> linear = R * x.linear, angular = R * x.angular;
      for (const S& number : {linear.x, linear.y, linear.z, angular.x, angular.y, angular.z}) all[row++] = number;
    };
    (add(Frames{}), ...);
    return all;
  }

  [[nodiscard]] constexpr const Chain& chain() const { return *this; }

 private:
  /// Throws `bad_argument`, naming the argument at fault, unless these numbers are finite.
  template <class X, class Q, class V>
  static void check(const X& x, std::size_t count, const char* what, const Q& q, const V& v) {
    using S = value_of<Q>;
    detail::check_result(x, count, [&] {
      detail::diagnose<typename Chain::wiring>(what, detail::each<S, Q>{q}, detail::each<S, V>{v},
                                               detail::same<zero_t>{}, "a");
    });
  }
};
template <class Gravity, class... E, key_type... Frames>
manipulator_kinematics_model(const static_chain<Gravity, E...>&, const Frames&...)
    -> manipulator_kinematics_model<static_chain<Gravity, E...>, Frames...>;

}  // namespace kte
