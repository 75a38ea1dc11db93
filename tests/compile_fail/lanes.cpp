// expect: error: .*kte: call it as lanes\(chain, .*, with a static chain
// expect: error: .*kte: of integrators, explicit Runge-Kutta methods integrate packs of states
// mistakes: 2
#include <kte/integrators/implicit_midpoint.hpp>
#include <kte/kte.hpp>
#include <kte/math/pack.hpp>
#include <kte/static_chain/lanes.hpp>

int main() {
  using P = kte::pack<double, 8>;
  kte::lanes(kte::runtime_chain(), kte::parameter{"tool/mass", P(1.0)});
  const auto f = [](double, const Eigen::Vector2<P>& x) { return x; };
  kte::implicit_midpoint<decltype(f), Eigen::Vector2<P>> solver(f, 0.0, Eigen::Vector2<P>::Zero(), 0.1);
}
