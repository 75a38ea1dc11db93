/// Prints straight-line C of the dynamics of the robots, to compare kte with: no calls, no loops, no memory, nothing
/// computed twice or in vain. The formulas are kte's own, run on `traced`.
#include <string>

#include "robots/hyq.hpp"
#include "robots/iiwa14.hpp"
#include "robots/panda.hpp"
#include "robots/solo12.hpp"
#include "robots/ur5.hpp"
#include "straightline/print.hpp"

/// Every element is traced by its type, so that nothing is computed with what is known to be zero.
template <>
inline constexpr bool kte::detail::is_a_few_instructions<straightline::traced> = true;

namespace straightline {
namespace {

/// Solves M x = b by M = L D L^T, unrolled.
template <int N>
void solve(kte::joint_matrix<traced, N> m, kte::joint_vector<traced, N>& b) {
  kte::joint_vector<traced, N> inverse;
  for (int k = 0; k < N; ++k) {
    inverse[k] = 1 / m(k, k);
    for (int i = k + 1; i < N; ++i) {
      const traced l = m(k, i) * inverse[k];
      for (int j = i; j < N; ++j) m(i, j) = m(i, j) - l * m(k, j);
      m(i, k) = l;
    }
  }
  for (int k = 0; k < N; ++k)
    for (int i = k + 1; i < N; ++i) b[i] = b[i] - m(i, k) * b[k];
  for (int k = 0; k < N; ++k) b[k] = b[k] * inverse[k];
  for (int k = N; k-- > 0;)
    for (int i = 0; i < k; ++i) b[i] = b[i] - m(k, i) * b[k];
}

/// Numbers n, n+1, ... of the inputs.
template <int N>
auto inputs(std::size_t n) {
  std::array<traced, std::size_t{N}> x;
  for (auto& xi : x) xi = traced::input(n++);
  return x;
}
void print(const std::string& robot, const char* operation, const std::vector<traced>& results) {
  printer(results).function((robot + "_" + operation).c_str(), results);
}
template <class Vector>
std::vector<traced> list(const Vector& v) {
  return {v.begin(), v.end()};
}

std::vector<traced> upper(const auto& m) {
  std::vector<traced> l;
  for (int i = 0; i < m.rows(); ++i)
    for (int j = i; j < m.cols(); ++j) l.push_back(m(i, j));
  return l;
}

/// The dynamics of any tree.
template <class Chain>
void print_dynamics(const std::string& robot, const Chain& c) {
  constexpr int n = Chain::dofs, nq = Chain::nq;
  const auto q = inputs<nq>(0);
  const auto v = inputs<n>(nq), a = inputs<n>(nq + n);
  print(robot, "inverse_dynamics", list(kte::inverse_dynamics(c, q, v, a)));
  print(robot, "mass_matrix", upper(kte::mass_matrix(c, q)));
  print(robot, "articulated", list(kte::forward_dynamics(c, q, v, a)));
}
/// All of a robot with as many numbers in q as in v.
template <class Chain, class Tool>
void print_robot(const std::string& robot, const Chain& c, const Tool& tool) {
  print_dynamics(robot, c);
  constexpr int n = Chain::dofs;
  const auto q = inputs<n>(0), v = inputs<n>(n), a = inputs<n>(2 * n);
  kte::joint_vector<traced, n> b = -kte::inverse_dynamics(c, q, v, std::array<traced, std::size_t{n}>{});
  for (int i = 0; i < n; ++i) b[i] = b[i] + a[static_cast<std::size_t>(i)];
  solve<n>(kte::mass_matrix(c, q), b);
  print(robot, "forward_dynamics", list(b));

  print(robot, "nonlinear_effects", list(kte::nonlinear_effects(c, q, v)));
  const auto j = kte::jacobian(c, q, tool, kte::in_world_axes);
  print(robot, "jacobian", {j.data(), j.data() + j.size()});

  const auto [r, p] = kte::forward_kinematics(c, q, tool);
  print(robot, "forward_kinematics", {r.x.x, r.x.y, r.x.z, r.y.x, r.y.y, r.y.z, r.z.x, r.z.y, r.z.z, p.x, p.y, p.z});
}

}  // namespace
}  // namespace straightline

int main() {
  std::puts("#include <math.h>\n");
  straightline::print_robot("iiwa14", robots::iiwa14, robots::iiwa14_names::tool);
  straightline::print_robot("ur5", robots::ur5, robots::ur5_names::tool);
  straightline::print_dynamics("panda", robots::panda);
  straightline::print_dynamics("solo12", robots::solo12);
  straightline::print_dynamics("hyq", robots::hyq);
}
