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
  using core = core_of<Chain, I>;
  using wiring = typename Chain::wiring;
  joint_place p;
  if constexpr (is_transmission<core>) {
    p.below = wiring::writer(core::ports.back().what, wiring::slot(I, port_count<core> - 2));
    if constexpr (IsFree) {
      p.row = wiring::template at<coordinate_kind<core>, wiring::slot(I, 0)>.v;
      p.axes = joint_dofs<core>;
    }
  }
  return p;
}

}  // namespace kte::detail
