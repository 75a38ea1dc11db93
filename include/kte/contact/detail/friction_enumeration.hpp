#pragma once

#include <kte/contact/detail/eliminate.hpp>
#include <kte/contact/detail/friction_system.hpp>
#include <kte/contact/detail/least_squares.hpp>

#include <limits>

namespace kte::detail {

/// Combinations of modes of contacts whose friction is piecewise linear: plane contacts, contacts that slide in a fixed
/// direction, and contacts without friction. At most 64 combinations, thus at most 6 unknowns.
template <class S>
class friction_enumeration {
 public:
  static constexpr int most = 64;
  /// Whether equations of a combination were nearly singular, but not singular; `solve` sets it.
  bool nearly_singular = false;

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
    G_ = {};
    int n = 0, generators = 0;
    for (std::size_t k = 0; k < p.contacts.size(); ++k) {
      const auto& contact = p.contacts[k];
      const int of = modes_of(p, k), mode = combination % of;
      combination /= of;
      const bool smooth = of == 2;
      modes[k] = mode == of - 1         ? friction_mode::open
                 : mode == 0 && !smooth ? friction_mode::sticks
                                        : friction_mode::slides;
      p.mu[k] =
          modes[k] == friction_mode::slides ? contact.friction : contact.sticking_friction.value_or(contact.friction);
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
        edge(generators, n) = edge(generators + 1, n) = S(1);
        edge(generators, n + 1) = p.mu[k], edge(generators + 1, n + 1) = -p.mu[k];
        n += 2, generators += 2;
        continue;
      }
      rows_[n] = contact.rows;
      coefficient_[n] = {S(1), S(0), S(0)};
      if (const auto& d = contact.sliding)
        for (int c = 1; c < contact.rows; ++c)
          coefficient_[n][static_cast<std::size_t>(c)] = -p.mu[k] * (*d)[static_cast<std::size_t>(c - 1)];
      else if (!smooth)
        coefficient_[n][1] = mode == 1 ? p.mu[k] : S(-p.mu[k]);
      edge(generators, n) = S(1);
      ++n, ++generators;
    }
    const auto entry = [&](int i, int j) {  // of R^T W C
      S sum(0);
      for (int c = 0; c < rows_[j]; ++c)
        sum += coefficient_[j][static_cast<std::size_t>(c)] * p.column(unknown_row_[j] + c)[unknown_row_[i]];
      return sum;
    };
    std::array<S, 48> A{};
    for (int i = 0; i < n; ++i) {
      for (int j = 0; j < n; ++j) A[static_cast<std::size_t>(8 * i + j)] = entry(i, j);
      A[static_cast<std::size_t>(8 * i + n)] = -p.b[unknown_row_[i]];
    }
    std::array<S, 6> x{};
    if (n > 0) {
      std::array<S, 48> eliminated = A;
      const S pivot = eliminate(eliminated.data(), n, 8);
      if (pivot > S(1e-9) * p.unit) {
        for (int i = 0; i < n; ++i) x[static_cast<std::size_t>(i)] = eliminated[static_cast<std::size_t>(8 * i + n)];
      } else {
        x = least_of(A, n, generators);
        nearly_singular = nearly_singular || pivot > S(100) * std::numeric_limits<S>::epsilon() * p.unit;
      }
    }
    std::fill_n(lambda, p.size, S(0));
    for (int j = 0; j < n; ++j)
      for (int c = 0; c < rows_[j]; ++c)
        lambda[unknown_row_[j] + c] += x[static_cast<std::size_t>(j)] * coefficient_[j][static_cast<std::size_t>(c)];
    for (std::size_t k = 0; k < p.contacts.size(); ++k)
      if (p.contacts[k].pressed && !(lambda[p.first[k]] > S(0))) return false;
    return true;
  }

 private:
  /// The least x = G a with A x = c, a >= 0. G: the edges of the friction cones.
  std::array<S, 6> least_of(const std::array<S, 48>& A, int n, int generators) const {
    using std::sqrt;
    small_columns<S, 12, 6> B{};
    std::array<S, 12> right{};
    S size(0);
    for (int i = 0; i < n; ++i) size = (std::max<S>)(size, A[static_cast<std::size_t>(9 * i)]);
    const S tiny = S(10) * sqrt(std::numeric_limits<S>::epsilon()) * size;
    const auto un = static_cast<std::size_t>(n), ug = static_cast<std::size_t>(generators);
    for (std::size_t i = 0; i < un; ++i) {
      right[i] = A[8 * i + un];
      for (std::size_t g = 0; g < ug; ++g) {
        for (std::size_t j = 0; j < un; ++j) B[g][i] += A[8 * i + j] * G_[g][j];
        B[g][6 + i] = tiny * G_[g][i];
      }
    }
    const auto a = nonnegative_least_squares<S>(B, right, ug);
    std::array<S, 6> x{};
    for (std::size_t g = 0; g < ug; ++g)
      for (std::size_t j = 0; j < un; ++j) x[j] += a[g] * G_[g][j];
    return x;
  }

  S& edge(int generator, int unknown) {
    return G_[static_cast<std::size_t>(generator)][static_cast<std::size_t>(unknown)];
  }

  small_columns<S, 6, 6> G_{};
  Eigen::Index unknown_row_[7]{};
  int rows_[7]{};
  std::array<S, 3> coefficient_[7]{};
};

}  // namespace kte::detail
