/// Pinocchio on models made from the elements of kte's chains, compiled from its headers for this machine, as kte is.
/// In models that float, the quaternion is written in its order.
#include <pinocchio/algorithm/aba-derivatives.hpp>
#include <pinocchio/algorithm/aba.hpp>
#include <pinocchio/algorithm/center-of-mass.hpp>
#include <pinocchio/algorithm/centroidal.hpp>
#include <pinocchio/algorithm/crba.hpp>
#include <pinocchio/algorithm/energy.hpp>
#include <pinocchio/algorithm/frames.hpp>
#include <pinocchio/algorithm/kinematics.hpp>
#include <pinocchio/algorithm/regressor.hpp>
#include <pinocchio/algorithm/rnea-derivatives.hpp>
#include <pinocchio/algorithm/rnea.hpp>
#include <pinocchio/multibody.hpp>
#include <stdexcept>

#include "further_operations.hpp"
#include "models.hpp"
#include "panda_hyq.hpp"
#include "timing.hpp"

namespace bench::peers {
namespace {

namespace pin = pinocchio;

/// A frame of kte: where it is on a joint.
struct place {
  pin::JointIndex joint = 0;
  pin::SE3 placement = pin::SE3::Identity();
};

template <class Coordinates>
pin::JointIndex add_joint(pin::Model& model, const place& base, const Coordinates& joint, const std::string& name) {
  return model.addJoint(base.joint, joint, base.placement, name);
}
pin::JointIndex add_joint(pin::Model& model, const place& base, const std::string& type, const Eigen::Vector3d& axis,
                          const std::string& name) {
  if (type == "free_joint_3D") return add_joint(model, base, pin::JointModelFreeFlyer(), name);
  if (type == "prismatic_joint_3D") {
    if (axis.x() == 1) return add_joint(model, base, pin::JointModelPX(), name);
    if (axis.y() == 1) return add_joint(model, base, pin::JointModelPY(), name);
    if (axis.z() == 1) return add_joint(model, base, pin::JointModelPZ(), name);
    return add_joint(model, base, pin::JointModelPrismaticUnaligned(axis), name);
  }
  if (type != "revolute_joint_3D") throw std::runtime_error("bench: Pinocchio's models have no " + type);
  if (axis.x() == 1) return add_joint(model, base, pin::JointModelRX(), name);
  if (axis.y() == 1) return add_joint(model, base, pin::JointModelRY(), name);
  if (axis.z() == 1) return add_joint(model, base, pin::JointModelRZ(), name);
  return add_joint(model, base, pin::JointModelRevoluteUnaligned(axis), name);
}

pin::Model model_of(const kte::model_record& chain, const std::string& tool) {
  using vector = Eigen::Map<const Eigen::Vector3d>;
  pin::Model model;
  model.gravity.linear() = vector(chain.gravity.data());
  std::map<std::string, place> frames;
  for (const auto& e : chain.elements) {
    const auto to = [&](std::string_view role) -> const std::string& {
      return std::find_if(e.connections.begin(), e.connections.end(), [&](const auto& c) { return c.role == role; })
          ->name;
    };
    const auto numbers = [&](std::string_view name) {
      static const std::vector<double> none(3);
      const auto p =
          std::find_if(e.parameters.begin(), e.parameters.end(), [&](const auto& x) { return x.name == name; });
      return (p == e.parameters.end() ? none : p->values).data();
    };
    if (e.type == "inertia_3D") {
      const place& at = frames[to("frame")];
      const double* const i = numbers("inertia");
      Eigen::Matrix3d inertia;
      inertia << i[0], i[1], i[2], i[1], i[3], i[4], i[2], i[4], i[5];
      model.appendBodyToJoint(at.joint, pin::Inertia(*numbers("mass"), vector(numbers("com")), inertia), at.placement);
    } else if (e.type == "rigid_link_3D") {
      const place& base = frames[to("base")];
      using rows = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;
      const pin::SE3 link(Eigen::Map<const rows>(numbers("rotation")), vector(numbers("position")));
      frames[to("end")] = {base.joint, base.placement * link};
    } else {
      frames[to("end")] = {add_joint(model, frames[to("base")], e.type, vector(numbers("axis")), to("coordinate"))};
    }
  }
  const place& at = frames[tool];
  model.addFrame(pin::Frame("tool", at.joint, at.placement, pin::OP_FRAME));
  return model;
}

template <class Model>
struct pinocchio_calls {
  using matrix = Eigen::Map<Eigen::MatrixXd>;

