/// Orocos KDL: numerical inverse kinematics from a random start, by Levenberg-Marquardt, which knows no limits, and by
/// Newton-Raphson within limits. To the tolerance of kte's `numerical_inverse_kinematics`, m and rad alike (but
/// rotations below 1e-6 rad are none to KDL); numbers of iterations as KDL has them.
#include <algorithm>
#include <kdl/chain.hpp>
#include <kdl/chainfksolverpos_recursive.hpp>
#include <kdl/chainiksolverpos_lma.hpp>
#include <kdl/chainiksolverpos_nr_jl.hpp>
#include <kdl/chainiksolvervel_pinv.hpp>

#include "arm_timing.hpp"

namespace bench::peers {
namespace {

constexpr const char* arms[]{"3R3R", "ur5", "iiwa14"};

KDL::Vector vector(const kte::vec3<>& v) { return {v.x, v.y, v.z}; }

/// All frames but the last are that of the base where q = 0.
KDL::Chain chain_of(const arm_numbers& arm) {
  KDL::Chain c;
  const auto& g = arm.geometry;
  for (std::size_t i = 0; i < arm.lower.size(); ++i)
    c.addSegment(KDL::Segment(KDL::Joint("", vector(g.point[i]), vector(g.axis[i]), KDL::Joint::RotAxis)));
  const auto& r = g.tool.rotation;
  const KDL::Rotation R(r.x.x, r.x.y, r.x.z, r.y.x, r.y.y, r.y.z, r.z.x, r.z.y, r.z.z);
  c.addSegment(KDL::Segment(KDL::Joint(KDL::Joint::None), KDL::Frame(R, vector(g.tool.position))));
  return c;
}
KDL::JntArray array_of(const std::vector<double>& numbers) {
  KDL::JntArray a(static_cast<unsigned>(numbers.size()));
  std::copy(numbers.begin(), numbers.end(), a.data.data());
  return a;
}

template <int M>
struct kdl_arm {
  struct subject {
    const arm_numbers& arm = arm_of(arms[M]);
    double tolerance = 1e-9;
    KDL::Chain chain = chain_of(arm);
    KDL::ChainFkSolverPos_recursive fk{chain};
    KDL::ChainIkSolverVel_pinv rates{chain};
    KDL::ChainIkSolverPos_LMA lma{chain, Eigen::Matrix<double, 6, 1>::Ones(), tolerance};
    KDL::ChainIkSolverPos_NR_JL newton{chain, array_of(arm.lower), array_of(arm.upper), fk, rates, 100, tolerance};
    KDL::JntArray start{chain.getNrOfJoints()}, q{start};
  };
  static subject& made() {
    static subject s;
    return s;
  }
  template <class Solver>
  static int solve(subject& s, Solver& solver, const arm_question& x, double* q) {
    KDL::Frame pose;
    std::copy_n(x.rotation, 9, pose.M.data), std::copy_n(x.position, 3, pose.p.data);
    std::copy_n(x.start, s.start.rows(), s.start.data.data());
    const bool reached = solver.CartToJnt(s.start, pose, s.q) >= 0;
    std::copy_n(s.q.data.data(), s.q.rows(), q);
    return reached;
  }
  [[gnu::noinline]] static void lma(const arm_question* x, double* q, int* count) {
    *count = solve(made(), made().lma, *x, q);
  }
  [[gnu::noinline]] static void newton(const arm_question* x, double* q, int* count) {
    *count = solve(made(), made().newton, *x, q);
  }
  static void add() {
    add_arm("numeric_kdl_lma", arms[M], answer_kind::any, lma);
    add_arm("numeric_kdl_nr_jl", arms[M], answer_kind::any, newton);
  }
};
const registered here{[] { kdl_arm<0>::add(), kdl_arm<1>::add(), kdl_arm<2>::add(); }};

}  // namespace
}  // namespace bench::peers
