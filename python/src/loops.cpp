#include <kte/dynamics/closed_loops/actuated_derivatives.hpp>
#include <kte/dynamics/closed_loops/actuated_forces.hpp>
#include <kte/dynamics/closed_loops/assemblies.hpp>
#include <kte/dynamics/closed_loops/constrained_dynamics.hpp>
#include <kte/dynamics/closed_loops/derivatives.hpp>

#include <pybind11/stl.h>

#include "one_state.hpp"
#include "parts.hpp"

namespace kte_python {

namespace {

void bind_derivatives_of_loops(py::module_& m) {
  using namespace py::literals;
  m.def(
      "constrained_dynamics_derivatives",
      [](py::handle chain, py::handle q, py::handle v, py::handle tau) {
        const auto& c = chain_of(chain);
        const auto positions = vector_from("q", q, c.chain().nq()), rates = vector_from("v", v, c.chain().dofs()),
                   forces = vector_from("tau", tau, c.chain().dofs());
        const auto r = compute(c, [&](const auto& k, auto& s) {
          return kte::constrained_dynamics_derivatives(k, s, positions, rates, forces);
        });
        return result(
            "ConstrainedDynamicsDerivatives",
            py::make_tuple(to_array(r.a), to_array(r.by_q), to_array(r.by_v), to_array(r.by_tau), to_array(r.lambda),
                           to_array(r.lambda_by_q), to_array(r.lambda_by_v), to_array(r.lambda_by_tau)));
      },
      R"(constrained_dynamics_derivatives(chain, q, v, tau)

Derivatives `.by_q` (along the numbers of v), `.by_v`, `.by_tau` of the accelerations `.a` of `constrained_dynamics`, and of the
closure `.forces` by the rows of `loop_jacobian`: `.forces_by_q` ... All coordinates are independent in them; along motions on
the loops they are `by_q @ loop_motion(...)`.)",
      "chain"_a, "q"_a, "v"_a, "tau"_a);
  m.def(
      "actuated_dynamics_derivatives",
      [](py::handle chain, py::handle q, py::handle v, py::handle tau, py::handle actuated) {
        const auto& c = chain_of(chain);
        const auto positions = vector_from("q", q, c.chain().nq()), rates = vector_from("v", v, c.chain().dofs()),
                   forces = vector_from("tau", tau, c.chain().dofs());
        const kte::actuated_coordinates names{names_from(actuated)};
        const auto r = compute(c, [&](const auto& k, auto& s) {
          return kte::actuated_dynamics_derivatives(k, s, positions, rates, forces, names);
        });
        return result("ForwardDynamicsDerivatives",
                      py::make_tuple(to_array(r.a), to_array(r.by_q), to_array(r.by_v), to_array(r.by_tau)));
      },
      R"(actuated_dynamics_derivatives(chain, q, v, tau, actuated)

The accelerations `.a` of the actuated coordinates y of a chain with loops, and their derivatives `.by_q`, `.by_v`, `.by_tau` by
y, y' and the forces on y; the other coordinates follow on the loops. q, v and tau are those of all coordinates.)",
      "chain"_a, "q"_a, "v"_a, "tau"_a, "actuated"_a);
}

}  // namespace

