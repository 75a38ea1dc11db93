/// Runtime chains of the same elements, appended one by one.
#include <kte/chain/kte_map_chain.hpp>
#include <kte/dynamics/runtime.hpp>

#include <boost/hana/for_each.hpp>

#include <algorithm>

#include "expected.hpp"

namespace bench {
namespace {

/// A runtime chain and a state that stays where it is, as in a simulation.
struct subject {
  explicit subject(kte::kte_map_chain c) : chain(std::move(c)), state(chain.make_state()) {}
  kte::kte_map_chain chain;
  kte::runtime_state state;
};
template <class Model>
kte::kte_map_chain build() {
  kte::kte_map_chain c;
  c.gravity(Model::chain.gravity());
  boost::hana::for_each(Model::chain.elements(), [&]<class Core, class... Keys>(const kte::element<Core, Keys...>& e) {
    c << kte::connect(e.core, Keys::name...);
  });
  return c;
}
template <class Model>
subject made{build<Model>()};

template <class Model>
[[gnu::noinline]] void passes(const double* x, double* y) {
  constexpr int n = Model::dofs;
  auto& [chain, s] = made<Model>;
  for (int i = 0; i < n; ++i) {
    auto& c = s.coordinate(i);
    c.q = x[i], c.q_dot = x[n + i], c.q_ddot = x[2 * n + i];
  }
  chain.doMotion(s);
  chain.clearForce(s);
  chain.doForce(s);
  for (int i = 0; i < n; ++i) y[i] = -s.coordinate(i).f;
}
template <class Model>
[[gnu::noinline]] void inverse_dynamics(const double* x, double* y) {
  constexpr int n = Model::dofs;
  auto& [chain, s] = made<Model>;
  const auto& tau = kte::inverse_dynamics(chain, s, x, x + n, x + 2 * n);
  std::copy_n(tau.data(), n, y);
}
template <class Model>
[[gnu::noinline]] void mass_matrix(const double* x, double* y) {
  constexpr int n = Model::dofs;
  auto& [chain, s] = made<Model>;
  const auto& m = kte::mass_matrix(chain, s, x);
  std::copy_n(m.data(), n * n, y);
}
template <class Model>
[[gnu::noinline]] void forward_dynamics(const double* x, double* y) {
  constexpr int n = Model::dofs;
  auto& [chain, s] = made<Model>;
  const auto& a = kte::forward_dynamics(chain, s, x, x + n, x + 2 * n);
  std::copy_n(a.data(), n, y);
}
template <class Model>
[[gnu::noinline]] void forward_kinematics(const double* x, double* y) {
  auto& [chain, s] = made<Model>;
  const auto [r, p] = kte::forward_kinematics(chain, s, x, Model::tool.name);
  if constexpr (std::is_same_v<Model, pendulum>) {
    y[0] = r.x.x, y[1] = r.y.x, y[2] = p.x, y[3] = p.y;
  } else {
    const double all[]{r.x.x, r.x.y, r.x.z, r.y.x, r.y.y, r.y.z, r.z.x, r.z.y, r.z.z, p.x, p.y, p.z};
    std::copy(std::begin(all), std::end(all), y);
  }
}

template <class Model>
void add_model() {
  constexpr auto how = "runtime";
  add<Model>(operation::passes, how, passes<Model>);
  add<Model>(operation::inverse_dynamics, how, inverse_dynamics<Model>);
  add<Model>(operation::mass_matrix, how, mass_matrix<Model>);
  add<Model>(operation::forward_dynamics, how, forward_dynamics<Model>);
  add<Model>(operation::forward_kinematics, how, forward_kinematics<Model>);
}

}  // namespace

void add_runtime() {
  add_model<pendulum>();
  add_model<iiwa14>();
  add_model<ur5>();
}

}  // namespace bench
