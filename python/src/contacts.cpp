#include <kte/contacts.hpp>

#include <pybind11/stl.h>

#include "one_state.hpp"
#include "parts.hpp"

namespace kte_python {

namespace {

py::object contact_of(const kte::contact_state<>& x) {
  const char* const modes[]{"open", "sticks", "slides"};
  return result("Contact", py::make_tuple(modes[static_cast<int>(kte::mode_of(x))], x.gap, xyz_array(x.force),
                                          xyz_array(x.point), xyz_array(x.slip), xyz_array(x.direction)));
}
kte::chosen_contacts named_contacts(const py::handle& names) { return {names_from(names)}; }

/// Arguments of functions of a state.
struct state_arguments {
  const chain_object& c;
  Eigen::VectorXd q, v, tau;
  state_arguments(py::handle chain, py::handle q_, py::handle v_ = {}, py::handle tau_ = {})
      : c(chain_of(chain)), q(vector_from("q", q_, c.chain().nq())) {
    if (v_) v = vector_from("v", v_, c.chain().dofs());
    if (tau_) tau = vector_from("tau", tau_, c.chain().dofs());
  }
};

void bind_motions(py::module_& m) {
  using namespace py::literals;
  m.def(
      "contact_dynamics",
      [](py::handle chain, py::handle q, py::handle v, py::handle tau) {
        const state_arguments x(chain, q, v, tau);
        const auto r =
            compute(x.c, [&](const auto& k, auto& s) { return kte::contact_dynamics(k, s, x.q, x.v, x.tau); });
        py::dict contacts;
        for (std::size_t i = 0; i < r.names.size(); ++i) contacts[py::str(r.names[i])] = contact_of(r.contacts[i]);
        return result("ContactDynamics", py::make_tuple(to_array(r.a), contacts, r.several));
      },
      R"(contact_dynamics(chain, q, v, tau)

Accelerations `.a` of a chain with rigid contacts, and `.contacts[name]`: `.mode` ("open", "sticks", "slides"), `.gap`, m,
`.force` on the body, N, `.point`, m, `.slip`, m/s, and `.direction` of sliding, in axes of the surface. `.several` tells
whether other accelerations satisfy the laws of contact too.)",
      "chain"_a, "q"_a, "v"_a, "tau"_a);
  m.def(
      "contact_dynamics_derivatives",
      [](py::handle chain, py::handle q, py::handle v, py::handle tau) {
        const state_arguments x(chain, q, v, tau);
        const auto r = compute(
            x.c, [&](const auto& k, auto& s) { return kte::contact_dynamics_derivatives(k, s, x.q, x.v, x.tau); });
        py::dict forces;
        for (std::size_t i = 0; i < r.names.size(); ++i) {
          const auto& f = r.contacts[i];
          forces[py::str(r.names[i])] =
              result("ForceDerivatives",
                     py::make_tuple(to_array(f.force_by_q), to_array(f.force_by_v), to_array(f.force_by_tau)));
        }
        return result("ContactDynamicsDerivatives",
                      py::make_tuple(to_array(r.a), to_array(r.by_q), to_array(r.by_v), to_array(r.by_tau), forces));
      },
      R"(contact_dynamics_derivatives(chain, q, v, tau)

Derivatives `.by_q` (along the numbers of v), `.by_v`, `.by_tau` of the accelerations `.a` of `contact_dynamics`, in the modes
of its contacts, and those of contact forces: `.forces[name].by_q` ..., (3, nv).)",
      "chain"_a, "q"_a, "v"_a, "tau"_a);
  m.def(
      "impact",
      [](py::handle chain, py::handle q, py::handle v, bool sequential) {
        const state_arguments x(chain, q, v);
        const auto law = sequential ? kte::impact_law::sequential : kte::impact_law::at_once;
        const auto r = compute(x.c, [&](const auto& k, auto& s) { return kte::impact(k, s, x.q, x.v, law); });
        py::dict impulses;
        for (std::size_t i = 0; i < r.names.size(); ++i) impulses[py::str(r.names[i])] = xyz_array(r.impulses[i]);
        return result("Impact", py::make_tuple(to_array(r.v), impulses, r.energy, r.restitution));
      },
      R"(impact(chain, q, v, sequential=False)

The velocities `.v` after an impact of the contacts that touch, `.impulses[name]`, Ns, the change of kinetic `.energy`, J, and
the factor `.restitution` of all coefficients that keeps energy from growing. `sequential`: one contact after the other.)",
      "chain"_a, "q"_a, "v"_a, "sequential"_a = false);
}

