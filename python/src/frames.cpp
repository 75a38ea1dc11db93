#include <kte/dynamics/forward_kinematics.hpp>
#include <kte/dynamics/frame_motion.hpp>
#include <kte/dynamics/jacobian.hpp>
#include <kte/dynamics/jacobian_rate.hpp>
#include <kte/dynamics/joint_reactions.hpp>
#include <kte/dynamics/relative_motion.hpp>

#include "define.hpp"
#include "parts.hpp"
#include "wrenches.hpp"

namespace kte_python {

using kte::runtime_chain;

namespace {

std::vector<shape> position_and_rotation(Py_ssize_t) { return {{3}, {3, 3}}; }

enum class axes_of { own, world, world_origin };
axes_of axes_from(const std::string& text) {
  if (text == "own") return axes_of::own;
  if (text == "world") return axes_of::world;
  if (text == "world_origin") return axes_of::world_origin;
  throw kte::bad_argument("kte: axes must be 'own', 'world' or 'world_origin', got '" + text + "'");
}
/// f(axes).
template <class F>
void with_axes(axes_of a, const F& f) {
  switch (a) {
    case axes_of::own:
      return f(kte::in_own_axes_t{});
    case axes_of::world:
      return f(kte::in_world_axes);
    case axes_of::world_origin:
      return f(kte::at_world_origin);
  }
}

py::object poses_of_all(py::handle chain, py::handle q, py::handle threads, const std::string& errors) {
  const auto& c = chain_of(chain);
  std::vector<std::string> names;
  std::vector<shape> shapes;
  for (const auto k : {kte::kind::frame_2D, kte::kind::frame_3D})
    for (const auto& name : c.chain().wiring().names[static_cast<std::size_t>(k)])
      names.push_back(name), shapes.push_back({3}), shapes.push_back({3, 3});
  const py::object all = call(c, {{"q", argument_of::q, q}}, shapes, 1, options_of({}, threads, errors),
                              [&names](const runtime_chain& k, workspace& w, double* const* out) {
                                kte::forward_kinematics(k, w.state, w.x[0]);
                                for (std::size_t i = 0; i < names.size(); ++i) {
                                  const auto pose = kte::forward_kinematics(k, w.state, w.x[0], names[i]);
                                  write_xyz(pose.position, out[2 * i]), write_rows(pose.rotation, out[2 * i + 1]);
                                }
                              });
  py::dict poses;
  for (std::size_t i = 0; i < names.size(); ++i)
    poses[py::str(names[i])] = result("Pose", py::make_tuple(all[py::int_(2 * i)], all[py::int_(2 * i + 1)]));
  return poses;
}

}  // namespace

void bind_frames(py::module_& m) {
  using namespace py::literals;
  const auto none = py::none();
  m.def(
      "forward_kinematics",
      [](py::handle chain, py::handle q, py::handle frame, py::handle threads, const std::string& errors) {
        if (frame.is_none()) return poses_of_all(chain, q, threads, errors);
        const auto name = frame.cast<std::string>();
        return result("Pose", call(chain_of(chain), {{"q", argument_of::q, q}}, {{3}, {3, 3}}, 0.5,
                                   options_of({}, threads, errors, "forward_kinematics", name),
                                   [&name](const runtime_chain& k, workspace& w, double* const* out) {
                                     const auto pose = kte::forward_kinematics(k, w.state, w.x[0], name);
                                     write_xyz(pose.position, out[0]), write_rows(pose.rotation, out[1]);
                                   }));
      },
      R"(forward_kinematics(chain, q, frame=None, *, threads=None, errors="raise")

The pose of a frame in axes of the base: `.position`, (3,), m, and `.rotation`, (3, 3), from axes of the frame to axes of
the base. Without a frame, a dict of the poses of all frames. Frames in the plane have z = 0 and rotate about z.)",
      "chain"_a, "q"_a, "frame"_a = none, py::kw_only(), "threads"_a = none, "errors"_a = "raise");
  m.def(
      "relative_pose",
      [](py::handle chain, py::handle q, const std::string& frame, const std::string& reference, py::handle threads,
         const std::string& errors) {
        return result("Pose", call(chain_of(chain), {{"q", argument_of::q, q}}, position_and_rotation(0), 1,
                                   options_of({}, threads, errors),
                                   [&](const runtime_chain& k, workspace& w, double* const* out) {
                                     const auto pose = kte::relative_pose(k, w.state, w.x[0], frame, reference);
                                     write_xyz(pose.position, out[0]), write_rows(pose.rotation, out[1]);
                                   }));
      },
      "relative_pose(chain, q, frame, reference, *, threads=None, errors=\"raise\")\n\nThe pose of a frame in another: "
      "`.position`, `.rotation`.",
      "chain"_a, "q"_a, "frame"_a, "reference"_a, py::kw_only(), "threads"_a = none, "errors"_a = "raise");
  define_of_frame<2>(m,
                     {"frame_velocity",
                      "frame_velocity(chain, q, v, frame, *, threads=None, errors=\"raise\")\n\n`.linear`, m/s, and "
                      "`.angular` velocity, "
                      "rad/s, of a frame, in its axes.",
                      two_xyz, 0.5, "LinearAngular"},
                     [](const runtime_chain& k, workspace& w, const std::string& frame, double* const* out) {
                       const auto x = kte::frame_velocity(k, w.state, w.x[0], w.x[1], frame);
                       write_xyz(x.linear, out[0]), write_xyz(x.angular, out[1]);
                     });
  define_of_frame<3>(
      m,
      {"frame_acceleration",
       "frame_acceleration(chain, q, v, a, frame, *, threads=None, errors=\"raise\")\n\n`.linear`, m/s^2, classical, "
       "without gravity: 0 at rest, where the proper one of recordings and states is g upward; and `.angular` "
       "acceleration, "
       "rad/s^2, of a frame, in its axes.",
       two_xyz, 0.5, "LinearAngular"},
      [](const runtime_chain& k, workspace& w, const std::string& frame, double* const* out) {
        const auto x = kte::frame_acceleration(k, w.state, w.x[0], w.x[1], w.x[2], frame);
        write_xyz(x.linear, out[0]), write_xyz(x.angular, out[1]);
      });
  m.def(
      "jacobian",
      [](py::handle chain, py::handle q, const std::string& frame, const std::string& axes, py::handle threads,
         const std::string& errors) {
        const auto& c = chain_of(chain);
        const auto in = axes_from(axes);
        const char* const function = in == axes_of::own     ? "jacobian"
                                     : in == axes_of::world ? "jacobian_in_world_axes"
                                                            : "";
        return call(c, {{"q", argument_of::q, q}}, six_by_n(c.chain().dofs()), 0.5,
                    options_of({}, threads, errors, function, frame),
                    [&](const runtime_chain& k, workspace& w, double* const* out) {
                      if (in == axes_of::own)
                        write(kte::jacobian(k, w.state, w.x[0], frame), out[0]);
                      else if (in == axes_of::world)
                        write(kte::jacobian(k, w.state, w.x[0], frame, kte::in_world_axes), out[0]);
                      else
                        write(kte::jacobian(k, w.state, w.x[0], frame, kte::at_world_origin), out[0]);
                    });
      },
      R"(jacobian(chain, q, frame, axes="own", *, threads=None, errors="raise")

The Jacobian of a frame, (6, nv), linear rows first: the velocity of the frame is J v. `axes`: "own", those of the frame;
"world", those of the base; "world_origin", of the point of the body at the origin of the base.)",
      "chain"_a, "q"_a, "frame"_a, "axes"_a = "own", py::kw_only(), "threads"_a = none, "errors"_a = "raise");
  m.def(
      "jacobian_rate",
      [](py::handle chain, py::handle q, py::handle v, const std::string& frame, const std::string& axes,
         py::handle threads, const std::string& errors) {
        const auto& c = chain_of(chain);
        const auto in = axes_from(axes);
        return call(c, {{"q", argument_of::q, q}, {"v", argument_of::v, v}}, six_by_n(c.chain().dofs()), 1,
                    options_of({}, threads, errors), [&](const runtime_chain& k, workspace& w, double* const* out) {
                      with_axes(in, [&](const auto& a) {
                        write(kte::jacobian_rate(k, w.state, w.x[0], w.x[1], frame, a), out[0]);
                      });
                    });
      },
      "jacobian_rate(chain, q, v, frame, axes=\"own\", *, threads=None, errors=\"raise\")\n\nThe time derivative of "
      "`jacobian`, (6, nv).",
      "chain"_a, "q"_a, "v"_a, "frame"_a, "axes"_a = "own", py::kw_only(), "threads"_a = none, "errors"_a = "raise");
  m.def(
      "relative_jacobian",
      [](py::handle chain, py::handle q, const std::string& frame, const std::string& reference, py::handle threads,
         const std::string& errors) {
        const auto& c = chain_of(chain);
        return call(c, {{"q", argument_of::q, q}}, six_by_n(c.chain().dofs()), 1, options_of({}, threads, errors),
                    [&](const runtime_chain& k, workspace& w, double* const* out) {
                      write(kte::relative_jacobian(k, w.state, w.x[0], frame, reference), out[0]);
                    });
      },
      "relative_jacobian(chain, q, frame, reference, *, threads=None, errors=\"raise\")\n\nThe Jacobian, (6, nv), of "
      "the "
      "motion of a frame in another, in axes of the frame.",
      "chain"_a, "q"_a, "frame"_a, "reference"_a, py::kw_only(), "threads"_a = none, "errors"_a = "raise");
  m.def(
      "bias_acceleration",
      [](py::handle chain, py::handle q, py::handle v, const std::string& frame, const std::string& axes,
         py::handle threads, const std::string& errors) {
        const auto in = axes_from(axes);
        return result("LinearAngular", call(chain_of(chain), {{"q", argument_of::q, q}, {"v", argument_of::v, v}},
                                            two_xyz(0), 1, options_of({}, threads, errors),
                                            [&](const runtime_chain& k, workspace& w, double* const* out) {
                                              with_axes(in, [&](const auto& a) {
                                                const auto x =
                                                    kte::bias_acceleration(k, w.state, w.x[0], w.x[1], frame, a);
                                                write_xyz(x.linear, out[0]), write_xyz(x.angular, out[1]);
                                              });
                                            }));
      },
      "bias_acceleration(chain, q, v, frame, axes=\"own\", *, threads=None, errors=\"raise\")\n\ndJ/dt v, which in "
      "\"world\" "
      "axes is the acceleration of the frame for a = 0: `.linear`, m/s^2, `.angular`, rad/s^2.",
      "chain"_a, "q"_a, "v"_a, "frame"_a, "axes"_a = "own", py::kw_only(), "threads"_a = none, "errors"_a = "raise");
  m.def(
      "external_forces",
      [](py::handle chain, py::handle q, py::handle wrenches, py::handle threads, const std::string& errors) {
        const auto& c = chain_of(chain);
        const wrenches_argument loads(wrenches);
        return call(c, {{"q", argument_of::q, q}}, {{c.chain().dofs()}}, 1, options_of({}, threads, errors),
                    [&loads](const runtime_chain& k, workspace& w, double* const* out) {
                      write_vector(kte::external_forces(k, w.state, w.x[0], loads.all), out[0]);
                    });
      },
      R"(external_forces(chain, q, wrenches, *, threads=None, errors="raise")

The generalized forces Q = sum J^T (F, T) of wrenches on frames, at their origins in their axes: a dict from frames to
3 numbers, F, or 6, F and T; N and Nm. Add them to `tau` of forward dynamics, take them off that of inverse dynamics.)",
      "chain"_a, "q"_a, "wrenches"_a, py::kw_only(), "threads"_a = none, "errors"_a = "raise");
  define_of_frame<3>(m,
                     {"joint_reaction",
                      "joint_reaction(chain, q, v, a, frame, *, threads=None, errors=\"raise\")\n\n`.force`, N, and "
                      "`.torque`, Nm, that "
                      "the joint or link which moves this frame applies to it, in its axes.",
                      two_xyz, 2, "Wrench"},
                     [](const runtime_chain& k, workspace& w, const std::string& frame, double* const* out) {
                       const auto x = kte::joint_reaction(k, w.state, w.x[0], w.x[1], w.x[2], frame);
                       write_xyz(x.force, out[0]), write_xyz(x.torque, out[1]);
                     });
}

}  // namespace kte_python
