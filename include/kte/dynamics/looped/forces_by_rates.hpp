#pragma once

#include <kte/dynamics/looped/inverse_dynamics.hpp>

/// What elements do at given rates, in articulated-body algorithms. `Elements` and states as in
/// dynamics/looped/inverse_dynamics.hpp.
namespace kte::detail {

/// The forces that elements put on coordinates and frames for the rates alone: onto coordinates, and into `loads` of
/// bodies.
template <class Elements, class State>
void push_by_rates(const Elements& c, State& s) {
  using S = typename State::scalar;
  const auto& t = s.tree();
  auto& w = s.work;
  clear_coordinates(s);
  for (std::size_t i = 0; i < t.body_tree.nodes.size(); ++i)
    if (w.is_free[i]) each_axis<vector_of::a>(s, t.body_tree.nodes[i], [](S& x, std::size_t) { x = S(0); });
  for (const int row : t.plan.jointless_dofs)
    if (!w.prescribed[static_cast<std::size_t>(row)])
      for_each_listed_freedom(s, [row](auto& x, const freedom& at) {
        if (at.v == row) visit_a(x, [](S& a) { a = S(0); });
      });
  if (!t.on_frames.empty() || !t.late.empty()) {
    std::fill(w.acceleration.begin(), w.acceleration.end(), S(0));
    tree::move_bodies<true>(t.body_tree, w);
    place_in_world(s);
    place_touched_frames(s, false);
    move_late(c, s);
    for (auto e = t.on_frames.rbegin(); e != t.on_frames.rend(); ++e) c.push(*e, s);
    take_frame_loads(s);
  }
  for (auto e = t.on_coordinates.rbegin(); e != t.on_coordinates.rend(); ++e) c.push(*e, s);
}
/// Where an axis has nothing to move, or more than a number can say.
template <class Elements, class State>
[[noreturn, gnu::cold]] void diagnose_axis(const Elements& c, const State& s, int axis) {
  const auto& inverse = s.work.factors[static_cast<std::size_t>(axis)].inverse;
  c.diagnose_mass(s, s.tree().body_tree.row[static_cast<std::size_t>(axis)],
                  all(inverse == inverse) && !all(inverse == typename State::scalar(0)));
}
}  // namespace kte::detail
