#pragma once

#include <kte/dynamics/looped/places.hpp>
#include <kte/recursions/world_placement.hpp>

#include <algorithm>
#include <utility>

/// Frames that elements act on: their motion from that of bodies, and loads back. State and `Elements`: as in
/// dynamics/looped/inverse_dynamics.hpp.
namespace kte::detail {

template <class State>
void clear_frame(State& s, kind k, int index) {
  with_frame(s, k, index, [](auto& x) { clear_load(x); });
}
/// Sets the motion of a frame from that of its body.
template <class State>
void place_frame(State& s, kind k, int index, bool accelerated) {
  using S = typename State::scalar;
  const auto& t = s.tree();
  const auto& at = t.body_tree.frame(k, index);
  const auto& b = s.work.bodies[static_cast<std::size_t>(at.slot)];
  const auto& place = s.work.world[static_cast<std::size_t>(at.slot)];
  if (at.slot < t.body_tree.bases) {  // the state has its motion, unless links fix it to the base
    if (std::find(t.plan.bases.begin(), t.plan.bases.end(), std::pair{k, index}) != t.plan.bases.end()) {
      clear_frame(s, k, index);
      return;
    }
  }
  tree::body_motion<S> moves = b;
  if (!accelerated) moves.acceleration = moves.ang_acceleration = {};
  const auto m = motion_of_frame(place, moves, at.at);
  with_frame(s, k, index, [&m](auto& x) {
    if constexpr (requires { x.rotation.x; }) {
      set_motion(x, m);
    } else {
      const auto flat = [](const vec3<S>& u) { return vec3{u.x, u.y, zero}; };
      const auto normal = [](const vec3<S>& u) { return vec3{zero, zero, u.z}; };
      set_motion(x, motion{flat(m.position), rotation_2D{m.rotation.x.x, m.rotation.y.x}, flat(m.velocity),
                           normal(m.ang_velocity), flat(m.acceleration), normal(m.ang_acceleration)});
    }
    clear_load(x);
  });
}
/// Sets the motion of all frames that elements act on.
template <class State>
void place_touched_frames(State& s, bool accelerated) {
  for (const auto& [k, index] : s.tree().touched) place_frame(s, k, index, accelerated);
}
/// Frames and signals that elements write after bodies are placed.
template <class Elements, class State>
void move_late(const Elements& c, State& s) {
  for (const int e : s.tree().late) c.move(e, s);
  for (const auto& [k, index] : s.tree().written) clear_frame(s, k, index);
}
/// Adds the loads of elements on frames to `loads` of their bodies.
template <class State>
void take_frame_loads(State& s) {
  using S = typename State::scalar;
  const auto& t = s.tree();
  auto& loads = s.work.loads;
  std::fill(loads.begin(), loads.end(), tree::dense_wrench<S>{});
  for (const auto& [k, index] : t.touched) {
    const auto& at = t.body_tree.frame(k, index);
    if (at.slot < t.body_tree.bases) continue;
    tree::dense_wrench<S> w;
    with_frame(s, k, index, [&w](const auto& x) {
      const auto load = load_of(x);
      w = {as<S>(load.force), as<S>(load.torque)};
    });
    const auto seen = transmit(at.at, w);
    auto& load = loads[static_cast<std::size_t>(at.slot)];
    load = {load.force + as<S>(seen.force), load.torque + as<S>(seen.torque)};
  }
}

}  // namespace kte::detail
