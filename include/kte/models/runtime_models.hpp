#pragma once

#include <kte/dynamics/derivatives.hpp>
#include <kte/dynamics/forward_kinematics.hpp>
#include <kte/dynamics/frame_motion.hpp>
#include <kte/dynamics/inverse_dynamics.hpp>
#include <kte/dynamics/jacobian.hpp>
#include <kte/dynamics/mass_matrix.hpp>
#include <kte/dynamics/state_vectors.hpp>
#include <kte/models/inverse_dynamics_model.hpp>
#include <kte/models/manipulator_kinematics_model.hpp>
#include <kte/models/unchanging_chain.hpp>
#include <kte/runtime_chain.hpp>

namespace kte {

/// `inverse_dynamics_model` of a runtime chain. It owns a state; results are valid until the next call. Use one model
/// per thread.
template <>
class inverse_dynamics_model<runtime_chain> : public unchanging_chain {
 public:
  explicit inverse_dynamics_model(const runtime_chain& c) : unchanging_chain(c), s_(make_state()) {
    detail::refuse_loops(c), detail::refuse_contacts(c);
  }

  template <indexable Q, indexable V, indexable A>
  const Eigen::VectorXd& computeForces(const Q& q, const V& v, const A& a) const {
    return inverse_dynamics(*this, s_, q, v, a);
  }
  template <indexable Q, indexable V, indexable A>
  const auto& computeForcesAndDerivatives(const Q& q, const V& v, const A& a) const {
    return inverse_dynamics_derivatives(*this, s_, q, v, a);
  }
  template <indexable Q>
  const Eigen::MatrixXd& getMassMatrix(const Q& q) const {
    return mass_matrix(*this, s_, q);
  }

 private:
  mutable runtime_state s_;  // working memory
};
inverse_dynamics_model(const runtime_chain&)->inverse_dynamics_model<runtime_chain>;

/// `manipulator_kinematics_model` of a runtime chain; tools are given by name.
template <>
class manipulator_kinematics_model<runtime_chain> : public unchanging_chain {
 public:
  /// Throws `unknown_name` for a frame that the chain does not have.
  manipulator_kinematics_model(const runtime_chain& c, std::vector<std::string> frames);

  [[nodiscard]] const std::vector<std::string>& tools() const { return frames_; }

  template <indexable Q>
  [[nodiscard]] std::vector<pose<mat3<vec3<>>, vec3<>>> getDependentPoses(const Q& q) const {
    detail::take(*this, s_, q);
    std::vector<pose<mat3<vec3<>>, vec3<>>> poses;
    for (const auto& f : frames_) poses.push_back(forward_kinematics(*this, s_, f));
    return poses;
  }
  template <indexable Q>
  [[nodiscard]] Eigen::MatrixXd getJacobianMatrix(const Q& q) const {
    detail::take(*this, s_, q);
    Eigen::MatrixXd j(6 * static_cast<Eigen::Index>(frames_.size()), dofs());
    Eigen::Index row = 0;
    for (const auto& f : frames_) j.middleRows(row, 6) = jacobian(*this, s_, f, in_world_axes), row += 6;
    return j;
  }
  /// Velocities of the frames: J v.
  template <indexable Q, indexable V>
  [[nodiscard]] Eigen::VectorXd getDependentVelocities(const Q& q, const V& v) const {
    detail::take(*this, s_, q, v);
    Eigen::VectorXd all = getJacobianMatrix(q) * velocities(s_);
    detail::check_result(all, static_cast<std::size_t>(all.size()), [this] { detail::diagnose("a velocity", s_); });
    return all;
  }
  /// Accelerations of the frames, classical, without gravity: J a + dJ/dt v.
  template <indexable Q, indexable V, indexable A>
  [[nodiscard]] Eigen::VectorXd getDependentAccelerations(const Q& q, const V& v, const A& a) const {
    detail::take(*this, s_, q, v, a);
    Eigen::VectorXd all(6 * static_cast<Eigen::Index>(frames_.size()));
    Eigen::Index row = 0;
    for (const auto& f : frames_) {
      const auto x = frame_acceleration(*this, s_, f);
      const auto R = forward_kinematics(*this, s_, f).rotation;
      const vec3<> linear = R * x.linear, angular = R * x.angular;
      for (const double number : {linear.x, linear.y, linear.z, angular.x, angular.y, angular.z}) all[row++] = number;
    }
    return all;
  }

 private:
  std::vector<std::string> frames_;
  mutable runtime_state s_;  // working memory
};
manipulator_kinematics_model(const runtime_chain&, std::vector<std::string>)
    ->manipulator_kinematics_model<runtime_chain>;

}  // namespace kte

#ifdef KTE_FUNCTION
namespace kte {

KTE_FUNCTION manipulator_kinematics_model<runtime_chain>::manipulator_kinematics_model(const runtime_chain& c,
                                                                                       std::vector<std::string> frames)
    : unchanging_chain(c), frames_(std::move(frames)), s_(make_state()) {
  detail::refuse_loops(c);
  if (frames_.empty()) throw bad_argument("kte: a kinematics model needs a frame that depends on the joints");
  for (const auto& f : frames_)
    if (!is_frame(wiring().kind_of(f, true))) throw unknown_name("kte: '" + f + "' is not a frame");
}

}  // namespace kte
#endif
