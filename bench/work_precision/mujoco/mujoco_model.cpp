#include "mujoco_model.hpp"

#include <Eigen/Geometry>

#include <cstdio>
#include <cstring>
#include <stdexcept>

namespace work_precision {
namespace {

/// `name="numbers"` to 17 digits.
template <class V>
std::string attribute(const char* name, const V& numbers) {
  std::string text = std::string(" ") + name + "=\"";
  for (const double x : numbers) {
    char digits[32];
    std::snprintf(digits, sizeof digits, "%.17g ", x);
    text += digits;
  }
  return text + '"';
}
std::string quaternion(const Eigen::Matrix3d& r) {
  const Eigen::Quaterniond q(r);
  return attribute("quat", Eigen::Vector4d(q.w(), q.x(), q.y(), q.z()));
}

/// Bodies inside each other, in the format of the simulator.
std::string text_of(const bench::serial_robot& robot) {
  std::string begin = "<mujoco><compiler angle=\"radian\" balanceinertia=\"false\"/><option integrator=\"RK4\"" +
                      attribute("gravity", robot.gravity) +
                      "><flag constraint=\"disable\" contact=\"disable\" sensor=\"disable\"/></option><worldbody>";
  std::string end = "</worldbody></mujoco>";
  for (const auto& l : robot.links) {
    const auto& i = l.inertia;
    Eigen::Matrix<double, 6, 1> inertia;
    inertia << i(0, 0), i(1, 1), i(2, 2), i(0, 1), i(0, 2), i(1, 2);
    begin += "<body" + attribute("pos", l.position) + quaternion(l.rotation) + "><joint armature=\"0\" damping=\"0\"" +
             (l.axis.isZero() ? " type=\"ball\"" : " type=\"hinge\"" + attribute("axis", l.axis)) + "/><inertial" +
             attribute("pos", l.com) + attribute("mass", Eigen::Matrix<double, 1, 1>(l.mass)) +
             attribute("fullinertia", inertia) + "/>";
    end = "</body>" + end;
  }
  return begin + end;
}

}  // namespace

mjModel* load_mujoco(const bench::serial_robot& robot) {
  const std::string text = text_of(robot);
  static mjVFS files;  // too large for the stack
  mj_defaultVFS(&files);
  mj_makeEmptyFileVFS(&files, "model.xml", static_cast<int>(text.size()));
  std::memcpy(files.filedata[mj_findFileVFS(&files, "model.xml")], text.data(), text.size());
  char error[1000]{};
  mjModel* m = mj_loadXML("model.xml", &files, error, sizeof error);
  mj_deleteVFS(&files);
  if (m == nullptr) throw std::runtime_error(std::string("MuJoCo: ") + error);
  return m;
}

}  // namespace work_precision
