#pragma once

#include <kte/dynamics/looped/forces_by_rates.hpp>
#include <kte/dynamics/looped/mass_matrix.hpp>
#include <kte/tree/articulated_clusters.hpp>
#include <kte/tree/given_forces.hpp>

/// Forward dynamics where coordinates follow others, by articulated bodies with clusters. `Elements` and states as in
/// dynamics/looped/inverse_dynamics.hpp.
namespace kte::detail {

/// Moves a follower, and says put(row of a coordinate, rate of what it writes by that coordinate). The motion of an
/// element that follows one coordinate is known from that at a rate of one,
///
///   y' = f_1 q',   y'' = f_1 q'' + f_2 q'^2          (1)
template <class Elements, class State, class Put>
void move_and_derive(const Elements& c, State& s, const tree::cluster_follower& x, const Put& put) {
  using S = typename State::scalar;
  if (!x.alone) {
    c.move(x.element, s);
    for (const auto& [port, coordinate, row] : x.followed)
      put(row, ratio_of(c, s, x.element, s.template get<kind::gen>(coordinate)));
    return;
  }
  auto& q = s.template get<kind::gen>(x.followed[0].coordinate);
  auto& end = s.template get<kind::gen>(x.written);
  const S v = q.q_dot, a = q.q_ddot;
  q.q_dot = S(1), q.q_ddot = S(0);
  c.move(x.element, s);
  q.q_dot = v, q.q_ddot = a;
  const S ratio = end.q_dot, curvature = end.q_ddot;
  end.q_dot = ratio * v, end.q_ddot = ratio * a + curvature * (v * v);
  put(x.followed[0].row, ratio);
}
/// Moves all followers, and finds how coordinates follow degrees of freedom.
template <class Elements, class State>
void move_and_derive_followers(const Elements& c, State& s) {
  using S = typename State::scalar;
  const auto& t = s.tree();
  auto& values = s.work.clusters;
  tree::open_rates(t.clusters, values);
  for (const auto& x : t.clusters.followers) {
    if (x.written < 0) {
      c.move(x.element, s);
      continue;
    }
    move_and_derive(c, s, x, [&](int row, const S& ratio) { tree::add_rates(t.clusters, values, x.row, row, ratio); });
    if constexpr (State::has_sines) update_angle(s.template get<kind::gen>(x.written));
  }
  for (const auto& [k, slot] : t.turned) with_coordinate(s, k, slot, [](auto& y) { update_angle(y); });
}
/// The forces of elements on the degrees of freedom, at the rates of the state and no accelerations of degrees of
/// freedom; with what is on coordinates that follow them.
template <class Elements, class State>
void forces_by_rates(const Elements& c, State& s) {
  using S = typename State::scalar;
  const auto& t = s.tree();
  auto& w = s.work;
  if (t.on_coordinates.empty() && t.on_frames.empty() && t.rotors.empty()) {
    for (int i = 0; i < s.dofs(); ++i) w.forces[i] = S(0);
    return;
  }
  push_by_rates(c, s);
  for (const auto& [coordinate, mass] : t.rotors) {
    auto& x = s.template get<kind::gen>(coordinate);
    x.f -= mass * x.q_ddot;
  }
  read_listed_numbers<vector_of::f>(s, w.forces);
  for (std::size_t i = 0; i < t.plan.row_of_gen.size(); ++i) {
    const int row = t.plan.row_of_gen[i];
    if (row < s.dofs()) continue;
    const int in = t.clusters.of_row[static_cast<std::size_t>(row)];
    if (in < 0) continue;
    const S f = s.template get<kind::gen>(static_cast<int>(i)).f;
    const auto& dofs = t.clusters.clusters[static_cast<std::size_t>(in)].dofs;
    const S* const rates = w.clusters.rates_of(t.clusters, row);
    for (std::size_t d = 0; d < dofs.size(); ++d) w.forces[dofs[d]] += rates[d] * f;
  }
}
/// A cluster with a rate that moves no mass, or one that is not finite.
template <class Elements, class State>
[[noreturn, gnu::cold]] void diagnose_cluster(const Elements& c, State& s, const tree::cluster& x) {
  const auto values = s.work.clusters.of(x);
  const std::size_t d = tree::least_pivot(values);
  const auto& pivot = values.mass[d * values.n + d];
  c.diagnose_mass(s, x.dofs[d], all(pivot == pivot));
}
/// Forces tau(i), and those of the elements, to accelerations in `forces`.
template <class Elements, class State>
void accelerate_clustered(const Elements& c, State& s, const tree::given_forces<typename State::scalar>& tau) {
  using S = typename State::scalar;
  const auto& t = s.tree();
  auto& w = s.work;
  for_each_listed_freedom(s, [](auto& x, const freedom&) { visit_a(x, [](S& a) { a = S(0); }); });
  move_and_derive_followers(c, s);
  place_bodies_by_coordinates(c, s);
  take_rates(s), take_bases(s);
  const auto biases = tree::bias_motions(tree::clustered_bodies(t.body_tree, w, t.clusters), w);
  forces_by_rates(c, s);
  for (int i = 0; i < s.dofs(); ++i) w.forces[i] += tau(i);
  for (std::size_t k = 0; k < t.body_tree.row.size(); ++k)
    w.force[k] = t.body_tree.row[k] < s.dofs() ? w.forces[t.body_tree.row[k]] : S(0);
  tree::open_clusters(t.clusters, w.clusters, t.has_own_mass ? t.own_mass.data() : nullptr,
                      [&w](int row) { return w.forces[row]; });
  if (const int bad = tree::articulate_clusters(t.body_tree, w, t.clusters, w.clusters, biases); bad >= 0)
      [[unlikely]] {
    const int in = t.clusters.of_row[static_cast<std::size_t>(t.body_tree.row[static_cast<std::size_t>(bad)])];
    if (in >= 0) diagnose_cluster(c, s, t.clusters.clusters[static_cast<std::size_t>(in)]);
    diagnose_axis(c, s, bad);
  }
  take_rates(s);  // also of coordinates that follow
  tree::accelerate_clusters(t.body_tree, w, t.clusters, w.clusters, biases);
  for (std::size_t k = 0; k < t.body_tree.row.size(); ++k)
    if (t.body_tree.row[k] < s.dofs()) w.forces[t.body_tree.row[k]] = w.acceleration[k];
  for (const auto& cluster : t.clusters.clusters) {
    const auto values = w.clusters.of(cluster);
    if (cluster.first_node < 0 && !tree::close_cluster(values)) diagnose_cluster(c, s, cluster);
    for (std::size_t d = 0; d < values.n; ++d)
      w.forces[cluster.dofs[d]] =
          cluster.first_node < 0 ? values.force[d] : w.clusters.acceleration[cluster.column + d];
  }
  for (const int row : t.plan.jointless_dofs)
    if (t.clusters.of_row[static_cast<std::size_t>(row)] < 0) {
      if (!all(t.own_mass[static_cast<std::size_t>(row)] > 0)) [[unlikely]]
        c.diagnose_mass(s, row, true);
      w.forces[row] /= t.own_mass[static_cast<std::size_t>(row)];
    }
}

}  // namespace kte::detail
