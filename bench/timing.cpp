#include "timing.hpp"

#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <random>

#include "expected.hpp"
#include "yardstick.hpp"

namespace bench {
namespace {

/// Numbers in aligned memory, with padding behind them.
template <class S>
class numbers {
 public:
  explicit numbers(std::size_t n) : lines_(n * sizeof(S) / sizeof(line) + 2) {}
  S* data() { return reinterpret_cast<S*>(lines_.data()); }

 private:
  struct alignas(64) line {
    char bytes[64];
  };
  std::vector<line> lines_;
};

template <class S>
struct subject {
  operation what;
  std::string model;
  call<S> f;
  int states;
  triangle part;
  bool packed;
  // Once it was asked for, as expectations of long chains take time:
  std::optional<double> error{};
  std::size_t size_of_result{};  ///< of one state
};

/// Largest error of a block, relative to its largest number; infinite if a result is NaN.
template <class S>
long double error_of(const S* y, const std::vector<long double>& expected) {
  long double size = 0, error = 0;
  for (const long double e : expected) {
    const long double d = std::fabs(static_cast<long double>(*y++) - e);
    error = d == d ? std::max(error, d) : HUGE_VALL, size = std::max(size, std::fabs(e));
  }
  return size == 0 ? error : error / size;
}

/// A table of numbers of S, from rows to columns.
template <class S>
void transpose(S* begin, std::size_t rows, std::size_t columns) {
  const std::vector<S> old(begin, begin + rows * columns);
  for (std::size_t i = 0; i < rows; ++i)
    for (std::size_t j = 0; j < columns; ++j) begin[j * rows + i] = old[i * columns + j];
}

/// Expectations follow each other in the lanes of a call, from the first on again if there are more lanes.
template <class S>
double largest_error(const subject<S>& t, const std::vector<expectation>& expected) {
  const auto lanes = static_cast<std::size_t>(t.states);
  numbers<S> y(lanes * t.size_of_result);
  long double largest = 0;
  for (std::size_t first = 0; first < expected.size(); first += lanes) {
    const auto in_lane = [&](std::size_t k) -> auto& { return expected[(first + k) % expected.size()]; };
    std::vector<S> x;
    for (std::size_t part = 0; part < 3; ++part) {
      const std::size_t begin = x.size();
      for (std::size_t k = 0; k < lanes; ++k)
        for (const double number : in_lane(k).x[part]) x.push_back(static_cast<S>(number));
      if (t.packed) transpose(x.data() + begin, lanes, in_lane(0).x[part].size());
    }
    t.f(x.data(), y.data());
    if (t.packed) transpose(y.data(), t.size_of_result, lanes);
    const S* at = y.data();
    for (std::size_t k = 0; k < lanes; ++k)
      for (const auto& block : in_lane(k).y) largest = std::max(largest, error_of(at, block)), at += block.size();
  }
  return static_cast<double>(largest);
}

/// States of a robot in motion, in groups of B: rad, rad/s, rad/s^2. As many as fit into the caches with the program.
template <class S>
std::vector<S> random_states(const model_size& n, int b) {
  constexpr int room = 1 << 14;
  const int groups = std::clamp(room, 3 * n.v * b, 3 * n.v * 512) / (3 * n.v * b);
  std::mt19937 random(1);
  std::vector<S> all;
  const auto put = [&](int many, double most) {
    std::uniform_real_distribution<> one(-most, most);
    for (int i = 0; i < many; ++i) all.push_back(static_cast<S>(one(random)));
  };
  for (int g = 0; g < groups; ++g) put(b * n.q, 3.1), put(b * n.v, 2), put(b * n.v, 5);
  return all;
}

template <class S>
void time(benchmark::State& state, subject<S>* t) {
  if (!t->error) {
    const auto expected = bench::expected(t->model, t->what, t->part);
    for (const auto& block : expected.front().y) t->size_of_result += block.size();
    t->error = largest_error(*t, expected);
  }
  const model_size n = size_of(t->model);
  const auto states = random_states<S>(n, t->states);
  const int stride = t->states * (n.q + 2 * n.v);
  const S *const begin = states.data(), *const end = begin + states.size(), *x = begin;
  numbers<S> y(static_cast<std::size_t>(t->states) * t->size_of_result);
  const against_yardstick here(state);
  while (state.KeepRunningBatch(t->states)) {
    t->f(x, y.data());
    benchmark::ClobberMemory();
    x += stride;
    if (x == end) x = begin;
  }
  state.counters["error"] = *t->error;
}

std::vector<void (*)()>& all_registered() {
  static std::vector<void (*)()> all;
  return all;
}

}  // namespace

template <class S>
void add(operation o, const std::string& how, const std::string& model, call<S> f, int states, triangle t,
         bool packed) {
  const std::string name = std::string(to_string(o)) + "/" + how + "/" + model;
  // Subjects live as long as the program, as benchmarks do.
  benchmark::RegisterBenchmark(name.c_str(), time<S>, new subject<S>{o, model, f, states, t, packed});
}
template void add(operation, const std::string&, const std::string&, call<float>, int, triangle, bool);
template void add(operation, const std::string&, const std::string&, call<double>, int, triangle, bool);
template void add(operation, const std::string&, const std::string&, call<long double>, int, triangle, bool);

registered::registered(void (*f)()) { all_registered().push_back(f); }
void register_all() {
  for (const auto f : all_registered()) f();
}

}  // namespace bench
