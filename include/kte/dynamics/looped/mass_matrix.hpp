#pragma once

#include <kte/dynamics/looped/rare_shapes.hpp>
#include <kte/tree/fill_matrix.hpp>

/// Projection of dependent coordinates, and the mass matrix, as loops over body nodes, for all `Elements` and states of
/// dynamics/looped/inverse_dynamics.hpp.
namespace kte::detail {

/// The derivative of a dependent coordinate by a followed coordinate: its rate if the followed rate is one.
template <class Elements, class State, class Coordinate>
auto ratio_of(const Elements& c, State& s, int follower, Coordinate& followed) {
  using S = typename State::scalar;
  auto& end = s.template get<kind::gen>(c.written(follower));
  const Coordinate before = followed, end_before = end;
  const auto rate_at = [&](const S& rate) -> S {
    followed.q_dot = rate;
    c.move(follower, s);
    return end.q_dot;
  };
  const S at_rest = rate_at(S(0)), ratio = rate_at(S(1)) - at_rest;
  followed = before, end = end_before;
  return ratio;
}
/// Calls visit(follower, port, row of the followed coordinate, row of the dependent coordinate), from the last follower
/// on. If two ports have one coordinate, only for the first, because rates include both.
template <class Elements, class State, class Visit>
void for_each_followed(const Elements& c, const State& s, const Visit& visit) {
  const auto& t = s.tree();
  for (auto f = t.followers.rbegin(); f != t.followers.rend(); ++f) {
    const auto ports = c.ports(*f);
    if (ports.back().what != kind::gen) continue;
    const auto row = [&t](int coordinate) { return t.plan.row_of_gen[static_cast<std::size_t>(coordinate)]; };
    for (std::size_t p = 0; p + 1 < ports.size(); ++p) {
      bool first = ports[p].what == kind::gen;
      for (std::size_t before = 0; before < p; ++before)
        first &= ports[before].what != kind::gen || c.index(*f, before) != c.index(*f, p);
      if (first) visit(*f, p, row(c.index(*f, p)), row(c.written(*f)));
    }
  }
}
/// Adds rows and columns of dependent coordinates to those of the followed ones, from the last on: x_b += ratio x_e.
template <class Elements, class State, class Add>
void pull_back_followers(const Elements& c, State& s, const Add& add) {
  for_each_followed(c, s, [&](int follower, std::size_t port, int to, int from) {
    add(to, from, ratio_of(c, s, follower, s.template get<kind::gen>(c.index(follower, port))));
  });
}

/// The mass matrix (CRBA), in the working memory.
template <class Elements, class State>
void mass_of_coordinates(const Elements& c, State& s) {
  using S = typename State::scalar;
  const auto& t = s.tree();
  auto& w = s.work;
  auto& m = w.mass;
  place_bodies(c, s);
  tree::carry_bodies<false>(t.body_tree, w);
  auto& j = w.followed.j;
  const bool follow = t.plan.coordinates > s.dofs() && [&] {
    j.clear();
    pull_back_followers(c, s, [&j](int to, int from, const S& ratio) { j.add(to, from, ratio); });
    return !j.empty();
  }();
  if (!follow) [[likely]] {
    constexpr std::size_t few_axes = 32;
    if (t.body_tree.axes() > few_axes) {
      place_in_world(s);
      tree::masses_in_world(t.body_tree, w, w.masses.wrenches, w.masses.rows);
    } else {
      tree::masses(t.body_tree, w, w.masses.wrenches, w.masses.rows);
    }
    tree::fill_symmetric(t.body_tree, s.dofs(), w.masses.rows, false, m);
    if (t.has_own_mass)
      for (int i = 0; i < s.dofs(); ++i) m(i, i) += t.own_mass[static_cast<std::size_t>(i)];
  } else {
    j.finish(s.dofs(), t.plan.coordinates);
    tree::followed_masses(t.body_tree, w, s.dofs(), w.followed, w.masses, m);
    for (int i = 0; t.has_own_mass && i < t.plan.coordinates; ++i) {
      const S mass(t.own_mass[static_cast<std::size_t>(i)]);
      for (const auto& [a, ratio] : j.of(i))
        for (const auto& [b, factor] : j.of(i)) m(a, b) += ratio * factor * mass;
    }
  }
  if (!t.distributed.empty()) add_distributed_masses(c, s, m);
}

}  // namespace kte::detail
