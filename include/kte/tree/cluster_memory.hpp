#pragma once

#include <kte/kernels/solve.hpp>
#include <kte/recursions/cluster.hpp>
#include <kte/tree/clusters.hpp>
#include <kte/tree/memory.hpp>

/// The numbers of clusters (recursions/cluster.hpp) on the way inward and outward.
namespace kte::tree {

/// What articulated bodies with clusters work with; made by the first call.
template <class S>
struct cluster_memory {
  std::vector<dense_wrench<S>> columns;  ///< U of clusters, then those of body nodes (`cluster_node::columns`)
  std::vector<dense_wrench<S>> gain;     ///< of degrees of freedom, by `cluster::column`
  std::vector<S> force, acceleration;    ///< the same
  std::vector<S> rates;                  ///< of coordinates, by `cluster_layout::rates`
  std::vector<S> mass;                   ///< by `cluster::square`

  engine::cluster_values<S> of(const cluster& c) {
    return {c.dofs.size(), columns.data() + c.column, gain.data() + c.column, mass.data() + c.square,
            force.data() + c.column};
  }
  /// The rates of a coordinate by the degrees of freedom of its cluster.
  S* rates_of(const cluster_layout& layout, int row) {
    return rates.data() + layout.rates[static_cast<std::size_t>(row)];
  }
};

/// Rates of coordinates before followers add to them: one of a degree of freedom, zero of others.
template <class S>
void open_rates(const cluster_layout& layout, cluster_memory<S>& x) {
  x.rates.assign(layout.all_rates, S(0));
  for (const cluster& c : layout.clusters)
    for (std::size_t d = 0; d < c.dofs.size(); ++d) x.rates_of(layout, c.dofs[d])[d] = S(1);
}
/// Coordinate `to` has `ratio` times the rate of coordinate `from` of its cluster, rows.
template <class S>
void add_rates(const cluster_layout& layout, cluster_memory<S>& x, int to, int from, const S& ratio) {
  const cluster& c = layout.clusters[static_cast<std::size_t>(layout.of_row[static_cast<std::size_t>(to)])];
  const S* const followed = x.rates_of(layout, from);
  S* const own = x.rates_of(layout, to);
  for (std::size_t d = 0; d < c.dofs.size(); ++d) own[d] += ratio * followed[d];
}
/// Starts D and u, from masses of coordinates, by row, and forces(row of a degree of freedom).
template <class S, class Masses, class Forces>
void open_clusters(const cluster_layout& layout, cluster_memory<S>& x, const Masses* own_mass, const Forces& forces) {
  x.columns.assign(layout.all_columns, {}), x.gain.resize(layout.all_dofs);
  x.force.resize(layout.all_dofs), x.acceleration.resize(layout.all_dofs), x.mass.assign(layout.all_squares, S(0));
  for (const cluster& c : layout.clusters) {
    const auto values = x.of(c);
    for (std::size_t d = 0; d < values.n; ++d) values.force[d] = forces(c.dofs[d]);
    if (own_mass == nullptr) continue;
    for (const int row : c.rows) {
      const S mass(own_mass[row]);
      const S* const rates = x.rates_of(layout, row);
      for (std::size_t a = 0; a < values.n; ++a)
        for (std::size_t b = 0; b < values.n; ++b) values.mass[a * values.n + b] += rates[a] * rates[b] * mass;
    }
  }
}
/// Factors of D, U D^-1 and D^-1 u. Returns whether no rate moves nothing.
template <class S>
bool close_cluster(const engine::cluster_values<S>& c) {
  const auto n = static_cast<Eigen::Index>(c.n);
  if (n == 1) [[likely]] {
    const S inverse = S(1) / c.mass[0];
    c.force[0] *= inverse, c.gain[0] = {inverse * c.load[0].force, inverse * c.load[0].torque};
    return all(c.mass[0] > S(0));
  }
  Eigen::Map<Eigen::Matrix<S, Eigen::Dynamic, Eigen::Dynamic>> d(c.mass, n, n);
  if (!detail::factorise(d)) return false;
  for (std::size_t k = 0; k < c.n; ++k) c.gain[k] = c.load[k];
  const auto less = [&](std::size_t i, const S& l, std::size_t k) {
    c.force[i] -= l * c.force[k];
    c.gain[i] = {c.gain[i].force - l * c.gain[k].force, c.gain[i].torque - l * c.gain[k].torque};
  };
  for (std::size_t i = 0; i < c.n; ++i)
    for (std::size_t k = 0; k < i; ++k) less(i, c.mass[k * c.n + i], k);
  for (std::size_t i = c.n; i-- > 0;) {
    const S inverse = S(1) / c.mass[i * c.n + i];
    c.force[i] *= inverse, c.gain[i] = {inverse * c.gain[i].force, inverse * c.gain[i].torque};
    for (std::size_t k = i + 1; k < c.n; ++k) less(i, c.mass[i * c.n + k], k);
  }
  return true;
}

/// The number of the rate with the least pivot, in a cluster that has been closed.
template <class S>
std::size_t least_pivot(const engine::cluster_values<S>& c) {
  std::size_t least = 0;
  for (std::size_t k = 0; k < c.n; ++k)
    if (!(all(c.mass[k * c.n + k] > c.mass[least * c.n + least]))) least = k;
  return least;
}

}  // namespace kte::tree