  struct subject {
    pin::Model model = model_of(kte::record_of(Model::chain), std::string(Model::tool.name));
    pin::Data data{model};
    pin::FrameIndex tool = model.getFrameId("tool");
    Eigen::Index n = model.nv;
    bool floats = model.nq > n;
    Eigen::VectorXd q{model.nq}, v{n}, a{n};
    Eigen::MatrixXd columns = Eigen::MatrixXd::Zero(6, n);

    void take_q(const double* x) {
      std::copy_n(x, model.nq, q.data());
      if (floats) std::rotate(q.data() + 3, q.data() + 4, q.data() + 7);  // w x y z to x y z w
    }
    void take_q_v(const double* x) { take_q(x), std::copy_n(x + model.nq, n, v.data()); }
    void take_q_v_a(const double* x) { take_q_v(x), std::copy_n(x + model.nq + n, n, a.data()); }
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
  /// By rows, from the diagonal on: Pinocchio writes the upper triangle only.
  static void put_upper(const Eigen::MatrixXd& m, double* y) {
    for (Eigen::Index i = 0; i < m.rows(); ++i)
      for (Eigen::Index j = i; j < m.cols(); ++j) *y++ = m(i, j);
  }
  template <class Matrix>
  static double* put_symmetric(const Matrix& m, double* y) {
    matrix(y, m.rows(), m.cols()) = m.template selfadjointView<Eigen::Upper>();
    return y + m.size();
  }

  static void put_pose(const pin::SE3& t, double* y) {
    Eigen::Map<Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(y, 3, 3) = t.rotation();
    Eigen::Map<Eigen::Vector3d>(y + 9, 3) = t.translation();
  }

