#pragma once

#include <kte/dynamics/looped/forces_by_rates.hpp>
#include <kte/dynamics/looped/mass_matrix.hpp>
#include <kte/tree/articulated_clusters.hpp>

/// Forward dynamics where coordinates follow others, by articulated bodies with clusters. `Elements` and states as in
/// dynamics/looped/inverse_dynamics.hpp.
namespace kte::detail {

/// The coordinates that an element follows, by the first port of each.
template <class Elements>
void followed_ports(const Elements& c, int follower, std::vector<std::size_t>& followed) {
  const auto ports = c.ports(follower);
  followed.clear();
  for (std::size_t p = 0; p + 1 < ports.size(); ++p) {
    bool first = ports[p].what == kind::gen;
    for (const std::size_t before : followed) first &= c.index(follower, before) != c.index(follower, p);
    if (first) followed.push_back(p);
  }
}
/// Moves a follower, and says put(port, rate of what it writes by that coordinate). A coordinate that follows a
/// single other one is known from its motion at a rate of one,
///
///   y' = f_1 q',   y'' = f_1 q'' + f_2 q'^2          (1)
template <class Elements, class State, class Put>
void move_and_derive(const Elements& c, State& s, int follower, const std::vector<std::size_t>& followed,
                     const Put& put) {
  using S = typename State::scalar;
  const auto ports = c.ports(follower);
  auto& end = s.template get<kind::gen>(c.written(follower));
  bool only_coordinates = true;
  for (std::size_t p = 0; p + 1 < ports.size(); ++p)
    only_coordinates &= !is_signal(ports[p].what) || ports[p].what == kind::internal;
  if (followed.size() == 1 && only_coordinates) {
    auto& q = s.template get<kind::gen>(c.index(follower, followed[0]));
    const S v = q.q_dot, a = q.q_ddot;
    q.q_dot = S(1), q.q_ddot = S(0);
    c.move(follower, s);
    q.q_dot = v, q.q_ddot = a;
    const S ratio = end.q_dot, curvature = end.q_ddot;
    end.q_dot = ratio * v, end.q_ddot = ratio * a + curvature * (v * v);
    put(followed[0], ratio);
  } else {
    c.move(follower, s);
    for (const std::size_t p : followed)
      put(p, ratio_of(c, s, follower, s.template get<kind::gen>(c.index(follower, p))));
  }
}
/// Moves all followers, and finds how coordinates follow degrees of freedom.
template <class Elements, class State>
void move_and_derive_followers(const Elements& c, State& s) {
  using S = typename State::scalar;
  const auto& t = s.tree();
  auto& x = s.work.clusters;
  const auto row = [&t](int coordinate) { return t.plan.row_of_gen[static_cast<std::size_t>(coordinate)]; };
  auto& steps = x.steps;
  steps.clear();
  for (const int e : t.followers) {
    if (c.ports(e).back().what != kind::gen) {
      c.move(e, s);
      continue;
    }
    followed_ports(c, e, x.followed);
    move_and_derive(c, s, e, x.followed, [&](std::size_t port, const S& ratio) {
      steps.push_back({row(c.index(e, port)), row(c.written(e)), ratio});
    });
    if constexpr (State::has_sines) update_angle(s.template get<kind::gen>(c.written(e)));
  }
  for (const auto& [k, slot] : t.turned) with_coordinate(s, k, slot, [](auto& y) { update_angle(y); });
  x.j.clear();
  for (auto step = steps.rbegin(); step != steps.rend(); ++step) x.j.add(step->to, step->from, step->ratio);
  x.j.finish(s.dofs(), t.plan.coordinates);
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
    const S f = s.template get<kind::gen>(static_cast<int>(i)).f;
    for (const auto& [dof, ratio] : w.clusters.j.of(row)) w.forces[dof] += ratio * f;
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
template <class Elements, class State, class Tau>
void accelerate_clustered(const Elements& c, State& s, const Tau& tau) {
  using S = typename State::scalar;
  const auto& t = s.tree();
  auto& w = s.work;
  for_each_listed_freedom(s, [](auto& x, const freedom&) { visit_a(x, [](S& a) { a = S(0); }); });
  move_and_derive_followers(c, s);
  place_bodies_by_coordinates(c, s);
  take_rates(s), take_bases(s);
  const auto biases = tree::bias_motions_of_clusters(t.body_tree, w, t.clusters);
  forces_by_rates(c, s);
  for (int i = 0; i < s.dofs(); ++i) w.forces[i] += tau(i);
  for (std::size_t k = 0; k < t.body_tree.row.size(); ++k)
    w.force[k] = t.body_tree.row[k] < s.dofs() ? w.forces[t.body_tree.row[k]] : S(0);
  tree::open_clusters(t.body_tree, t.clusters, w.clusters, t.own_mass, [&w](int row) { return w.forces[row]; });
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
      if (!(t.own_mass[static_cast<std::size_t>(row)] > 0)) [[unlikely]]
        c.diagnose_mass(s, row, true);
      w.forces[row] /= t.own_mass[static_cast<std::size_t>(row)];
    }
}

}  // namespace kte::detail
