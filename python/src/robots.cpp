#include "robots.hpp"

#include <kte/io/printable.hpp>
#include <kte/robots/check_robot.hpp>
#include <kte/robots/load_robot.hpp>
#include <kte/robots/mjcf_writer.hpp>
#include <kte/robots/motors.hpp>
#include <kte/robots/urdf_writer.hpp>

#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include "call.hpp"
#include "joint_limits.hpp"
#include "parts.hpp"
#include "signal_watch.hpp"

namespace kte_python {

void warn_of_robot(const std::string& text, int level) {
  const py::object category = py::module_::import("kte.errors").attr("RobotWarning");
  if (PyErr_WarnEx(category.ptr(), kte::detail::printable(text).c_str(), level) != 0) throw py::error_already_set();
}
kte::robot current(const robot_object& r) {
  kte::robot whole = r.robot;
  whole.chain = chain_of(r.chain).chain();
  return whole;
}

kte::joint_limits<> limits_from(py::handle robot_or_chain, py::handle limits) {
  const auto& c = chain_of(robot_or_chain).chain();
  if (limits.is_none())
    return py::isinstance<robot_object>(robot_or_chain) ? robot_or_chain.cast<const robot_object&>().robot.limits
                                                        : kte::unlimited(c);
  const auto list = [&](const char* name) {
    const auto x = vector_from((std::string("limits.") + name).c_str(), limits.attr(name), c.dofs());
    return std::vector<double>(x.data(), x.data() + x.size());
  };
  return {list("lower"), list("upper"), list("rate"), list("acceleration"), list("jerk"), list("effort")};
}

py::object limits_of(const kte::joint_limits<>& l) {
  const auto list = [](const std::vector<double>& x) {
    return fixed(
        to_array(Eigen::VectorXd(Eigen::Map<const Eigen::VectorXd>(x.data(), static_cast<Eigen::Index>(x.size())))));
  };
  return result("Limits", py::make_tuple(list(l.lower), list(l.upper), list(l.rate), list(l.acceleration), list(l.jerk),
                                         list(l.effort)));
}

namespace {

std::string text_of(const kte::robot_note& n, const std::string& file) {
  const std::string& where = n.file.empty() ? file : n.file;
  std::string s = "kte: " + where;
  if (n.line > 0) s += ":" + std::to_string(n.line);
  return s + ": " + n.text;
}
void warn(const std::vector<kte::robot_note>& notes, const std::string& file) {
  for (const auto& n : notes) warn_of_robot(text_of(n, file));
}
py::list notes_of(const std::vector<kte::robot_note>& notes) {
  py::list all;
  for (const auto& n : notes) all.append(result("Note", py::make_tuple(n.text, n.line, n.file, n.changes_motion)));
  return all;
}

/// Takes numbers out of a dict of Python by their names; then it must be empty.
class dict_reader {
 public:
  dict_reader(std::string what, py::handle from) : what_(std::move(what)) {
    if (!py::isinstance<py::dict>(from)) throw py::type_error("kte: " + what_ + " must be a dict");
    left_ = py::dict(py::reinterpret_borrow<py::dict>(from).attr("copy")());
  }
  template <class T>
  void take(const char* name, T& to) {
    if (!left_.contains(name)) return;
    const py::object value = left_.attr("pop")(name);
    if (value.is_none()) return;
    try {
      to = value.cast<T>();
    } catch (const py::cast_error&) {
      throw py::type_error("kte: " + what_ + "['" + name + "'] is " + py::repr(value).cast<std::string>());
    }
  }
  py::object take_object(const char* name) {
    return left_.contains(name) ? py::object(left_.attr("pop")(name)) : py::none();
  }
  void finish() const {
    if (left_.empty()) return;
    throw py::type_error("kte: " + what_ + " has no '" + py::str((*left_.begin()).first).cast<std::string>() + "'");
  }

