#include <kte/dynamics/state_vectors.hpp>

#include <limits>
#include <pybind11/stl.h>

#include "call.hpp"
#include "parts.hpp"

namespace kte_python {

namespace {

/// kte.State: a chain and a state of it, for the passes.
class state_object {
 public:
  explicit state_object(const kte::runtime_chain& c) : chain_(c), s_(chain_.make_state()) {}

  const kte::runtime_chain& of() const { return chain_; }
  const kte::runtime_state& s() const { return s_; }
  /// The state, to set what the motion of frames follows from.
  kte::runtime_state& set() {
    has_ = pass::none;
    return s_;
  }
  void do_motion() { chain_.doMotion(s_), has_ = pass::motion; }
  void do_force() {
    require_motion("do_force");
    chain_.clearForce(s_), chain_.doForce(s_), has_ = pass::force;
  }
  bool has_motion() const { return has_ != pass::none; }
  bool has_forces() const { return has_ == pass::force; }
  void require_motion(const std::string& what) const {
    if (!has_motion()) refuse(what, "do_motion");
  }
  void require_forces(const std::string& what) const {
    if (!has_forces()) refuse(what, "do_motion() and do_force");
  }

 private:
  enum class pass { none, motion, force };
  [[noreturn]] static void refuse(const std::string& what, const char* calls) {
    throw kte::bad_argument("kte: " + what + " of a State is not computed for these q, v, a and inputs: call " + calls +
                            "() first");
  }

