#pragma once

#include <kte/dynamics/runtime/elements.hpp>
#include <kte/tree/momentum.hpp>

/// Loops over the bodies of runtime chains, in the working memory of a state.
namespace kte {

namespace detail {

/// Throws `bad_argument` for distributed masses.
template <class S>
void refuse_distributed_masses(const runtime_chain& c, const basic_runtime_state<S>& s) {
  if (!s.tree().distributed.empty()) [[unlikely]]
    throw bad_argument("kte: this algorithm counts the masses of single frames and coordinates, and " +
                       describe_element(runtime_elements{c}.element(s.tree().distributed.front())) +
                       " has a mass between several");
}

/// Composite inertias of subtrees, and the places of bodies in the world. `Place`, `Inertia`: without skipped parts.
template <class S, class Place = tree::world_place<S>, class Inertia = tree::dense_composite<S>>
void carry_bodies(const runtime_chain& c, basic_runtime_state<S>& s) {
  place_bodies(runtime_elements{c}, s);
  place_bodies_in_world<Place>(s);
  tree::carry_bodies<true, Inertia>(s.tree().body_tree, s.work);
}
/// The mass and the first moment of all bodies, in the world; of bodies that have their places.
template <class S>
tree::mass_moment<S> weigh_in_place(basic_runtime_state<S>& s) {
  place_bases_in_world(s);
  tree::carry_bodies<true, composite<S, vec3<S>, skip>>(s.tree().body_tree, s.work);
  return tree::weight_in_world(s.tree().body_tree, s.work);
}
/// The mass and the first moment of all bodies, in the world.
template <class S>
tree::mass_moment<S> weigh(const runtime_chain& c, basic_runtime_state<S>& s) {
  place_bodies(runtime_elements{c}, s);
  return weigh_in_place(s);
}
/// The motion of a chain with bodies only.
template <class S>
void carry(const runtime_chain& c, basic_runtime_state<S>& s) {
  refuse_distributed_masses(c, s);
  carry_bodies(c, s);
}
/// Calls visit(row, momentum) for each axis: its row among all coordinates, and the momentum of its unit rate about a
/// point of the world.
template <class S, class F>
void for_each_momentum(basic_runtime_state<S>& s, const vec3<S>& about, const F& visit) {
  const auto& f = s.tree().body_tree;
  tree::momenta(f, s.work, about,
                [row = f.row.data(), visit](int k, const auto& h) KTE_INLINE_LAMBDA { visit(row[k], h); });
}
/// Sets the rates of prescribed coordinates to zero.
template <class S>
void rest_given_coordinates(basic_runtime_state<S>& s) {
  for (const auto& r : s.tree().body_tree.nodes)
    if (r.is_number() && !r.is_free && s.made_for()->writers[0][static_cast<std::size_t>(r.slot)] < 0)
      s.work.rate[static_cast<std::size_t>(r.first)] = s.work.acceleration[static_cast<std::size_t>(r.first)] = S(0);
}
/// Calls visit(motion, slot) for bases that elements move by signals. Other bases are set to rest.
template <class S, class Visit>
void for_each_moved_base(basic_runtime_state<S>& s, const Visit& visit) {
  const auto& t = s.tree();
  for (std::size_t i = 0; i < t.plan.bases.size(); ++i) {
    const auto [k, index] = t.plan.bases[i];
    if (s.made_for()->writers[static_cast<std::size_t>(k)][static_cast<std::size_t>(index)] < 0) continue;
    const auto slot = static_cast<std::size_t>(t.slot_of_base[i]);
    with_frame(s, k, index, [&](const auto& x) { visit(spatial(x), slot); });
  }
}
/// Momentum about a point of the world; call `carry` first. Prescribed coordinates are at rest.
template <class S>
tree::dense_wrench<S> momentum_of_coordinates(basic_runtime_state<S>& s, const vec3<S>& about) {
  take_rates(s), rest_given_coordinates(s);
  tree::dense_wrench<S> sum = tree::momentum(s.tree().body_tree, s.work, about);
  for_each_moved_base(s, [&](const auto& x, std::size_t slot) {
    const tree::dense_composite<S>& all = s.work.carried[slot];
    const tree::world_place<S>& at = s.work.world[slot];
    const vec3<S> v = as<S>(x.velocity), w = as<S>(x.ang_velocity);
    const vec3<S> p = at.rotation * (all.mass * v + cross(w, all.moment));
    const vec3<S> spin = at.rotation * (all.inertia * w + cross(all.moment, v));
    sum = {sum.force + p, sum.torque + spin + cross(at.position - about, p)};
  });
  return sum;
}
}  // namespace detail

}  // namespace kte
