#include <kte/robots/mjcf_writer.hpp>

#include <cmath>
#include <memory>
#include <mujoco/mujoco.h>
#include <stdexcept>

#include "measure.hpp"
#include "robots/solo12.hpp"

/// MuJoCo with elliptic cones and its Newton solver; solref is the time constant of its soft contacts, s.
namespace contact_bench {

namespace {

constexpr const char* file_begin =
    "<mujoco><compiler angle=\"radian\"/><option cone=\"elliptic\" solver=\"Newton\" tolerance=\"1e-12\"/><worldbody>"
    "<geom name=\"ground\" type=\"plane\" size=\"50 50 1\"/>";
constexpr const char* file_end = "</worldbody></mujoco>";

std::string planar_body(const std::string& geom, const char* inertia) {
  return std::string(file_begin) +
         "<body><joint type=\"slide\" axis=\"1 0 0\"/><joint type=\"slide\" axis=\"0 0 1\"/>"
         "<joint type=\"hinge\" axis=\"0 1 0\"/><inertial pos=\"0 0 0\" mass=\"1\" diaginertia=\"" +
         inertia + "\"/>" + geom + "</body>" + file_end;
}
/// The file of the quadruped with its ground and feet.
std::string quadruped() {
  kte::runtime_chain robot;
  robot << robots::solo12;
  std::string text = kte::to_mjcf(robot);
  const auto insert_after = [&text](const std::string& what, const char* tail, const std::string& more) {
    const auto at = text.find(what);
    if (at == std::string::npos) throw std::runtime_error("no " + what);
    text.insert(text.find(tail, at) + std::string(tail).size(), more);
  };
  for (const std::string leg : {"FL", "FR", "HL", "HR"}) {
    const double side = leg[1] == 'L' ? 1 : -1;
    insert_after("name=\"" + leg + "_LOWER_LEG\"", ">",
                 "<geom type=\"sphere\" size=\"0.016\" pos=\"0 " + text_of(0.008 * side, "%g") + " -0.16\"/>");
  }
  insert_after("<worldbody", ">", "<geom name=\"ground\" type=\"plane\" size=\"50 50 1\"/>");
  return text;
}

struct model_and_data {
  std::unique_ptr<mjModel, void (*)(mjModel*)> model{nullptr, mj_deleteModel};
  std::unique_ptr<mjData, void (*)(mjData*)> data{nullptr, mj_deleteData};
};
model_and_data load(const std::string& text) {
  mjVFS files;
  mj_defaultVFS(&files);
  if (mj_makeEmptyFileVFS(&files, "model.xml", static_cast<int>(text.size())) != 0) throw std::runtime_error("MuJoCo");
  std::copy(text.begin(), text.end(), static_cast<char*>(files.filedata[files.nfile - 1]));
  char error[300] = "";
  model_and_data m;
  m.model.reset(mj_loadXML("model.xml", &files, error, sizeof error));
  mj_deleteVFS(&files);
  if (!m.model) throw std::runtime_error(std::string("MuJoCo: ") + error);
  m.model->opt.cone = mjCONE_ELLIPTIC;
  m.data.reset(mj_makeData(m.model.get()));
  return m;
}

/// A scene in MuJoCo: its model, start, and q at the end as kte has it.
struct run {
  model_and_data m;
  std::function<void(mjData&)> start;
  std::function<Eigen::VectorXd(const mjData&)> q;
};
void put_friction(mjModel& m, double friction) {
  for (int i = 0; i < m.ngeom; ++i) m.geom_friction[3 * i] = friction, m.geom_condim[i] = 3;
}
run planar_run(const std::string& text, double friction, double slope, double height, double speed) {
  run r{load(text), {}, {}};
  put_friction(*r.m.model, friction);
  r.m.model->opt.gravity[0] = g * std::sin(slope), r.m.model->opt.gravity[2] = -g * std::cos(slope);
  r.start = [height, speed](mjData& d) { d.qpos[1] = height, d.qvel[0] = speed; };
  r.q = [](const mjData& d) { return Eigen::Vector3d(d.qpos[0], d.qpos[1], -d.qpos[2]); };
  return r;
}
run quadruped_run(const scene& s) {
  run r{load(quadruped()), {}, {}};
  auto& m = *r.m.model;
  put_friction(m, 0.7);
  m.opt.gravity[2] = -g;
  std::vector<int> places;
  for (const auto& [joint, target] : servos()) {
    const int j = mj_name2id(&m, mjOBJ_JOINT, joint.c_str());
    if (j < 0) throw std::runtime_error("MuJoCo: no joint " + joint);
    places.push_back(m.jnt_qposadr[j]);
    m.jnt_stiffness[j] = 10, m.qpos_spring[m.jnt_qposadr[j]] = target, m.dof_damping[m.jnt_dofadr[j]] = 0.3;
  }
  r.start = [q = s.q, places](mjData& d) {
    for (int i = 0; i < 7; ++i) d.qpos[i] = q[i];
    for (std::size_t i = 0; i < places.size(); ++i) d.qpos[places[i]] = q[7 + static_cast<Eigen::Index>(i)];
  };
  r.q = [](const mjData& d) { return Eigen::Vector3d(d.qpos[0], d.qpos[1], d.qpos[2]); };
  return r;
}
/// No model where contacts of MuJoCo cannot have the law of the scene: Newton's restitution, points on spokes.
run run_of(const scene& s) {
  const auto box = planar_body("<geom type=\"box\" size=\"0.1 0.1 0.05\"/>", "0.01 0.01 0.01");
  if (s.name == sliding_box().name) return planar_run(box, 0.2, -0.3, 0.05, 2);
  if (s.name == resting_box().name) return planar_run(box, 0.4, -0.3, 0.05, 2);
  if (s.name == slipping_ball().name)
    return planar_run(planar_body("<geom type=\"sphere\" size=\"0.1\"/>", "0.004 0.004 0.004"), 0.2, 0, 0.1, 1);
  if (s.name == falling_quadruped().name) return quadruped_run(s);
  return {};
}

}  // namespace

std::vector<row> mujoco_rows(const scene& s, bool quick) {
  std::vector<row> rows;
  const auto r = run_of(s);
  if (!r.m.model) return rows;
  auto& m = *r.m.model;
  auto& d = *r.m.data;
  for (const auto& [solref, step] : {std::pair(0.02, 1e-3), std::pair(0.002, 1e-4), std::pair(0.0002, 1e-5)}) {
    if (quick && step < 1e-3) continue;
    for (int i = 0; i < m.ngeom; ++i) m.geom_solref[2 * i] = solref, m.geom_solref[2 * i + 1] = 1;
    m.opt.timestep = step;
    const long long steps = std::llround(s.end / step);
    const double seconds = fastest(1, [&] {
      mj_resetData(&m, &d);
      r.start(d);
      for (long long i = 0; i < steps; ++i) mj_step(&m, &d);
    });
    rows.push_back({s.name, "MuJoCo", "solref " + text_of(solref, "%g") + ", h = " + text_of(step), s.error(r.q(d)),
                    steps, seconds});
  }
  return rows;
}

}  // namespace contact_bench
