#include "data/problems/spherical_double_pendulum.hpp"
#include "rotations.hpp"

namespace work_precision {

void add_spherical(std::vector<problem>& all) {
  using kte::problems::spherical_double_pendulum;
  using equation = kte::problems::equation_of_motion<spherical_double_pendulum>;
  const auto about_vertical = [](const equation::state& x) { return equation::angular_momentum(x).tail<1>().eval(); };
  const auto t = task_of_mechanism<spherical_double_pendulum>(0, 0, about_vertical);
  auto& p = all.emplace_back(problem{"spherical_double_pendulum", t.t_end, 200});
  add_rotating<spherical_double_pendulum>(p, t);
}

}  // namespace work_precision
