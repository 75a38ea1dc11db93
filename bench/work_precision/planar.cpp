/// Problems with two and four numbers.
#include "data/problems/andrews.hpp"
#include "data/problems/double_pendulum.hpp"
#include "data/problems/elastic_pendulum_chain.hpp"
#include "data/problems/kapitza.hpp"
#include "data/problems/pendulum.hpp"
#include "mechanism.hpp"
#include "variational.hpp"

namespace work_precision {
namespace {

using namespace kte::problems;

template <class Mechanism, int N>
void add_mechanism(std::vector<problem>& all, const char* name, double steps) {
  static constexpr equations<N> f{rate_of_mechanism<Mechanism>};
  const auto t = task_of_mechanism<Mechanism>();
  auto& p = all.emplace_back(problem{name, t.t_end, steps});
  const entrants<equations<N>, vector<N>> those(p, f, t);
  those.add_explicit(), those.add_structured(), those.add_stiff();
  add_variational<Mechanism>(p, t);
}

void add_elastic_pendulum(std::vector<problem>& all) {
  static constexpr equations<4> f{rate_of<elastic_pendulum<>>};
  static constexpr equations_of_second_order<4> second{f};
  const auto t = task_of<elastic_pendulum<>>();
  auto& p = all.emplace_back(problem{"elastic_pendulum", t.t_end, 100});
  const entrants<equations<4>, vector<4>> those(p, f, t);
  those.add_explicit();
  those.add<kte::semi_implicit_euler>("semi_implicit_euler", 4);
  those.add<kte::implicit_midpoint>("implicit_midpoint", 4);
  entrants<equations_of_second_order<4>, vector<4>>(p, second, t).add<kte::stormer_verlet>("stormer_verlet", 4);
  add_variational<elastic_pendulum_chain>(p, task_of_mechanism<elastic_pendulum_chain>());
}

void add_kapitza(std::vector<problem>& all) {
  static constexpr equations<2> f{rate_of<kapitza<>>};
  static constexpr equations_of_second_order<2> second{f};
  const auto t = task_of<kapitza<>>();
  auto& p = all.emplace_back(problem{"kapitza", t.t_end, 1000});
  const entrants<equations<2>, vector<2>> those(p, f, t);
  those.add_explicit();
  entrants<equations_of_second_order<2>, vector<2>>(p, second, t).add<kte::stormer_verlet>("stormer_verlet", 4);
}

void add_andrews(std::vector<problem>& all) {
  static constexpr equations<2> f{rate_of<andrews<>>};
  const auto t = task_of<andrews<>>();
  auto& p = all.emplace_back(problem{"andrews", t.t_end, 32});
  const entrants<equations<2>, vector<2>> those(p, f, t);
  those.add_explicit(), those.add_stiff();
}

}  // namespace

void add_planar(std::vector<problem>& all) {
  add_mechanism<pendulum, 2>(all, "pendulum", 250);
  add_mechanism<double_pendulum_from_2_rad, 4>(all, "double_pendulum_2_rad", 100);
  add_mechanism<double_pendulum_from_horizontal, 4>(all, "double_pendulum_horizontal", 100);
  add_elastic_pendulum(all);
  add_kapitza(all);
  add_andrews(all);
}

}  // namespace work_precision
