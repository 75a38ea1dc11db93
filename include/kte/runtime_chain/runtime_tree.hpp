#pragma once

#include <kte/runtime_chain/kte_map.hpp>
#include <kte/runtime_chain/topology.hpp>
#include <kte/tree/chain_tree.hpp>
#include <kte/tree/loop_memory.hpp>

#include <algorithm>

/// The body nodes of a runtime chain, computed once for all copies of a state.
namespace kte::detail {

/// A runtime chain in the form that `arrange` reads.
struct runtime_connections {
  const topology& t;
  std::size_t elements() const { return t.elements.size(); }
  std::span<const port> ports(std::size_t e) const { return t.elements[e].ports; }
  int index(std::size_t e, std::size_t p) const { return t.elements[e].index[p]; }
  bool rigid(std::size_t e) const { return t.elements[e].rigid; }
  bool distributed_mass(std::size_t e) const { return t.elements[e].distributed_mass; }
  int count(kind k) const { return t.count(k); }
  int writer(kind k, int i) const { return t.writers[static_cast<std::size_t>(k)][static_cast<std::size_t>(i)]; }
  std::size_t freedoms() const { return t.free.size(); }
  freedom freedom_at(std::size_t f) const { return t.free[f]; }
  int dofs() const { return t.nv; }
};

template <class P>
using runtime_tree = chain_tree<P, runtime_plan>;
/// The tree of the chain in a lane.
template <class P>
runtime_tree<P> tree_of_lane(const topology& t, std::size_t lane) {
  const runtime_connections c{t};
  return {c, arrange<growing_list>(c), [&](const auto& each) {
            for (std::size_t e = 0; e < t.elements.size(); ++e) {
              if constexpr (std::is_same_v<P, double>)
                each(e, t.elements[e].element->lane(lane).numbers());
              else
                each(e, as_numbers<P>(t.elements[e].element->lane(lane).numbers()));
            }
          }};
}
/// With packs P the numbers of all lanes.
template <class P>
runtime_tree<P> tree_of(const topology& t) {
  if constexpr (is_pack<P>) {
    using T = typename P::value_type;
    const bool equal =
        std::all_of(t.elements.begin(), t.elements.end(), [](const auto& e) { return e.element->lanes() == 1; });
    std::vector<runtime_tree<T>> lanes;
    for (std::size_t i = 0; i < (equal ? 1 : std::size_t{P::lanes}); ++i) lanes.push_back(tree_of_lane<T>(t, i));
    return runtime_tree<P>(std::span<const runtime_tree<T>>(lanes));
  } else {
    return tree_of_lane<P>(t, 0);
  }
}
template <class S>
inline constexpr bool has_lanes_of_double = requires {
  requires std::is_same_v<typename S::value_type, double> &&(S::lanes > 0);
};
/// Throws `bad_argument` for an element that states in the scalar S do not support.
template <class S, class P>
void check_scalar(const topology& t, const runtime_tree<P>& tree) {
  if (std::is_same_v<S, double>) return;
  const auto refuse = [&t](int e, const char* why) {
    throw bad_argument(
        (is_pack<S> ? "kte: states of runtime chains in packs: "
                    : "kte: states of runtime chains in scalars other than double and packs support joints, links and "
                      "bodies only; ") +
        describe_element(*t.elements[static_cast<std::size_t>(e)].element) + why);
  };
  for (std::size_t e = 0; e < t.elements.size() && !has_lanes_of_double<S>; ++e)
    if (t.elements[e].closes) refuse(static_cast<int>(e), " closes a loop");
  if (tree.irregular) refuse(tree.irregular.element, tree.irregular.why);
  for (const int e : tree.locks)
    if (is_pack<S>) refuse(e, " may hold its coordinate, in some lanes and not in others");
  if (is_pack<S>) return;
  for (const int i : tree.body_tree.varying)
    refuse(tree.body_tree.nodes[static_cast<std::size_t>(i)].element, " has axes that depend on its coordinates");
  for (const auto* list : {&tree.followers, &tree.readers, &tree.on_coordinates, &tree.on_frames})
    for (const int e : *list) refuse(e, " has its own force law");
}

}  // namespace kte::detail