 private:
  std::string what_;
  py::dict left_;
};
kte::robot_contact_options contacts_from(py::handle contacts) {
  kte::robot_contact_options o;
  if (contacts.is_none()) return o;
  dict_reader in("contacts", contacts);
  in.take("ground", o.ground), in.take("rim_points", o.rim_points);
  in.take("friction", o.friction), in.take("restitution", o.restitution);
  if (const auto compliant = in.take_object("compliant"); !compliant.is_none()) {
    auto& p = o.compliant;
    dict_reader soft("compliant", compliant);
    soft.take("stiffness", p.stiffness), soft.take("exponent", p.exponent);
    soft.take("dissipation", p.dissipation), soft.take("slip_speed", p.slip_speed);
    soft.finish();
  }
  in.finish();
  if (o.ground.empty()) throw py::value_error("kte: contacts needs a 'ground', such as 'world'");
  return o;
}
kte::robot_options options_from(const py::dict& from) {
  kte::robot_options o;
  const auto take = [&from](const char* name, auto& to) {
    to = from[name].cast<std::remove_reference_t<decltype(to)>>();
  };
  o.contacts = contacts_from(from["contacts"]);
  if (const py::object gravity = from["gravity"]; !gravity.is_none()) {
    const auto g = vector_from("gravity", gravity, 3);
    o.gravity = kte::vec3<>{g[0], g[1], g[2]};
  }
  take("root", o.root), take("floating_base", o.floating_base), take("fold_fixed", o.fold_fixed);
  take("joint_dynamics", o.joint_dynamics), take("friction_smoothing", o.friction_smoothing);
  take("quarter_turn_tolerance", o.quarter_turn_tolerance), take("strict", o.strict), take("model", o.model);
  if (const double x = o.friction_smoothing; !(x > 0 && std::isfinite(x)))
    throw kte::bad_argument("kte: friction_smoothing must be finite and positive, got " + kte::detail::number(x));
  if (const double x = o.quarter_turn_tolerance; !(x >= 0 && x <= 0.1))
    throw kte::bad_argument("kte: quarter_turn_tolerance must be between 0 and 0.1 rad, got " + kte::detail::number(x));
  if (py::isinstance<py::str>(from["search_path"]))  // else its letters would be folders
    throw py::type_error("kte: search_path must be a list of folders, not a str");
  o.search_path = names_from(from["search_path"]);
  return o;
}

std::unique_ptr<robot_object> as_object(kte::robot r, py::tuple source) {
  py::object chain = py::cast(std::make_unique<chain_object>(r.chain));
  auto made = std::make_unique<robot_object>(robot_object{std::move(r), std::move(chain), std::move(source)});
  warn(made->robot.warnings, made->robot.file);
  return made;
}
std::unique_ptr<robot_object> robot_from_file(const std::filesystem::path& path, const py::dict& options) {
  const auto whole = std::filesystem::absolute(path);  // for pickles, which may be read in another folder
  auto read = run_aside([path, o = options_from(options)] { return kte::load_robot(path, o); });
  return as_object(std::move(read), py::make_tuple("load_robot", whole, options));
}
std::unique_ptr<robot_object> robot_from_text(const std::string& text, const std::string& name,
                                              const py::dict& options) {
  auto read = run_aside(
      [text, name, o = options_from(options)] { return kte::to_robot(kte::describe_robot(text, name, o), o); });
  return as_object(std::move(read), py::make_tuple("parse_robot", py::make_tuple(text, name), options));
}

void add_motors(robot_object& r, double stiffness, double damping, double stop_stiffness, double stop_damping) {
  auto whole = current(r);
  const auto before = whole.warnings.size();
  kte::add_motors(
      whole,
      {.stiffness = stiffness, .damping = damping, .stop_stiffness = stop_stiffness, .stop_damping = stop_damping});
  r.chain.cast<chain_object&>().edit() = whole.chain;
  r.robot = std::move(whole);
  r.motors.append(py::make_tuple(stiffness, damping, stop_stiffness, stop_damping));
  warn({r.robot.warnings.begin() + static_cast<std::ptrdiff_t>(before), r.robot.warnings.end()}, r.robot.file);
}

robot_object copy_of(const robot_object& r) {
  return {r.robot, py::cast(chain_object(chain_of(r.chain))), r.source, py::list(r.motors.attr("copy")())};
}
std::string repr_of(const robot_object& r) {
  const auto& c = chain_of(r.chain).chain();
  std::string s = "<kte.Robot '" + r.robot.name + "': " + std::to_string(c.dofs()) +
                  (c.dofs() == 1 ? " degree of freedom" : " degrees of freedom");
  if (!r.robot.motors.empty()) s += ", " + std::to_string(r.robot.motors.size()) + " motors";
  if (!r.robot.file.empty()) s += ", from " + r.robot.file;
  return s + ">";
}

constexpr const char* options_text = R"(
gravity                 in axes of the root, m/s^2; by default that of the file, or (0, 0, -9.81)
root                    the link used as base
floating_base           whether the root moves freely, by a coordinate 'floating_base', in a frame 'world'
fold_fixed              merges bodies of fixed links into their parents
joint_dynamics          False: no damping, friction, springs and rotor inertias
contacts                of collision shapes with the ground, a dict: 'ground', a frame such as 'world'; 'friction' and
                        'restitution', by default those of the file, or 1 and 0; 'rim_points' of cylinders; 'compliant',
                        a dict of 'stiffness', 'exponent', 'dissipation', 'slip_speed', instead of rigid contacts
friction_smoothing      rate over which dry friction changes sign, rad/s or m/s
quarter_turn_tolerance  angles within this of multiples of pi/2, rad, become exact
strict                  refuses robots that would move differently from those in the file
model                   the model to read from an SDF file with several
search_path             folders for model:// and package://

What the file has and the robot has not is a RobotWarning if it changes the motion, else in `.not_read`.)";

}  // namespace

