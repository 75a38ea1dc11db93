#pragma once

#include <Eigen/Core>

#include <functional>
#include <utility>

namespace kte::test {

/// A right-hand side x' = f(t, x) of one type, with or without its Jacobian: a solver is instantiated once for all of
/// them.
template <class S = double, int N = Eigen::Dynamic>
class any_system {
 public:
  using state = Eigen::Matrix<S, N, 1>;
  using matrix = Eigen::Matrix<S, N, N>;

  /// f(t, x), and jacobian(t, x, J) or nothing.
  any_system(std::function<state(const S&, const state&)> f,
             std::function<void(const S&, const state&, matrix&)> jacobian = {})
      : f_(std::move(f)), jacobian_(std::move(jacobian)) {}

  state operator()(const S& t, const state& x) const { return f_(t, x); }
  bool jacobian(const S& t, const state& x, matrix& J) const { return jacobian_ && (jacobian_(t, x, J), true); }

 private:
  std::function<state(const S&, const state&)> f_;
  std::function<void(const S&, const state&, matrix&)> jacobian_;
};

/// A problem of data/problems as a system of dynamic size: f alone, or with its Jacobian.
template <class Problem, class S = double>
any_system<S> system_of() {
  using state = typename any_system<S>::state;
  return {[](const S& t, const state& x) -> state { return Problem()(t, typename Problem::state(x)); }};
}
template <class Problem, class S = double>
any_system<S> system_with_jacobian_of() {
  return {system_of<Problem, S>(), [](const S& t, const auto& x, auto& J) {
            typename Problem::matrix known;
            Problem().jacobian(t, x, known);
            J = known;
          }};
}

template <class S = double, class... X>
auto numbers(const X&... x) {
  return Eigen::Matrix<S, int{sizeof...(X)}, 1>(S(x)...);
}

}  // namespace kte::test
