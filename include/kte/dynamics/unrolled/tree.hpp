#pragma once

#include <kte/contract/joint.hpp>
#include <kte/dynamics/unrolled/passes.hpp>
#include <kte/dynamics/unrolled/plan.hpp>

/// The properties of a chain for algorithms along the tree of its joints.
namespace kte::detail {

/// Whether a chain is a tree of joints: only links and joints move frames, no coordinate follows another or moves two
/// joints.
template <class Chain>
inline constexpr bool is_tree_of_joints = static_plan<Chain>.tree;

/// A joint or link: the element whose end is its base, or -1; the number of its first axis among all axes; the rows of
/// its coordinates.
struct tree_step {
  int below = -1, axes = 0;
  std::array<int, 6> row{};
  std::size_t first = 0;
};
template <class Chain>
inline constexpr auto tree_steps = [] {
  std::array<tree_step, Chain::size + 1> steps{};  // the last has the number of all axes
  const static_connections<Chain> c;
  for (std::size_t e = 0; e < Chain::size; ++e) {
    auto& x = steps[e];
    steps[e + 1].first = x.first;
    if (!c.rigid(e)) continue;
    const auto ports = c.ports(e);
    const std::size_t base = ports.size() - 2;
    x.below = c.writer(ports[base].what, c.index(e, base));
    if (base > 0 && ports[0].what != kind::gen) {
      x.axes = nv_of(ports[0].what);
      for (int k = 0; k < x.axes; ++k) x.row[static_cast<std::size_t>(k)] = static_plan<Chain>.joint_row[e] + k;
    }
    for (std::size_t k = 0; ports[k].what == kind::gen; ++k)
      x.row[k] = static_plan<Chain>.row_of_gen[static_cast<std::size_t>(c.index(e, k))], ++x.axes;
    steps[e + 1].first += static_cast<std::size_t>(x.axes);
  }
  return steps;
}();

/// Whether element I is a joint whose coordinate is a degree of freedom.
template <class Chain, std::size_t I, class Core = typename Chain::template core_type<I>>
inline constexpr bool is_free_joint = [] {
  if constexpr (is_transmission<Core>) {
    return coordinates_of<Core> > 0 &&
           Chain::wiring::template is_free<coordinate_kind<Core>, Chain::wiring::slot(I, 0)>;
  } else {
    return false;
  }
}();

/// The first element for which `Is<core>` holds; void if there is none.
template <class Chain, template <class> class Is>
constexpr auto find_element() {
  constexpr std::size_t first = []<std::size_t... I>(std::index_sequence<I...>) {
    const bool is[]{Is<core_of<Chain, I>>::value..., true};
    std::size_t i = 0;
    while (!is[i]) ++i;
    return i;
  }
  (std::make_index_sequence<Chain::size>{});
  if constexpr (first < Chain::size)
    return std::type_identity<core_of<Chain, first>>{};
  else
    return std::type_identity<void>{};
}
template <class Chain, template <class> class Is>
using first_element = typename decltype(find_element<Chain, Is>())::type;
template <class Core>
struct has_own_loads : std::bool_constant<!loads_by_relative<Core> || !power_dual<Core>> {};
template <class Core>
struct has_distributed_mass : std::bool_constant<distributed_mass<Core>> {};
template <class Core>
struct closes_loop : std::bool_constant<is_closure<Core>> {};
template <class Core>
struct touches : std::bool_constant<is_contact<Core>> {};
template <class Core>
struct is_load_dependent : std::bool_constant<load_dependent_friction<Core>> {};

/// Whether joints have load-dependent friction.
template <class Chain>
inline constexpr bool has_load_dependent_friction =
    !Chain::common && !std::is_void_v<first_element<Chain, is_load_dependent>>;

/// Checks algorithms that omit such loads.
template <class Chain, class Core = first_element<Chain, has_own_loads>>
using check_loads_of = check_loads<Core, std::is_void_v<Core>>;
template <class Chain, class Core = first_element<Chain, has_distributed_mass>>
using check_bodies_of = check_bodies<Core, std::is_void_v<Core>>;
template <class Chain, class Core = first_element<Chain, touches>>
using check_contacts_of = check_contacts<Core, std::is_void_v<Core>>;
/// Refuses closures and contacts.
template <class Chain, class Core = first_element<Chain, closes_loop>>
struct check_closures_of : check_closures<Core, std::is_void_v<Core>>, check_contacts_of<Chain> {};
/// Whether a static chain has closures.
template <class Chain>
inline constexpr bool has_closures = !Chain::common && !std::is_void_v<first_element<Chain, closes_loop>>;
/// Whether a static chain has contacts.
template <class Chain>
inline constexpr bool has_contact_elements = !Chain::common && !std::is_void_v<first_element<Chain, touches>>;
/// Accelerations of chains with closures: kte/loops.hpp.
template <class Chain>
struct static_loops;

/// The place of an element: its axes that are degrees of freedom, in contiguous rows from the first on; the preceding
/// element, or -1.
struct joint_place {
  int row = 0, axes = 0, below = -1;
};
/// The place of element I; a joint that is not free to move has no axes.
template <class Chain, std::size_t I, bool IsFree>
constexpr joint_place joint_place_of() {
  const tree_step& x = tree_steps<Chain>[I];
  return {IsFree ? x.row[0] : 0, IsFree ? x.axes : 0, x.below};
}

}  // namespace kte::detail