void bind_robots(py::module_& m) {
  using namespace py::literals;
  py::class_<robot_object>(m, "Robot", "A robot read from a file: a chain, and data beside it.")
      .def_readonly("chain", &robot_object::chain,
                    "The mechanism, a `Chain`; coordinates are named as joints, frames as links.")
      .def_property_readonly(
          "name", [](const robot_object& r) { return r.robot.name; }, "Its name.")
      .def_property_readonly(
          "file", [](const robot_object& r) { return r.robot.file; }, "The file it was read from.")
      .def_property_readonly(
          "limits", [](const robot_object& r) { return limits_of(r.robot.limits); },
          "`Limits` over v: lower, upper, rate, acceleration, jerk, effort; infinite if the file gives none.")
      .def_property_readonly(
          "soft_limits", [](const robot_object& r) { return limits_of(r.robot.soft_limits); },
          "Limits with the range of safety controllers.")
      .def_property_readonly(
          "joints", [](const robot_object& r) { return r.robot.joints; },
          "Names of the coordinates of joints, in the order of the file.")
      .def_property_readonly(
          "loops", [](const robot_object& r) { return r.robot.loops; }, "The names of closures of loops.")
      .def_property_readonly(
          "contacts", [](const robot_object& r) { return r.robot.contacts; },
          "Names of the rigid contacts of its shapes with the ground.")
      .def_property_readonly(
          "configurations",
          [](const robot_object& r) {
            py::dict all;
            for (const auto& c : r.robot.configurations)
              all[py::str(c.name)] = to_array(Eigen::VectorXd(
                  Eigen::Map<const Eigen::VectorXd>(c.q.data(), static_cast<Eigen::Index>(c.q.size()))));
            return all;
          },
          "Named configurations, such as MJCF keyframes: a dict of q.")
      .def_property_readonly(
          "motors",
          [](const robot_object& r) {
            py::list all;
            for (const auto& x : r.robot.motors) all.append(result("Motor", py::make_tuple(x.input, x.joint, x.v)));
            return all;
          },
          "The motors in the chain, after `add_motors`.")
      .def_property_readonly(
          "warnings", [](const robot_object& r) { return notes_of(r.robot.warnings); },
          "Why the robot moves differently from that of the file, and what is odd about the file: `Note`s.")
      .def_property_readonly(
          "not_read", [](const robot_object& r) { return notes_of(r.robot.not_read); },
          "Contents of the file that were not read and do not change the motion: `Note`s.")
      .def(
          "check",
          [](const robot_object& r) {
            std::vector<std::string> all;
            for (const auto& n : run_aside([whole = current(r)] { return kte::check_robot(whole); }))
              all.push_back((n.line > 0 ? std::to_string(n.line) + ": " : "") + n.text);
            return all;
          },
          "check()\n\nWhat is odd about the robot, as sentences with lines of the file.")
      .def("add_motors", &add_motors,
           R"(add_motors(*, stiffness=0, damping=0, stop_stiffness=0, stop_damping=0)

Adds the motors of the file to the chain; their commands are inputs, listed in `.motors`. With `stiffness` and `damping`,
N/m or Nm/rad, they are servos, whose commands are positions. `stop_*`: stops at the ends of the ranges of joints.)",
           py::kw_only(), "stiffness"_a = 0.0, "damping"_a = 0.0, "stop_stiffness"_a = 0.0, "stop_damping"_a = 0.0)
      .def("__copy__", [](const robot_object& r) { return copy_of(r); })
      .def("__deepcopy__", [](const robot_object& r, py::handle) { return copy_of(r); })
      .def("__reduce__",
           [](const robot_object& r) {
             const auto remade = py::module_::import("kte.robots").attr("_remade");
             return py::make_tuple(remade, r.source + py::make_tuple(r.motors, r.chain));
           })
      .def("_put_chain", [](robot_object& r, py::object chain) { r.chain = std::move(chain); })
      .def("__repr__", &repr_of);

  static const std::string options =
      "*, gravity=None, root=\"\", floating_base=False, fold_fixed=False, joint_dynamics=True, "
      "friction_smoothing=1e-3, quarter_turn_tolerance=1e-15, strict=False, model=\"\", search_path=(), "
      "contacts=None)\n\n";
  static const std::string load_doc =
      "load_robot(path, " + options + "Reads a robot from a file in URDF, MJCF or SDF.\n" + std::string(options_text);
  static const std::string parse_doc = "parse_robot(text, name=\"robot\", " + options +
                                       "Reads a robot from a text in URDF, MJCF or SDF. Options as for `load_robot`.";
  const auto none = py::none();
  const auto no_folders = py::tuple();
  m.def(
      "load_robot",
      [](const std::filesystem::path& path, py::handle gravity, const std::string& root, bool floating_base,
         bool fold_fixed, bool joint_dynamics, double friction_smoothing, double quarter_turn_tolerance, bool strict,
         const std::string& model, py::handle search_path, py::handle contacts) {
        return robot_from_file(
            path,
            py::dict("gravity"_a = gravity, "root"_a = root, "floating_base"_a = floating_base,
                     "fold_fixed"_a = fold_fixed, "joint_dynamics"_a = joint_dynamics,
                     "friction_smoothing"_a = friction_smoothing, "quarter_turn_tolerance"_a = quarter_turn_tolerance,
                     "strict"_a = strict, "model"_a = model, "search_path"_a = search_path, "contacts"_a = contacts));
      },
      load_doc.c_str(), "path"_a, py::kw_only(), "gravity"_a = none, "root"_a = "", "floating_base"_a = false,
      "fold_fixed"_a = false, "joint_dynamics"_a = true, "friction_smoothing"_a = 1e-3,
      "quarter_turn_tolerance"_a = 1e-15, "strict"_a = false, "model"_a = "", "search_path"_a = no_folders,
      "contacts"_a = none);
  m.def(
      "parse_robot",
      [](const std::string& text, const std::string& name, py::handle gravity, const std::string& root,
         bool floating_base, bool fold_fixed, bool joint_dynamics, double friction_smoothing,
         double quarter_turn_tolerance, bool strict, const std::string& model, py::handle search_path,
         py::handle contacts) {
        return robot_from_text(
            text, name,
            py::dict("gravity"_a = gravity, "root"_a = root, "floating_base"_a = floating_base,
                     "fold_fixed"_a = fold_fixed, "joint_dynamics"_a = joint_dynamics,
                     "friction_smoothing"_a = friction_smoothing, "quarter_turn_tolerance"_a = quarter_turn_tolerance,
                     "strict"_a = strict, "model"_a = model, "search_path"_a = search_path, "contacts"_a = contacts));
      },
      parse_doc.c_str(), "text"_a, "name"_a = "robot", py::kw_only(), "gravity"_a = none, "root"_a = "",
      "floating_base"_a = false, "fold_fixed"_a = false, "joint_dynamics"_a = true, "friction_smoothing"_a = 1e-3,
      "quarter_turn_tolerance"_a = 1e-15, "strict"_a = false, "model"_a = "", "search_path"_a = no_folders,
      "contacts"_a = none);

  const auto writer = [&m](const char* name, const char* doc, auto write_robot, auto write_chain) {
    m.def(
        name,
        [write_robot, write_chain](py::handle x, bool lossy) {
          const auto written = [lossy](auto write, auto what) {
            return run_aside([lossy, write, what = std::move(what)] {
              std::vector<kte::robot_note> left;
              auto text = write(what, kte::robot_writing{.not_written = &left, .lossy = lossy});
              return std::pair(std::move(text), std::move(left));
            });
          };
          const auto [text, not_written] = py::isinstance<robot_object>(x)
                                               ? written(write_robot, current(x.cast<const robot_object&>()))
                                               : written(write_chain, chain_of(x).chain());
          warn(not_written, "not written");
          return text;
        },
        doc, "robot"_a, py::kw_only(), "lossy"_a = false);
  };
  writer(
      "to_urdf",
      "to_urdf(robot, *, lossy=False)\n\nA robot or chain as a text in URDF. What cannot be written is refused, or "
      "with "
      "`lossy` a RobotWarning.",
      [](const kte::robot& r, const auto& o) { return kte::to_urdf(r, o); },
      [](const kte::runtime_chain& c, const auto& o) { return kte::to_urdf(c, "robot", o); });
  writer(
      "to_mjcf",
      "to_mjcf(robot, *, lossy=False)\n\nA robot or chain as a text in MJCF. What cannot be written is refused, or "
      "with "
      "`lossy` a RobotWarning.",
      [](const kte::robot& r, const auto& o) { return kte::to_mjcf(r, o); },
      [](const kte::runtime_chain& c, const auto& o) { return kte::to_mjcf(c, "robot", o); });
}

}  // namespace kte_python
