#pragma once

#include <kte/contact/detail/friction_system.hpp>
#include <kte/errors.hpp>

namespace kte::detail {

/// The modes of lambda: open if lambda_n <= 1e-10 of the largest, sticks if |lambda_t| < mu lambda_n (1 - 1e-9).
template <class S, class Solution>
void find_modes(const friction_system<S>& p, Solution& x) {
  using std::sqrt;
  S largest(0);
  for (const Eigen::Index r : p.first) largest = (std::max<S>)(largest, x.lambda[static_cast<std::size_t>(r)]);
  for (std::size_t k = 0; k < p.contacts.size(); ++k) {
    const auto r = static_cast<std::size_t>(p.first[k]);
    const int n = p.contacts[k].rows;
    const S t1 = x.lambda[r + 1], t2 = n == 3 ? x.lambda[r + 2] : S(0);
    if (!(x.lambda[r] > S(1e-10) * largest)) {
      x.modes[k] = friction_mode::open;
    } else {
      const bool inside = sqrt(t1 * t1 + t2 * t2) < p.mu[k] * x.lambda[r] * S(1 - 1e-9);
      x.modes[k] = inside && !p.contacts[k].sliding ? friction_mode::sticks : friction_mode::slides;
    }
  }
}

/// Throws `bad_argument` for sizes that do not fit, and invalid friction.
template <class S>
void check_friction_problem(const friction_problem<S>& p) {
  Eigen::Index rows = 0;
  for (const auto& contact : p.contacts) {
    if (contact.rows != 2 && contact.rows != 3)
      detail::raise<bad_argument>("friction problem: a contact has 2 or 3 rows");
    if (!(contact.friction >= S(0)) || !(contact.friction - contact.friction == S(0)))
      detail::raise<bad_argument>("friction problem: friction must be finite and not negative");
    if (contact.sticking_friction && !(*contact.sticking_friction >= contact.friction))
      detail::raise<bad_argument>("friction problem: friction of sticking must not be below that of sliding");
    rows += contact.rows;
  }
  if (p.W.rows() != rows || p.W.cols() != rows || p.b.size() != rows)
    detail::raise<bad_argument>("friction problem: the sizes of W and b must be the number of rows of all contacts");
}

}  // namespace kte::detail
