#include "data/problems/pleiades.hpp"
#include "equations.hpp"

namespace work_precision {

void add_stars(std::vector<problem>& all) {
  using kte::problems::pleiades;
  static constexpr equations<28> f{rate_of<pleiades<>>};
  static constexpr equations_of_second_order<28> second{f};
  const auto t = task_of<pleiades<>>();
  auto& p = all.emplace_back(problem{"pleiades", t.t_end, 100});
  entrants<equations<28>, vector<28>>(p, f, t).add_explicit();
  entrants<equations_of_second_order<28>, vector<28>>(p, second, t).add<kte::stormer_verlet>("stormer_verlet", 4);
}

}  // namespace work_precision
