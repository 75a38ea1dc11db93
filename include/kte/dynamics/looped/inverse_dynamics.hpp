#pragma once

#include <kte/dynamics/looped/places.hpp>
#include <kte/dynamics/looped/touched_frames.hpp>
#include <kte/tree/composite.hpp>
#include <kte/tree/newton_euler.hpp>

/// Connects the state of a chain to the loops over body nodes: the forces of elements, and inverse dynamics. State:
/// like `runtime_state`, for runtime chains and for static chains that are not unrolled. `Elements` has for element e
///   move(e, s), push(e, s)          its doMotion and doForce
///   ports(e), index(e, p)           its ports and their items; written(e): the item at its last port
///   derive(e, s)                    derivatives of its forces (contract/force_derivatives.hpp)
///   mass_loads(e, s)                loads of a mass between several ports, due to accelerations only
///   holds(e, s)                     whether it holds its coordinate
///   place_joint(e, q, axes, second) the pose and axes of a joint with varying axes (contract/varying_joint.hpp)
///   friction(e, s, wrench)          the friction of a joint that carries a wrench at its end
///   diagnose_mass(s, row, finite)   throws: the mass of coordinate `row` is unusable
///   diagnose_friction(s, row)       throws: the friction of coordinate `row` jams
namespace kte::detail {

/// Sets the forces on coordinates to zero.
template <class State>
void clear_coordinates(State& s) {
  for (std::size_t i = 0; i < s.tree().plan.row_of_gen.size(); ++i)
    s.template get<kind::gen>(static_cast<int>(i)).f = typename State::scalar(0);
  for_each_listed_freedom(s, [](auto& c, const freedom&) {
    if constexpr (requires { clear_load(c); }) clear_load(c);
  });
}

/// The elements that act: all; all, with the load-dependent friction stored in the working memory; bodies.
enum class acting { all, with_given_friction, bodies };

/// Applies the elements that act on coordinates, and followers, which transmit the forces on them; from the last to the
/// first.
template <class Elements, class State>
void push_on_coordinates(const Elements& c, State& s, acting who) {
  const auto& t = s.tree();
  auto f = t.followers.rbegin();
  const auto pass_on = [&](int until) {
    for (; f != t.followers.rend() && *f > until; ++f) c.push(*f, s);
  };
  if (who != acting::bodies)
    for (auto e = t.on_coordinates.rbegin(); e != t.on_coordinates.rend(); ++e) {
      pass_on(*e);
      c.push(*e, s);
    }
  pass_on(-1);
}

/// Calls friction(element, row of its coordinate, force on it) for joints with load-dependent friction. Call
/// `transmit_wrenches` first.
template <class Elements, class State, class F>
void for_each_friction(const Elements& c, State& s, const F& f) {
  using S = typename State::scalar;
  const auto& body_tree = s.tree().body_tree;
  for (const int e : s.tree().readers) {
    const auto& place = body_tree.frame(c.ports(e).back().what, c.written(e));
    const auto& body_wrench = s.work.wrenches[static_cast<std::size_t>(place.slot)];
    const auto carried = transmit(inverse(place.at), tree::dense_wrench<S>{-body_wrench.force, -body_wrench.torque});
    const auto& r = body_tree.nodes[static_cast<std::size_t>(place.slot - body_tree.bases)];
    f(r, c.friction(e, s, tree::dense_wrench<S>{as<S>(carried.force), as<S>(carried.torque)}));
  }
}

/// Writes the generalized forces to the state, for chains with bodies only, after `transmit_wrenches`.
template <class State>
void put_forces_of_bodies(State& s) {
  const auto& t = s.tree();
  auto& w = s.work;
  if (t.has_own_mass)
    for (std::size_t k = 0; k < w.force.size(); ++k) w.force[k] += w.own_mass[k] * w.acceleration[k];
  for (const auto& r : t.body_tree.nodes) {
    const auto k = static_cast<std::size_t>(r.first);
    if (r.is_number()) [[likely]]
      s.template get<kind::gen>(r.slot).f = -w.force[k];
    else
      each_axis<vector_of::f>(s, r, [&w](auto& f, std::size_t i) { f = -w.force[i]; });
  }
}
/// Inverse dynamics at the rates of the state, for zero accelerations of coordinates.
template <class Elements, class State>
void bias_forces_of_bodies(const Elements& c, State& s) {
  auto& w = s.work;
  place_bodies(c, s), take_rates(s), take_bases(s);
  std::fill(w.acceleration.begin(), w.acceleration.end(), typename State::scalar(0));
  tree::move_bodies<false>(s.tree().body_tree, w);
  tree::transmit_wrenches(s.tree().body_tree, w, engine::no_load{});
  put_forces_of_bodies(s);
}

/// Inverse dynamics (RNEA): writes the generalized forces on the coordinates to the state, at its rates and
/// accelerations, for bases that are accelerated or not. `moved`: forward dynamics was just called for this state, so
/// that bodies of chains with bodies only have their places and motions.
template <class Elements, class State>
void forces_on_coordinates(const Elements& c, State& s, acting who, bool accelerated_bases = true, bool moved = false) {
  using S = typename State::scalar;
  const auto& t = s.tree();
  auto& w = s.work;
  moved &= t.only_bodies;
  if (!moved) place_bodies(c, s), take_rates(s), take_bases(s);
  if (!accelerated_bases)
    for (std::size_t b = 0; b < static_cast<std::size_t>(t.body_tree.bases); ++b)
      w.bodies[b].acceleration = w.bodies[b].ang_acceleration = vec3<S>{};
  if (t.only_bodies) {
    if (!moved) tree::move_bodies<false>(t.body_tree, w);
    tree::transmit_wrenches(t.body_tree, w, engine::no_load{});
    return put_forces_of_bodies(s);
  }
  clear_coordinates(s);
  for (const auto& [coordinate, mass] : t.rotors) {
    auto& x = s.template get<kind::gen>(coordinate);
    x.f -= mass * x.q_ddot;
  }
  const auto& others = who != acting::bodies ? t.on_frames : t.weights;
  if (others.empty() && (who == acting::bodies || t.late.empty())) {
    tree::move_bodies<false>(t.body_tree, w);
    tree::transmit_wrenches(t.body_tree, w, engine::no_load{});
  } else {
    tree::move_bodies<true>(t.body_tree, w);
    place_in_world(s);
    place_touched_frames(s, true);
    if (who != acting::bodies) move_late(c, s);
    for (auto e = others.rbegin(); e != others.rend(); ++e) c.push(*e, s);
    take_frame_loads(s);
    tree::transmit_wrenches(t.body_tree, w, tree::load_of_slot<S>{w.loads.data()});
  }
  for (const auto& r : t.body_tree.nodes)
    each_axis<vector_of::f>(s, r, [&w](auto& f, std::size_t k) { f -= w.force[k]; });
  if (who != acting::bodies) {
    auto given = w.friction.begin();
    for_each_friction(c, s, [&](const auto& r, const S& friction) {
      s.template get<kind::gen>(r.slot).f += who == acting::all ? friction : *given++;
    });
  }
  push_on_coordinates(c, s, who);
}

/// Writes the forces of axes to `forces` of the working memory, in trees of degrees of freedom.
template <class State>
void take_forces_of_axes(State& s) {
  const auto& row = s.tree().body_tree.row;
  for (std::size_t k = 0; k < row.size(); ++k) s.work.forces[row[k]] = s.work.force[k];
}
/// Writes the forces to apply for this motion to `forces`, after `forces_on_coordinates`.
template <class State>
void take_generalized_forces(State& s) {
  if (s.tree().only_bodies) {
    take_forces_of_axes(s);
  } else {
    auto& f = s.work.forces;
    read_listed_numbers<vector_of::f>(s, f);
    f = -f;
  }
}

}  // namespace kte::detail
