/// Static chains: sines and cosines four at a time, or, in kte_bench_libm, one by one.
#include <new>

#include "expected.hpp"

namespace bench {
namespace {

#if defined(KTE_SCALAR_SINCOS)
constexpr auto how = "static_libm";
#else
constexpr auto how = "static";
#endif

/// Evaluates on a state that stays where it is, as in a simulation.
template <class Model>
[[gnu::noinline]] void passes(const double* x, double* y) {
  constexpr int n = Model::dofs;
  static constinit auto s = kte::make_state(Model::chain);
  for (int i = 0; i < n; ++i) {
    auto& c = s.coordinate(i);
    c.q = x[i], c.q_dot = x[n + i], c.q_ddot = x[2 * n + i];
  }
  Model::chain.doMotion(s);
  Model::chain.clearForce(s);
  Model::chain.doForce(s);
  for (int i = 0; i < n; ++i) y[i] = -s.coordinate(i).f;
}

/// Results are made where y points to, without a copy.
template <class Model>
[[gnu::noinline]] void inverse_dynamics(const double* x, double* y) {
  constexpr int n = Model::dofs;
  new (y) auto(kte::inverse_dynamics(Model::chain, x, x + n, x + 2 * n));
}
template <class Model>
[[gnu::noinline]] void mass_matrix(const double* x, double* y) {
  new (y) auto(kte::mass_matrix(Model::chain, x));
}
template <class Model>
[[gnu::noinline]] void forward_dynamics(const double* x, double* y) {
  constexpr int n = Model::dofs;
  new (y) auto(kte::forward_dynamics(Model::chain, x, x + n, x + 2 * n));
}
template <class Model>
[[gnu::noinline]] void forward_kinematics(const double* x, double* y) {
  new (y) auto(kte::forward_kinematics(Model::chain, x, Model::tool));
}

template <class Model>
void add_model() {
  add<Model>(operation::passes, how, passes<Model>);
  add<Model>(operation::inverse_dynamics, how, inverse_dynamics<Model>);
  add<Model>(operation::mass_matrix, how, mass_matrix<Model>);
  add<Model>(operation::forward_dynamics, how, forward_dynamics<Model>);
  add<Model>(operation::forward_kinematics, how, forward_kinematics<Model>);
}

}  // namespace

void add_static() {
  add_model<pendulum>();
  add_model<iiwa14>();
  add_model<ur5>();
}

}  // namespace bench
