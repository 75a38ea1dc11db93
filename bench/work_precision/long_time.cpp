#include <cstdio>

#include "data/problems/pendulum.hpp"
#include "mechanism.hpp"
#include "more.hpp"
#include "variational.hpp"

namespace work_precision {
namespace {

using kte::problems::pendulum;
using equation = kte::problems::equation_of_motion<pendulum>;

template <template <class, class> class Method>
void print_energy(const char* name, long long steps) {
  constexpr double h = 0.02;
  constexpr int tenths = 10;
  const auto energy = [](const equation::state& x) { return equation::energy(x); };
  const double before = energy(equation::start());
  Method<std::reference_wrapper<const mechanism<pendulum>>, equation::state> solver(std::cref(the<pendulum>), 0.0,
                                                                                    equation::start(), h);
  for (int i = 1; i <= tenths; ++i) {
    double most = 0;
    solver.integrate(i * (static_cast<double>(steps) / tenths) * h,
                     [&](double, const equation::state& x) { most = std::max(most, std::abs(energy(x) - before)); });
    std::printf("%s %d %.4g\n", name, i, most);
  }
}

}  // namespace

void print_long_time(long long steps) {
  print_energy<kte::stormer_verlet>("stormer_verlet", steps);
  print_energy<kte::implicit_midpoint>("implicit_midpoint", steps);
  print_energy<kte::variational2>("variational2", steps);
  print_energy<kte::variational4>("variational4", steps);
  print_energy<kte::runge_kutta4>("runge_kutta4", steps);
  print_energy<kte::runge_kutta5>("runge_kutta5", steps);
}

}  // namespace work_precision
