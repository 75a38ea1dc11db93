#include <kte/dynamics/configuration_space.hpp>
#include <kte/dynamics/forward_kinematics.hpp>
#include <kte/dynamics/inverse_dynamics.hpp>
#include <kte/dynamics/mass_matrix.hpp>
#include <kte/robots/load_robot.hpp>
#include <kte/robots/mjcf_writer.hpp>
#include <kte/runtime_chain/runtime_chain.hpp>

#include <Eigen/Geometry>

#include <fstream>
#include <memory>
#include <mujoco/mujoco.h>

#include "catch.hpp"
#include "robots/files.hpp"

namespace mujoco_test {

using namespace kte;
using test::robot_file;

using model = std::unique_ptr<mjModel, decltype(&mj_deleteModel)>;
using data = std::unique_ptr<mjData, decltype(&mj_deleteData)>;

/// As MuJoCo reads it; the meshes of tests/data are written with their folders.
model read_by_mujoco(const robot& r) {
  const auto in_folder = [](const std::string& mesh) { return robot_file(mesh).string(); };
  const auto file = std::filesystem::temp_directory_path() / "kte_peers_test.xml";
  std::ofstream(file) << to_mjcf(r, {.mesh_path = in_folder});
  char why[500] = "";
  model m(mj_loadXML(file.string().c_str(), nullptr, why, sizeof why), mj_deleteModel);
  std::filesystem::remove(file);
  INFO(why);
  REQUIRE(m);
  return m;
}

/// A state of a chain, and what makes MuJoCo's of it: its rates are T v, its accelerations T a + drift.
struct states {
  Eigen::VectorXd q, v, a, drift;
  Eigen::MatrixXd T;
};
states state_of(const robot& r, const mjModel& m, mjData& d, int trial) {
  const auto n = static_cast<Eigen::Index>(r.chain.dofs());
  REQUIRE(m.nv == n);
  states s{{}, Eigen::VectorXd(n), Eigen::VectorXd(n), Eigen::VectorXd::Zero(n), Eigen::MatrixXd::Zero(n, n)};
  Eigen::VectorXd step(n);
  for (int i = 0; i < n; ++i) {
    step[i] = 2 * std::sin(5.0 * i + trial), s.a[i] = std::sin(2.0 * i + trial);
    s.v[i] = 0.5 + std::cos(3.0 * i + trial) * (i % 2 ? 0.25 : -0.25);  // dry friction is fully there
  }
  s.q = integrate(r.chain, neutral_configuration(r.chain), step, 1.0);
  for (const auto& e : layout(r.chain)) {
    const bool planar = e.nq == 3 && e.nv == 3;
    const int j = mj_name2id(&m, mjOBJ_JOINT, (planar ? e.name + "_x" : e.name).c_str());
    REQUIRE(j >= 0);
    const int to = m.jnt_dofadr[j];
    for (int i = 0; i < e.nq; ++i) d.qpos[m.jnt_qposadr[j] + i] = s.q[e.q + i];
    s.T.block(to, e.v, e.nv, e.nv).setIdentity();
    Eigen::Matrix3d turn = Eigen::Matrix3d::Identity();
    Eigen::Vector3d w{0, 0, 0}, v{0, 0, 0};
    if (planar) {  // rates in the axes of the body; MuJoCo's are in those of the plane
      turn = Eigen::AngleAxisd(s.q[e.q + 2], Eigen::Vector3d::UnitZ()).toRotationMatrix();
      w[2] = s.v[e.v + 2], v.head<2>() = s.v.segment<2>(e.v);
      s.T.block<3, 3>(to, e.v) = turn;
    } else if (e.nv == 6) {  // in axes of the world
      const auto x = s.q.segment<4>(e.q + 3);
      turn = Eigen::Quaterniond(x[0], x[1], x[2], x[3]).toRotationMatrix();
      v = s.v.segment<3>(e.v), w = s.v.segment<3>(e.v + 3);
      s.T.block<3, 3>(to, e.v) = turn;
    }
    if (planar || e.nv == 6) s.drift.segment<3>(to) = turn * w.cross(v);
  }
  const Eigen::VectorXd rates = s.T * s.v;
  for (int i = 0; i < n; ++i) d.qvel[i] = rates[i];
  return s;
}

TEST_CASE("MuJoCo reads robots written as MJCF as the same robots") {
  const auto name = GENERATE("iiwa14.urdf", "everything.sdf", "several.xml", "parts.urdf");
  CAPTURE(name);
  const auto r = load_robot(robot_file(name));
  const auto m = read_by_mujoco(r);
  const data d(mj_makeData(m.get()), mj_deleteData);
  const auto n = static_cast<Eigen::Index>(m->nv);
  auto work = r.chain.make_state();
  for (int trial = 0; trial < 3; ++trial) {
    const auto s = state_of(r, *m, *d, trial);
    mj_fwdPosition(m.get(), d.get()), mj_fwdVelocity(m.get(), d.get());
    Eigen::MatrixXd M(n, n);
    mj_fullM(m.get(), M.data(), d->qM);
    Eigen::VectorXd tau = M * (s.T * s.a + s.drift);
    for (int i = 0; i < n; ++i)
      tau[i] += d->qfrc_bias[i] - d->qfrc_passive[i] + m->dof_frictionloss[i] * (d->qvel[i] > 0 ? 1 : -1);
    M = s.T.transpose() * M * s.T, tau = s.T.transpose() * tau;
    const Eigen::MatrixXd mass = mass_matrix(r.chain, work, s.q);
    CHECK((mass - M).norm() == within(0, 1e-14 * M.norm()));
    for (int i = 0; i < n; ++i)
      for (int k = 0; k < n; ++k)  // moments of 0 are raised to 1e-15 kg m^2
        CHECK(mass(i, k) == within(M(i, k), 2e-15 + 1e-14 * std::sqrt(M(i, i) * M(k, k))));
    const auto& f = inverse_dynamics(r.chain, work, s.q, s.v, s.a);
    for (int i = 0; i < n; ++i) CHECK(f[i] == within(tau[i], 1e-13 * tau.norm()));
    for (int b = 1; b < m->nbody; ++b) {
      const auto x = forward_kinematics(r.chain, work, s.q, std::string(mj_id2name(m.get(), mjOBJ_BODY, b)));
      const double *p = d->xpos + 3 * b, *R = d->xmat + 9 * b;
      CHECK((x.position.x == within(p[0], 1e-14) && x.position.y == within(p[1], 1e-14)));
      CHECK((x.position.z == within(p[2], 1e-14) && x.rotation.x.x == within(R[0], 1e-14)));
      CHECK((x.rotation.y.x == within(R[3], 1e-14) && x.rotation.z.y == within(R[7], 1e-14)));
    }
  }
  for (const auto& e : layout(r.chain)) {
    if (e.nv != 1) continue;
    const auto i = static_cast<std::size_t>(e.v);
    const int j = mj_name2id(m.get(), mjOBJ_JOINT, e.name.c_str());
    const bool limited = std::isfinite(r.limits.lower[i]) || std::isfinite(r.limits.upper[i]);
    CHECK((m->jnt_limited[j] != 0) == limited);
    if (!limited) continue;
    CHECK(m->jnt_range[2 * j] == within(std::max(r.limits.lower[i], -1e308), 0));
    CHECK(m->jnt_range[2 * j + 1] == within(std::min(r.limits.upper[i], 1e308), 1e-16));
  }
}

TEST_CASE("MuJoCo reads what is written as near as may be") {
  auto d = describe(load_robot(robot_file("everything.urdf"), {.quarter_turn_tolerance = 1e-6}));
  for (auto& j : d.joints) j.origin.position = j.is == robot_joint::kind::floating ? vec3<>{} : j.origin.position;
  CHECK_THROWS_AS(to_mjcf(d), bad_argument);
  const auto r = to_robot(d);
  const auto file = std::filesystem::temp_directory_path() / "kte_peers_test.xml";
  std::ofstream(file) << to_mjcf(d, {.lossy = true, .mesh_path = [](const std::string&) { return std::string(); }});
  char why[500] = "";
  const model m(mj_loadXML(file.string().c_str(), nullptr, why, sizeof why), mj_deleteModel);
  std::filesystem::remove(file);
  INFO(why);
  REQUIRE(m);
  CHECK(m->nv == r.chain.dofs() + 1);  // the follower has a coordinate
  CHECK(m->neq == 1);
}

}  // namespace mujoco_test
