/// Pinocchio: each operation by its algorithm, on a model with joints about unit axes where they are such.
#include <algorithm>
#include <pinocchio/algorithm/aba-derivatives.hpp>
#include <pinocchio/algorithm/aba.hpp>
#include <pinocchio/algorithm/crba.hpp>
#include <pinocchio/algorithm/frames.hpp>
#include <pinocchio/algorithm/kinematics.hpp>
#include <pinocchio/algorithm/rnea-derivatives.hpp>
#include <pinocchio/algorithm/rnea.hpp>
#include <pinocchio/multibody/data.hpp>
#include <pinocchio/multibody/model.hpp>

#include "peer.hpp"

namespace bench::peers {
namespace {

namespace pin = pinocchio;

pin::JointIndex add_joint(pin::Model& model, pin::JointIndex parent, const Eigen::Vector3d& axis,
                          const pin::SE3& placement, const std::string& name) {
  if (axis == Eigen::Vector3d::UnitX()) return model.addJoint(parent, pin::JointModelRX(), placement, name);
  if (axis == Eigen::Vector3d::UnitY()) return model.addJoint(parent, pin::JointModelRY(), placement, name);
  if (axis == Eigen::Vector3d::UnitZ()) return model.addJoint(parent, pin::JointModelRZ(), placement, name);
  return model.addJoint(parent, pin::JointModelRevoluteUnaligned(axis), placement, name);
}

pin::Model model_of(const serial_robot& robot) {
  pin::Model model;
  model.gravity.linear() = robot.gravity;
  pin::JointIndex last = 0;
  for (const auto& l : robot.links) {
    last = add_joint(model, last, l.axis, pin::SE3(l.rotation, l.position), "joint" + std::to_string(last));
    model.appendBodyToJoint(last, pin::Inertia(l.mass, l.com, l.inertia), pin::SE3::Identity());
  }
  const auto parent = static_cast<pin::FrameIndex>(model.addJointFrame(last));
  model.addFrame(pin::Frame("tool", last, parent, pin::SE3(robot.tool_rotation, robot.tool_position), pin::OP_FRAME));
  return model;
}

template <int M>
struct pinocchio_calls {
  static constexpr auto how = "pinocchio";
  using vector = Eigen::Map<const Eigen::VectorXd>;
  using matrix = Eigen::Map<Eigen::MatrixXd>;

  struct subject {
    pin::Model model = model_of(robot_of(models[M]));
    pin::Data data{model};
    pin::FrameIndex tool = model.getFrameId("tool");
    Eigen::Index n = model.nv;
    Eigen::MatrixXd columns = Eigen::MatrixXd::Zero(6, n);
  };
  static subject& made() {
    static subject s;
    return s;
  }
  static double* put(const Eigen::VectorXd& x, double* y) { return std::copy_n(x.data(), x.size(), y); }
  template <class Matrix>
  static double* put_matrix(const Matrix& m, double* y) {
    matrix(y, m.rows(), m.cols()) = m;
    return y + m.size();
  }
  /// Pinocchio writes the upper triangle only.
  template <class Matrix>
  static double* put_symmetric(const Matrix& m, double* y) {
    matrix(y, m.rows(), m.cols()) = m.template selfadjointView<Eigen::Upper>();
    return y + m.size();
  }

  [[gnu::noinline]] static void inverse_dynamics(const double* x, double* y) {
    auto& s = made();
    put(pin::rnea(s.model, s.data, vector(x, s.n), vector(x + s.n, s.n), vector(x + 2 * s.n, s.n)), y);
  }
  [[gnu::noinline]] static void forward_dynamics(const double* x, double* y) {
    auto& s = made();
    put(pin::aba(s.model, s.data, vector(x, s.n), vector(x + s.n, s.n), vector(x + 2 * s.n, s.n)), y);
  }
  [[gnu::noinline]] static void mass_matrix(const double* x, double* y) {
    auto& s = made();
    pin::crba(s.model, s.data, vector(x, s.n));
    put_symmetric(s.data.M, y);
  }
  [[gnu::noinline]] static void mass_matrix_inverse(const double* x, double* y) {
    auto& s = made();
    pin::computeMinverse(s.model, s.data, vector(x, s.n));
    put_symmetric(s.data.Minv, y);
  }
  [[gnu::noinline]] static void id_derivatives(const double* x, double* y) {
    auto& s = made();
    pin::computeRNEADerivatives(s.model, s.data, vector(x, s.n), vector(x + s.n, s.n), vector(x + 2 * s.n, s.n));
    put_symmetric(s.data.M, put_matrix(s.data.dtau_dv, put_matrix(s.data.dtau_dq, put(s.data.tau, y))));
  }
  [[gnu::noinline]] static void fd_derivatives(const double* x, double* y) {
    auto& s = made();
    pin::computeABADerivatives(s.model, s.data, vector(x, s.n), vector(x + s.n, s.n), vector(x + 2 * s.n, s.n));
    put_symmetric(s.data.Minv, put_matrix(s.data.ddq_dv, put_matrix(s.data.ddq_dq, put(s.data.ddq, y))));
  }
  [[gnu::noinline]] static void forward_kinematics(const double* x, double* y) {
    auto& s = made();
    pin::forwardKinematics(s.model, s.data, vector(x, s.n));
    const pin::SE3& t = pin::updateFramePlacement(s.model, s.data, s.tool);
    Eigen::Map<Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(y, 3, 3) = t.rotation();
    Eigen::Map<Eigen::Vector3d>(y + 9, 3) = t.translation();
  }
  [[gnu::noinline]] static void jacobian(const double* x, double* y) {
    auto& s = made();
    pin::computeFrameJacobian(s.model, s.data, vector(x, s.n), s.tool, pin::LOCAL_WORLD_ALIGNED, s.columns);
    put_matrix(s.columns, y);
  }
};

const registered here{add_all<pinocchio_calls>};

}  // namespace
}  // namespace bench::peers
