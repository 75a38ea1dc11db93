/// Long chains of numbers.
#include "data/problems/iiwa14_free_swing.hpp"
#include "data/problems/ten_rods.hpp"
#include "mechanism.hpp"
#include "variational.hpp"

namespace work_precision {
namespace {

template <class Mechanism, int N>
void add_mechanism(std::vector<problem>& all, const char* name, std::size_t from, double steps) {
  static constexpr equations<N> f{rate_of_mechanism<Mechanism>};
  const auto t = task_of_mechanism<Mechanism>(from);
  auto& p = all.emplace_back(problem{name, t.t_end, steps});
  const entrants<equations<N>, vector<N>> those(p, f, t);
  those.add_explicit(), those.add_structured();
  add_variational<Mechanism>(p, t);
}

}  // namespace

void add_robots(std::vector<problem>& all) {
  constexpr std::size_t tool = 14;
  add_mechanism<kte::problems::iiwa14_free_swing, 14>(all, "iiwa14", tool, 25);
  add_mechanism<kte::problems::ten_rods, 20>(all, "ten_rods", 0, 25);
}

}  // namespace work_precision
