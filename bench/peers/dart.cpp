/// DART: recursive Newton-Euler, articulated bodies; its mass matrix is that of the skeleton, as it offers no other.
#include <algorithm>
#include <dart/dynamics/BodyNode.hpp>
#include <dart/dynamics/RevoluteJoint.hpp>
#include <dart/dynamics/Skeleton.hpp>

#include "peer.hpp"

namespace bench::peers {
namespace {

Eigen::Isometry3d pose(const Eigen::Matrix3d& r, const Eigen::Vector3d& p) {
  Eigen::Isometry3d t = Eigen::Isometry3d::Identity();
  t.linear() = r, t.translation() = p;
  return t;
}

dart::dynamics::SkeletonPtr skeleton_of(const serial_robot& robot) {
  using namespace dart::dynamics;
  const auto skeleton = Skeleton::create();
  skeleton->setGravity(robot.gravity);
  BodyNode* parent = nullptr;
  for (const auto& l : robot.links) {
    RevoluteJoint::Properties joint;
    joint.mName = "joint" + std::to_string(skeleton->getNumBodyNodes());
    joint.mAxis = l.axis, joint.mT_ParentBodyToJoint = pose(l.rotation, l.position);
    BodyNode::Properties body;
    body.mName = "link" + std::to_string(skeleton->getNumBodyNodes());
    body.mInertia = Inertia(l.mass, l.com, l.inertia);
    parent = skeleton->createJointAndBodyNodePair<RevoluteJoint>(parent, joint, body).second;
  }
  return skeleton;
}

template <int M>
struct dart6 {
  static constexpr auto how = "dart";
  /// It complains about bodies without rotational inertia.
  static bool builds(const std::string& model) { return model != "pendulum"; }
  using vector = Eigen::Map<const Eigen::VectorXd>;

  struct subject {
    serial_robot robot = robot_of(models[M]);
    dart::dynamics::SkeletonPtr skeleton = skeleton_of(robot);
    Eigen::Index n = static_cast<Eigen::Index>(robot.links.size());
    dart::dynamics::BodyNode* last = skeleton->getBodyNode(skeleton->getNumBodyNodes() - 1);
    Eigen::Isometry3d tool = pose(robot.tool_rotation, robot.tool_position);
  };
  static subject& made() {
    static subject s;
    return s;
  }
  static void copy(const Eigen::VectorXd& x, double* y) { std::copy_n(x.data(), x.size(), y); }

  [[gnu::noinline]] static void inverse_dynamics(const double* x, double* y) {
    auto& s = made();
    s.skeleton->setPositions(vector(x, s.n)), s.skeleton->setVelocities(vector(x + s.n, s.n));
    s.skeleton->setAccelerations(vector(x + 2 * s.n, s.n));
    s.skeleton->computeInverseDynamics();
    copy(s.skeleton->getForces(), y);
  }
  [[gnu::noinline]] static void forward_dynamics(const double* x, double* y) {
    auto& s = made();
    s.skeleton->setPositions(vector(x, s.n)), s.skeleton->setVelocities(vector(x + s.n, s.n));
    s.skeleton->setForces(vector(x + 2 * s.n, s.n));
    s.skeleton->computeForwardDynamics();
    copy(s.skeleton->getAccelerations(), y);
  }
  [[gnu::noinline]] static void mass_matrix(const double* x, double* y) {
    auto& s = made();
    s.skeleton->setPositions(vector(x, s.n));
    const auto& m = s.skeleton->getMassMatrix();
    std::copy_n(m.data(), m.size(), y);
  }
  [[gnu::noinline]] static void forward_kinematics(const double* x, double* y) {
    auto& s = made();
    s.skeleton->setPositions(vector(x, s.n));
    const Eigen::Isometry3d t = s.last->getTransform() * s.tool;
    Eigen::Map<Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(y, 3, 3) = t.linear();
    Eigen::Map<Eigen::Vector3d>(y + 9, 3) = t.translation();
  }
  [[gnu::noinline]] static void jacobian(const double* x, double* y) {
    auto& s = made();
    s.skeleton->setPositions(vector(x, s.n));
    const auto j = s.skeleton->getWorldJacobian(s.last, s.tool.translation());  // angular part first
    Eigen::Map<Eigen::MatrixXd> out(y, 6, s.n);
    out.topRows(3) = j.bottomRows(3), out.bottomRows(3) = j.topRows(3);
  }
};

const registered here{add_all<dart6>};

}  // namespace
}  // namespace bench::peers
