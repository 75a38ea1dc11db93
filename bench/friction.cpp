/// Friction problems of random rigid bodies: points of one body on a plane (`plate`), or on all its sides (`points`),
/// legs, and boxes on each other (`tower`). The time is the mean; counters: the median and the largest time of a
/// problem in us, Newton steps and steps of other methods, the largest residual, and how many problems were not solved.
#include <kte/contact/friction_solver.hpp>

#include <benchmark/benchmark.h>

#include <algorithm>
#include <chrono>
#include <functional>

#include "contact/friction_scenes.hpp"
#include "timing.hpp"

namespace bench {
namespace {

using kte::test::friction_scene;
using kte::test::friction_scenes;

void add(const std::string& name, int count, const std::function<friction_scene(friction_scenes&)>& make) {
  benchmark::RegisterBenchmark(("friction_problem/" + name).c_str(), [=](benchmark::State& state) {
    friction_scenes random(1);
    std::vector<friction_scene> scenes;
    for (int i = 0; i < count; ++i) scenes.push_back(make(random));
    kte::friction_solver<> solver;
    std::size_t k = 0;
    for (auto _ : state) {
      const auto& s = scenes[k++ % scenes.size()];
      benchmark::DoNotOptimize(solver.solve(s.problem()).lambda.data());
    }
    std::vector<double> times;
    double residual = 0, steps = 0, failed = 0;
    for (const auto& s : scenes) {
      using clock = std::chrono::steady_clock;
      double best = 1e9;
      for (int repeat = 0; repeat < 3; ++repeat) {
        const auto from = clock::now();
        benchmark::DoNotOptimize(solver.solve(s.problem()).lambda.data());
        best = std::min(best, std::chrono::duration<double, std::micro>(clock::now() - from).count());
      }
      const auto& x = solver.solve(s.problem());
      times.push_back(best);
      steps += x.iterations / static_cast<double>(count);
      x.solved() ? void(residual = std::max(residual, x.residual)) : void(++failed);
    }
    std::sort(times.begin(), times.end());
    state.counters["median_us"] = times[times.size() / 2];
    state.counters["worst_us"] = times.back();
    state.counters["steps"] = steps;
    state.counters["error"] = residual;
    state.counters["failed"] = failed;
  });
}

const registered friction_benchmarks{[] {
  for (const int n : {1, 2, 4, 8}) {
    add("plate" + std::to_string(n), 1000, [n](friction_scenes& r) { return r.plate(n); });
    add("points" + std::to_string(n), 1000, [n](friction_scenes& r) { return r.points(n); });
    add("legs" + std::to_string(n), 1000, [n](friction_scenes& r) { return r.legs(n); });
  }
  for (const int n : {1, 2, 3})
    add("plane" + std::to_string(n), 1000, [n](friction_scenes& r) { return r.plane(n, 0.5, 0.3); });
  for (const int n : {16, 32}) add("plate" + std::to_string(n), 100, [n](friction_scenes& r) { return r.plate(n); });
  for (const int n : {2, 4, 8}) add("tower" + std::to_string(n), 100, [n](friction_scenes& r) { return r.tower(n); });
}};

}  // namespace
}  // namespace bench
