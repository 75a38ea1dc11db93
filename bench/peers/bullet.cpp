/// Bullet: articulated bodies of its multibody class, in double precision. Its separate library of inverse dynamics is
/// packaged without its main header, so there is no more to time.
#include <Eigen/Eigenvalues>

#include <BulletDynamics/Featherstone/btMultiBody.h>
#include <memory>
#include <vector>

#include "peer.hpp"

namespace bench::peers {
namespace {

btVector3 vector(const Eigen::Vector3d& v) { return {v[0], v[1], v[2]}; }
btQuaternion quaternion(const Eigen::Matrix3d& r) {
  const Eigen::Quaterniond q(r);
  return {q.x(), q.y(), q.z(), q.w()};
}

/// Axes in which the inertia of a body is diagonal: those of the link where it is so already.
Eigen::Matrix3d principal_axes(const Eigen::Matrix3d& inertia) {
  if (inertia.isDiagonal(0)) return Eigen::Matrix3d::Identity();
  Eigen::Matrix3d axes = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(inertia).eigenvectors();
  if (axes.determinant() < 0) axes.col(0) *= -1;
  return axes;
}

std::unique_ptr<btMultiBody> body_of(const serial_robot& robot) {
  auto body = std::make_unique<btMultiBody>(static_cast<int>(robot.links.size()), 0, btVector3(0, 0, 0), true, false);
  Eigen::Matrix3d parent = Eigen::Matrix3d::Identity();
  Eigen::Vector3d parent_com = Eigen::Vector3d::Zero();
  int i = 0;
  for (const auto& l : robot.links) {
    const Eigen::Matrix3d axes = principal_axes(l.inertia), to_axes = axes.transpose();
    body->setupRevolute(i, l.mass, vector((to_axes * l.inertia * axes).diagonal()), i - 1,
                        quaternion(to_axes * l.rotation.transpose() * parent), vector(to_axes * l.axis),
                        vector(parent.transpose() * (l.position - parent_com)), vector(to_axes * l.com));
    parent = axes, parent_com = l.com, ++i;
  }
  body->finalizeMultiDof();
  body->setLinearDamping(0), body->setAngularDamping(0);
  body->setMaxCoordinateVelocity(1e30);
  return body;
}

template <int M>
struct bullet {
  static constexpr auto how = "bullet";

  struct subject {
    serial_robot robot = robot_of(models[M]);
    std::unique_ptr<btMultiBody> body = body_of(robot);
    int n = body->getNumLinks();
    btAlignedObjectArray<btScalar> r;
    btAlignedObjectArray<btVector3> v;
    btAlignedObjectArray<btMatrix3x3> m;
  };
  static subject& made() {
    static subject s;
    return s;
  }
  /// A step of 1 s adds the accelerations to the velocities.
  [[gnu::noinline]] static void forward_dynamics(const double* x, double* y) {
    auto& s = made();
    s.body->clearForcesAndTorques();
    for (int i = 0; i < s.n; ++i) {
      s.body->setJointPos(i, x[i]), s.body->setJointVel(i, x[s.n + i]);
      s.body->addJointTorque(i, x[2 * s.n + i]);
      s.body->addLinkForce(i, s.body->getLinkMass(i) * vector(s.robot.gravity));
    }
    s.body->computeAccelerationsArticulatedBodyAlgorithmMultiDof(1, s.r, s.v, s.m, false, false, false);
    for (int i = 0; i < s.n; ++i) y[i] = s.body->getJointVel(i) - x[s.n + i];
  }
};

const registered here{add_all<bullet>};

}  // namespace
}  // namespace bench::peers
