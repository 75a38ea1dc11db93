#pragma once

#include <kte/dynamics/derivatives.hpp>
#include <kte/models/detail/displacement.hpp>
#include <kte/models/detail/internal_rates.hpp>

#include <algorithm>
#include <span>

/// Derivatives of the rates of a model, x' = (v, a, z'), by displacements d = (dq, dv, dz) from its state, at d = 0,
/// and by its inputs u:
///
///           | V    1    0    0   |
///   (J B) = | A_q  A_v  A_z  A_u |   V: of the rate of dq, `add_variation_of_pull_back`          (1)
///           | Z_q  Z_v  Z_z  Z_u |
///
/// A_q and A_v are those of `forward_dynamics_derivatives`. A_z = M^-1 dr/dz with r = f - M a at constant a, and
/// likewise A_u; dr and Z by dual numbers.
namespace kte::detail {

/// The state x, with lane i displaced along number first + i of d.
template <class Number, class X>
auto moved_along(std::span<const freedom> freedoms, int rates, const X& x, int first) {
  Eigen::Matrix<Number, X::RowsAtCompileTime, 1> moved = x.template cast<Number>();
  const int longer = static_cast<int>(x.size()) - rates;  // q may have more numbers than v
  const int last = (std::min)(first + Number::variables, rates);
  int positions = 0;
  for (const freedom& f : freedoms) {
    const std::span<Number> numbers(moved.data(), static_cast<std::size_t>(moved.size()));
    for (int k = (std::max)(0, first - f.v); k < (std::min)(nv_of(f.what), last - f.v); ++k)
      displace(f, k, static_cast<std::size_t>(f.v + k - first), numbers);
    positions += nv_of(f.what);
  }
  for (int j = (std::max)(first, positions); j < last; ++j)
    moved[longer + j].derivative[static_cast<std::size_t>(j - first)] = typename Number::scalar(1);
  return moved;
}

/// Writes the blocks of coordinates and accelerations, from the derivatives of accelerations, with z at rest.
template <class Freedoms, class Rate, class Accelerations, class J>
void put_rate_derivatives(const Freedoms& freedoms, const Rate& v, const Accelerations& a, J& jacobian) {
  const Eigen::Index n = a.by_q.rows();
  jacobian.setZero();
  for (const freedom& f : freedoms) add_variation_of_pull_back<typename J::Scalar>(f, v, jacobian);
  jacobian.block(0, n, n, n).setIdentity();
  jacobian.block(n, 0, n, n) = a.by_q;
  jacobian.block(n, n, n, n) = a.by_v;
}

/// Writes A_z, Z and, if J has these columns, A_u and Z_u of a static chain, four directions at a time. `a` contains
/// accelerations and their derivatives.
template <class S, class Chain, class X, class U, class Accelerations, class J>
void derive_signals(const Chain& c, const S& t, const X& x, const U& u, const Accelerations& a, J& jacobian) {
  constexpr int lanes = 4, n = Chain::dofs;
  using number = dual<S, lanes>;
  using wiring = typename Chain::wiring;
  constexpr int nz = wiring::count(kind::internal);
  const std::span<const freedom> freedoms(wiring::table.free.data(), wiring::freedoms);
  const int columns = static_cast<int>(jacobian.cols());
  std::array<number, static_cast<std::size_t>(nz) + 1> z_dot;
  for (int first = nz > 0 ? 0 : 2 * n; first < columns; first += lanes) {
    const auto xs = moved_along<number>(freedoms, 2 * n + nz, x, first);
    Eigen::Matrix<number, U::RowsAtCompileTime, 1> us = u.template cast<number>();
    const int last = (std::min)(first + lanes, columns);
    for (int j = (std::max)(first, 2 * n + nz); j < last; ++j)
      us[j - 2 * n - nz].derivative[static_cast<std::size_t>(j - first)] = S(1);
    const number *q = xs.data(), *v = q + Chain::nq, *z = v + n;
    const configuration<number, wiring, const number*> at(q);
    const auto bases = with_signals<wiring>(base_under_gravity(c), number(t), std::as_const(us).data(), z);
    if constexpr (nz > 0) internal_rates(c, at, v, bases, z_dot.data());
    for (int j = first; j < last; ++j)
      for (int i = 0; i < nz; ++i)
        jacobian(2 * n + i, j) = z_dot[static_cast<std::size_t>(i)].derivative[static_cast<std::size_t>(j - first)];
    if (last <= 2 * n) continue;
    const auto rest = generalized_forces<number>(
        c, given{at, each<number, const number*>{v}, each<number, joint_vector<S, n>>{a.a}, bases}, one);
    for (int j = (std::max)(first, 2 * n); j < last; ++j) {
      joint_vector<S, n> by_signal;
      for (int i = 0; i < n; ++i) by_signal[i] = rest[i].derivative[static_cast<std::size_t>(j - first)];
      jacobian.col(j).template segment<n>(n).noalias() = a.by_tau * by_signal;
    }
  }
}

}  // namespace kte::detail
