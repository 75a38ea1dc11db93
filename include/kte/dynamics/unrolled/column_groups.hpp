#pragma once

#include <kte/contract/coordinate_variation.hpp>
#include <kte/dynamics/unrolled/tree.hpp>
#include <kte/tree/solve_limbs.hpp>

/// Products with the inverse of a mass matrix that omit rows that the wiring determines to be zero.
namespace kte::detail {

/// Columns from `first` to `end`, with the same rows.
template <std::size_t N>
struct column_group {
  int first = 0, end = 0;
  std::size_t count = 0;
  std::array<int, N> row{};
};
template <std::size_t N>
struct column_groups {
  std::size_t count = 0;
  std::array<column_group<N>, N> group{};
};

/// Which coordinates affect the forces on each other: those of joints on one path to the base, and those that an
/// element on coordinates couples.
template <class Chain, std::size_t... E>
constexpr auto couplings(std::index_sequence<E...>) {
  using wiring = typename Chain::wiring;
  constexpr std::size_t n{Chain::dofs};
  const joint_place joints[]{joint_place_of<Chain, E, is_free_joint<Chain, E>>()..., {}};
  const bool on_coordinates[]{is_on_coordinates<core_of<Chain, E>>..., false};
  std::array<std::array<bool, n + 1>, n + 1> couples{};
  const auto couple = [&couples](const joint_place& a, const joint_place& b) {
    for (int i = a.row; i < a.row + a.axes; ++i)
      for (int j = b.row; j < b.row + b.axes; ++j)
        couples[static_cast<std::size_t>(i)][static_cast<std::size_t>(j)] =
            couples[static_cast<std::size_t>(j)][static_cast<std::size_t>(i)] = true;
  };
  const auto coordinate = [](std::size_t port) {
    const kind k = wiring::table.what[port];
    const freedom f = wiring::freedom_of(k, wiring::table.slot[port]);
    return f.what == k && is_coordinate(k) ? joint_place{f.v, nv_of(k), -1} : joint_place{};
  };
  for (std::size_t e = 0; e < sizeof...(E); ++e) {
    for (int below = static_cast<int>(e); below >= 0; below = joints[below].below) couple(joints[e], joints[below]);
    if (!on_coordinates[e]) continue;
    const auto end = static_cast<std::size_t>(wiring::first[e + 1]);
    for (auto p = static_cast<std::size_t>(wiring::first[e]); p < end; ++p)
      for (std::size_t other = p; other < end; ++other) couple(coordinate(p), coordinate(other));
  }
  return couples;
}
/// The rows of each column; all rows if derivatives are not `Known` element by element.
template <class Chain, bool Known>
constexpr auto group_columns() {
  constexpr std::size_t n{Chain::dofs};
  column_groups<n + 1> groups;
  if constexpr (Known) {
    const auto couples = couplings<Chain>(std::make_index_sequence<Chain::size>{});
    for (std::size_t j = 0; j < n; ++j) {
      if (j == 0 || couples[j] != couples[j - 1]) {
        auto& g = groups.group[groups.count++];
        g.first = static_cast<int>(j);
        for (std::size_t i = 0; i < n; ++i)
          if (couples[j][i]) g.row[g.count++] = static_cast<int>(i);
      }
      groups.group[groups.count - 1].end = static_cast<int>(j) + 1;
    }
  } else {
    auto& all = groups.group[groups.count++];
    for (all.end = Chain::dofs; all.count < n; ++all.count) all.row[all.count] = static_cast<int>(all.count);
  }
  return groups;
}
/// X = -M^-1 B and Y = -M^-1 C, for derivatives B, C of the forces of a chain.
template <class Chain, bool Known, class Matrix, class X>
void solve_by_groups(const Matrix& inverse, const Matrix& b, const Matrix& c, X& x, X& y) {
  using S = typename Matrix::Scalar;
  using size = std::integral_constant<int, Chain::dofs>;
  static constexpr auto groups = group_columns<Chain, Known>();
  const auto solve = [&](const auto& rows, int first, int end) {
    tree::solve_columns(
        tree::solve_arguments<S, size, std::remove_cvref_t<decltype(rows)>>{
            {}, inverse.data(), b.data(), c.data(), x.data(), y.data(), rows},
        first, end);
  };
  if constexpr (groups.count == 1 && groups.group[0].count == Chain::dofs) {
    solve(tree::all_rows<size>{}, 0, Chain::dofs);
  } else {
    for (std::size_t k = 0; k < groups.count; ++k) {
      const auto& g = groups.group[k];
      solve(tree::some_rows{std::span(g.row.data(), g.count)}, g.first, g.end);
    }
  }
}

}  // namespace kte::detail
