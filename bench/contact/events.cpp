#include <kte/contacts.hpp>
#include <kte/kte.hpp>
#include <kte/models/runtime_dynamics_model.hpp>

#include "measure.hpp"

namespace contact_bench {

std::vector<row> event_rows(const scene& s, bool quick) {
  std::vector<row> rows;
  kte::manipulator_dynamics_model model(s.chain);
  const auto x0 = kte::settled(model, 0.0, model.make_x(s.q, s.v));
  // slow sliding in space is stiff, so that small tolerances cost much there
  const std::vector all = s.v.size() > 3 ? std::vector{1e-4, 1e-5, 1e-6} : std::vector{1e-4, 1e-6, 1e-9};
  for (const double tolerance : quick ? std::vector{all.front()} : all) {
    Eigen::VectorXd q;
    long long work = 0;
    const double seconds = fastest(quick ? 1 : 3, [&] {
      kte::dormand_prince45 solver(std::cref(model), 0.0, x0, {.absolute = tolerance, .relative = tolerance});
      solver.integrate(s.end, kte::element_events(model)).require_end();
      q = model.positions_of(solver.state()), work = solver.statistics().evaluations;
    });
    rows.push_back({s.name, "events", "tolerance " + text_of(tolerance), s.error(q), work, seconds});
  }
  return rows;
}

}  // namespace contact_bench
