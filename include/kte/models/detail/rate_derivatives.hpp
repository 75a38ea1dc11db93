#pragma once

#include <kte/dynamics/derivatives.hpp>
#include <kte/dynamics/detail/internal_rates.hpp>
#include <kte/models/detail/displacement.hpp>

/// Derivatives of the rates of a model, x' = (v, a, z'), by displacements d = (dq, dv, dz) from its state, at d = 0:
///
///       | V    1    0   |
///   J = | A_q  A_v  A_z |   V: of the rate of dq, `add_variation_of_pull_back`          (1)
///       | Z_q  Z_v  Z_z |
///
/// A_q and A_v by `forward_dynamics_derivatives`; A_z = M^-1 df/dz, df/dz and Z by dual numbers.
namespace kte::detail {

/// Of coordinates and accelerations, from the derivatives of accelerations; z at rest.
template <class Freedoms, class Rate, class Accelerations, class J>
void put_rate_derivatives(const Freedoms& freedoms, const Rate& v, const Accelerations& a, J& jacobian) {
  const Eigen::Index n = a.by_q.rows();
  jacobian.setZero();
  for (const freedom& f : freedoms) add_variation_of_pull_back<typename J::Scalar>(f, v, jacobian);
  jacobian.block(0, n, n, n).setIdentity();
  jacobian.block(n, 0, n, n) = a.by_q;
  jacobian.block(n, n, n, n) = a.by_v;
}

/// A_z and Z of a static chain, four directions at a time.
template <class S, class Chain, class Inverse, class J>
void derive_internals(const Chain& c, const S& t, const S* q, const S* v, const S* z, const S* u,
                      const Inverse& inverse_of_mass, J& jacobian) {
  constexpr int lanes = 4, n = Chain::dofs;
  using number = dual<S, lanes>;
  using wiring = typename Chain::wiring;
  constexpr int nz = wiring::count(kind::internal), nu = wiring::nu;
  const auto constants = [](const S* from, auto& to) {
    for (std::size_t i = 0; i < to.size(); ++i) to[i] = number(from[i]);
  };
  std::array<number, static_cast<std::size_t>(Chain::nq)> qs;
  std::array<number, static_cast<std::size_t>(n)> vs;
  std::array<number, static_cast<std::size_t>(nz)> zs, z_dot;
  std::array<number, static_cast<std::size_t>(nu) + 1> us{};
  for (int i = 0; i < nu; ++i) us[static_cast<std::size_t>(i)] = number(u[i]);
  for (int first = 0; first < 2 * n + nz; first += lanes) {
    constants(q, qs), constants(v, vs), constants(z, zs);
    for (std::size_t lane = 0; lane < lanes; ++lane) {
      const int j = first + static_cast<int>(lane);
      for (std::size_t f = 0; f < wiring::freedoms; ++f) {
        const freedom& at = wiring::table.free[f];
        if (at.v <= j && j < at.v + nv_of(at.what)) displace(at, j - at.v, lane, std::span<number>(qs));
      }
      if (n <= j && j < 2 * n) vs[static_cast<std::size_t>(j - n)].derivative[lane] = S(1);
      if (2 * n <= j && j < 2 * n + nz) zs[static_cast<std::size_t>(j - 2 * n)].derivative[lane] = S(1);
    }
    const configuration<number, wiring, decltype(qs)> at(qs);
    const auto bases =
        with_signals<wiring>(base_under_gravity(c), number(t), std::as_const(us).data(), std::as_const(zs).data());
    internal_rates(c, at, std::as_const(vs).data(), bases, z_dot.data());
    const int last = (std::min)(first + lanes, 2 * n + nz);
    for (int j = first; j < last; ++j)
      for (int i = 0; i < nz; ++i)
        jacobian(2 * n + i, j) = z_dot[static_cast<std::size_t>(i)].derivative[static_cast<std::size_t>(j - first)];
    if (last <= 2 * n) continue;
    const auto force =
        coordinate_forces<number>(c, given{at, each<number, decltype(vs)>{vs}, same<zero_t>{}, bases}, one);
    for (int j = (std::max)(first, 2 * n); j < last; ++j) {
      joint_vector<S, n> by_z;
      for (int i = 0; i < n; ++i) by_z[i] = force[i].derivative[static_cast<std::size_t>(j - first)];
      jacobian.col(j).segment(n, n) = inverse_of_mass * by_z;
    }
  }
}

}  // namespace kte::detail
