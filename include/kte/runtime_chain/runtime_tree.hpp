#pragma once

#include <kte/runtime_chain/kte_map.hpp>
#include <kte/runtime_chain/topology.hpp>
#include <kte/tree/chain_tree.hpp>
#include <kte/tree/loop_memory.hpp>

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
template <class P>
runtime_tree<P> tree_of(const topology& t) {
  const runtime_connections c{t};
  return {c, arrange<growing_list>(c), [&t](const auto& each) {
            for (std::size_t e = 0; e < t.elements.size(); ++e) {
              if constexpr (std::is_same_v<P, double>)
                each(e, t.elements[e].element->numbers());
              else
                each(e, as_numbers<P>(t.elements[e].element->numbers()));
            }
          }};
}
template <class S>
inline constexpr bool has_lanes_of_double = requires {
  requires std::is_same_v<typename S::value_type, double> &&(S::lanes > 0);
};
/// Throws `bad_argument` if S is a scalar that does not support forces or dependent coordinates.
template <class S, class P>
void check_scalar(const topology& t, const runtime_tree<P>& tree) {
  if (std::is_same_v<S, double>) return;
  const auto refuse = [&t](int e, const char* why) {
    throw bad_argument(
        "kte: states of runtime chains in scalars other than double support joints, links and bodies only; " +
        describe_element(*t.elements[static_cast<std::size_t>(e)].element) + why);
  };
  for (std::size_t e = 0; e < t.elements.size() && !has_lanes_of_double<S>; ++e)
    if (t.elements[e].closes) refuse(static_cast<int>(e), " closes a loop");
  for (const int i : tree.body_tree.varying)
    refuse(tree.body_tree.nodes[static_cast<std::size_t>(i)].element, " has axes that depend on its coordinates");
  if (tree.irregular) refuse(tree.irregular.element, tree.irregular.why);
  for (const auto* list : {&tree.followers, &tree.readers, &tree.on_coordinates, &tree.on_frames})
    for (const int e : *list) refuse(e, " has its own force law");
}

}  // namespace kte::detail
