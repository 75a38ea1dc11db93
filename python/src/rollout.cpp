#include <kte/errors.hpp>

#include "call.hpp"
#include "parts.hpp"
#include "simulation_in_lanes.hpp"

namespace kte_python {

void bind_rollout(py::module_& m) {
  using namespace py::literals;
  m.def(
      "_rollout_in_lanes",
      [](py::handle chain, py::handle q, py::handle v, py::handle tau, double every, double step,
         py::handle threads) -> py::object {
        const auto& object = chain_of(chain);
        const auto& c = object.chain();
        if (!can_be_in_lanes(c, "runge_kutta4")) return py::none();
        const numbers starts("q", q, c.nq()), rates("v", v, c.dofs()), forces("tau", tau, c.dofs());
        const Py_ssize_t count = starts.states(), steps = forces.leading().back();
        std::vector<double> memory[3];
        array positions({count, steps + 1, static_cast<Py_ssize_t>(c.nq())}),
            velocities({count, steps + 1, static_cast<Py_ssize_t>(c.dofs())});
        const rollout_arrays all{static_cast<std::size_t>(count),
                                 static_cast<std::size_t>(steps),
                                 starts.contiguous(count, memory[0]),
                                 rates.contiguous(count, memory[1]),
                                 forces.contiguous(count * steps, memory[2]),
                                 positions.mutable_data(),
                                 velocities.mutable_data()};
        const interruptible_threads team(threads_from(threads));
        const lease held(object);
        const py::gil_scoped_release without;
        if (count > 0) rollouts_in_lanes(c, all, every, step, team);
        const py::gil_scoped_acquire with;
        return py::make_tuple(positions, velocities);
      },
      "chain"_a, "q"_a, "v"_a, "tau"_a, "every"_a, "step"_a, "threads"_a);
}

}  // namespace kte_python
