#pragma once

#include <kte/dynamics/state_vectors.hpp>
#include <kte/math/sincos.hpp>
#include <kte/tree/chain_tree.hpp>
#include <kte/tree/loop_memory.hpp>

/// Sets body nodes and bases from the coordinates of a state. State and `Elements`: as in
/// dynamics/looped/inverse_dynamics.hpp.
namespace kte::detail {

/// Calls visit(coordinate of a body node).
template <class State, class P, class Visit>
KTE_INLINE void with_coordinate(State& s, const tree::body_node<P>& r, const Visit& visit) {
  with_coordinate(s, r.what, r.slot, visit);
}
/// Calls visit(coordinate, its axis) for a joint whose coordinates are numbers.
template <class State, class P, class Visit>
void each_number(State& s, const tree::body_node<P>& r, const Visit& visit) {
  const auto& slots = s.tree().body_tree.coordinate;
  for (auto k = static_cast<std::size_t>(r.first); k < static_cast<std::size_t>(r.first + r.axes); ++k)
    visit(s.template get<kind::gen>(slots[k]), k);
}
/// Calls number(x, k) for each number x that belongs to axis k of a body node.
template <vector_of Which, class State, class P, class Number>
KTE_INLINE void each_axis(State& s, const tree::body_node<P>& r, const Number& number) {
  if (r.moves == tree::joint::varying) [[unlikely]]
    return each_number(s, r, [&](auto& c, std::size_t k) { visit_numbers<Which>(c, [&](auto& x) { number(x, k); }); });
  with_coordinate(s, r, [&](auto& c) {
    auto k = static_cast<std::size_t>(r.first);
    visit_numbers<Which>(c, [&](auto& x) { number(x, k++); });
  });
}

template <class Elements, class State>
[[gnu::noinline]] void move_followers(const Elements& c, State& s) {
  for (const int e : s.tree().followers) {
    c.move(e, s);
    if (c.ports(e).back().what == kind::gen) update_angle(s.template get<kind::gen>(c.written(e)));
  }
  for (const auto& [k, slot] : s.tree().turned) with_coordinate(s, k, slot, [](auto& x) { update_angle(x); });
}
/// Computes the quantities that must be known before bodies are placed, and the sines and matrices that elements other
/// than joints read. Few chains have any.
template <class Elements, class State>
KTE_INLINE void bring_up_to_date(const Elements& c, State& s) {
  if (!s.tree().followers.empty() || !s.tree().turned.empty()) [[unlikely]]
    move_followers(c, s);
}

/// Places a joint of several axes at its coordinate.
template <class State, class P, class S>
void place_several(State& s, const tree::body_node<P>& r, tree::joint_transform<S>& at) {
  with_coordinate(s, r, [&](auto& c) {
    if constexpr (!requires { c.q; }) {
      if constexpr (!State::has_sines) update_angle(c);
      at.position = tree::slid(r, as<S>(spatial(c).position));
      at.more.front().rotation = as<S>(matrix(spatial(c).rotation));
    }
  });
}
/// The sine and cosine of the angle of a body node, without a precomputed table.
template <class State, class P>
auto turn_of(State& s, const tree::body_node<P>& r) {
  using S = typename State::scalar;
  using std::cos;
  using std::sin;
  const auto& c = s.template get<kind::gen>(r.slot);
  if (all(r.turns == P(1)) && s.has_sine(r.slot)) return tree::turn<S>{c.cos, c.sin};
  const S angle = r.turns * c.q;
  return tree::turn<S>{cos(angle), sin(angle)};
}
/// Places joints that rotate about z, given by the numbers of their body nodes, at their coordinates.
template <class State>
void place_turning(State& s, std::span<const int> joints) {
  using S = typename State::scalar;
  const auto& nodes = s.tree().body_tree.nodes;
  const auto node_of = [&](std::size_t i) -> auto& { return nodes[static_cast<std::size_t>(joints[i])]; };
  const auto place = [&](std::size_t i, const tree::turn<S>& turn) KTE_INLINE_LAMBDA {
    const auto& r = node_of(i);
    auto& at = s.work.joint_transforms[static_cast<std::size_t>(joints[i])];
    if (r.moves == tree::joint::revolute) [[likely]]
      at.angle = r.after * turn;
    else
      tree::place_on_z(r, s.template get<kind::gen>(r.slot).q, turn, at);
  };
  if constexpr (State::has_sines)
    for (std::size_t i = 0; i < joints.size(); ++i) place(i, turn_of(s, node_of(i)));
  else
    sincos_each<S>(
        joints.size(),
        [&](std::size_t i) {
          const auto& r = node_of(i);
          return S(r.turns * s.template get<kind::gen>(r.slot).q);
        },
        [&](std::size_t i, const S& sine, const S& cosine) {
          place(i, tree::turn<S>{cosine, sine});
        });
}
/// Places a joint with varying axes at its coordinates; on request with second derivatives of axes.
template <class Elements, class State, class P, class S>
[[gnu::noinline]] void place_varying(const Elements& c, State& s, const tree::body_node<P>& r,
                                     tree::joint_transform<S>& at, bool second = false) {
  std::array<S, 6> q{};
  each_number(s, r, [&](const auto& x, std::size_t k) { q[k - static_cast<std::size_t>(r.first)] = x.q; });
  auto& [rotation, axes] = at.more.front();
  axes.resize((std::max)(axes.size(), count_of_axes(r.axes, second)));
  const tree::dense_pose<S> x = c.place_joint(r.element, q.data(), axes.data(), second);
  at.position = tree::slid(r, x.position), rotation = x.rotation;
}
/// Places a joint that does not rotate, or rotates about several axes.
template <class Elements, class State, class P, class S>
void place_other(const Elements& c, State& s, const tree::body_node<P>& r, tree::joint_transform<S>& at) {
  if (r.moves == tree::joint::several)
    place_several(s, r, at);
  else if (r.moves == tree::joint::varying)
    place_varying(c, s, r, at);
  else
    tree::place_on_z(r, s.template get<kind::gen>(r.slot).q, tree::turn<S>{}, at);
}
template <class P>
bool is_turning(const tree::body_node<P>& r) {
  return r.moves == tree::joint::revolute || r.moves == tree::joint::screw;
}
/// Bodies to where the coordinates of the state are; of coordinates that are up to date.
template <class Elements, class State>
void place_bodies_by_coordinates(const Elements& c, State& s) {
  const auto& nodes = s.tree().body_tree.nodes;
  place_turning(s, s.tree().angles);
  if (s.tree().angles.size() == nodes.size()) return;
  for (std::size_t n = 0; n < nodes.size(); ++n)
    if (!is_turning(nodes[n])) place_other(c, s, nodes[n], s.work.joint_transforms[n]);
}
/// Places all bodies at the coordinates of the state.
template <class Elements, class State>
void place_bodies(const Elements& c, State& s) {
  bring_up_to_date(c, s);
  place_bodies_by_coordinates(c, s);
}

/// Places the body of a slot and all bodies before it. Returns this path to the base. Followers: all.
template <class Elements, class State>
std::span<const int> place_ancestors(const Elements& c, State& s, int slot) {
  bring_up_to_date(c, s);
  auto& w = s.work;
  const auto& f = s.tree().body_tree;
  std::size_t length = 0, count = 0;
  while (slot >= f.bases) {
    const int n = slot - f.bases;
    const auto& r = f.nodes[static_cast<std::size_t>(n)];
    w.way[length++] = n;
    if (is_turning(r)) [[likely]]
      w.turning[count++] = n;
    else
      place_other(c, s, r, w.joint_transforms[static_cast<std::size_t>(n)]);
    slot = r.parent;
  }
  place_turning(s, {w.turning.data(), count});
  return {w.way.data(), length};
}

template <class State>
void take_rates(State& s) {
  for (const auto& r : s.tree().body_tree.nodes) {
    const auto k = static_cast<std::size_t>(r.first);
    if (r.is_number()) [[likely]] {
      const auto& c = s.template get<kind::gen>(r.slot);
      s.work.rate[k] = c.q_dot, s.work.acceleration[k] = c.q_ddot;
    } else {
      each_axis<vector_of::v>(s, r, [&s](auto& x, std::size_t i) { s.work.rate[i] = x; });
      each_axis<vector_of::a>(s, r, [&s](auto& x, std::size_t i) { s.work.acceleration[i] = x; });
    }
  }
}

/// Calls visit(motion of a base in the form of kernels, its slot).
template <class State, class Visit>
void for_each_base(State& s, const Visit& visit) {
  const auto& t = s.tree();
  for (std::size_t i = 0; i < t.plan.bases.size(); ++i) {
    const auto [k, index] = t.plan.bases[i];
    const auto slot = static_cast<std::size_t>(t.slot_of_base[i]);
    with_frame(s, k, index, [&](const auto& x) { visit(spatial(x), slot); });
  }
}
/// The axes of the base at a slot.
template <class State>
auto axes_of_base(State& s, int base) {
  using S = typename State::scalar;
  mat3<vec3<S>> axes{};
  for_each_base(s, [&](const auto& m, std::size_t slot) {
    if (static_cast<int>(slot) == base) axes = as<S>(matrix(m.rotation));
  });
  return axes;
}
template <class State>
void take_bases(State& s) {
  using S = typename State::scalar;
  for_each_base(s, [&s](const auto& m, std::size_t slot) {
    auto& b = s.work.bodies[slot];
    b.velocity = as<S>(m.velocity), b.ang_velocity = as<S>(m.ang_velocity);
    b.acceleration = as<S>(m.acceleration), b.ang_acceleration = as<S>(m.ang_acceleration);
  });
}
template <class State>
void place_bases_in_world(State& s) {
  using S = typename State::scalar;
  for_each_base(s, [&s](const auto& m, std::size_t slot) {
    auto& b = s.work.world[slot];
    b.rotation = as<S>(matrix(m.rotation)), b.position = as<S>(m.position), b.step = {};
  });
}
/// Places all bodies in the world. `Hand`: without skipped parts.
template <class Hand, class State>
void place_bodies_in_world(State& s) {
  place_bases_in_world(s);
  tree::place_bodies_in_world<Hand>(s.tree().body_tree, s.work);
}
/// Places all bodies and the axes of joints in the world.
template <class State>
void place_in_world(State& s) {
  using place = tree::world_place<typename State::scalar>;
  place_bases_in_world(s);
  tree::place_bodies_in_world<place>(s.tree().body_tree, s.work, s.work.axes.data());
}

}  // namespace kte::detail
