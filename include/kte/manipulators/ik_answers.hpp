#pragma once

#include <kte/manipulators/detail/solve_closed_form.hpp>
#include <kte/manipulators/unreachable.hpp>
#include <kte/models/joint_limits.hpp>

namespace kte {

/// A solution of inverse kinematics: a posture of the arm.
template <class Q>
struct ik_answer {
  using scalar = value_of<Q>;

  Q q;                  ///< a configuration of the chain
  unsigned branch = 0;  ///< bits: 1 shoulder, 2 elbow, 4 wrist; higher ones if there are more solutions
  scalar position{};    ///< error of the tool's position by forward kinematics, m
  scalar rotation{};
  truth<scalar> exact{};  ///< whether both errors are within the tolerance; otherwise q is a least-squares solution
  truth<scalar> within_limits{};
  /// Bit i: coordinate i of v is arbitrary (singular configuration), and equal to that of the seed, or 0. For packs one
  /// value per lane.
  /// element.
  detail::for_each_lane<scalar, unsigned> free{};
};

/// All solutions of inverse kinematics, in a fixed order of branches: a range with `begin`, `end`, `size` and `empty`.
/// `most` is the largest number of solutions.
template <class Q>
class ik_answers {
 public:
  static constexpr std::size_t most = detail::raw_answers<double>::most;

  [[nodiscard]] const ik_answer<Q>* begin() const { return all_.data(); }
  [[nodiscard]] const ik_answer<Q>* end() const { return all_.data() + size_; }
  [[nodiscard]] std::size_t size() const { return size_; }
  [[nodiscard]] bool empty() const { return size_ == 0; }
  [[nodiscard]] const ik_answer<Q>& operator[](std::size_t i) const { return all_[i]; }
  /// Adds a solution at q.
  ik_answer<Q>& add(const Q& q) {
    all_[size_].q = q;
    return all_[size_++];
  }

 private:
  std::array<ik_answer<Q>, most> all_;
  std::size_t size_ = 0;
};

/// Tolerance of the pose of a tool for a solution to be exact: `position`, as a fraction of the reach of the arm, and
/// `rotation`, rad.
struct ik_tolerance {
  double position = 1e-9, rotation = 1e-9;
};

/// The axes of this arm have no closed-form inverse kinematics; what() states the deviation.
struct no_closed_form : error {
  using error::error;
};

}  // namespace kte
