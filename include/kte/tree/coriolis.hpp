#pragma once

#include <kte/recursions/coriolis.hpp>
#include <kte/tree/composite.hpp>

#include <vector>

/// The Coriolis matrix of body nodes.
namespace kte::tree {

/// Body nodes as joints in the world.
template <class P, class S>
class nodes_in_world {
 public:
  nodes_in_world(const body_tree<P>& f, const memory<P, S>& m)
      : nodes_(f.nodes.data()),
        places_(m.world.data() + f.bases),
        axes_(m.axes.data()),
        count_(static_cast<int>(f.nodes.size())),
        bases_(f.bases) {}
  KTE_INLINE int count() const { return count_; }
  KTE_INLINE int parent(int i) const { return nodes_[i].parent - bases_; }  // bases come first
  KTE_INLINE int first(int i) const { return nodes_[i].first; }
  KTE_INLINE int axes(int i) const { return nodes_[i].axes; }
  KTE_INLINE bool slides(int i) const { return nodes_[i].moves != joint::revolute; }
  KTE_INLINE const world_axis<S>& axis(int k) const { return axes_[k]; }
  KTE_INLINE const vec3<S>& step(int i) const { return places_[i].step; }

 private:
  const body_node<P>* nodes_;
  const world_place<S>* places_;
  const world_axis<S>* axes_;
  int count_, bases_;
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
  engine::coriolis_terms(nodes_in_world<P, S>(f, m), changes.data(), all.data(), put);
}

}  // namespace kte::tree