void bind_loops(py::module_& m) {
  using namespace py::literals;
  bind_derivatives_of_loops(m);
  m.def(
      "assemblies",
      [](py::handle chain, int n, py::handle q, py::handle held) {
        const auto& c = chain_of(chain);
        if (n < 0) throw kte::bad_argument("kte: n must not be negative, got " + std::to_string(n));
        const auto at = q.is_none() ? kte::neutral_configuration(c.chain()) : vector_from("q", q, c.chain().nq());
        const kte::held_coordinates names{names_from(held)};
        const auto all = compute(c, [&](const auto& k, auto& s) { return kte::assemblies(k, s, n, at, names); });
        Eigen::MatrixXd rows(static_cast<Eigen::Index>(all.size()), c.chain().nq());
        for (std::size_t i = 0; i < all.size(); ++i) rows.row(static_cast<Eigen::Index>(i)) = all[i].transpose();
        return to_array(rows);
      },
      R"(assemblies(chain, n, q=None, held=())

All configurations with closed loops that are found from n random starts, a row each; coordinates that are `held`, by name, have
their values in q. Starts have a fixed seed. Raises BadArgument if the mechanism can still move.)",
      "chain"_a, "n"_a, "q"_a = py::none(), "held"_a = py::tuple());
  m.def(
      "assemble",
      [](py::handle chain, py::handle guess, py::handle held) {
        const auto& c = chain_of(chain);
        const auto q = vector_from("guess", guess, c.chain().nq());
        const kte::held_coordinates names{names_from(held)};
        return to_array(
            compute(c, [&](const auto& k, auto& s) -> Eigen::VectorXd { return kte::assemble(k, s, q, names); }));
      },
      R"(assemble(chain, guess, held=())

A configuration with closed loops, from a guess; coordinates that are `held`, by name, keep their values. Raises
CannotAssemble, with the closure that stays open and its gap.)",
      "chain"_a, "guess"_a, "held"_a = py::tuple());
  m.def(
      "consistent_velocities",
      [](py::handle chain, py::handle q, py::handle v) {
        const auto& c = chain_of(chain);
        const auto positions = vector_from("q", q, c.chain().nq()), rates = vector_from("v", v, c.chain().dofs());
        return to_array(compute(c, [&](const auto& k, auto& s) -> Eigen::VectorXd {
          return kte::consistent_velocities(k, s, positions, rates);
        }));
      },
      "consistent_velocities(chain, q, v)\n\nThe velocities nearest to v, in kinetic energy, that keep loops closed.",
      "chain"_a, "q"_a, "v"_a);
  m.def(
      "constrained_dynamics",
      [](py::handle chain, py::handle q, py::handle v, py::handle tau) {
        const auto& c = chain_of(chain);
        const auto positions = vector_from("q", q, c.chain().nq()), rates = vector_from("v", v, c.chain().dofs()),
                   forces = vector_from("tau", tau, c.chain().dofs());
        const auto r = compute(
            c, [&](const auto& k, auto& s) { return kte::constrained_dynamics(k, s, positions, rates, forces); });
        py::dict loops;
        for (std::size_t i = 0; i < r.names.size(); ++i)
          loops[py::str(r.names[i])] =
              result("Wrench", py::make_tuple(xyz_array(r.loops[i].force), xyz_array(r.loops[i].torque)));
        return result("ConstrainedDynamics", py::make_tuple(to_array(r.a), loops, r.rank, r.mobility, r.dependent));
      },
      R"(constrained_dynamics(chain, q, v, tau)

Accelerations `.a` of a chain with loops, the forces of closures `.loops[name].force`, N, and `.torque`, Nm, the `.rank` of
their rows, the `.mobility`, and the `.dependent` rows, which follow from others and get no force.)",
      "chain"_a, "q"_a, "v"_a, "tau"_a);
  m.def(
      "loops",
      [](py::handle chain, py::handle q) {
        const auto& c = chain_of(chain);
        const auto positions = vector_from("q", q, c.chain().nq());
        const auto r = compute(c, [&](const auto& k, auto& s) { return kte::loops(k, s, positions); });
        return result(
            "Loops", py::make_tuple(r.rows, r.rank, r.mobility, r.pivot_ratio, r.gap, r.widest, r.dependent, r.blocks));
      },
      R"(loops(chain, q)

The closures at q: `.rows`, `.rank`, `.mobility`, `.pivot_ratio` (near zero at singular configurations), the widest `.gap`,
m or rad, and the closure `.widest` that has it, `.dependent` rows, and `.blocks` of closures that share coordinates.)",
      "chain"_a, "q"_a);
  m.def(
      "loop_jacobian",
      [](py::handle chain, py::handle q) {
        const auto& c = chain_of(chain);
        const auto positions = vector_from("q", q, c.chain().nq());
        return to_array(
            compute(c, [&](const auto& k, auto& s) -> Eigen::MatrixXd { return kte::loop_jacobian(k, s, positions); }));
      },
      "loop_jacobian(chain, q)\n\nThe Jacobian of all closures, (rows, nv): the rates of their residuals are J v.",
      "chain"_a, "q"_a);
  m.def(
      "loop_motion",
      [](py::handle chain, py::handle q, py::handle actuated) {
        const auto& c = chain_of(chain);
        const auto positions = vector_from("q", q, c.chain().nq());
        const kte::actuated_coordinates names{names_from(actuated)};
        return to_array(compute(
            c, [&](const auto& k, auto& s) -> Eigen::MatrixXd { return kte::loop_motion(k, s, positions, names); }));
      },
      R"(loop_motion(chain, q, actuated)

G, (nv, actuated): v = G v_actuated. G^T M G is the mass matrix of the mechanism, `jacobian(...) @ G` its Jacobian.)",
      "chain"_a, "q"_a, "actuated"_a);
  m.def(
      "actuated_forces",
      [](py::handle chain, py::handle q, py::handle v, py::handle a, py::handle actuated) {
        const auto& c = chain_of(chain);
        const auto positions = vector_from("q", q, c.chain().nq()), rates = vector_from("v", v, c.chain().dofs()),
                   accelerations = vector_from("a", a, c.chain().dofs());
        const kte::actuated_coordinates names{names_from(actuated)};
        return to_array(compute(c, [&](const auto& k, auto& s) -> Eigen::VectorXd {
          return kte::inverse_dynamics(k, s, positions, rates, accelerations, names);
        }));
      },
      "actuated_forces(chain, q, v, a, actuated)\n\nInverse dynamics of a chain with loops: the forces at the actuated "
      "coordinates, in their order, by which accelerations a happen.",
      "chain"_a, "q"_a, "v"_a, "a"_a, "actuated"_a);
}

}  // namespace kte_python
