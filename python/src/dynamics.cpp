#include <kte/dynamics/bias_forces.hpp>
#include <kte/dynamics/forward_dynamics.hpp>
#include <kte/dynamics/inverse_dynamics.hpp>
#include <kte/dynamics/mass_matrix.hpp>
#include <kte/dynamics/mass_matrix_inverse.hpp>

#include "batch.hpp"
#include "define.hpp"
#include "parts.hpp"

namespace kte_python {

namespace {

using kte::runtime_chain;

Py_ssize_t nv_of(const chain_object& c) { return c.chain().dofs(); }

const char* const doc_inverse = R"(inverse_dynamics(chain, q, v, a, *, inputs=None, threads=None, errors="raise")

Generalized forces tau = M a + C v + g - Q for accelerations a, N and Nm; Q are the forces of springs, dampers, motors.

Arguments have shape (n,) or (..., n), the result the same. Several states are computed in threads, and in packs if
the chain is of joints, links and bodies only. `inputs` is a dict of signals. A state without a result raises an error
with its number, or is NaN with errors="nan".)";
const char* const doc_forward = R"(forward_dynamics(chain, q, v, tau, *, inputs=None, threads=None, errors="raise")

Accelerations a = M^-1 (tau - C v - g + Q), by the articulated body algorithm; of chains with closed loops the
constrained ones. Arguments as for `inverse_dynamics`. Raises SingularMassMatrix if a coordinate moves no mass.)";

}  // namespace

void bind_dynamics(py::module_& m) {
  using namespace py::literals;
  const auto none = py::none();
  m.def(
      "inverse_dynamics",
      [](py::handle chain, py::handle q, py::handle v, py::handle a, py::handle inputs, py::handle threads,
         const std::string& errors) {
        const auto& c = chain_of(chain);
        return call(
            c, {{"q", argument_of::q, q}, {"v", argument_of::v, v}, {"a", argument_of::v, a}}, {{nv_of(c)}}, 1,
            options_of(inputs, threads, errors, "inverse_dynamics"),
            [](const runtime_chain& k, workspace& w, double* const* out) {
              write_vector(kte::inverse_dynamics(k, w.state, w.x[0], w.x[1], w.x[2]), out[0]);
            },
            inverse_dynamics_in_packs);
      },
      doc_inverse, "chain"_a, "q"_a, "v"_a, "a"_a, py::kw_only(), "inputs"_a = none, "threads"_a = none,
      "errors"_a = "raise");
  m.def(
      "forward_dynamics",
      [](py::handle chain, py::handle q, py::handle v, py::handle tau, py::handle inputs, py::handle threads,
         const std::string& errors) {
        const auto& c = chain_of(chain);
        return call(
            c, {{"q", argument_of::q, q}, {"v", argument_of::v, v}, {"tau", argument_of::v, tau}}, {{nv_of(c)}}, 2,
            options_of(inputs, threads, errors, "forward_dynamics"),
            [](const runtime_chain& k, workspace& w, double* const* out) {
              write_vector(kte::forward_dynamics(k, w.state, w.x[0], w.x[1], w.x[2]), out[0]);
            },
            forward_dynamics_in_packs);
      },
      doc_forward, "chain"_a, "q"_a, "v"_a, "tau"_a, py::kw_only(), "inputs"_a = none, "threads"_a = none,
      "errors"_a = "raise");

  m.def(
      "mass_matrix",
      [](py::handle chain, py::handle q, py::handle threads, const std::string& errors) {
        const auto& c = chain_of(chain);
        return call(
            c, {{"q", argument_of::q, q}}, {{nv_of(c), nv_of(c)}}, 1.5, options_of({}, threads, errors, "mass_matrix"),
            [](const runtime_chain& k, workspace& w, double* const* out) {
              write(kte::mass_matrix(k, w.state, w.x[0]), out[0]);
            },
            mass_matrix_in_packs);
      },
      "mass_matrix(chain, q, *, threads=None, errors=\"raise\")\n\nThe mass matrix M, (nv, nv), or (..., nv, nv); "
      "kg m^2, kg m, kg.",
      "chain"_a, "q"_a, py::kw_only(), "threads"_a = none, "errors"_a = "raise");
  define<1>(
      m,
      {"mass_matrix_inverse",
       "mass_matrix_inverse(chain, q, *, inputs=None, threads=None, errors=\"raise\")\n\nM^-1, without forming M, "
       "(nv, nv) or (..., nv, nv).",
       a_matrix, 2.5},
      [](const runtime_chain& k, workspace& w, double* const* out) {
        write(kte::mass_matrix_inverse(k, w.state, w.x[0]), out[0]);
      });
  define<1>(
      m,
      {"gravity_forces",
       "gravity_forces(chain, q, *, inputs=None, threads=None, errors=\"raise\")\n\nThe gravity terms g of inverse "
       "dynamics, of bodies only, N and Nm.",
       a_vector, 1},
      [](const runtime_chain& k, workspace& w, double* const* out) {
        write_vector(kte::gravity_forces(k, w.state, w.x[0]), out[0]);
      });
  define<1>(m,
            {"static_forces",
             "static_forces(chain, q, *, inputs=None, threads=None, errors=\"raise\")\n\nThe forces tau that hold the "
             "mechanism at rest, springs included, N and Nm.",
             a_vector, 1},
            [](const runtime_chain& k, workspace& w, double* const* out) {
              write_vector(kte::static_forces(k, w.state, w.x[0]), out[0]);
            });
  define<2>(
      m,
      {"nonlinear_effects",
       "nonlinear_effects(chain, q, v, *, inputs=None, threads=None, errors=\"raise\")\n\nThe bias forces g + C v - "
       "Q: inverse dynamics for a = 0, N and Nm.",
       a_vector, 1},
      [](const runtime_chain& k, workspace& w, double* const* out) {
        write_vector(kte::nonlinear_effects(k, w.state, w.x[0], w.x[1]), out[0]);
      });
  define<2>(
      m,
      {"coriolis_forces",
       "coriolis_forces(chain, q, v, *, inputs=None, threads=None, errors=\"raise\")\n\nC v, of bodies only, N and "
       "Nm.",
       a_vector, 1},
      [](const runtime_chain& k, workspace& w, double* const* out) {
        write_vector(kte::coriolis_forces(k, w.state, w.x[0], w.x[1]), out[0]);
      });
}

}  // namespace kte_python
