#include "data/problems/flyball_governor.hpp"
#include "mechanism.hpp"

namespace work_precision {

void add_governor(std::vector<problem>& all) {
  using kte::problems::flyball_governor;
  static constexpr equations<8> f{rate_of_mechanism<flyball_governor>};
  auto t = task_of_mechanism<flyball_governor>(0, 1);  // the height of the slider
  t.judge = [judge = t.judge](const vector<8>& x) { return judgement{judge(x).error, none, none, none}; };  // dampers
  auto& p = all.emplace_back(problem{"flyball_governor", t.t_end, 32768});
  const entrants<equations<8>, vector<8>> those(p, f, t);
  those.add_stiff();
  those.add<kte::dormand_prince45>("dormand_prince45");
  those.add<kte::adams>("adams");
  those.add<kte::runge_kutta4>("runge_kutta4");
}

}  // namespace work_precision
