#pragma once

#include <kte/dynamics/inverse_dynamics.hpp>
#include <kte/dynamics/mass_matrix.hpp>

#include <Eigen/Cholesky>

#include <cmath>

namespace kte {

namespace detail {
/// Factorises a mass matrix (Cholesky, Eigen's LLT). Throws `singular_mass_matrix` where a coordinate moves no mass,
/// and for NaN.
template <class Matrix>
void factorise(const Matrix& m, Eigen::LLT<Matrix>& factors) {
  factors.compute(m);
  const auto& l = factors.matrixLLT();
  using S = typename Matrix::Scalar;
  bool good = factors.info() == Eigen::Success;
  for (Eigen::Index i = 0; i < l.rows(); ++i) good &= l(i, i) > S(0) && l(i, i) - l(i, i) == S(0);
  if (!good) [[unlikely]]
    detail::raise<singular_mass_matrix>(
        "kte: the mass matrix is not positive definite: a coordinate moves no mass, or an argument is not a number");
}
template <class Factors, class Vector>
void solve_in_place(const Factors& factors, Vector& b) {
  factors.solveInPlace(b);
  check_finite(b, static_cast<std::size_t>(b.size()), "an acceleration is no finite number: an argument is none");
}
template <class Matrix, class Vector>
void factorise_and_solve(const Matrix& m, Vector& b) {
  Eigen::LLT<Matrix> factors;
  factorise(m, factors);
  solve_in_place(factors, b);
}
}  // namespace detail

/// Forward dynamics by the factorised mass matrix:
///
///   a = M(q)^-1 (tau - bias),   bias = the inverse dynamics for a = 0          (1)
///
/// tau: forces applied to the degrees of freedom besides those of the chain's own elements; else as `inverse_dynamics`.
/// Returns accelerations, rad/s^2 and m/s^2. Throws `singular_mass_matrix`.
template <class Gravity, class... E, indexable Q, indexable V, indexable T>
auto forward_dynamics(const static_chain<Gravity, E...>& c, const Q& q, const V& v, const T& tau) {
  using chain_type = static_chain<Gravity, E...>;
  using S = value_of<Q>;
  constexpr int n = chain_type::dofs;
  check_size<n>(q, "q"), check_size<n>(v, "v"), check_size<n>(tau, "tau");
  const detail::positions<S, typename chain_type::wiring, detail::each<S, Q>> at({q});
  joint_vector<S, n> a = detail::coordinate_forces<S>(
      c, detail::given{at, detail::each<S, V>{v}, detail::same<zero_t>{}, detail::base_under_gravity(c)}, one);
  for (int i = 0; i < n; ++i) a[i] += S(tau[static_cast<std::size_t>(i)]);
  detail::factorise_and_solve(detail::local_mass_matrix<S>(c, at), a);
  return a;
}

/// The same at the positions and rates of a state, with its moving bases and its inputs, and no other forces.
template <class Gravity, class... E, class S>
auto forward_dynamics(const static_chain<Gravity, E...>& c, const chain_state<S, detail::wiring<E...>>& s) {
  using namespace detail;
  using state = chain_state<S, wiring<E...>>;
  const positions<S, wiring<E...>, of_state<state, &gen_coord<S>::q>> at({s});
  joint_vector<S, static_chain<Gravity, E...>::dofs> a = coordinate_forces<S>(
      c, given{at, of_state<state, &gen_coord<S>::q_dot>{s}, same<zero_t>{}, base_of_state<state>{s}}, one);
  factorise_and_solve(local_mass_matrix<S>(c, at), a);
  return a;
}

}  // namespace kte
