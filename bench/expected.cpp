#include "expected.hpp"

#include <random>
#include <span>

#include "data/chain2.hpp"
#include "data/chain8.hpp"
#include "data/hyq.hpp"
#include "data/panda.hpp"
#include "digits.hpp"
#include "from_textbook.hpp"
#include "models.hpp"
#include "serial_robot.hpp"

namespace bench {
namespace {

/// Whether forces are given, and not accelerations.
constexpr bool is_under_forces(operation o) {
  return o == operation::forward_dynamics || o == operation::fd_derivatives;
}

/// States of tests/data; what these do not have is filled up by the textbook, which knows serial robots.
template <int N, class State, std::size_t States>
std::vector<expectation> of_states(const std::string& model, operation o, const State (&states)[States],
                                   std::span<const kte::reference::derivatives<N>> d = {}) {
  std::vector<expectation> all;
  for (std::size_t k = 0; k < States; ++k) {
    const auto& s = states[k];
    const auto& given = is_under_forces(o) ? s.tau : s.a;
    expectation e{{{{std::begin(s.q), std::end(s.q)}, {s.v, s.v + N}, {given, given + N}}},
                  from_digits<State, N>(o, s, k < d.size() ? &d[k] : nullptr)};
    if (e.y.empty() && !d.empty() && model != solo12::name) e.y = from_textbook(o, model, e.x);
    if (!e.y.empty()) all.push_back(e);
  }
  return all;
}

/// Four random states.
std::vector<expectation> of_textbook(const std::string& model, operation o) {
  const int n = size_of(model).v;
  std::mt19937 random(7);
  std::vector<expectation> all(4);
  for (auto& e : all) {
    const double most[]{3.1, 2, 5};
    for (std::size_t part = 0; part < 3; ++part)
      for (int i = 0; i < n; ++i)
        e.x[part].push_back(std::uniform_real_distribution<>(-most[part], most[part])(random));
    e.y = from_textbook(o, model, e.x);
    if (model == pendulum::name && o == operation::forward_kinematics)  // in the plane: cos, sin; x, y
      e.y = {{e.y[0][0], e.y[0][3]}, {e.y[1][0], e.y[1][1]}};
  }
  return all;
}

std::vector<expectation> in_full(const std::string& model, operation o) {
  using namespace kte::reference;
  if (model == iiwa14::name) return of_states<7>(model, o, kte::reference::iiwa14, iiwa14_derivatives);
  if (model == ur5::name) return of_states<6>(model, o, kte::reference::ur5, ur5_derivatives);
  if (model == solo12::name) return of_states<18>(model, o, kte::reference::solo12, solo12_derivatives);
  if (model == "panda") return of_states<9>(model, o, panda);
  if (model == "hyq") return of_states<18>(model, o, hyq);
  if (model == "serial2") return of_states<2>(model, o, chain2, chain2_derivatives);
  if (model == "serial8") return of_states<8>(model, o, chain8, chain8_derivatives);
  return of_textbook(model, o);
}

}  // namespace

model_size size_of(const std::string& model) {
  if (model == pendulum::name) return {1, 1};
  if (model == iiwa14::name) return {7, 7};
  if (model == ur5::name) return {6, 6};
  if (model == solo12::name || model == "hyq") return {19, 18};
  if (model == "panda") return {9, 9};
  return {serial_length(model), serial_length(model)};
}

std::vector<expectation> expected(const std::string& model, operation o, triangle t) {
  auto all = in_full(model, o);
  if (t == triangle::both) return all;
  const auto n = static_cast<std::size_t>(size_of(model).v);
  for (auto& e : all) {
    block upper;
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t j = i; j < n; ++j) upper.push_back(e.y.front()[j * n + i]);
    e.y = {upper};
  }
  return all;
}

}  // namespace bench
