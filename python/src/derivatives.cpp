#include <kte/dynamics/coriolis_matrix.hpp>
#include <kte/dynamics/derivatives.hpp>
#include <kte/dynamics/hybrid_dynamics.hpp>
#include <kte/dynamics/regressor.hpp>

#include "define.hpp"
#include "parts.hpp"

namespace kte_python {

using kte::runtime_chain;

namespace {
std::vector<shape> vector_and_three_matrices(Py_ssize_t n) { return {{n}, {n, n}, {n, n}, {n, n}}; }
}  // namespace

void bind_derivatives(py::module_& m) {
  define<3>(m,
            {"inverse_dynamics_derivatives",
             R"(inverse_dynamics_derivatives(chain, q, v, a, *, inputs=None, threads=None, errors="raise")

Inverse dynamics and its derivatives: `.tau`, and the matrices `.by_q`, `.by_v`, `.by_a`, (nv, nv). Derivatives by q of
rotations and poses are along the numbers of v.)",
             vector_and_three_matrices, 4, "InverseDynamicsDerivatives"},
            [](const runtime_chain& k, workspace& w, double* const* out) {
              const auto& r = kte::inverse_dynamics_derivatives(k, w.state, w.x[0], w.x[1], w.x[2]);
              write_vector(r.tau, out[0]), write(r.by_q, out[1]), write(r.by_v, out[2]), write(r.by_a, out[3]);
            });
  define<3>(m,
            {"forward_dynamics_derivatives",
             R"(forward_dynamics_derivatives(chain, q, v, tau, *, inputs=None, threads=None, errors="raise")

Forward dynamics and its derivatives: `.a`, and the matrices `.by_q`, `.by_v`, `.by_tau`, (nv, nv).)",
             vector_and_three_matrices, 7, "ForwardDynamicsDerivatives", "tau"},
            [](const runtime_chain& k, workspace& w, double* const* out) {
              const auto& r = kte::forward_dynamics_derivatives(k, w.state, w.x[0], w.x[1], w.x[2]);
              write_vector(r.a, out[0]), write(r.by_q, out[1]), write(r.by_v, out[2]), write(r.by_tau, out[3]);
            });
  define<2>(m,
            {"coriolis_matrix",
             "coriolis_matrix(chain, q, v, *, inputs=None, threads=None, errors=\"raise\")\n\nC from Christoffel "
             "symbols, (nv, nv): "
             "dM/dt - 2 C is skew-symmetric.",
             a_matrix, 3},
            [](const runtime_chain& k, workspace& w, double* const* out) {
              write(kte::coriolis_matrix(k, w.state, w.x[0], w.x[1]), out[0]);
            });
  define<2>(m,
            {"mass_matrix_rate",
             "mass_matrix_rate(chain, q, v, *, inputs=None, threads=None, errors=\"raise\")\n\nThe time derivative "
             "dM/dt, (nv, nv).",
             a_matrix, 3},
            [](const runtime_chain& k, workspace& w, double* const* out) {
              write(kte::mass_matrix_rate(k, w.state, w.x[0], w.x[1]), out[0]);
            });

  using namespace py::literals;
  const auto none = py::none();
  m.def(
      "inertial_parameters",
      [](py::handle chain) { return to_array(kte::inertial_parameters(chain_of(chain).chain())); },
      R"(inertial_parameters(chain)

The inertial parameters pi of all bodies, in the order of the chain. Those of a body in space are m, m c_x, m c_y, m c_z,
I_xx, I_xy, I_yy, I_xz, I_yz, I_zz about the origin of its frame; in the plane m, m c_x, m c_y, I_zz; kg, kg m, kg m^2.)",
      "chain"_a);
  m.def(
      "torque_regressor",
      [](py::handle chain, py::handle q, py::handle v, py::handle a, py::handle threads, const std::string& errors) {
        const auto& c = chain_of(chain);
        const Py_ssize_t parameters = kte::inertial_parameters(c.chain()).size();
        return call(c, {{"q", argument_of::q, q}, {"v", argument_of::v, v}, {"a", argument_of::v, a}},
                    {{c.chain().dofs(), parameters}}, 4, options_of({}, threads, errors),
                    [](const runtime_chain& k, workspace& w, double* const* out) {
                      write(kte::torque_regressor(k, w.state, w.x[0], w.x[1], w.x[2]), out[0]);
                    });
      },
      R"(torque_regressor(chain, q, v, a, *, threads=None, errors="raise")

The regressor Y, (nv, parameters): Y pi = M a + C v + g with pi = inertial_parameters(chain).)",
      "chain"_a, "q"_a, "v"_a, "a"_a, py::kw_only(), "threads"_a = none, "errors"_a = "raise");
  m.def(
      "hybrid_dynamics",
      [](py::handle chain, py::handle q, py::handle v, py::handle known, py::handle prescribed, py::handle inputs,
         py::handle threads, const std::string& errors) {
        const auto& c = chain_of(chain);
        const Py_ssize_t n = c.chain().dofs();
        const auto names = names_from(prescribed);
        const std::vector<std::string_view> views(names.begin(), names.end());
        return result("HybridDynamics",
                      call(c, {{"q", argument_of::q, q}, {"v", argument_of::v, v}, {"known", argument_of::v, known}},
                           {{n}, {n}}, 3, options_of(inputs, threads, errors),
                           [&views](const runtime_chain& k, workspace& w, double* const* out) {
                             const auto r = kte::hybrid_dynamics(k, w.state, w.x[0], w.x[1], w.x[2], views);
                             write_vector(r.a, out[0]), write_vector(r.tau, out[1]);
                           }));
      },
      R"(hybrid_dynamics(chain, q, v, known, prescribed, *, inputs=None, threads=None, errors="raise")

`.a` and `.tau` where `known` holds the acceleration of the coordinates that are `prescribed`, by name, and the force on
all others.)",
      "chain"_a, "q"_a, "v"_a, "known"_a, "prescribed"_a, py::kw_only(), "inputs"_a = none, "threads"_a = none,
      "errors"_a = "raise");
}

}  // namespace kte_python
