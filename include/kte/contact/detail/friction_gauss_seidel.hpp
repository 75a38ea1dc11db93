#pragma once

#include <kte/contact/detail/eliminate.hpp>
#include <kte/contact/detail/friction_system.hpp>

namespace kte::detail {

/// The problem of one contact in space or in the plane: W = W_ii, b with the velocity of all other contacts in it.
/// Returns lambda. Sliding in space: with lambda_t = mu lambda_n d and d at the angle theta,
///
///   lambda_n = -b_n/(W_nn + mu W_nt d),   d x u_t = 0,   d.u_t <= 0,
///
/// whose roots are bracketed on 32 angles and bisected.
template <class S>
std::array<S, 3> contact_alone(const friction_system<S>& p, int i, const std::array<S, 3>& b, const S* start) {
  using std::abs;
  using std::cos;
  using std::sin;
  using std::sqrt;
  const auto k = static_cast<std::size_t>(i);
  const Eigen::Index r = p.first[k];
  const int n = p.contacts[k].rows;
  const S mu = p.mu[k];
  S W[3][3]{};
  for (int j = 0; j < n; ++j)
    for (int e = 0; e < n; ++e) W[e][j] = p.column(r + j)[r + e];
  std::array<S, 3> none{};
  if (!(b[0] < S(0))) return none;
  const auto sliding = [&](S d1, S d2) {
    const S denominator = W[0][0] + mu * (W[0][1] * d1 + W[0][2] * d2);
    const S normal = denominator > S(0) ? S(-b[0] / denominator) : S(-1);
    return std::array<S, 3>{normal, mu * normal * d1, mu * normal * d2};
  };
  if (const auto& d = p.contacts[k].sliding) {
    const auto x = sliding(-(*d)[0], n == 3 ? S(-(*d)[1]) : S(0));
    return x[0] > S(0) ? x : none;
  }
  if (!(mu > S(0))) return {-b[0] / W[0][0], S(0), S(0)};
  // Sticking
  std::array<S, 12> A{W[0][0], W[0][1], W[0][2], -b[0],   W[1][0], W[1][1],
                      W[1][2], -b[1],   W[2][0], W[2][1], W[2][2], -b[2]};
  for (std::size_t e = 0; e < 3; ++e) A[5 * e] += p.unit * S(1e-12);
  if (eliminate(A.data(), 3, 4) > S(0)) {
    const std::array<S, 3> x{A[3], A[7], A[11]};
    if (x[0] >= S(0) && x[1] * x[1] + x[2] * x[2] <= mu * mu * x[0] * x[0]) return x;
  }
  // Sliding
  const auto slip = [&](const std::array<S, 3>& l, int row) {
    return b[static_cast<std::size_t>(row)] + W[row][0] * l[0] + W[row][1] * l[1] + W[row][2] * l[2];
  };
  std::array<S, 3> best{start[0], start[1], n == 3 ? start[2] : S(0)};
  S distance(-1);
  const auto consider = [&](const std::array<S, 3>& l) {
    if (!(l[0] > S(0)) || !(l[1] * slip(l, 1) + (n == 3 ? S(l[2] * slip(l, 2)) : S(0)) <= S(0))) return;
    S moved(0);
    for (int e = 0; e < n; ++e)
      moved += (l[static_cast<std::size_t>(e)] - start[e]) * (l[static_cast<std::size_t>(e)] - start[e]);
    if (distance < S(0) || moved < distance) distance = moved, best = l;
  };
  if (n == 2) {
    consider(sliding(S(1), S(0)));
    consider(sliding(S(-1), S(0)));
    return best;
  }
  const auto cross = [&](S angle) {  // positive factors left out
    const S d1 = cos(angle), d2 = sin(angle);
    const S denominator = W[0][0] + mu * (W[0][1] * d1 + W[0][2] * d2);
    const S u1 = b[1] * denominator - b[0] * (W[1][0] + mu * (W[1][1] * d1 + W[1][2] * d2));
    const S u2 = b[2] * denominator - b[0] * (W[2][0] + mu * (W[2][1] * d1 + W[2][2] * d2));
    return d1 * u2 - d2 * u1;
  };
  const S turn = S(6.283185307179586);
  constexpr int parts = 32;
  S low(0), at_low = cross(low);
  for (int part = 1; part <= parts; ++part) {
    S high = turn * S(part) / S(parts);
    S at_high = cross(high);
    const S next = high, at_next = at_high;
    if ((at_low < S(0)) != (at_high < S(0))) {
      for (int halving = 0; halving < 60; ++halving) {
        const S middle = (low + high) / S(2), at = cross(middle);
        if ((at < S(0)) == (at_low < S(0)))
          low = middle, at_low = at;
        else
          high = middle, at_high = at;
      }
      consider(sliding(cos(low), sin(low)));
    }
    low = next, at_low = at_next;
  }
  return best;
}

/// One sweep of the Gauss-Seidel method over the contacts: solves each exactly, with the others fixed.
template <class S>
void gauss_seidel_sweep(const friction_system<S>& p, S* lambda, S* u) {
  for (int i = 0; i < p.count(); ++i) {
    const auto k = static_cast<std::size_t>(i);
    const Eigen::Index r = p.first[k];
    const int n = p.contacts[k].rows;
    std::array<S, 3> b{};
    for (int e = 0; e < n; ++e) {
      b[static_cast<std::size_t>(e)] = u[r + e];
      for (int j = 0; j < n; ++j) b[static_cast<std::size_t>(e)] -= p.column(r + j)[r + e] * lambda[r + j];
    }
    const auto l = contact_alone(p, i, b, lambda + r);
    for (int j = 0; j < n; ++j) {
      const S change = l[static_cast<std::size_t>(j)] - lambda[r + j];
      if (change == S(0)) continue;
      typename friction_system<S>::view(u, p.size) +=
          change * typename friction_system<S>::const_view(p.column(r + j), p.size);
      lambda[r + j] = l[static_cast<std::size_t>(j)];
    }
  }
}

}  // namespace kte::detail
