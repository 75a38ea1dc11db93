#pragma once

#include <kte/dynamics/closed_loops/closure_places.hpp>

#include <map>
#include <utility>

/// Closures on frames that move by signals. Models support functions of time: the projection of steps takes positions
/// and rates of residuals at the time of a state. They do not support functions of measurements, because residuals then
/// depend on other quantities than positions and the time.
namespace kte::detail {

/// What moves by signals: a signal, a coordinate or a frame, with the element that writes it. begins(e, p): whether the
/// motion begins at port p of element e.
template <class Begins>
std::map<std::pair<kind, int>, int> moved_by(const chain_constraints& c, const Begins& begins) {
  std::map<std::pair<kind, int>, int> moved;
  const int n = c.element_count();
  for (std::size_t known = ~std::size_t{0}; known != moved.size();) {
    known = moved.size();
    for (int e = 0; e < n; ++e) {
      const auto ports = c.ports(e);
      const port& last = ports.back();
      if (last.how != access::out || c.is_transmission(e)) continue;
      bool moves = false;
      for (std::size_t p = 0; p + 1 < ports.size(); ++p)
        moves |= begins(e, p) || moved.count({ports[p].what, c.index(e, p)}) > 0;
      if (moves) moved.emplace(std::pair{last.what, c.written(e)}, e);
    }
  }
  return moved;
}
inline auto moved_by_measurements(const chain_constraints& c) {
  return moved_by(
      c, [&c](int e, std::size_t p) { return is_signal(c.ports(e).back().what) && !is_signal(c.ports(e)[p].what); });
}
/// By the time, or internal states, which move with it.
inline auto moved_by_time(const chain_constraints& c) {
  return moved_by(c, [&c](int e, std::size_t p) {
    const kind k = c.ports(e)[p].what;
    return k == kind::internal || (is_signal(k) && c.is_time(k, c.index(e, p)));
  });
}
/// How signals move coordinates and frames of a chain: not at all, by its inputs only, which are constant between
/// changes by the user, or by the time.
enum class given_motion { none, inputs, time };
given_motion given_motion_of(const chain_constraints& c);
/// Raises `bad_argument` if a closure is on a frame in `moved` that moves relative to its other frame.
void refuse_given_motion(const chain_constraints& c, const runtime_state& s, const closure_places& places,
                         const std::map<std::pair<kind, int>, int>& moved, const char* how);

#ifdef KTE_FUNCTION
KTE_FUNCTION given_motion given_motion_of(const chain_constraints& c) {
  const auto moves_something = [](const auto& moved) {
    return std::any_of(moved.begin(), moved.end(), [](const auto& x) { return !is_signal(x.first.first); });
  };
  if (moves_something(moved_by_time(c))) return given_motion::time;
  return moves_something(moved_by(c, [&c](int e, std::size_t p) { return is_signal(c.ports(e)[p].what); }))
             ? given_motion::inputs
             : given_motion::none;
}
KTE_FUNCTION void refuse_given_motion(const chain_constraints& c, const runtime_state& s, const closure_places& places,
                                      const std::map<std::pair<kind, int>, int>& moved, const char* how) {
  const auto& t = s.tree();
  const auto& f = t.body_tree;
  if (moved.empty()) return;
  std::vector<int> by_row(static_cast<std::size_t>(t.plan.coordinates), -1);
  for (std::size_t i = 0; i < t.plan.row_of_gen.size(); ++i)
    if (const auto x = moved.find({kind::gen, static_cast<int>(i)}); x != moved.end())
      by_row[static_cast<std::size_t>(t.plan.row_of_gen[i])] = x->second;
  const auto mover_of_base = [&](int slot) {
    for (std::size_t i = 0; i < t.plan.bases.size(); ++i)
      if (t.slot_of_base[i] == slot)
        if (const auto x = moved.find(t.plan.bases[i]); x != moved.end()) return x->second;
    return -1;
  };
  for (const auto& x : places.closures) {
    if (!x.of_frames()) continue;
    const auto check = [&](int e, const char* what) {
      if (e >= 0)
        raise<bad_argument>("kte: '" + c.loop_name(x.loop) + "' closes a loop with a " + what + " that " +
                            c.describe(e) + " moves " + how +
                            ": such models do not support this; let it be moved by a joint and forces on it");
    };
    const int a = f.frame(x.frame1.what, x.frame1.index).slot, b = f.frame(x.frame2.what, x.frame2.index).slot;
    const int common = tree::common_slot(f, a, b);
    for (int slot : {a, b}) {
      while (slot != common && slot >= f.bases) {
        const auto& node = f.nodes[static_cast<std::size_t>(slot - f.bases)];
        for (int k = node.first; k < node.first + node.axes; ++k)
          check(by_row[static_cast<std::size_t>(f.row[static_cast<std::size_t>(k)])], "joint");
        slot = node.parent;
      }
      if (slot != common) check(mover_of_base(slot), "base");
    }
  }
}
#endif

}  // namespace kte::detail
