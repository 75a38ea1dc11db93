#pragma once

#include <kte/kernels/solve.hpp>
#include <kte/recursions/cluster.hpp>
#include <kte/tree/clusters.hpp>
#include <kte/tree/memory.hpp>
#include <kte/tree/ratios.hpp>

/// The numbers of clusters (recursions/cluster.hpp) on the way inward and outward.
namespace kte::tree {

/// What articulated bodies with clusters work with; made by the first call.
template <class S>
struct cluster_memory {
  struct step {
    int to, from;
    S ratio;
  };
  std::vector<step> steps;            ///< how coordinates follow others, in order
  std::vector<std::size_t> followed;  ///< ports of a follower
  ratios<S> j;
  std::vector<dense_wrench<S>> columns;     ///< of body nodes, by `cluster_layout::columns`
  std::vector<dense_wrench<S>> load, gain;  ///< of degrees of freedom, by `cluster::column`
  std::vector<S> force, acceleration;       ///< the same
  std::vector<S> rates;                     ///< of axes, by `cluster_layout::rates`
  std::vector<S> mass;                      ///< by `cluster::square`

  engine::cluster_values<S> of(const cluster& c) {
    return {c.dofs.size(), load.data() + c.column, gain.data() + c.column, mass.data() + c.square,
            force.data() + c.column};
  }
};

/// Starts D and u at the ratios of `x.j`, from masses of coordinates, by row, and forces(row of a degree of freedom).
template <class P, class S, class Masses, class Forces>
void open_clusters(const body_tree<P>& f, const cluster_layout& layout, cluster_memory<S>& x, const Masses& own_mass,
                   const Forces& forces) {
  x.columns.assign(layout.all_columns, {}), x.load.assign(layout.all_dofs, {}), x.gain.resize(layout.all_dofs);
  x.force.resize(layout.all_dofs), x.acceleration.resize(layout.all_dofs), x.mass.assign(layout.all_squares, S(0));
  x.rates.assign(layout.all_rates, S(0));
  const auto place = [&layout](int dof) {
    return static_cast<std::size_t>(layout.place[static_cast<std::size_t>(dof)]);
  };
  for (std::size_t i = 0; i < f.nodes.size(); ++i) {
    if (layout.of_node[i] < 0) continue;
    const std::size_t n = layout.at(static_cast<int>(i)).dofs.size();
    for (int k = 0; k < f.nodes[i].axes; ++k)
      for (const auto& [dof, ratio] : x.j.of(f.row[static_cast<std::size_t>(f.nodes[i].first + k)]))
        x.rates[layout.rates[i] + static_cast<std::size_t>(k) * n + place(dof)] = ratio;
  }
  for (const cluster& c : layout.clusters) {
    const auto values = x.of(c);
    for (std::size_t d = 0; d < values.n; ++d) values.force[d] = forces(c.dofs[d]);
    for (const int row : c.rows) {
      const S mass(own_mass[static_cast<std::size_t>(row)]);
      if (all(mass == S(0))) continue;
      for (const auto& [a, ratio] : x.j.of(row))
        for (const auto& [b, factor] : x.j.of(row))
          values.mass[place(a) * values.n + place(b)] += ratio * factor * mass;
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
