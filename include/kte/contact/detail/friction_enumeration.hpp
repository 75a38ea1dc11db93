#pragma once

#include <kte/contact/detail/friction_system.hpp>
#include <kte/contact/detail/least_squares.hpp>

namespace kte::detail {

/// Combinations of modes of contacts whose friction is piecewise linear: plane contacts, contacts that slide in a fixed
/// direction, and contacts without friction. At most 64 combinations, thus at most 6 unknowns.
template <class S>
class friction_enumeration {
 public:
  static constexpr int most = 64;

  /// The number of modes of contact k; 0 if it is not piecewise linear.
  static int modes_of(const friction_system<S>& p, std::size_t k) {
    const auto& contact = p.contacts[k];
    if (contact.sliding || !(p.mu[k] > S(0))) return 2;
    return contact.rows == 2 ? 4 : 0;
  }
  /// The number of combinations; 0 if the problem is not piecewise linear, or there are too many.
  static int combinations(const friction_system<S>& p) {
    int n = 1;
    for (std::size_t k = 0; k < p.contacts.size() && n > 0 && n <= most; ++k) n *= modes_of(p, k);
    return n <= most ? n : 0;
  }

  /// lambda of a combination, sticking first, open last, and the modes; false if it has none >= 0. Sets p.mu to the
  /// friction of each mode.
  bool solve(friction_system<S>& p, int combination, S* lambda, friction_mode* modes) {
    G_.setZero(), R_.setZero(), C_.setZero();
    int n = 0, generators = 0;
    for (std::size_t k = 0; k < p.contacts.size(); ++k) {
      const auto& contact = p.contacts[k];
      const int of = modes_of(p, k), mode = combination % of;
      combination /= of;
      const bool smooth = of == 2;
      modes[k] = mode == of - 1 ? friction_mode::open : mode == 0 && !smooth ? friction_mode::sticks : friction_mode::slides;
      if (smooth && !contact.sliding && modes[k] == friction_mode::slides) modes[k] = friction_mode::slides;
      p.mu[k] = modes[k] == friction_mode::slides ? contact.friction : contact.sticking_friction.value_or(contact.friction);
      if (modes[k] == friction_mode::open) {
        if (contact.pressed) return false;
        continue;
      }
      const auto row = p.first[k];
      unknown_row_[n] = row;
      if (modes[k] == friction_mode::sticks) {
        unknown_row_[n + 1] = row + 1;
        coefficient_[n] = {S(1), S(0), S(0)}, coefficient_[n + 1] = {S(1), S(0), S(0)};
        rows_[n] = rows_[n + 1] = 1;
        G_(n, generators) = G_(n, generators + 1) = S(1);
        G_(n + 1, generators) = p.mu[k], G_(n + 1, generators + 1) = -p.mu[k];
        n += 2, generators += 2;
        continue;
      }
      rows_[n] = contact.rows;
      coefficient_[n] = {S(1), S(0), S(0)};
      if (const auto& d = contact.sliding)
        for (int c = 1; c < contact.rows; ++c) coefficient_[n][static_cast<std::size_t>(c)] = -p.mu[k] * (*d)[static_cast<std::size_t>(c - 1)];
      else if (!smooth)
        coefficient_[n][1] = mode == 1 ? p.mu[k] : S(-p.mu[k]);
      G_(n, generators) = S(1);
      ++n, ++generators;
    }
    for (int j = 0; j < n; ++j)
      for (int i = 0; i < n; ++i)
        for (int c = 0; c < rows_[j]; ++c) R_(i, j) += coefficient_[j][static_cast<std::size_t>(c)] * p.column(unknown_row_[j] + c)[unknown_row_[i]];
    for (int i = 0; i < n; ++i) C_[i] = -p.b[unknown_row_[i]];
    small_vector<S, 6> x = small_vector<S, 6>::Zero(n);
    if (n > 0) {
      const small_matrix<S, 6, 6> A = R_.topLeftCorner(n, n);
      const Eigen::FullPivLU<small_matrix<S, 6, 6>> lu(A);
      using std::abs;
      if (abs(lu.matrixLU()(n - 1, n - 1)) > S(1e-10) * lu.maxPivot())
        x = lu.solve(C_.head(n));
      else
        x = G_.topLeftCorner(n, generators) *
            nonnegative_least_squares<S>(A, G_.topLeftCorner(n, generators), C_.head(n));
    }
    std::fill_n(lambda, p.size, S(0));
    for (int j = 0; j < n; ++j)
      for (int c = 0; c < rows_[j]; ++c) lambda[unknown_row_[j] + c] += x[j] * coefficient_[j][static_cast<std::size_t>(c)];
    for (std::size_t k = 0; k < p.contacts.size(); ++k)
      if (p.contacts[k].pressed && !(lambda[p.first[k]] > S(0))) return false;
    return true;
  }

 private:
  small_matrix<S, 6, 6> G_ = small_matrix<S, 6, 6>::Zero(6, 6), R_ = small_matrix<S, 6, 6>::Zero(6, 6);
  small_vector<S, 6> C_ = small_vector<S, 6>::Zero(6);
  Eigen::Index unknown_row_[7]{};
  int rows_[7]{};
  std::array<S, 3> coefficient_[7]{};
};

}  // namespace kte::detail