void bind_geometry(py::module_& m) {
  using namespace py::literals;
  m.def(
      "contact_jacobian",
      [](py::handle chain, py::handle q, py::handle contacts) {
        const state_arguments x(chain, q);
        const auto of = named_contacts(contacts);
        return to_array(compute(x.c, [&](const auto& k, auto& s) { return kte::contact_jacobian(k, s, x.q, of); }));
      },
      R"(contact_jacobian(chain, q, contacts=())

The Jacobian J of contacts, by default of those that touch, (3 each, nv), in the plane (2 each, nv): their velocities are J v, in
axes of the surface.)",
      "chain"_a, "q"_a, "contacts"_a = py::tuple());
  m.def(
      "contact_jacobian_rate",
      [](py::handle chain, py::handle q, py::handle v, py::handle contacts) {
        const state_arguments x(chain, q, v);
        const auto of = named_contacts(contacts);
        return to_array(
            compute(x.c, [&](const auto& k, auto& s) { return kte::contact_jacobian_rate(k, s, x.q, x.v, of); }));
      },
      "contact_jacobian_rate(chain, q, v, contacts=())\n\nThe rate of `contact_jacobian` at the velocities v.",
      "chain"_a, "q"_a, "v"_a, "contacts"_a = py::tuple());
  m.def(
      "delassus_matrix",
      [](py::handle chain, py::handle q, py::handle contacts) {
        const state_arguments x(chain, q);
        const auto of = named_contacts(contacts);
        return to_array(compute(x.c, [&](const auto& k, auto& s) { return kte::delassus_matrix(k, s, x.q, of); }));
      },
      "delassus_matrix(chain, q, contacts=())\n\nJ M^-1 J^T of contacts, 1/kg, with J of `contact_jacobian`.",
      "chain"_a, "q"_a, "contacts"_a = py::tuple());
  m.def(
      "operational_inertia",
      [](py::handle chain, py::handle q, py::handle contacts, py::handle frame) {
        const state_arguments x(chain, q);
        if (frame.is_none()) {
          const auto of = named_contacts(contacts);
          return to_array(
              compute(x.c, [&](const auto& k, auto& s) { return kte::operational_inertia(k, s, x.q, of); }));
        }
        if (!names_from(contacts).empty())
          throw kte::bad_argument("kte: operational_inertia is that of contacts or of a frame, not of both");
        const auto name = frame.cast<std::string>();
        return to_array(
            compute(x.c, [&](const auto& k, auto& s) { return kte::operational_inertia(k, s, x.q, name); }));
      },
      R"(operational_inertia(chain, q, contacts=(), *, frame=None)

The operational-space inertia (J M^-1 J^T)^-1 of contacts, kg, or of a frame, (6, 6), in its axes. Raises NoSolution for
dependent rows.)",
      "chain"_a, "q"_a, "contacts"_a = py::tuple(), py::kw_only(), "frame"_a = py::none());
  m.def(
      "support_polygon",
      [](py::handle chain, py::handle q, py::handle contacts) {
        const state_arguments x(chain, q);
        const auto of = named_contacts(contacts);
        const auto r = compute(x.c, [&](const auto& k, auto& s) { return kte::support_polygon(k, s, x.q, of); });
        Eigen::MatrixXd corners(static_cast<Eigen::Index>(r.corners.size()), 3);
        for (std::size_t i = 0; i < r.corners.size(); ++i)
          corners.row(static_cast<Eigen::Index>(i)) << r.corners[i].x, r.corners[i].y, r.corners[i].z;
        return result("SupportPolygon", py::make_tuple(r.contacts, to_array(corners), xyz_array(r.normal), r.area()));
      },
      R"(support_polygon(chain, q, contacts=())

The convex hull of contacts with one plane, by default of those that touch: `.corners`, (n, 3), m, counterclockwise about
`.normal`, in axes of the frame of the surface, the names of `.contacts`, and the `.area`, m^2.)",
      "chain"_a, "q"_a, "contacts"_a = py::tuple());
  m.def(
      "centre_of_pressure",
      [](py::handle chain, py::handle q, py::handle v, py::handle tau, py::handle contacts) {
        const state_arguments x(chain, q, v, tau);
        const auto of = named_contacts(contacts);
        return xyz_array(compute(x.c, [&](const auto& k, auto& s) {
          kte::contact_dynamics(k, s, x.q, x.v, x.tau);
          return kte::centre_of_pressure(k, s, of);
        }));
      },
      R"(centre_of_pressure(chain, q, v, tau, contacts=())

Where the forces of `contact_dynamics` on contacts with one plane have no moment along the plane, m, in axes of the frame of its
surface.)",
      "chain"_a, "q"_a, "v"_a, "tau"_a, "contacts"_a = py::tuple());
}

}  // namespace

void bind_contacts(py::module_& m) { bind_motions(m), bind_geometry(m); }

}  // namespace kte_python
