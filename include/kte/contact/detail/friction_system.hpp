#pragma once

#include <kte/contact/friction_problem.hpp>
#include <kte/tree/simd.hpp>

#include <algorithm>
#include <cmath>
#include <vector>

namespace kte::detail {

/// A friction problem with what all methods need of it: where the rows of each contact begin, the friction to use, and
/// steps rho = 1/W_ii of normal and tangential rows.
template <class S>
struct friction_system {
  using vector = Eigen::Matrix<S, Eigen::Dynamic, 1>;
  using view = Eigen::Map<vector>;
  using const_view = Eigen::Map<const vector>;

  const S* W{};
  Eigen::Index stride{}, size{};
  const S* b{};
  S unit{1};  // mean of the diagonal of W
  std::span<const friction_contact<S>> contacts;
  std::vector<Eigen::Index> first;
  std::vector<S> mu, rho_n, rho_t;

  int count() const { return static_cast<int>(contacts.size()); }
  const S* column(Eigen::Index j) const { return W + j * stride; }

  void assign(const friction_problem<S>& p) {
    using std::sqrt;
    W = p.W.data(), stride = p.W.outerStride(), size = p.b.size(), b = p.b.data(), contacts = p.contacts;
    const std::size_t n = contacts.size();
    first.resize(n), mu.resize(n), rho_n.resize(n), rho_t.resize(n);
    Eigen::Index row = 0;
    S trace(0);
    for (Eigen::Index i = 0; i < size; ++i) trace += column(i)[i];
    unit = trace > S(0) ? S(trace / S(size)) : S(1);
    const S least = unit * S(1e-10);
    for (std::size_t i = 0; i < n; ++i) {
      first[i] = row;
      mu[i] = contacts[i].friction;
      rho_n[i] = S(1) / (std::max<S>)(column(row)[row], least);
      S sum(0);
      for (int k = 1; k < contacts[i].rows; ++k) sum += column(row + k)[row + k];
      rho_t[i] = S(contacts[i].rows - 1) / (std::max<S>)(sum, least);
      row += contacts[i].rows;
    }
  }

  /// Whether contact k slides in a fixed direction d with W_nn - mu W_nt d <= 0 (Painleve).
  bool is_jammed(std::size_t k) const {
    const auto& d = contacts[k].sliding;
    if (!d) return false;
    S sum = column(first[k])[first[k]];
    for (int c = 0; c + 1 < contacts[k].rows; ++c)
      sum -= mu[k] * (*d)[static_cast<std::size_t>(c)] * column(first[k] + 1 + c)[first[k]];
    return !(sum > S(0));
  }
  /// u = W lambda + b.
  void velocity(const S* lambda, S* u) const {
    constexpr auto lanes = static_cast<Eigen::Index>(tree::simd_of<S>::count);
    Eigen::Index i = 0;
    for (; i + lanes <= size; i += lanes) {
      tree::simd<S> sum, w;
      tree::load<S>(sum, b + i);
      for (Eigen::Index j = 0; j < size; ++j) {
        tree::load<S>(w, column(j) + i);
        sum = sum + lambda[j] * w;
      }
      tree::store<S>(sum, u + i);
    }
    for (; i < size; ++i) {
      u[i] = b[i];
      for (Eigen::Index j = 0; j < size; ++j) u[i] += lambda[j] * column(j)[i];
    }
  }

  /// The natural map F of Alart and Curnier (Comput. Methods Appl. Mech. Engrg. 92, 1991),
  ///
  ///   F_n = lambda_n - max(0, tau_n),   F_t = lambda_t - P(tau_t),   tau = lambda - rho u,
  ///
  /// P: onto the disc of radius mu max(0, tau_n). Returns max |F|/s, s the largest of |lambda| and rho |b|.
  S residual(const S* lambda, const S* u, S* F) const {
    using std::abs;
    using std::sqrt;
    S scale(0), worst(0);
    for (int i = 0; i < count(); ++i) {
      const auto k = static_cast<std::size_t>(i);
      const Eigen::Index r = first[k];
      const S pressure = (std::max<S>)(S(0), lambda[r] - rho_n[k] * u[r]);
      F[r] = lambda[r] - pressure;
      scale = (std::max)({scale, S(abs(lambda[r])), S(rho_n[k] * abs(b[r]))});
      worst = (std::max<S>)(worst, abs(F[r]));
      const S radius = mu[k] * pressure;
      S length(0);
      S tau[2]{};
      for (int c = 0; c + 1 < contacts[k].rows; ++c) {
        tau[c] = lambda[r + 1 + c] - rho_t[k] * u[r + 1 + c];
        length += tau[c] * tau[c];
        scale = (std::max<S>)(scale, abs(lambda[r + 1 + c]));
        if (radius > S(0) && !contacts[k].sliding) scale = (std::max<S>)(scale, rho_t[k] * abs(b[r + 1 + c]));
      }
      length = sqrt(length);
      const bool inside = length <= radius;
      for (int c = 0; c + 1 < contacts[k].rows; ++c) {
        S target = inside ? tau[c] : tau[c] * radius / length;
        if (const auto& d = contacts[k].sliding) target = -radius * (*d)[static_cast<std::size_t>(c)];
        F[r + 1 + c] = lambda[r + 1 + c] - target;
        worst = (std::max<S>)(worst, abs(F[r + 1 + c]));
      }
    }
    return scale > S(0) ? S(worst / scale) : worst;
  }
};

}  // namespace kte::detail
