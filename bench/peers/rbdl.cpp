/// RBDL: recursive Newton-Euler, composite and articulated bodies.
#include <algorithm>
#include <rbdl/rbdl.h>

#include "peer.hpp"

namespace bench::peers {
namespace {

using RigidBodyDynamics::Math::MatrixNd, RigidBodyDynamics::Math::VectorNd;

template <int M>
struct rbdl_calls {
  static constexpr auto how = "rbdl";

  struct subject {
    subject() {
      const auto robot = robot_of(models[M]);
      model.gravity = robot.gravity;
      for (const auto& l : robot.links)
        last = model.AddBody(last, RigidBodyDynamics::Math::SpatialTransform(l.rotation.transpose(), l.position),
                             RigidBodyDynamics::Joint(RigidBodyDynamics::JointTypeRevolute, l.axis),
                             RigidBodyDynamics::Body(l.mass, l.com, l.inertia));
      n = model.dof_count;
      tool_rotation = robot.tool_rotation, tool_position = robot.tool_position;
      q = v = a = tau = VectorNd::Zero(n), mass = MatrixNd::Zero(n, n), columns = MatrixNd::Zero(6, n);
    }
    RigidBodyDynamics::Model model;
    unsigned int last = 0;
    Eigen::Index n;
    RigidBodyDynamics::Math::Matrix3d tool_rotation;
    RigidBodyDynamics::Math::Vector3d tool_position;
    VectorNd q, v, a, tau;
    MatrixNd mass, columns;
  };
  static subject& made() {
    static subject s;
    return s;
  }
  static void take(const double* x, Eigen::Index n, VectorNd& to) { to = Eigen::Map<const Eigen::VectorXd>(x, n); }

  [[gnu::noinline]] static void inverse_dynamics(const double* x, double* y) {
    auto& s = made();
    take(x, s.n, s.q), take(x + s.n, s.n, s.v), take(x + 2 * s.n, s.n, s.a);
    RigidBodyDynamics::InverseDynamics(s.model, s.q, s.v, s.a, s.tau);
    std::copy_n(s.tau.data(), s.n, y);
  }
  [[gnu::noinline]] static void forward_dynamics(const double* x, double* y) {
    auto& s = made();
    take(x, s.n, s.q), take(x + s.n, s.n, s.v), take(x + 2 * s.n, s.n, s.tau);
    RigidBodyDynamics::ForwardDynamics(s.model, s.q, s.v, s.tau, s.a);
    std::copy_n(s.a.data(), s.n, y);
  }
  /// It writes what is not zero.
  [[gnu::noinline]] static void mass_matrix(const double* x, double* y) {
    auto& s = made();
    take(x, s.n, s.q);
    RigidBodyDynamics::CompositeRigidBodyAlgorithm(s.model, s.q, s.mass);
    std::copy_n(s.mass.data(), s.mass.size(), y);
  }
  [[gnu::noinline]] static void forward_kinematics(const double* x, double* y) {
    auto& s = made();
    take(x, s.n, s.q);
    Eigen::Map<Eigen::Vector3d>(y + 9, 3) =
        RigidBodyDynamics::CalcBodyToBaseCoordinates(s.model, s.q, s.last, s.tool_position);
    Eigen::Map<Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(y, 3, 3) =
        RigidBodyDynamics::CalcBodyWorldOrientation(s.model, s.q, s.last, false).transpose() * s.tool_rotation;
  }
  [[gnu::noinline]] static void jacobian(const double* x, double* y) {
    auto& s = made();
    take(x, s.n, s.q);
    RigidBodyDynamics::CalcPointJacobian6D(s.model, s.q, s.last, s.tool_position, s.columns);  // angular part first
    Eigen::Map<Eigen::MatrixXd> out(y, 6, s.n);
    out.topRows(3) = s.columns.bottomRows(3), out.bottomRows(3) = s.columns.topRows(3);
  }
};

const registered here{add_all<rbdl_calls>};

}  // namespace
}  // namespace bench::peers
