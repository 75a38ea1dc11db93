#pragma once

#include <kte/manipulators/detail/solve_closed_form.hpp>
#include <kte/manipulators/unreachable.hpp>
#include <kte/models/joint_limits.hpp>

namespace kte {

/// One posture by which an arm answers a pose.
template <class Q>
struct ik_answer {
  using scalar = value_of<Q>;

  Q q;                    ///< a configuration of the chain
  unsigned branch = 0;    ///< bits: 1 shoulder, 2 elbow, 4 wrist; higher ones where there are more answers
  scalar position{};      ///< m that the tool is away, by forward kinematics
  scalar rotation{};      ///< rad
  truth<scalar> exact{};  ///< whether these are within the tolerance; else it is an answer of least squares
  truth<scalar> within_limits{};
  /// Bit i: coordinate i of v could have been anything here (singular); it is as in the seed, or 0. Of packs for each
  /// lane.
  detail::for_each_lane<scalar, unsigned> free{};
};

/// All answers, in a fixed order of branches: a range.
template <class Q>
class ik_answers {
 public:
  static constexpr std::size_t most = detail::raw_answers<double>::most;

  const ik_answer<Q>* begin() const { return all_.data(); }
  const ik_answer<Q>* end() const { return all_.data() + size_; }
  std::size_t size() const { return size_; }
  bool empty() const { return size_ == 0; }
  const ik_answer<Q>& operator[](std::size_t i) const { return all_[i]; }
  /// One more, at `q` so far.
  ik_answer<Q>& add(const Q& q) {
    all_[size_].q = q;
    return all_[size_++];
  }

 private:
  std::array<ik_answer<Q>, most> all_;
  std::size_t size_ = 0;
};

/// How near a tool must be for an answer to be called exact: of the reach of the arm, and rad.
struct ik_tolerance {
  double position = 1e-9, rotation = 1e-9;
};

/// The axes of this arm are none of those of which the inverse kinematics is closed form; what() says by how much.
struct no_closed_form : error {
  using error::error;
};

}  // namespace kte