  static void inverse_dynamics(const double* x, double* y) {
    auto& s = made();
    s.take_q_v_a(x);
    put(pin::rnea(s.model, s.data, s.q, s.v, s.a), y);
  }
  static void nonlinear_effects(const double* x, double* y) {
    auto& s = made();
    s.take_q_v(x);
    put(pin::nonLinearEffects(s.model, s.data, s.q, s.v), y);
  }
  static void forward_dynamics(const double* x, double* y) {
    auto& s = made();
    s.take_q_v_a(x);
    put(pin::aba(s.model, s.data, s.q, s.v, s.a), y);
  }
  static void mass_matrix(const double* x, double* y) {
    auto& s = made();
    s.take_q(x);
    pin::crba(s.model, s.data, s.q);
    put_upper(s.data.M, y);
  }
  static void mass_matrix_inverse(const double* x, double* y) {
    auto& s = made();
    s.take_q(x);
    pin::computeMinverse(s.model, s.data, s.q);
    put_symmetric(s.data.Minv, y);
  }
  static void id_derivatives(const double* x, double* y) {
    auto& s = made();
    s.take_q_v_a(x);
    pin::computeRNEADerivatives(s.model, s.data, s.q, s.v, s.a);
    put_symmetric(s.data.M, put_matrix(s.data.dtau_dv, put_matrix(s.data.dtau_dq, put(s.data.tau, y))));
  }
  static void fd_derivatives(const double* x, double* y) {
    auto& s = made();
    s.take_q_v_a(x);
    pin::computeABADerivatives(s.model, s.data, s.q, s.v, s.a);
    put_symmetric(s.data.Minv, put_matrix(s.data.ddq_dv, put_matrix(s.data.ddq_dq, put(s.data.ddq, y))));
  }
  static void forward_kinematics(const double* x, double* y) {
    auto& s = made();
    s.take_q(x);
    pin::forwardKinematics(s.model, s.data, s.q);
    put_pose(pin::updateFramePlacement(s.model, s.data, s.tool), y);
  }
  static void jacobian(const double* x, double* y) {
    auto& s = made();
    s.take_q(x);
    pin::computeFrameJacobian(s.model, s.data, s.q, s.tool, pin::LOCAL_WORLD_ALIGNED, s.columns);
    put_matrix(s.columns, y);
  }
  static void regressor(const double* x, double* y) {
    auto& s = made();
    s.take_q_v_a(x);
    put_matrix(pin::computeJointTorqueRegressor(s.model, s.data, s.q, s.v, s.a), y);
  }
  static void frames(const double* x, double* y) {
    auto& s = made();
    s.take_q(x);
    pin::framesForwardKinematics(s.model, s.data, s.q);
    put_pose(s.data.oMf[s.tool], y);
  }
  static void kinetic_energy(const double* x, double* y) {
    auto& s = made();
    s.take_q_v(x);
    *y = pin::computeKineticEnergy(s.model, s.data, s.q, s.v);
  }
  static void potential_energy(const double* x, double* y) {
    auto& s = made();
    s.take_q(x);
    *y = pin::computePotentialEnergy(s.model, s.data, s.q);
  }
  static void gravity_forces(const double* x, double* y) {
    auto& s = made();
    s.take_q(x);
    put(pin::computeGeneralizedGravity(s.model, s.data, s.q), y);
  }
  static void coriolis_matrix(const double* x, double* y) {
    auto& s = made();
    s.take_q_v(x);
    Eigen::Map<Eigen::VectorXd>(y, s.n).noalias() = pin::computeCoriolisMatrix(s.model, s.data, s.q, s.v) * s.v;
  }
  static void jacobian_rate(const double* x, double* y) {
    auto& s = made();
    s.take_q_v(x);
    pin::computeJointJacobiansTimeVariation(s.model, s.data, s.q, s.v);
    pin::updateFramePlacement(s.model, s.data, s.tool);
    s.columns.setZero();
    pin::getFrameJacobianTimeVariation(s.model, s.data, s.tool, pin::LOCAL_WORLD_ALIGNED, s.columns);
    put_matrix(s.columns, y);
  }
  static void com_jacobian(const double* x, double* y) {
    auto& s = made();
    s.take_q(x);
    put_matrix(pin::jacobianCenterOfMass(s.model, s.data, s.q, false), y);
  }
  static void momentum_matrix(const double* x, double* y) {
    auto& s = made();
    s.take_q(x);
    put_matrix(pin::computeCentroidalMap(s.model, s.data, s.q), y);
  }
  static void momentum_rate(const double* x, double* y) {
    auto& s = made();
    s.take_q_v_a(x);
    const auto& h = pin::computeCentroidalMomentumTimeVariation(s.model, s.data, s.q, s.v, s.a);
    Eigen::Map<Eigen::Matrix<double, 6, 1>>(y, 6) = h.toVector();
  }
};

/// `all`: also operations with references for few robots.
template <class Model>
void add_model(bool all) {
  using calls = pinocchio_calls<Model>;
  const auto add = [](operation o, call<double> f, triangle t = triangle::both) {
    bench::add(o, "pinocchio", Model::name, f, 1, t);
  };
  add(operation::inverse_dynamics, calls::inverse_dynamics);
  add(operation::mass_matrix, calls::mass_matrix, triangle::upper);
  add(operation::forward_dynamics, calls::forward_dynamics);
  if (!all) return;
  add(operation::forward_kinematics, calls::forward_kinematics);
  add(operation::jacobian, calls::jacobian);
  add(operation::mass_matrix_inverse, calls::mass_matrix_inverse);
  add(operation::nonlinear_effects, calls::nonlinear_effects);
  add(operation::id_derivatives, calls::id_derivatives);
  add(operation::fd_derivatives, calls::fd_derivatives);
}

const registered here{[] {
  add_model<iiwa14>(true);
  add_model<ur5>(true);
  add_model<solo12>(true);
  add_model<serial<8>>(true);
  add_model<serial<32>>(true);
  add_model<serial<128>>(false);
  add_further<pinocchio_calls<iiwa14>>("pinocchio", iiwa14::name);
  add_further<pinocchio_calls<ur5>>("pinocchio", ur5::name);
  add_further<pinocchio_calls<serial<8>>>("pinocchio", serial<8>::name);
  add_further<pinocchio_calls<serial<32>>>("pinocchio", serial<32>::name);
  add_further<pinocchio_calls<serial<128>>>("pinocchio", serial<128>::name);
  add(operation::regressor, "pinocchio", iiwa14::name, pinocchio_calls<iiwa14>::regressor);
  add_model<panda>(false);
  add_model<hyq>(false);
}};

}  // namespace
}  // namespace bench::peers
