/// A body that turns, free or about a point.
#include "data/problems/dzhanibekov.hpp"
#include "data/problems/euler_top.hpp"
#include "data/problems/heavy_top.hpp"
#include "rotations.hpp"

namespace work_precision {
namespace {

using namespace kte::problems;
using state = vector<7>;

/// Of states (quaternion, rates).
double distance_from_unit(const state& x) { return std::abs(x.head<4>().norm() - 1); }

void add_dzhanibekov(std::vector<problem>& all) {
  constexpr std::size_t attitude = 3;
  const auto t = task_of_mechanism<dzhanibekov>(attitude, 9, equation_of_motion<dzhanibekov>::angular_momentum);
  auto& p = all.emplace_back(problem{"dzhanibekov", t.t_end, 1e6 / 256, 1.2});  // down to 1e-4 s
  add_rotating<dzhanibekov>(p, t);
}

void add_heavy_top(std::vector<problem>& all) {
  const auto about_vertical = [](const state& x) {
    return equation_of_motion<heavy_top>::angular_momentum(x).tail<1>().eval();
  };
  const auto t = task_of_mechanism<heavy_top>(0, 0, about_vertical);
  auto& p = all.emplace_back(problem{"heavy_top", t.t_end, 200});
  add_rotating<heavy_top>(p, t);
  const entrants<mechanism<heavy_top>, state> those(p, the<heavy_top>, t);
  those.add<kte::rodas>("rodas");
  those.add<kte::kennedy_carpenter34>("kennedy_carpenter34");
}

void add_euler_top(std::vector<problem>& all) {
  static constexpr equations<7> f{rate_of<euler_top<>>};
  task<state> t = task_of<euler_top<>>();
  t.judge = [](const state& x) {
    const euler_top<> top;
    const auto momentum = top.momentum(top.start());
    return judgement{largest_error(top.output(x), top.reference), std::abs(top.energy(x) - top.energy(top.start())),
                     (top.momentum(x) - momentum).norm() / momentum.norm(), distance_from_unit(x)};
  };
  auto& p = all.emplace_back(problem{"euler_top", t.t_end, 500});
  const entrants<equations<7>, state> those(p, f, t);
  those.add_explicit();
  those.add<kte::implicit_midpoint>("implicit_midpoint", 4);
}

}  // namespace

void add_bodies(std::vector<problem>& all) {
  add_dzhanibekov(all);
  add_euler_top(all);
  add_heavy_top(all);
}

}  // namespace work_precision
