#pragma once

#include <kte/contract/thing_lists.hpp>
#include <kte/detail/unroll.hpp>
#include <kte/dynamics/unrolled/copy_given.hpp>
#include <kte/math/plain_scalar.hpp>
#include <kte/tree/chain_tree.hpp>
#include <kte/tree/loop_memory.hpp>

/// The state of a static chain for algorithms that are loops over body nodes.
namespace kte::detail {

/// The scalar of the parameters of a core, as the type of their sum.
template <class Core>
auto parameters_in(const Core& core) {
  const auto in_pose = [](const auto& x) {
    const auto r = matrix(x.rotation);
    return dot(r.x, r.y) + dot(r.y, r.z) + dot(x.position, x.position) + 0.0;
  };
  if constexpr (!is_transmission<Core>) {
    if constexpr (has_mass<Core, double>) {
      const auto m = core.template mass<double>();
      if constexpr (is_frame(Core::ports[0].what)) {
        return m.mass + dot(m.moment, m.moment) + m.inertia.xx + 0.0;
      } else {
        return m + 0.0;
      }
    } else {
      return 0.0;
    }
  } else if constexpr (coordinates_of<Core> == 0) {
    return in_pose(core.relative());
  } else {
    return in_pose(relative_at(core, position_only(plain_coordinates<Core>(true))));
  }
}
template <class S, class Chain>
inline constexpr bool has_plain_parameters = []<std::size_t... I>(std::index_sequence<I...>) {
  const bool plain[]{std::is_convertible_v<decltype(parameters_in(std::declval<const core_of<Chain, I>&>())), S>...,
                     true};
  for (const bool p : plain)
    if (!p) return false;
  return true;
}
(std::make_index_sequence<Chain::size>{});
/// The scalar P of the body nodes of a chain in calculations with S; derivatives by parameters are kept.
template <class S, class Chain, class Plain = plain_scalar<S>>
using tree_number = std::conditional_t<has_plain_parameters<Plain, Chain>, Plain, S>;

/// Coordinates, signals, and the frames that elements act on.
template <class S, class Chain>
class static_state {
 public:
  using wiring = typename Chain::wiring;
  using scalar = S;
  using parameter = tree_number<S, Chain>;
  using tree_type = chain_tree<parameter, const std::remove_cvref_t<decltype(static_plan<Chain>)>&>;
  static constexpr bool has_sines = true;
  /// Whether it is known with the compiler that articulated bodies alone are needed.
  static constexpr bool always_tree = static_plan<Chain>.tree && Chain::common;

  explicit static_state(const Chain& c)
      : tree_(static_connections<Chain>{}, static_plan<Chain>,
              [&c](const auto& each) {
                unroll<Chain::size>([&]<std::size_t I>() { each(I, numbers_of<parameter>(c.template core<I>())); });
              }),
        work(tree_, dofs(), Chain::size) {}

  /// Copies all given quantities (dynamics/unrolled/given.hpp).
  template <class Given>
  void take(const Given& g) {
    unroll<wiring::freedoms>([&]<std::size_t F>() {
      constexpr freedom at = wiring::template free<F>;
      copy_coordinate<S>(get<at.what>(at.slot), g.template coordinate<at.what, at.slot>());
    });
    copy_given_items<wiring>(g, *this, []<kind>(int slot) { return slot; });
  }

  template <kind K>
  auto& get(int i) {
    return things_.template get<K>(i);
  }
  template <kind K>
  const auto& get(int i) const {
    return things_.template get<K>(i);
  }
  static constexpr int dofs() { return wiring::dofs; }
  static std::span<const freedom> freedoms() { return {wiring::table.free.data(), wiring::freedoms}; }
  const tree_type& tree() const { return tree_; }
  /// Whether the sine of generalized coordinate i is set; false if the coordinate was not computed.
  static bool has_sine(int i) {
    return wiring::angle(i) || static_plan<Chain>.row_of_gen[static_cast<std::size_t>(i)] >= dofs();
  }

 private:
  thing_lists<S> things_{[](kind k) { return wiring::count(k); }};
  tree_type tree_;

 public:
  loop_memory<parameter, S> work;
};

}  // namespace kte::detail
