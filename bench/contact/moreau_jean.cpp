#include <kte/contacts.hpp>
#include <kte/kte.hpp>
#include <kte/models/runtime_dynamics_model.hpp>

#include "measure.hpp"

namespace contact_bench {

std::vector<row> moreau_jean_rows(const scene& s, bool quick) {
  std::vector<row> rows;
  kte::manipulator_dynamics_model model(s.chain);
  const auto x0 = model.make_x(s.q, s.v);
  for (const double step : quick ? std::vector{1e-2} : std::vector{1e-3, 1e-4, 1e-5}) {
    if (step * 2e7 < s.end) continue;
    Eigen::VectorXd q;
    long long work = 0;
    const double seconds = fastest(quick ? 1 : 3, [&] {
      kte::moreau_jean solver(std::cref(model), 0.0, x0, step);
      solver.integrate(s.end);
      q = model.positions_of(solver.state()), work = solver.statistics().evaluations;
    });
    rows.push_back({s.name, "moreau_jean", "h = " + text_of(step), s.error(q), work, seconds});
  }
  return rows;
}

}  // namespace contact_bench
