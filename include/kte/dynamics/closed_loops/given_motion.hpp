#pragma once

#include <kte/dynamics/closed_loops/closure_places.hpp>

#include <map>
#include <utility>

/// Closures on frames that move by functions of time. Velocities that keep such a loop closed depend on time, which the
/// projection of steps does not support.
namespace kte::detail {

/// What moves by time or measurements: a signal, a coordinate or a frame, with the element that writes it, or -1.
/// Inputs of the chain are constant between changes by the user, and move nothing.
template <class Closures>
std::map<std::pair<kind, int>, int> moved_by_signals(const Closures& c) {
  std::map<std::pair<kind, int>, int> moved;
  const int n = c.element_count();
  for (int e = 0; e < n; ++e)
    for (std::size_t p = 0; p < c.ports(e).size(); ++p)
      if (const kind k = c.ports(e)[p].what; is_signal(k) && c.is_time(k, c.index(e, p)))
        moved[{k, c.index(e, p)}] = -1;
  for (std::size_t known = ~std::size_t{0}; known != moved.size();) {
    known = moved.size();
    for (int e = 0; e < n; ++e) {
      const auto ports = c.ports(e);
      const port& last = ports.back();
      if (last.how != access::out || c.is_transmission(e)) continue;
      bool moves = false;
      for (std::size_t p = 0; p + 1 < ports.size(); ++p)
        moves |= (is_signal(last.what) && !is_signal(ports[p].what)) || moved.count({ports[p].what, c.index(e, p)}) > 0;
      if (moves) moved.emplace(std::pair{last.what, c.written(e)}, e);
    }
  }
  return moved;
}
/// Raises `bad_argument` if a closure is on a frame that moves in this way relative to its other frame.
template <class Closures, class State>
void refuse_given_motion(const Closures& c, const State& s, const closure_places& places) {
  const auto& t = s.tree();
  const auto& f = t.body_tree;
  const auto moved = moved_by_signals(c);
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
                            c.describe(e) +
                            " moves in time: models with closures do not support this; let it be moved by a joint "
                            "and forces on it");
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

}  // namespace kte::detail
