#pragma once

#include <kte/detail/short_list.hpp>
#include <kte/manipulators/subproblems.hpp>

#include <algorithm>

namespace kte {

/// A pair of angles, `first` and `second`, a solution of two equations.
template <class S>
struct angle_pair {
  solved_angle<S> first, second;
  unsigned slot;  ///< identifies the pair among all solutions
};
/// All pairs: at most four, and double solutions.
template <class S>
using angle_pairs = detail::short_list<angle_pair<S>, 8>;

namespace detail {
/// Whether two angles are equal, up to the error of double roots, or up to `unknown`, rad.
template <class S>
bool same_angle(const solved_angle<S>& p, const solved_angle<S>& q, double unknown = 0) {
  return std::abs(double_of(S(p.cos - q.cos))) + std::abs(double_of(S(p.sin - q.sin))) <= (std::max)(1e-9, unknown);
}

/// Sorts pairs and assigns their slots. Bit 0 of a slot is given: whether the determinant of the derivatives is
/// negative, which changes only through a double root. Higher bits number the pairs of one sign by their first angle,
/// from -pi; these change if an angle passes half a turn. (No numbering could be invariant: some arms move between
/// solutions of the same sign without a double root on the way; Wenger, Uniqueness Domains and Regions of Feasible
/// Paths for Cuspidal Manipulators, IEEE Transactions on Robotics 20, 2004.)
template <class S>
void name_slots(angle_pairs<S>& all) {
  const auto place = [](const solved_angle<S>& t) {  // increases with the angle
    return t.sin < S(0) ? double_of(t.cos) - 1 : 1 - double_of(t.cos);
  };
  std::sort(all.item.begin(), all.item.begin() + static_cast<std::ptrdiff_t>(all.size()),
            [&](const angle_pair<S>& x, const angle_pair<S>& y) {
              return x.slot < y.slot || (x.slot == y.slot && place(x.first) < place(y.first));
            });
  unsigned next[]{0, 1};
  for (std::size_t i = 0; i < all.size(); ++i) {
    auto& n = next[all[i].slot];
    all[i].slot = n, n += 2;
  }
}
}  // namespace detail

}  // namespace kte
