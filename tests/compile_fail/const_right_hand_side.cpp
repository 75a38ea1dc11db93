// expect: error: .*kte: this right-hand side changes when it is called: pass std::ref
#include <kte/integrators/euler.hpp>

struct counting {
  int calls = 0;
  Eigen::Vector2d operator()(double, const Eigen::Vector2d& x) { return ++calls, -x; }
};
void f(const counting& decay) {
  kte::euler solver(std::cref(decay), 0.0, Eigen::Vector2d(1, 0), 0.1);
  solver.integrate(1.0);
}
