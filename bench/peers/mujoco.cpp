/// MuJoCo: the stages of its pipeline that an operation needs, no others; no contacts, no constraints.
#include <Eigen/Geometry>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <mujoco/mujoco.h>
#include <vector>

#include "peer.hpp"

namespace bench::peers {
namespace {

/// `name="numbers"` to 17 digits.
template <class... X>
std::string attribute(const char* name, X... numbers) {
  std::string text = std::string(" ") + name + "=\"";
  const auto append = [&](double x) {
    char digits[32];
    std::snprintf(digits, sizeof digits, "%.17g ", x);
    text += digits;
  };
  (append(numbers), ...);
  return text + '"';
}
std::string attribute(const char* name, const Eigen::Vector3d& v) { return attribute(name, v[0], v[1], v[2]); }
std::string attribute(const char* name, const Eigen::Matrix3d& r) {
  const Eigen::Quaterniond q(r);
  return attribute(name, q.w(), q.x(), q.y(), q.z());
}

/// Bodies inside each other, in the format of the simulator.
std::string model_text(const serial_robot& robot) {
  std::string begin = "<mujoco><compiler angle=\"radian\" balanceinertia=\"false\"/><option" +
                      attribute("gravity", robot.gravity) +
                      "><flag constraint=\"disable\" contact=\"disable\"/></option><worldbody>",
              end = "</worldbody></mujoco>";
  for (const auto& l : robot.links) {
    const auto& j = l.inertia;
    begin += "<body" + attribute("pos", l.position) + attribute("quat", l.rotation) +
             "><joint type=\"hinge\" armature=\"0\" damping=\"0\"" + attribute("axis", l.axis) + "/><inertial" +
             attribute("pos", l.com) + attribute("mass", l.mass) +
             attribute("fullinertia", j(0, 0), j(1, 1), j(2, 2), j(0, 1), j(0, 2), j(1, 2)) + "/>";
    end = "</body>" + end;
  }
  return begin + "<site" + attribute("pos", robot.tool_position) + attribute("quat", robot.tool_rotation) + "/>" + end;
}

mjModel* load(const std::string& text) {
  static mjVFS files;
  mj_defaultVFS(&files);
  mj_makeEmptyFileVFS(&files, "model.xml", static_cast<int>(text.size()));
  std::memcpy(files.filedata[mj_findFileVFS(&files, "model.xml")], text.data(), text.size());
  char error[1000]{};
  mjModel* m = mj_loadXML("model.xml", &files, error, sizeof error);
  mj_deleteVFS(&files);
  if (m == nullptr) std::fprintf(stderr, "mujoco: %s\n", error), std::abort();
  return m;
}

template <int M>
struct mujoco {
  static constexpr auto how = "mujoco";
  /// It refuses bodies without rotational inertia, and XML that nests as deeply as the longest chain.
  static bool builds(const std::string& model) { return model != "pendulum" && model != "serial128"; }

  struct subject {
    mjModel* m = load(model_text(robot_of(models[M])));
    mjData* d = mj_makeData(m);
    int n = m->nv;
    std::vector<double> jacobian = std::vector<double>(static_cast<std::size_t>(6 * n));
  };
  static subject& made() {
    static subject s;
    return s;
  }
  static void position(const subject& s, const double* x) {
    std::copy_n(x, s.n, s.d->qpos);
    mj_kinematics(s.m, s.d);
    mj_comPos(s.m, s.d);
  }
  static void velocity(const subject& s, const double* x) {
    std::copy_n(x + s.n, s.n, s.d->qvel);
    mj_comVel(s.m, s.d);
  }

  [[gnu::noinline]] static void inverse_dynamics(const double* x, double* y) {
    const auto& s = made();
    position(s, x), velocity(s, x);
    std::copy_n(x + 2 * s.n, s.n, s.d->qacc);
    mj_rne(s.m, s.d, 1, y);
  }
  [[gnu::noinline]] static void forward_dynamics(const double* x, double* y) {
    const auto& s = made();
    position(s, x);
    mj_crb(s.m, s.d);
    mj_factorM(s.m, s.d);
    velocity(s, x);
    mj_rne(s.m, s.d, 0, y);
    for (int i = 0; i < s.n; ++i) y[i] = x[2 * s.n + i] - y[i];
    mj_solveM(s.m, s.d, y, y, 1);
  }
  [[gnu::noinline]] static void mass_matrix(const double* x, double* y) {
    const auto& s = made();
    position(s, x);
    mj_crb(s.m, s.d);
    mj_fullM(s.m, y, s.d->qM);
  }
  [[gnu::noinline]] static void forward_kinematics(const double* x, double* y) {
    const auto& s = made();
    std::copy_n(x, s.n, s.d->qpos);
    mj_kinematics(s.m, s.d);
    std::copy_n(s.d->site_xpos, 3, std::copy_n(s.d->site_xmat, 9, y));
  }
  [[gnu::noinline]] static void jacobian(const double* x, double* y) {
    auto& s = made();
    position(s, x);
    double* const rows = s.jacobian.data();
    mj_jacSite(s.m, s.d, rows, rows + 3 * s.n, 0);
    for (int j = 0; j < s.n; ++j)
      for (int i = 0; i < 6; ++i) *y++ = rows[i * s.n + j];
  }
};

const registered here{add_all<mujoco>};

}  // namespace
}  // namespace bench::peers
