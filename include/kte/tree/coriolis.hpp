#pragma once

#include <kte/recursions/coriolis.hpp>
#include <kte/tree/composite.hpp>

#include <vector>

/// The Coriolis matrix of body nodes.
namespace kte::tree {

/// Body nodes as joints in the world.
template <class P, class S>
struct nodes_in_world {
  const body_tree<P>& f;
  const memory<P, S>& m;
  const body_node<P>& at(int i) const { return f.nodes[static_cast<std::size_t>(i)]; }
  int count() const { return static_cast<int>(f.nodes.size()); }
  int parent(int i) const { return at(i).parent - f.bases; }  // bases come first
  int first(int i) const { return at(i).first; }
  int axes(int i) const { return at(i).axes; }
  bool slides(int i) const { return at(i).moves != joint::revolute; }
  const world_axis<S>& axis(int k) const { return m.axes[static_cast<std::size_t>(k)]; }
  const vec3<S>& step(int i) const { return m.world[static_cast<std::size_t>(f.bases + i)].step; }
};
/// `coriolis_terms` for body nodes. Call `place_in_world` first, with `rate` and the velocities of bases in `bodies`,
/// in the axes of the world.
template <class P, class S, class Put>
void coriolis_of_tree(const body_tree<P>& f, memory<P, S>& m, const Put& put) {
  std::vector<engine::coriolis_body<S>> all(f.nodes.size());
  std::vector<world_axis<S>> changes(f.axes());
  for (std::size_t i = 0; i < f.nodes.size(); ++i) {
    const body_node<P>& r = f.nodes[i];
    const std::size_t slot = static_cast<std::size_t>(f.bases) + i, first = static_cast<std::size_t>(r.first),
                      end = first + static_cast<std::size_t>(r.axes);
    const world_place<S>& place = m.world[slot];
    const body_motion<S>& on = m.bodies[static_cast<std::size_t>(r.parent)];
    vec3<S> v = on.velocity + cross(on.ang_velocity, place.step), w = on.ang_velocity;
    for (std::size_t k = first; k < end; ++k)
      v = v + m.rate[k] * m.axes[k].linear, w = w + m.rate[k] * m.axes[k].angular;
    m.bodies[slot].velocity = v, m.bodies[slot].ang_velocity = w;
    for (std::size_t k = first; k < end; ++k) {
      changes[k] = engine::change_of(m.axes[k], v, w);
      if (r.moves != joint::varying) [[likely]]
        continue;
      const world_axis<S> own = rate_of_axis(r, m.joint_transforms[i], static_cast<int>(k - first), &m.rate[first]);
      changes[k] = {changes[k].linear + place.rotation * own.linear, changes[k].angular + place.rotation * own.angular};
    }
    all[i] = engine::coriolis_of<S>({S(r.weight.mass), place.rotation * as<S>(r.weight.moment),
                                     as<S>(congruence(place.rotation, as<S>(r.weight.inertia)))},
                                    v, w);
  }
  engine::coriolis_terms(nodes_in_world<P, S>{f, m}, changes.data(), all.data(), put);
}

}  // namespace kte::tree
