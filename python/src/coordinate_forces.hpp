#pragma once

#include <kte/runtime_chain/runtime_chain.hpp>

#include <string>
#include <vector>

namespace kte_python {

/// Forces tau on all degrees of freedom of a chain, as inputs that it gets: of a number by a `driving_actuator_gen`, of
/// a rotation or pose by a wrench on the end of its joint, and the opposite one on its base if that moves.
class coordinate_forces {
 public:
  coordinate_forces() = default;
  /// Adds them to the chain. Throws `bad_argument` for a rotation or pose by which no joint moves a frame.
  explicit coordinate_forces(kte::runtime_chain& c);
  /// Whether they depend on tau alone, not on the configuration.
  bool of_tau_alone() const;
  /// Puts them into the inputs u.
  void put(const Eigen::VectorXd& tau, const Eigen::VectorXd& q, Eigen::VectorXd& u) const;

 private:
  /// Where a wrench is in u.
  struct wrench_input {
    Eigen::Index force = -1, torque = -1;
  };
  struct coordinate {
    kte::kind what{};
    Eigen::Index q = 0, v = 0;
    Eigen::Index u = -1;  ///< of a number
    bool planar = false;
    wrench_input end, base;                                  ///< in axes of these frames; base.force < 0: there is none
    Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();  ///< the placement of the joint in its base
    Eigen::Vector3d position = Eigen::Vector3d::Zero();
  };
  static void put_wrench(const Eigen::Vector3d& f, const Eigen::Vector3d& t, const wrench_input& at, bool planar,
                         Eigen::VectorXd& u);

  std::vector<coordinate> all_;
};

}  // namespace kte_python
