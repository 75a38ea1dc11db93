#pragma once

#include <kte/contract/thing_lists.hpp>
#include <kte/detail/unroll.hpp>
#include <kte/dynamics/unrolled/given.hpp>
#include <kte/dynamics/unrolled/plan.hpp>
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
      take_coordinate(get<at.what>(at.slot), g.template coordinate<at.what, at.slot>());
    });
    unroll(given_things<wiring, kind::gen>{},
           [&]<std::size_t I>() { take_coordinate(get<kind::gen>(I), g.template fixed<int{I}>()); });
    unroll(given_things<wiring, kind::input>{},
           [&]<std::size_t I>() { get<kind::input>(I) = as<S>(g.template input<int{I}>()); });
    unroll(given_things<wiring, kind::vector>{},
           [&]<std::size_t I>() { get<kind::vector>(I) = as<S>(g.template vector<int{I}>()); });
    unroll<wiring::count(kind::internal)>([&]<int I>() { get<kind::internal>(I).z = as<S>(g.template internal<I>()); });
    for_each_base<wiring>([&]<kind K, int Slot>() { take_base(get<K>(Slot), g.template base<K, Slot>()); });
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
  /// Copies a number; quantities that were not computed become zero.
  template <class To, class From>
  static void take_number(To& to, const From& from) {
    if constexpr (std::is_same_v<From, skip>) {
      to = To(0);
    } else if constexpr (std::is_same_v<To, S>) {
      to = as<S>(from);
    } else {
      take_number(to.x, from.x), take_number(to.y, from.y);
      if constexpr (requires { to.z; }) take_number(to.z, from.z);
    }
  }
  template <class C>
  static void take_coordinate(gen_coord<S>& to, const C& c) {
    take_number(to.q, c.q), take_number(to.q_dot, c.q_dot), take_number(to.q_ddot, c.q_ddot);
    take_number(to.cos, c.cos), take_number(to.sin, c.sin);
  }
  template <class M>
  static void take_coordinate(pose_coord_2D<S>& to, const M& m) {
    take_number(to.position, m.position), take_number(to.cos, m.rotation.cos), take_number(to.sin, m.rotation.sin);
    take_number(to.velocity, m.velocity), take_number(to.ang_velocity, m.ang_velocity.z);
    take_number(to.acceleration, m.acceleration), take_number(to.ang_acceleration, m.ang_acceleration.z);
  }
  template <class To, class M>
  static void take_coordinate(To& to, const M& m) {
    to.matrix = m.rotation;
    if constexpr (requires { to.position; }) {
      take_number(to.position, m.position), take_number(to.velocity, m.velocity);
      take_number(to.acceleration, m.acceleration);
    }
    take_number(to.ang_velocity, m.ang_velocity), take_number(to.ang_acceleration, m.ang_acceleration);
  }
  /// Returns x, or the other value if x was not computed.
  template <class X, class Other>
  static const auto& known(const X& x, const Other& otherwise) {
    if constexpr (std::is_same_v<X, skip>) {
      return otherwise;
    } else {
      return x;
    }
  }
  template <class Frame, class M>
  static void take_base(Frame& to, const M& m) {
    static constexpr zero3 none{};
    set_motion(to, motion{known(m.position, none), known(m.rotation, no_rotation{}), known(m.velocity, none),
                          known(m.ang_velocity, none), known(m.acceleration, none), known(m.ang_acceleration, none)});
  }

  thing_lists<S> things_{[](kind k) { return wiring::count(k); }};
  tree_type tree_;

 public:
  loop_memory<parameter, S> work;
};

}  // namespace kte::detail
