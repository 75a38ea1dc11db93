#include <kte/dynamics/configuration_space.hpp>
#include <kte/manipulators/nearest.hpp>
#include <kte/manipulators/numerical_inverse_kinematics.hpp>
#include <kte/manipulators/runtime_manipulator.hpp>

#include <cstdio>
#include <pybind11/stl.h>

#include "call.hpp"
#include "joint_limits.hpp"
#include "parts.hpp"

namespace kte_python {

namespace {

using arm_type = kte::manipulator<kte::runtime_chain>;

kte::vec3<> position_from(py::handle x) {
  const auto p = vector_from("position", x, 3);
  return {p[0], p[1], p[2]};
}
kte::mat3<kte::vec3<>> rotation_from(py::handle x) {
  const py::object matrix = py::hasattr(x, "as_matrix") ? x.attr("as_matrix")() : py::reinterpret_borrow<py::object>(x);
  const auto r = matrix_from("rotation", matrix, 3, 3);
  return {{r(0, 0), r(0, 1), r(0, 2)}, {r(1, 0), r(1, 1), r(1, 2)}, {r(2, 0), r(2, 1), r(2, 2)}};
}

const char* text_of(kte::numerical_ik_status s) {
  switch (s) {
    case kte::numerical_ik_status::reached:
      return "reached";
    case kte::numerical_ik_status::at_limits:
      return "at_limits";
    case kte::numerical_ik_status::local_minimum:
      return "local_minimum";
  }
  return "";
}

std::string in_three_digits(double x) {
  char text[32];
  std::snprintf(text, sizeof text, "%.3g", x);
  return text;
}

/// The tuple of kte.InverseKinematics.
struct answer {
  Eigen::VectorXd q;
  std::string status;
  double position, rotation;
};
py::object as_object(const answer& a) {
  return result("InverseKinematics", py::make_tuple(to_array(a.q), a.status, a.position, a.rotation));
}

/// Whether a position is farther from the base of a frame than all links in a row are long. False for chains with
/// joints that slide or have several coordinates.
bool is_too_far(const kte::runtime_chain& c, const std::string& frame, const kte::vec3<>& position) {
  const kte::runtime_state s = c.make_state();
  const auto& f = s.tree().body_tree;
  const auto length = [](const kte::vec3<>& x) { return std::sqrt(dot(x, x)); };
  const auto& at = f.frame(kte::kind::frame_3D, c.wiring().find(frame, kte::kind::frame_3D));
  double reach = length(at.at.position), first = 0;
  kte::vec3<> shoulder{};
  for (int slot = at.slot; slot >= f.bases;) {
    const auto& r = f.nodes[static_cast<std::size_t>(slot - f.bases)];
    if (r.moves != kte::tree::joint::revolute) return false;
    reach += first, first = length(r.position), shoulder = r.position, slot = r.parent;
  }
  return length(position - shoulder) > reach * (1 + 1e-9);
}
/// The nearest to q within limits, in closed form if there is one.
answer nearest_to(const kte::runtime_chain& c, const arm_type& arm, const std::string& frame,
                  const kte::vec3<>& position, const kte::mat3<kte::vec3<>>* rotation, const Eigen::VectorXd& q,
                  bool numeric) {
  bool too_far = false;
  if (rotation && !numeric && arm.family() != kte::arm_family::none) {
    try {
      const auto a = kte::inverse_kinematics(arm, kte::pose{*rotation, position}, kte::nearest(q));
      return {Eigen::VectorXd(a.q), "reached", a.position, a.rotation};
    } catch (const kte::unreachable& e) {  // then the nearest that there is within limits
      too_far = e.reason == kte::unreachable_reason::distance;
    }
  }
  const kte::numerical_ik_options how{.numeric = numeric};
  const auto put = [&](const auto& r) {
    too_far = r.status != kte::numerical_ik_status::reached && (too_far || is_too_far(c, frame, position));
    return answer{Eigen::VectorXd(r.q), too_far ? "out_of_reach" : text_of(r.status), r.position, r.rotation};
  };
  if (rotation)
    return put(kte::numerical_inverse_kinematics(arm, kte::reach(frame, kte::pose{*rotation, position}), q, how));
  return put(kte::numerical_inverse_kinematics(arm, kte::reach_position(frame, position), q, how));
}

}  // namespace

void bind_inverse_kinematics(py::module_& m) {
  using namespace py::literals;
  const auto none = py::none();
  m.def(
      "inverse_kinematics",
      [](py::handle arm, const std::string& frame, py::handle position, py::handle rotation, py::handle start,
         py::handle limits, bool numeric, bool must_reach) {
        const auto& c = chain_of(arm).chain();
        const arm_type manipulator(c, std::vector<std::string>{frame}, limits_from(arm, limits));
        const auto p = position_from(position);
        kte::mat3<kte::vec3<>> r{};
        const bool turned = !rotation.is_none();
        if (turned) r = rotation_from(rotation);
        Eigen::VectorXd q =
            start.is_none() ? Eigen::VectorXd(kte::neutral_configuration(c)) : vector_from("start", start, c.nq());
        const auto a =
            run_interruptibly([&] { return nearest_to(c, manipulator, frame, p, turned ? &r : nullptr, q, numeric); });
        if (must_reach && a.status != "reached")
          throw kte::unreachable("kte: '" + frame + "' does not get there (" + a.status +
                                     "): " + in_three_digits(a.position) + " m and " + in_three_digits(a.rotation) +
                                     " rad are left",
                                 kte::unreachable_reason::local_minimum, {}, a.position, a.rotation);
        return as_object(a);
      },
      R"(inverse_kinematics(arm, frame, position, rotation=None, *, start=None, limits=None, numeric=False, must_reach=False)

A configuration within limits whose frame is at a position, m, and rotation, (3, 3), in axes of the base; without a
rotation only the position matters. In closed form if the arm has one, near `start`, else numerically from `start`.
Limits are a `Limits`, by default those of a robot. Returns `.q`, `.status` and the errors `.position_error`, m, and
`.rotation_error`, rad. Status: "reached"; otherwise q is the best configuration found, "out_of_reach" if the arm is too
short for the pose, "at_limits", or "local_minimum"; must_reach: raise Unreachable instead.)",
      "arm"_a, "frame"_a, "position"_a, "rotation"_a = none, py::kw_only(), "start"_a = none, "limits"_a = none,
      "numeric"_a = false, "must_reach"_a = false);
  m.def(
      "inverse_kinematics_all",
      [](py::handle arm, const std::string& frame, py::handle position, py::handle rotation, py::handle limits) {
        const arm_type manipulator(chain_of(arm).chain(), std::vector<std::string>{frame}, limits_from(arm, limits));
        py::list all;
        for (const auto& a :
             kte::inverse_kinematics(manipulator, kte::pose{rotation_from(rotation), position_from(position)}))
          if (a.exact)
            all.append(as_object(
                {Eigen::VectorXd(a.q), a.within_limits ? "reached" : "beyond_limits", a.position, a.rotation}));
        return all;
      },
      R"(inverse_kinematics_all(arm, frame, position, rotation, *, limits=None)

All configurations that reach a pose, of arms with a closed form: a list with `.q`, `.status` ("reached" or
"beyond_limits") and the errors `.position_error` and `.rotation_error`. It is empty beyond the reach of the arm; the configuration that
comes nearest is that of `inverse_kinematics`. Raises Error for arms without a closed form.)",
      "arm"_a, "frame"_a, "position"_a, "rotation"_a, py::kw_only(), "limits"_a = none);
}

}  // namespace kte_python
