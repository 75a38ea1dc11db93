#include <algorithm>
#include <cstdio>

#include "data/problems/iiwa14_free_swing.hpp"
#include "measure.hpp"
#include "mechanism.hpp"
#include "more.hpp"

namespace work_precision {
namespace {

using kte::problems::iiwa14_free_swing;
using model = mechanism<iiwa14_free_swing>;
using state = model::state;

/// Seconds of an evaluation, each after the last one, as those of an integration are.
double time_evaluation(const std::vector<state>& states, long long count) {
  model::rate r = model::rate::Zero();
  const double before = cpu_seconds();
  std::size_t i = 0;
  for (long long n = 0; n < count; ++n) {
    state x = states[i];
    x[0] += 1e-300 * r[0];
    r = the<iiwa14_free_swing>(0.0, x);
    if (++i == states.size()) i = 0;
  }
  return (cpu_seconds() - before) / static_cast<double>(count);
}

double median(std::vector<double> x) {
  std::nth_element(x.begin(), x.begin() + static_cast<std::ptrdiff_t>(x.size() / 2), x.end());
  return x[x.size() / 2];
}

template <class Solver, class Setting>
void print_overhead_of(const char* name, const Setting& setting, int rounds) {
  const state start = kte::problems::equation_of_motion<iiwa14_free_swing>::start();
  std::vector<state> states;
  Solver recorded(std::cref(the<iiwa14_free_swing>), 0.0, start, setting);
  recorded.integrate(1.0, [&](double, const state& x) { states.push_back(x); });
  const long long count = recorded.statistics().evaluations;
  std::vector<double> whole, one, percent;
  for (int i = 0; i < rounds; ++i) {
    const double before = cpu_seconds();
    Solver solver(std::cref(the<iiwa14_free_swing>), 0.0, start, setting);
    solver.integrate(1.0);
    whole.push_back(cpu_seconds() - before);
    one.push_back(time_evaluation(states, count));
    percent.push_back(100 * (whole.back() / (one.back() * static_cast<double>(count)) - 1));
  }
  std::printf("%s %.4g %lld %.4g %.1f\n", name, median(whole), count, median(one), median(percent));
}

}  // namespace

void print_overhead(int rounds) {
  using f = std::reference_wrapper<const model>;
  const kte::tolerances<double> tight{.absolute = 1e-10, .relative = 1e-10};
  print_overhead_of<kte::runge_kutta4<f, state>>("runge_kutta4", 1e-4, rounds);
  print_overhead_of<kte::dormand_prince45<f, state>>("dormand_prince45", tight, rounds);
  print_overhead_of<kte::prince_dormand87<f, state>>("prince_dormand87", tight, rounds);
  print_overhead_of<kte::adams<f, state>>("adams", tight, rounds);
}

}  // namespace work_precision
