/// Real arms: the KUKA iiwa14 and the UR5 as static and as runtime chains. Inverse dynamics, mass matrix, forward
/// dynamics and tool pose at random states, with the time of a call and the error against 31-digit values.
#include <kte/elements/registry.hpp>
#include <kte/kte.hpp>

#include <chrono>
#include <cmath>
#include <cstdio>

#include "data/iiwa14.hpp"
#include "data/ur5.hpp"
#include "robots/iiwa14.hpp"
#include "robots/ur5.hpp"

/// max |x - reference| / max |reference|
template <class X>
double relative_error(const X& x, const long double* reference, std::size_t n) {
  long double difference = 0, size = 0;
  for (std::size_t i = 0; i < n; ++i) {
    difference = std::max(difference, std::fabs(static_cast<long double>(x[i]) - reference[i]));
    size = std::max(size, std::fabs(reference[i]));
  }
  return static_cast<double>(difference / size);
}

/// Upper triangle, by rows.
template <class M>
auto upper(const M& m) {
  std::vector<double> u;
  for (Eigen::Index i = 0; i < m.rows(); ++i)
    for (Eigen::Index j = i; j < m.cols(); ++j) u.push_back(m(i, j));
  return u;
}
template <class Pose>
std::array<double, 12> numbers(const Pose& p) {
  const auto& [R, x] = p;
  return {R.x.x, R.x.y, R.x.z, R.y.x, R.y.y, R.y.z, R.z.x, R.z.y, R.z.z, x.x, x.y, x.z};
}

/// Runs `call` on all states: the largest error, and the nanoseconds of a call (best of many rounds).
template <std::size_t N, class State, class Call, class Error>
void line(const char* operation, const char* how, const State (&states)[N], const Call& call, const Error& error) {
  double worst = 0;
  for (const auto& s : states) worst = std::max(worst, error(call(s), s));
  using clock = std::chrono::steady_clock;
  double best = 1e300;
  for (int round = 0; round < 200; ++round) {
    const auto start = clock::now();
    for (int i = 0; i < 20; ++i)
      for (const auto& s : states) {
        [[maybe_unused]] const auto& result = call(s);
        asm volatile("" : : "g"(&result) : "memory");
      }
    best = std::min(best, std::chrono::duration<double, std::nano>(clock::now() - start).count() / (20 * N));
  }
  std::printf("  %-18s %-8s %8.0f %12.1e\n", operation, how, best, worst);
}

template <class Chain, std::size_t N, int n, class Tool>
void report(const char* name, const Chain& arm, const kte::reference::state<n> (&states)[N], const Tool& tool) {
  using state = kte::reference::state<n>;
  const auto id = [](const auto& x, const state& s) { return relative_error(x, s.inverse_dynamics, n); };
  const auto fd = [](const auto& x, const state& s) { return relative_error(x, s.forward_dynamics, n); };
  const auto mass = [](const auto& x, const state& s) {
    return relative_error(upper(x), s.mass_matrix, n * (n + 1) / 2);
  };
  const auto pose = [](const auto& x, const state& s) {
    const auto p = numbers(x);
    return std::max(relative_error(p.data(), s.tool_rotation, 9), relative_error(p.data() + 9, s.tool_position, 3));
  };

  std::printf("%s, %zu random states:\n  %-18s %-8s %8s %12s\n", name, N, "operation", "chain", "ns", "error");
  line(
      "inverse_dynamics", "static", states, [&](const state& s) { return kte::inverse_dynamics(arm, s.q, s.v, s.a); },
      id);
  line(
      "mass_matrix", "static", states, [&](const state& s) { return kte::mass_matrix(arm, s.q); }, mass);
  line(
      "forward_dynamics", "static", states, [&](const state& s) { return kte::forward_dynamics(arm, s.q, s.v, s.tau); },
      fd);
  line(
      "tool pose", "static", states, [&](const state& s) { return kte::forward_kinematics(arm, s.q, tool); }, pose);

  const auto model = kte::to_chain(kte::record_of(arm));  // the arm as a list of elements, as from a file
  auto x = model.make_state();
  using result = const Eigen::VectorXd&;
  line(
      "inverse_dynamics", "runtime", states,
      [&](const state& s) -> result { return kte::inverse_dynamics(model, x, s.q, s.v, s.a); }, id);
  line(
      "mass_matrix", "runtime", states,
      [&](const state& s) -> const Eigen::MatrixXd& { return kte::mass_matrix(model, x, s.q); }, mass);
  line(
      "forward_dynamics", "runtime", states,
      [&](const state& s) -> result { return kte::forward_dynamics(model, x, s.q, s.v, s.tau); }, fd);
  line(
      "tool pose", "runtime", states, [&](const state& s) { return kte::forward_kinematics(model, x, s.q, tool.name); },
      pose);
}

int main() {
  report("KUKA iiwa14", robots::iiwa14, kte::reference::iiwa14, robots::iiwa14_names::tool);
  report("UR5", robots::ur5, kte::reference::ur5, robots::ur5_names::tool);
}
