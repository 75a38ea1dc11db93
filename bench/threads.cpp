#include <kte/dynamics/batch.hpp>
#include <kte/static_chain/in_scalar.hpp>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <limits>
#include <random>
#include <thread>

#include "robots/iiwa14.hpp"
#include "robots/panda.hpp"

/// Batches of forward and inverse dynamics by one thread and by several: evaluations a second and core, and how much
/// faster several threads are. For a machine that does nothing else; states are 65,536, random, in rows.
namespace {

using seconds = std::chrono::duration<double>;
constexpr std::size_t states = 65536;

/// The least time of a call of some, s.
template <class F>
double time_of(const F& f) {
  double least = std::numeric_limits<double>::infinity();
  for (int i = 0; i < 25; ++i) {
    const auto begin = std::chrono::steady_clock::now();
    f();
    least = (std::min)(least, seconds(std::chrono::steady_clock::now() - begin).count());
  }
  return least;
}

template <class S, class Chain>
void measure(const char* robot, const char* scalar, const Chain& chain) {
  constexpr std::size_t n = Chain::dofs;
  std::mt19937_64 engine(1);
  std::uniform_real_distribution<double> number(-1, 1);
  std::vector<S> x[3], y(states * n);
  for (auto& each : x) {
    each.resize(states * n);
    for (auto& number_of_state : each) number_of_state = static_cast<S>(number(engine));
  }
  const auto row = [&](const char* operation, const auto& call) {
    std::printf("%-7s %-7s %-17s", robot, scalar, operation);
    double alone = 0;
    for (std::size_t count = 1; count <= std::thread::hardware_concurrency(); count *= 2) {
      const double time = time_of([&] { call(kte::batch::threads(count)); });
      if (count == 1) alone = time;
      std::printf("  %zu: %6.1f M/s a thread, %5.2f x", count,
                  static_cast<double>(states) / time / static_cast<double>(count) / 1e6, alone / time);
    }
    std::printf("\n");
  };
  row("forward_dynamics",
      [&](const auto& executor) { kte::batch::forward_dynamics(chain, x[0], x[1], x[2], y, executor); });
  row("inverse_dynamics",
      [&](const auto& executor) { kte::batch::inverse_dynamics(chain, x[0], x[1], x[2], y, executor); });
}

}  // namespace

int main() {
  measure<double>("panda", "double", robots::panda);
  measure<float>("panda", "float", kte::in<float>(robots::panda));
  measure<double>("iiwa14", "double", robots::iiwa14);
  measure<float>("iiwa14", "float", kte::in<float>(robots::iiwa14));
}
