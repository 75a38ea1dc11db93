/// Orocos KDL: recursive Newton-Euler, composite bodies; forward dynamics by the mass matrix.
#include <algorithm>
#include <kdl/chain.hpp>
#include <kdl/chaindynparam.hpp>
#include <kdl/chainfdsolver_recursive_newton_euler.hpp>
#include <kdl/chainfksolverpos_recursive.hpp>
#include <kdl/chainidsolver_recursive_newton_euler.hpp>
#include <kdl/chainjnttojacsolver.hpp>

#include "peer.hpp"

namespace bench::peers {
namespace {

KDL::Vector vector(const Eigen::Vector3d& v) { return {v[0], v[1], v[2]}; }
KDL::Frame frame(const Eigen::Matrix3d& r, const Eigen::Vector3d& p) {
  return {KDL::Rotation(r(0, 0), r(0, 1), r(0, 2), r(1, 0), r(1, 1), r(1, 2), r(2, 0), r(2, 1), r(2, 2)), vector(p)};
}

/// A segment a link; its joint is given in the frame of the segment before.
KDL::Chain chain_of(const serial_robot& robot) {
  KDL::Chain c;
  for (const auto& l : robot.links) {
    const auto& j = l.inertia;
    const KDL::RotationalInertia inertia(j(0, 0), j(1, 1), j(2, 2), j(0, 1), j(0, 2), j(1, 2));
    c.addSegment(KDL::Segment(KDL::Joint("", vector(l.position), vector(l.rotation * l.axis), KDL::Joint::RotAxis),
                              frame(l.rotation, l.position), KDL::RigidBodyInertia(l.mass, vector(l.com), inertia)));
  }
  return c;
}
KDL::Chain with_tool(KDL::Chain c, const serial_robot& robot) {
  c.addSegment(KDL::Segment(KDL::Joint(KDL::Joint::None), frame(robot.tool_rotation, robot.tool_position)));
  return c;
}

template <int M>
struct kdl {
  static constexpr auto how = "kdl";

  struct subject {
    serial_robot robot = robot_of(models[M]);
    unsigned n = static_cast<unsigned>(robot.links.size());
    KDL::Chain chain = chain_of(robot), to_tool = with_tool(chain, robot);
    KDL::ChainIdSolver_RNE rne{chain, vector(robot.gravity)};
    KDL::ChainFdSolver_RNE fd{chain, vector(robot.gravity)};
    KDL::ChainDynParam dynamics{chain, vector(robot.gravity)};
    KDL::ChainFkSolverPos_recursive fk{to_tool};
    KDL::ChainJntToJacSolver jacobian{to_tool};
    KDL::JntArray q{n}, v{n}, a{n}, tau{n};
    KDL::JntSpaceInertiaMatrix m{static_cast<int>(n)};
    KDL::Jacobian j{n};
    KDL::Wrenches none{n, KDL::Wrench::Zero()};
  };
  static subject& made() {
    static subject s;
    return s;
  }
  static void put(KDL::JntArray& to, const double* x) { std::copy_n(x, to.rows(), to.data.data()); }

  [[gnu::noinline]] static void inverse_dynamics(const double* x, double* y) {
    auto& s = made();
    put(s.q, x), put(s.v, x + s.n), put(s.a, x + 2 * s.n);
    s.rne.CartToJnt(s.q, s.v, s.a, s.none, s.tau);
    std::copy_n(s.tau.data.data(), s.n, y);
  }
  [[gnu::noinline]] static void forward_dynamics(const double* x, double* y) {
    auto& s = made();
    put(s.q, x), put(s.v, x + s.n), put(s.tau, x + 2 * s.n);
    s.fd.CartToJnt(s.q, s.v, s.tau, s.none, s.a);
    std::copy_n(s.a.data.data(), s.n, y);
  }
  [[gnu::noinline]] static void mass_matrix(const double* x, double* y) {
    auto& s = made();
    put(s.q, x);
    s.dynamics.JntToMass(s.q, s.m);
    std::copy_n(s.m.data.data(), s.n * s.n, y);
  }
  [[gnu::noinline]] static void forward_kinematics(const double* x, double* y) {
    auto& s = made();
    put(s.q, x);
    KDL::Frame f;
    s.fk.JntToCart(s.q, f);
    std::copy_n(f.p.data, 3, std::copy_n(f.M.data, 9, y));
  }
  [[gnu::noinline]] static void jacobian(const double* x, double* y) {
    auto& s = made();
    put(s.q, x);
    s.jacobian.JntToJac(s.q, s.j);
    std::copy_n(s.j.data.data(), 6 * s.n, y);
  }
};

const registered here{add_all<kdl>};

}  // namespace
}  // namespace bench::peers