  kte::runtime_chain chain_;
  kte::runtime_state s_;
  pass has_ = pass::none;  ///< the last pass at these q, v, a and inputs
};

array xyz_array(const kte::vec3<>& v) { return to_array(Eigen::VectorXd(Eigen::Vector3d(v.x, v.y, v.z))); }
template <class V>
array planar(const V& v) {
  return xyz_array({v.x, v.y, 0});
}
array about_z(double x) { return xyz_array({0, 0, x}); }

py::object frame_of(const state_object& x, const std::string& name) {
  const auto [what, index] = x.of().wiring().frame(name);
  x.require_motion("frame '" + name + "'");
  const auto load = [&x](const array& known) {
    return x.has_forces() ? known : xyz_array(kte::vec3<>{} * std::numeric_limits<double>::quiet_NaN());
  };
  if (what == kte::kind::frame_3D) {
    const auto& f = x.s().get<kte::kind::frame_3D>(index);
    const auto& r = f.rotation;
    Eigen::Matrix3d rotation;
    rotation << r.x.x, r.x.y, r.x.z, r.y.x, r.y.y, r.y.z, r.z.x, r.z.y, r.z.z;
    return result("Frame",
                  py::make_tuple(xyz_array(f.position), to_array(Eigen::MatrixXd(rotation)), xyz_array(f.velocity),
                                 xyz_array(f.ang_velocity), xyz_array(f.acceleration), xyz_array(f.ang_acceleration),
                                 load(xyz_array(f.force)), load(xyz_array(f.torque))));
  }
  const auto& f = x.s().get<kte::kind::frame_2D>(index);
  Eigen::Matrix3d rotation;
  rotation << f.rotation.cos, -f.rotation.sin, 0, f.rotation.sin, f.rotation.cos, 0, 0, 0, 1;
  return result("Frame", py::make_tuple(planar(f.position), to_array(Eigen::MatrixXd(rotation)), planar(f.velocity),
                                        about_z(f.ang_velocity), planar(f.acceleration), about_z(f.ang_acceleration),
                                        load(planar(f.force)), load(about_z(f.torque))));
}

/// The inputs that no element writes, a dict for `put_inputs`.
py::dict inputs_of(const state_object& x) {
  py::dict all;
  const auto& w = x.of().wiring();
  for (const auto k : {kte::kind::input, kte::kind::vector}) {
    const auto& names = w.names[static_cast<std::size_t>(k)];
    for (std::size_t i = 0; i < names.size(); ++i) {
      if (w.writers[static_cast<std::size_t>(k)][i] >= 0) continue;
      const auto at = static_cast<int>(i);
      all[py::str(names[i])] = k == kte::kind::input ? py::object(py::float_(x.s().get<kte::kind::input>(at)))
                                                     : py::object(xyz_array(x.s().get<kte::kind::vector>(at)));
    }
  }
  return all;
}
/// What a pickle holds: numbers, the passes that were made, and attributes of a derived class.
py::tuple pickled(py::handle self) {
  const auto& x = self.cast<const state_object&>();
  const auto& s = x.s();
  return py::make_tuple(bytes_of(x.of()), to_array(Eigen::VectorXd(kte::positions(s))),
                        to_array(Eigen::VectorXd(kte::velocities(s))), to_array(Eigen::VectorXd(kte::accelerations(s))),
                        inputs_of(x), x.has_motion(), x.has_forces(), py::getattr(self, "__dict__", py::dict()));
}
std::pair<std::unique_ptr<state_object>, py::dict> unpickled(const py::tuple& t) {
  const auto c = chain_from_bytes(py::bytes(t[0]));
  auto made = std::make_unique<state_object>(c);
  auto& s = made->set();
  kte::set_positions(s, vector_from("q", t[1], c.nq()));
  kte::set_velocities(s, vector_from("v", t[2], c.dofs())), kte::set_accelerations(s, vector_from("a", t[3], c.dofs()));
  put_inputs(c, s, t[4]);
  if (t[5].cast<bool>()) made->do_motion();
  if (t[6].cast<bool>()) made->do_force();
  return {std::move(made), py::dict(t[7])};
}

}  // namespace

void bind_state(py::module_& m) {
  using namespace py::literals;
  py::class_<state_object>(m, "State", R"(State(chain, q=None, v=None, a=None, *, inputs=None)

All coordinates, frames and signals of a chain, for the passes: `do_motion` computes the motion of frames, `do_force` the
forces from the tips to the bases. The state has a copy of the chain: later changes of the chain do not change it. What
a pass computes raises BadArgument before that pass, and again after q, v, a or inputs are set.)")
      .def(py::init([](py::handle chain, py::handle q, py::handle v, py::handle a, py::handle inputs) {
             const auto& c = chain_of(chain).chain();
             auto made = std::make_unique<state_object>(c);
             auto& s = made->set();
             if (!q.is_none()) kte::set_positions(s, vector_from("q", q, c.nq()));
             if (!v.is_none()) kte::set_velocities(s, vector_from("v", v, c.dofs()));
             if (!a.is_none()) kte::set_accelerations(s, vector_from("a", a, c.dofs()));
             if (!inputs.is_none()) put_inputs(c, s, inputs);
             return made;
           }),
           "chain"_a, "q"_a = py::none(), "v"_a = py::none(), "a"_a = py::none(), py::kw_only(),
           "inputs"_a = py::none())
      .def_property(
          "q", [](const state_object& x) { return fixed(to_array(Eigen::VectorXd(kte::positions(x.s())))); },
          [](state_object& x, py::handle q) { kte::set_positions(x.set(), vector_from("q", q, x.s().nq())); },
          "The configuration.")
      .def_property(
          "v", [](const state_object& x) { return fixed(to_array(Eigen::VectorXd(kte::velocities(x.s())))); },
          [](state_object& x, py::handle v) { kte::set_velocities(x.set(), vector_from("v", v, x.s().dofs())); },
          "The velocities.")
      .def_property(
          "a", [](const state_object& x) { return fixed(to_array(Eigen::VectorXd(kte::accelerations(x.s())))); },
          [](state_object& x, py::handle a) { kte::set_accelerations(x.set(), vector_from("a", a, x.s().dofs())); },
          "The accelerations.")
      .def_property_readonly(
          "f",
          [](const state_object& x) {
            x.require_forces("f");
            return to_array(Eigen::VectorXd(kte::forces(x.s())));
          },
          "After `do_force`: the generalized forces that remain, Q - (M a + C v + g), N and Nm.")
      .def(
          "set_inputs", [](state_object& x, py::handle inputs) { put_inputs(x.of(), x.set(), inputs); },
          "set_inputs(inputs)\n\nSets inputs: a dict from names to numbers.", "inputs"_a)
      .def("do_motion", &state_object::do_motion,
           "do_motion()\n\nThe motion of all frames from that of the coordinates.")
      .def("do_force", &state_object::do_force,
           "do_force()\n\nThe forces on all frames and coordinates, after `do_motion`.")
      .def("frame", &frame_of,
           "frame(name)\n\nA frame, after `do_motion`: `.position`, `.rotation`, `.velocity`, `.ang_velocity`, "
           "`.acceleration` (proper, as an accelerometer measures: g upward at rest), `.ang_acceleration`, and after "
           "`do_force` `.force`, `.torque`, which are NaN before it; "
           "rates "
           "and forces in its own axes.",
           "name"_a)
      .def_property_readonly(
          "outputs",
          [](const state_object& x) {
            x.require_motion("outputs");
            py::dict all;
            for (const auto& y : x.of().outputs(x.s()))
              all[py::str(std::string(y.name))] =
                  y.numbers.size() == 1 ? py::object(py::float_(y.numbers[0]))
                                        : py::object(to_array(Eigen::VectorXd(Eigen::Map<const Eigen::VectorXd>(
                                              y.numbers.data(), static_cast<Eigen::Index>(y.numbers.size())))));
            return all;
          },
          "The signals that elements write, such as sensors, after `do_motion`: a dict.")
      .def(py::pickle(&pickled, &unpickled))
      .def("__repr__", [](const state_object& x) {
        const auto numbers = [](const Eigen::VectorXd& v) {
          return py::repr(py::list(to_array(v).attr("tolist")())).cast<std::string>();
        };
        return "<kte.State: q = " + numbers(kte::positions(x.s())) + ", v = " + numbers(kte::velocities(x.s())) + ">";
      });
}

}  // namespace kte_python
