/// Forward dynamics of chains with closed loops and of the same trees without closures, and `constrained_dynamics`. The
/// counter `error` is what is left of M a + bias - tau - J^T lambda, relative to its largest term.
#include <kte/kte.hpp>
#include <kte/loops.hpp>

#include <benchmark/benchmark.h>

#include <random>

#include "timing.hpp"

namespace bench {
namespace {

using vector = Eigen::VectorXd;
struct mechanism {
  kte::runtime_chain closed, tree;
};

/// An arm of seven joints whose end is pinned to the ground.
mechanism pinned_arm() {
  mechanism m;
  std::mt19937 g(3);
  std::uniform_real_distribution<double> u(-0.1, 0.1);
  m.tree.gravity(kte::along_z(-9.81));
  for (int i = 0; i < 7; ++i) {
    const auto n = std::to_string(i + 1);
    const std::string below = i == 0 ? "base" : std::string("l").append(std::to_string(i));
    m.tree << kte::rigid_link_3D(below, "s" + n, kte::vec3<>{u(g), u(g), 0.3})
           << kte::revolute_joint_3D("q" + n, "s" + n, "l" + n,
                                     kte::vec3<>{0, i % 2 == 0 ? 0.0 : 1.0, i % 2 == 0 ? 1.0 : 0.0})
           << kte::inertia_3D("l" + n, kte::rigid_body{1.0 + 0.1 * i, kte::vec3<>{0.01, 0.02, 0.1},
                                                       kte::sym3<>{0.02, 0, 0, 0.02, 0, 0.01}});
  }
  m.closed = m.tree;
  m.closed << kte::coincident_points_3D("pin", "base", "l7");
  return m;
}
/// Four-bars that share nothing.
mechanism four_bars(int count) {
  mechanism m;
  const auto bar = kte::planar_body(1.0, 0.02, kte::along_x(0.3));
  m.tree.gravity(kte::along_y(-9.81));
  for (int i = 0; i < count; ++i) {
    const auto n = std::to_string(i);
    m.tree << kte::revolute_joint_2D("c" + n, "base", "a" + n) << kte::inertia_2D("a" + n, bar)
           << kte::rigid_link_2D("a" + n, "A" + n, kte::along_x(0.4))
           << kte::revolute_joint_2D("p" + n, "A" + n, "b" + n) << kte::inertia_2D("b" + n, bar)
           << kte::rigid_link_2D("b" + n, "B1" + n, kte::along_x(1.1))
           << kte::revolute_joint_2D("r" + n, "base", "d" + n).at(kte::vec2<>{1, 0}) << kte::inertia_2D("d" + n, bar)
           << kte::rigid_link_2D("d" + n, "B2" + n, kte::along_x(0.8));
  }
  m.closed = m.tree;
  for (int i = 0; i < count; ++i) {
    const auto n = std::to_string(i);
    m.closed << kte::coincident_points_2D("pin" + n, "B1" + n, "B2" + n);
  }
  return m;
}

struct arguments {
  std::vector<vector> q;
  vector v, tau;
  explicit arguments(const kte::runtime_chain& c) : v(vector::Constant(c.dofs(), 0.3)), tau(vector::Zero(c.dofs())) {
    std::mt19937 g(5);
    std::uniform_real_distribution<double> u(-1, 1);
    auto s = c.make_state();
    for (int k = 0; k < 16; ++k)
      q.push_back(kte::assemble(c, s, vector::NullaryExpr(c.dofs(), [&] { return u(g); }).eval()));
  }
};
double error_of(const mechanism& m, const arguments& x) {
  auto s = m.closed.make_state(), t = m.tree.make_state();
  double worst = 0;
  for (const auto& q : x.q) {
    const auto& r = kte::constrained_dynamics(m.closed, s, q, x.v, x.tau);
    const vector a = r.a;
    std::vector<double> lambda;
    const auto& elements = m.closed.wiring().elements;
    std::size_t loop = 0;
    for (const auto& e : elements)
      if (e.closes) {
        const double force[]{r.loops[loop].force.x, r.loops[loop].force.y, r.loops[loop].force.z};
        lambda.insert(lambda.end(), force, force + e.element->rows().count());
        ++loop;
      }
    const Eigen::MatrixXd j = kte::loop_jacobian(m.closed, s, q);
    const vector by_loops = j.transpose() * Eigen::Map<const vector>(lambda.data(), j.rows());
    const vector forces = kte::inverse_dynamics(m.tree, t, q, x.v, a);
    const double size = (std::max)(forces.cwiseAbs().maxCoeff(), by_loops.cwiseAbs().maxCoeff());
    worst = (std::max)(worst, (forces - x.tau - by_loops).cwiseAbs().maxCoeff() / size);
  }
  return worst;
}
template <class Call>
void add(const std::string& name, const mechanism& m, bool closed, const Call& call) {
  benchmark::RegisterBenchmark(name.c_str(), [=](benchmark::State& state) {
    const kte::runtime_chain& c = closed ? m.closed : m.tree;
    auto s = c.make_state();
    const arguments x(m.closed);
    std::size_t k = 0;
    for (auto _ : state) benchmark::DoNotOptimize(call(c, s, x.q[k++ % x.q.size()], x));
    if (closed) state.counters["error"] = error_of(m, x);
  });
}
void add_all(const std::string& name, const mechanism& m) {
  const auto forward = [](const auto& c, auto& s, const auto& q, const auto& x) {
    return kte::forward_dynamics(c, s, q, x.v, x.tau)[0];
  };
  add("forward_dynamics_on_loops/runtime/" + name, m, true, forward);
  add("forward_dynamics_without_loops/runtime/" + name, m, false, forward);
  add("constrained_dynamics/runtime/" + name, m, true, [](const auto& c, auto& s, const auto& q, const auto& x) {
    return kte::constrained_dynamics(c, s, q, x.v, x.tau).a[0];
  });
}

const registered closed_loops_benchmarks{[] {
  add_all("pinned_arm", pinned_arm());
  for (const int n : {1, 4, 16, 64}) add_all("four_bars_" + std::to_string(n), four_bars(n));
}};

}  // namespace
}  // namespace bench
