#include <kte/statics.hpp>

#include "one_state.hpp"
#include "parts.hpp"
#include "wrenches.hpp"

namespace kte_python {

namespace {

py::object loads_from(py::handle loads) {
  return loads.is_none() ? py::object(py::dict()) : py::reinterpret_borrow<py::object>(loads);
}
kte::runtime_state state_with(const kte::runtime_chain& c, py::handle inputs) {
  kte::runtime_state s = c.make_state();
  if (!inputs.is_none()) put_inputs(c, s, inputs);
  return s;
}
/// f(chain, state with the inputs) without the GIL; Ctrl-C ends it.
template <class F>
auto compute_with(const chain_object& c, py::handle inputs, const F& f) {
  kte::runtime_state s = state_with(c.chain(), inputs);
  const lease held(c);
  return run_interruptibly([&] { return f(c.chain(), s); });
}
kte::natural_modes_result modes_at(const chain_object& c, py::handle inputs, const Eigen::VectorXd& q) {
  constexpr int quick = 30;  // coordinates: their modes take milliseconds
  if (c.chain().dofs() <= quick)
    return compute_with(c, inputs, [&](const auto& k, auto& s) { return kte::natural_modes(k, s, q); });
  const auto own = std::make_shared<kte::runtime_chain>(c.chain());
  const auto s = std::make_shared<kte::runtime_state>(state_with(*own, inputs));
  return run_aside([own, s, q] { return kte::natural_modes(*own, *s, q); });
}
py::object as_python(const kte::tangent_stability& x) {
  return result("Stability", py::make_tuple(x.stiffness, x.unstable, x.asymmetry));
}
const char* text_of(kte::equilibrium_status s) {
  return s == kte::equilibrium_status::stable     ? "stable"
         : s == kte::equilibrium_status::unstable ? "unstable"
                                                  : "not_reached";
}

}  // namespace

void bind_statics(py::module_& m) {
  using namespace py::literals;
  const auto none = py::none();
  m.def(
      "static_equilibrium",
      [](py::handle chain, py::handle q, py::handle inputs, py::handle loads, double tolerance, int iterations,
         bool must_reach) {
        const auto& c = chain_of(chain);
        const auto start = vector_from("q", q, c.chain().nq());
        const wrenches_argument wrenches(loads_from(loads));
        const auto r = compute_with(c, inputs, [&](const auto& k, auto& s) {
          return kte::static_equilibrium(k, s, start, {wrenches.all, tolerance, iterations, must_reach});
        });
        return result("Equilibrium", py::make_tuple(to_array(r.q), text_of(r.status), r.load, r.residual,
                                                    as_python(r.stability), r.load_steps, r.iterations));
      },
      R"(static_equilibrium(chain, q, *, inputs=None, loads=None, tolerance=1e-10, iterations=1000, must_reach=True)

The configuration `.q` in which the chain is at rest under its loads, by Newton's method from q; loads grow from zero, so
that the result is the shape to which they lead. `.status`: "stable", "unstable", or "not_reached", at the load factor
`.load`; `.residual`, N or Nm; `.stability`: the smallest eigenvalue `.stiffness` of the derivative of forces, N/m or
Nm/rad, the number of `.unstable` directions and the relative `.asymmetry`.

inputs      a dict of signals
loads       wrenches in addition to those of the chain: a dict from frames to 3 numbers, a force, N, or 6, with a
            torque, Nm, in axes of the frames
tolerance   of the last step, rad, and lengths relative to the size of the chain
iterations  at most
must_reach  raise NoSolution, which names what nothing holds, or the load factor reached, instead of "not_reached")",
      "chain"_a, "q"_a, py::kw_only(), "inputs"_a = none, "loads"_a = none, "tolerance"_a = 1e-10,
      "iterations"_a = 1000, "must_reach"_a = true);
  m.def(
      "equilibrium_path",
      [](py::handle chain, py::handle q, const std::string& parameter, double from, double to, double step, int points,
         py::handle inputs, py::handle loads, double tolerance) {
        const auto& c = chain_of(chain);
        const auto start = vector_from("q", q, c.chain().nq());
        const wrenches_argument wrenches(loads_from(loads));
        const auto path = compute_with(c, inputs, [&](const auto& k, auto& s) {
          return kte::equilibrium_path(k, s, start, {parameter, from, to, step, points, wrenches.all, tolerance});
        });
        const auto n = static_cast<Eigen::Index>(path.size());
        Eigen::VectorXd parameters(n), stiffness(n), unstable(n);
        Eigen::MatrixXd all(n, c.chain().nq());
        for (Eigen::Index i = 0; i < n; ++i) {
          const auto& x = path[static_cast<std::size_t>(i)];
          parameters[i] = x.parameter, all.row(i) = x.q.transpose();
          stiffness[i] = x.stability.stiffness, unstable[i] = x.stability.unstable;
        }
        return result("EquilibriumPath", py::make_tuple(to_array(parameters), to_array(all), to_array(stiffness),
                                                        to_array(unstable).attr("astype")("int64")));
      },
      R"(equilibrium_path(chain, q, *, parameter="", start=0.0, end=1.0, step=0.1, points=1000, inputs=None, loads=None,
                 tolerance=1e-10)

Equilibria from q on while a parameter goes from `start` to `end`, also through points where it turns back: arrays
`.parameter`, `.q`, `.stiffness` and `.unstable`, a row a point, as of `static_equilibrium`.

parameter  an input, or a coordinate of base_gen; empty: the load factor
step       largest distance of points: rad, lengths relative to the size of the chain, and the parameter to its range
points     at most
Others as for `static_equilibrium`.)",
      "chain"_a, "q"_a, py::kw_only(), "parameter"_a = "", "start"_a = 0.0, "end"_a = 1.0, "step"_a = 0.1,
      "points"_a = 1000, "inputs"_a = none, "loads"_a = none, "tolerance"_a = 1e-10);
  m.def(
      "natural_modes",
      [](py::handle chain, py::handle q, py::handle inputs) {
        const auto& c = chain_of(chain);
        const auto at = vector_from("q", q, c.chain().nq());
        const auto r = modes_at(c, inputs, at);
        return result("NaturalModes", py::make_tuple(to_array(r.frequency), to_array(r.damping),
                                                     complex_array(r.root, true), complex_array(r.shape, false)));
      },
      R"(natural_modes(chain, q, *, inputs=None)

Small motions about an equilibrium q, lowest first: `.frequency`, rad/s, `.damping` (ratio; negative if the mode grows),
`.root`, 1/s, and `.shape`, a column per mode along the numbers of v. A drift has frequency 0.)",
      "chain"_a, "q"_a, py::kw_only(), "inputs"_a = none);
}

}  // namespace kte_python
