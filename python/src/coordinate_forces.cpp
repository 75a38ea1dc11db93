#include "coordinate_forces.hpp"

#include <kte/elements/registry.hpp>
#include <kte/runtime_chain/layout.hpp>

#include <Eigen/Geometry>

#include <algorithm>

namespace kte_python {

namespace {

bool has_signal(const kte::runtime_chain& c, const std::string& name) {
  for (const auto& names : c.wiring().names)
    if (std::find(names.begin(), names.end(), name) != names.end()) return true;
  return false;
}
std::string new_signal(const kte::runtime_chain& c, std::string name) {
  while (has_signal(c, name)) name += '\'';
  return name;
}
Eigen::Index place_of(const kte::runtime_chain& c, const std::string& input) {
  for (const auto& s : c.wiring().signals)
    if (c.wiring().names[static_cast<std::size_t>(s.what)][static_cast<std::size_t>(s.slot)] == input) return s.u;
  return -1;
}
const std::string* name_for(const kte::element_record& e, std::string_view role) {
  for (const auto& c : e.connections)
    if (c.role == role) return &c.name;
  return nullptr;
}
const std::vector<double>* numbers_for(const kte::element_record& e, std::string_view parameter) {
  for (const auto& p : e.parameters)
    if (p.name == parameter) return &p.values;
  return nullptr;
}
/// The first joint that moves a frame by a coordinate; null if there is none.
const kte::element_record* joint_of(const kte::model_record& m, const std::string& coordinate) {
  for (const auto& e : m.elements) {
    const auto* name = name_for(e, "coordinate");
    if (name && *name == coordinate && name_for(e, "base") && name_for(e, "end")) return &e;
  }
  return nullptr;
}
bool moves(const kte::runtime_chain& c, const std::string& frame) {
  const auto [what, index] = c.wiring().frame(frame);
  return c.wiring().writers[static_cast<std::size_t>(what)][static_cast<std::size_t>(index)] >= 0;
}
/// Rotation and position of a rotation or pose.
std::pair<Eigen::Matrix3d, Eigen::Vector3d> pose_of(kte::kind what, const double* q) {
  if (what == kte::kind::pose_2D)
    return {Eigen::AngleAxisd(q[2], Eigen::Vector3d::UnitZ()).toRotationMatrix(), {q[0], q[1], 0}};
  const bool moves = what == kte::kind::pose_3D;
  const double* const r = moves ? q + 3 : q;
  return {Eigen::Quaterniond(r[0], r[1], r[2], r[3]).normalized().toRotationMatrix(),
          moves ? Eigen::Vector3d(q[0], q[1], q[2]) : Eigen::Vector3d::Zero().eval()};
}

}  // namespace

coordinate_forces::coordinate_forces(kte::runtime_chain& c) {
  static const auto registry = kte::element_registry::standard();
  const auto record = kte::record_of(c);
  std::vector<std::pair<std::string, Eigen::Index*>> places;
  const auto table = kte::layout(c);
  all_.reserve(table.size());
  for (const auto& e : table) {
    auto& x = all_.emplace_back();
    x.what = e.what, x.q = e.q, x.v = e.v;
    const auto input = new_signal(c, "tau/" + e.name);
    if (e.nv == 1) {
      c.append(registry.make({"driving_actuator_gen", 1, {{"coordinate", e.name}, {"input", input}}, {}}));
      places.emplace_back(input, &x.u);
      continue;
    }
    const auto* joint = joint_of(record, e.name);
    if (!joint) throw kte::bad_argument("kte: control: no joint moves a frame by '" + e.name + "'");
    x.planar = c.wiring().frame(*name_for(*joint, "end")).first == kte::kind::frame_2D;
    const auto push = [&](const std::string& frame, const std::string& force, wrench_input& at) {
      const auto f = new_signal(c, force), t = new_signal(c, force + "/torque");
      c.append(registry.make({x.planar ? "driving_actuator_2D" : "driving_actuator_3D",
                              1,
                              {{"frame", frame}, {"force", f}, {"torque", t}},
                              {}}));
      places.emplace_back(f, &at.force), places.emplace_back(t, &at.torque);
    };
    push(*name_for(*joint, "end"), input, x.end);
    if (moves(c, *name_for(*joint, "base"))) push(*name_for(*joint, "base"), input + "/reaction", x.base);
    if (const auto* r = numbers_for(*joint, "rotation"))
      x.rotation = Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(r->data());
    if (const auto* p = numbers_for(*joint, "position")) x.position = Eigen::Map<const Eigen::Vector3d>(p->data());
  }
  for (const auto& [input, place] : places) *place = place_of(c, input);
}

bool coordinate_forces::of_tau_alone() const {
  return std::all_of(all_.begin(), all_.end(), [](const coordinate& x) { return x.base.force < 0; });
}

void coordinate_forces::put_wrench(const Eigen::Vector3d& f, const Eigen::Vector3d& t, const wrench_input& at,
                                   bool planar, Eigen::VectorXd& u) {
  u.segment<3>(at.force) = f;
  if (planar)
    u[at.torque] = t.z();
  else
    u.segment<3>(at.torque) = t;
}

void coordinate_forces::put(const Eigen::VectorXd& tau, const Eigen::VectorXd& q, Eigen::VectorXd& u) const {
  for (const auto& x : all_) {
    if (x.u >= 0) {
      u[x.u] = tau[x.v];
      continue;
    }
    Eigen::Vector3d f = Eigen::Vector3d::Zero(), t = f;
    if (x.what == kte::kind::rotation_3D)
      t = tau.segment<3>(x.v);
    else if (x.what == kte::kind::pose_2D)
      f = {tau[x.v], tau[x.v + 1], 0}, t.z() = tau[x.v + 2];
    else
      f = tau.segment<3>(x.v), t = tau.segment<3>(x.v + 3);
    put_wrench(f, t, x.end, x.planar, u);
    if (x.base.force < 0) continue;
    const auto [turn, place] = pose_of(x.what, q.data() + x.q);
    const Eigen::Vector3d force = -(x.rotation * (turn * f)), torque = -(x.rotation * (turn * t));
    put_wrench(force, torque + (x.position + x.rotation * place).cross(force), x.base, x.planar, u);
  }
}

}  // namespace kte_python
