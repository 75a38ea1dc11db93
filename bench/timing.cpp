#include "timing.hpp"

#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace bench {
namespace {

/// Room for the largest result, aligned as Eigen likes it.
struct alignas(64) result {
  double y[64];
};

std::vector<double> random_states(int dofs) {
  constexpr int states = 512;
  std::mt19937 random(1);
  const auto fill = [&](double* x, double size) {
    std::generate_n(x, dofs, [&] { return std::uniform_real_distribution(-size, size)(random); });
  };
  std::vector<double> all(static_cast<std::size_t>(3 * dofs * states));
  for (int s = 0; s < states; ++s) {
    double* const x = all.data() + 3 * dofs * s;
    fill(x, 3.1), fill(x + dofs, 2), fill(x + 2 * dofs, 5);
  }
  return all;
}

void time(benchmark::State& state, int dofs, call f, double error) {
  const auto states = random_states(dofs);
  const double *const begin = states.data(), *const end = begin + states.size(), *x = begin;
  result r;
  for (auto _ : state) {
    f(x, r.y);
    benchmark::DoNotOptimize(r);
    x += 3 * dofs;
    if (x == end) x = begin;
  }
  state.counters["error"] = error;
}

}  // namespace

double largest_error(call f, const std::vector<expectation>& expected) {
  long double largest = 0;
  for (const auto& e : expected) {
    result r;
    f(e.x.data(), r.y);
    long double size = 0, error = 0;
    for (std::size_t i = 0; i < e.y.size(); ++i) {
      const long double d = std::fabs(r.y[i] - e.y[i]);
      if (i < e.rotations) {
        largest = std::fmax(largest, d);
      } else {
        error = std::fmax(error, d), size = std::fmax(size, std::fabs(e.y[i]));
      }
    }
    largest = std::fmax(largest, error / size);
  }
  return static_cast<double>(largest);
}

void add(const std::string& operation, const std::string& how, const std::string& model, int dofs, call f,
         const std::vector<expectation>& expected) {
  const std::string name = operation + "/" + how + "/" + model;
  benchmark::RegisterBenchmark(name.c_str(), time, dofs, f, largest_error(f, expected));
}

}  // namespace bench
