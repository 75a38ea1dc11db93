#include <kte/manipulators/joint_motion.hpp>
#include <kte/manipulators/runtime_manipulator.hpp>

#include <functional>
#include <memory>

#include "arrays.hpp"
#include "chain.hpp"
#include "joint_limits.hpp"
#include "parts.hpp"

namespace kte_python {

namespace {

using arm_type = kte::manipulator<kte::runtime_chain>;
/// A point of a motion.
struct point {
  Eigen::VectorXd q, v, a;
};

/// kte.Motion: a motion of a robot from rest to rest.
class motion_object {
 public:
  /// make(arm) returns a `joint_motion`; `again` is what makes it once more.
  template <class Make>
  motion_object(arm_type arm, const Make& make, py::tuple once_more)
      : again(std::move(once_more)), arm_(std::make_shared<const arm_type>(std::move(arm))) {
    const auto m = make(*arm_);
    duration_ = m.duration();
    at_ = [m](double t) {
      auto [q, v, a] = m(t);
      return point{std::move(q), std::move(v), std::move(a)};
    };
  }
  double duration() const { return duration_; }
  /// (q, v, a) at a time, or at many.
  py::object operator()(py::handle t) const {
    refuse_masked("t", t);
    const auto times = py::array_t<double, py::array::c_style | py::array::forcecast>::ensure(t);
    if (!times || times.ndim() > 1) {
      PyErr_Clear();
      throw py::type_error("kte: t must be a number or a list of numbers, not " + py::repr(t).cast<std::string>());
    }
    if (times.ndim() == 0) {
      const point x = at_(*times.data());
      return result_of(to_array(x.q), to_array(x.v), to_array(x.a));
    }
    const auto n = times.size();
    const point one = at_(0);
    Eigen::MatrixXd q(n, one.q.size()), v(n, one.v.size()), a(n, one.a.size());
    for (Eigen::Index i = 0; i < n; ++i) {
      const point x = at_(times.data()[i]);
      q.row(i) = x.q.transpose(), v.row(i) = x.v.transpose(), a.row(i) = x.a.transpose();
    }
    return result_of(to_array(q), to_array(v), to_array(a));
  }

  py::tuple again;  ///< as of `__reduce__`

 private:
  static py::object result_of(const array& q, const array& v, const array& a) {
    return py::module_::import("kte._results").attr("MotionPoint")(q, v, a);
  }
  std::shared_ptr<const arm_type> arm_;  ///< to which at_ refers
  std::function<point(double)> at_;
  double duration_ = 0;
};

/// An arm with its limits. Motions of joints need no tool; a manipulator has one: any frame.
arm_type arm_from(py::handle robot, py::handle limits) {
  const auto& c = chain_of(robot).chain();
  for (const auto k : {kte::kind::frame_3D, kte::kind::frame_2D})
    if (const auto& names = c.wiring().names[static_cast<std::size_t>(k)]; !names.empty())
      return {c, std::vector<std::string>{names.back()}, limits_from(robot, limits)};
  throw kte::bad_argument("kte: a motion needs a chain that moves frames");
}

/// A function of the package and its arguments, as of `__reduce__`; the chain and the limits are copied.
py::tuple call_of(const char* function, py::handle robot, py::handle limits, const Eigen::VectorXd& from,
                  const Eigen::VectorXd& to, double at_least = 0) {
  const auto& c = chain_of(robot);
  auto arguments = py::make_tuple(std::make_unique<chain_object>(c.chain()), to_array(from), to_array(to));
  if (at_least > 0) arguments = py::tuple(arguments + py::make_tuple(at_least));
  py::dict keywords;
  keywords["limits"] = limits_of(limits_from(robot, limits));
  return py::make_tuple(py::module_::import("kte._copies").attr("called"),
                        py::make_tuple(function, arguments, keywords));
}

}  // namespace

void bind_joint_motions(py::module_& m) {
  using namespace py::literals;
  py::class_<motion_object>(
      m, "Motion",
      R"(A motion from rest to rest: `motion(t)` gives `.q`, `.v` and `.a` at a time, s, or at many, a row each.)")
      .def_property_readonly("duration", &motion_object::duration, "The duration, s.")
      .def("__call__", &motion_object::operator(), "motion(t)\n\nq, v and a at the time t, s, or at times t.", "t"_a)
      .def("__reduce__", [](const motion_object& x) { return x.again; })
      .def("__repr__", [](const motion_object& x) {
        return "<kte.Motion of " + py::repr(py::float_(x.duration())).cast<std::string>() + " s>";
      });
  m.def(
      "trapezoidal_motion",
      [](py::handle robot, py::handle start, py::handle end, py::handle limits) {
        const auto nq = chain_of(robot).chain().nq();
        const auto from = vector_from("start", start, nq), to = vector_from("end", end, nq);
        return motion_object(
            arm_from(robot, limits), [&](const arm_type& arm) { return kte::trapezoidal_motion(arm, from, to); },
            call_of("trapezoidal_motion", robot, limits, from, to));
      },
      R"(trapezoidal_motion(robot, start, end, *, limits=None)

The fastest `Motion` from rest to rest on the straight line in joint space within limits of velocity and acceleration. Limits
are a `Limits`, by default those of the robot; files rarely have accelerations:
`limits=robot.limits._replace(acceleration=[10.0] * 7)`, rad/s^2.)",
      "robot"_a, "start"_a, "end"_a, py::kw_only(), "limits"_a = py::none());
  m.def(
      "quintic_motion",
      [](py::handle robot, py::handle start, py::handle end, double at_least, py::handle limits) {
        const auto nq = chain_of(robot).chain().nq();
        const auto from = vector_from("start", start, nq), to = vector_from("end", end, nq);
        return motion_object(
            arm_from(robot, limits), [&](const arm_type& arm) { return kte::quintic_motion(arm, from, to, at_least); },
            call_of("quintic_motion", robot, limits, from, to, at_least));
      },
      R"(quintic_motion(robot, start, end, at_least=0.0, *, limits=None)

A `Motion` from rest to rest on the straight line in joint space by a polynomial of degree five, as fast as limits of velocity,
acceleration and jerk allow, with a duration of `at_least` this number of seconds. Limits as for `trapezoidal_motion`.)",
      "robot"_a, "start"_a, "end"_a, "at_least"_a = 0.0, py::kw_only(), "limits"_a = py::none());
}

}  // namespace kte_python
