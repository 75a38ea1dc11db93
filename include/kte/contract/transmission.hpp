#pragma once

#include <kte/contract/element.hpp>
#include <kte/detail/numbered.hpp>
#include <kte/frames/motion.hpp>

#include <tuple>
#include <type_traits>
#include <utility>

namespace kte {

/// The loads of an element on its input ports, in their order: a number for a coordinate (N or Nm, along it), a wrench
/// for a frame (at its origin, in its axes). Signals (inputs, internal states) have none.
template <class... L>
using loads = values<L...>;

/// Returns the `loads` of doForce, in the order of the input ports.
template <class... L>
[[nodiscard]] KTE_INLINE constexpr auto make_loads(const L&... l) {
  return values<L...>{{{l}...}};
}

/// Returns the rates of several internal states from `z_dot`, in their order.
template <class... R>
[[nodiscard]] KTE_INLINE constexpr auto make_rates(const R&... r) {
  return values<R...>{{{r}...}};
}

namespace detail {
/// A type that no pass is called with.
struct no_pass;

/// Unit vector N of the coordinate axes; zero for other N.
template <int N>
KTE_INLINE constexpr auto unit_vector() {
  return vec3<constant<N == 0>, constant<N == 1>, constant<N == 2>>{};
}
/// A coordinate of kind K with rate 1 for degree of freedom N and 0 for the others: its motion is axis N of the joint.
template <kind K, int N, class C>
KTE_INLINE constexpr auto unit_rate(const C& c) {
  if constexpr (K == kind::gen) {
    return coordinate{c.q, one, zero, c.cos, c.sin};
  } else {
    constexpr int first_angular = K == kind::rotation_3D ? 0 : K == kind::pose_2D ? 2 : 3;
    constexpr int angular = N < first_angular ? -1 : K == kind::pose_2D ? 2 : N - first_angular;
    const auto turning = unit_vector<angular>();
    const auto moving = unit_vector<(N < first_angular ? N : -1)>();
    return motion{c.position, c.rotation, moving, turning, zero3{}, zero3{}};
  }
}
/// A coordinate without rates.
template <class C>
KTE_INLINE constexpr auto position_only(const C& c) {
  if constexpr (requires { c.q; }) {
    return coordinate{c.q, skip{}, skip{}, c.cos, c.sin};
  } else {
    constexpr vec3<skip> none{};
    return motion{c.position, c.rotation, none, none, none, none};
  }
}
/// The power of a wrench on a velocity.
template <class Motion, class F, class T>
KTE_INLINE constexpr auto power(const Motion& m, const wrench<F, T>& w) {
  return dot(m.velocity, w.force) + dot(m.ang_velocity, w.torque);
}
/// The generalized forces on a coordinate of kind K as a load: f(N) for each degree of freedom N.
template <kind K, class F>
KTE_INLINE constexpr auto load_on(const F& f) {
  if constexpr (K == kind::gen) {
    return f.template operator()<0>();
  } else if constexpr (K == kind::rotation_3D) {
    return wrench{zero3{}, vec3{f.template operator()<0>(), f.template operator()<1>(), f.template operator()<2>()}};
  } else if constexpr (K == kind::pose_2D) {
    return wrench{vec3{f.template operator()<0>(), f.template operator()<1>(), zero},
                  vec3{zero, zero, f.template operator()<2>()}};
  } else {
    return wrench{vec3{f.template operator()<0>(), f.template operator()<1>(), f.template operator()<2>()},
                  vec3{f.template operator()<3>(), f.template operator()<4>(), f.template operator()<5>()}};
  }
}
/// The motion at unit rate of coordinate N of a joint, with the others at rest.
template <std::size_t N, class Core, class Coordinates, std::size_t... K>
KTE_INLINE constexpr auto axis_among(const Core& core, const Coordinates& c, std::index_sequence<K...>) {
  const auto at = [&c]<std::size_t I>() KTE_INLINE_LAMBDA {
    const auto& x = std::get<I>(c);
    if constexpr (I == N) {
      return unit_rate<kind::gen, 0>(x);
    } else {
      return coordinate{x.q, zero, zero, x.cos, x.sin};
    }
  };
  return core.relative(at.template operator()<K>()...);
}
/// Number N of the load on a coordinate.
template <kind K, int N, class L>
KTE_INLINE constexpr auto number_of(const L& load) {
  if constexpr (K == kind::gen) {
    return load;
  } else {  // power on one rate
    constexpr motion<zero3, no_rotation, zero3, zero3, zero3, zero3> none{};
    return power(unit_rate<K, N>(none), load);
  }
}
}  // namespace detail

/// A rigid connection between two frames: a link or a joint. A core derived from it has one function,
///
///   relative(coordinate)   the motion of the end frame in the base frame; for a link relative()     (1)
///
/// and the passes follow from it:
///   doMotion   X_end = X_base * relative                     (compose, frames/motion.hpp)        (2)
///   doForce    the full wrench of the end acts on the base   (transmit, frames/motion.hpp)       (3)
///              f = s . wrench, s the velocity at unit rate of the coordinate                     (4)
/// so that f is the generalized force on the coordinate, in any chain. With `static constexpr bool
/// load_dependent_friction = true` in the core, f also includes its `friction(coordinate, wrench)`. The articulated
/// inertia, the accelerations (dynamics/) and all other quantities of algorithms follow as well. A coordinate is a
/// number (`coordinate`), or a rotation or pose (`motion`, with several f). In the axes of the end, s must be the same
/// in every position; a core with other axes declares `static constexpr bool varying_axes = true`. A joint with several
/// coordinates, which are numbers, has them before the base: `relative(coordinate1, coordinate2)`, with one f for each.
template <class Core>
struct transmission {
  /// A link.
  template <class Base>
  KTE_INLINE constexpr auto doMotion(const Base& base) const {
    return compose(base, core().relative());  // (2)
  }
  template <class Base, class F, class T>
  KTE_INLINE constexpr auto doForce(const Base&, const wrench<F, T>& end) const {
    return make_loads(transmit(core().relative(), end));  // (3)
  }
  /// A joint.
  template <class C, class Base>
  KTE_INLINE constexpr auto doMotion(const C& c, const Base& base) const {
    return compose(base, core().relative(c));  // (2)
  }
  template <class C, class Base, class Wrench>
  KTE_INLINE constexpr auto doForce(const C& c, const Base&, const Wrench& end) const {
    constexpr kind k = Core::ports[0].what;
    const auto f = [&]<int N>()
                       KTE_INLINE_LAMBDA { return detail::power(core().relative(detail::unit_rate<k, N>(c)), end); };
    // Single expressions: with a local variable g++ needs 10 % more instructions for inverse dynamics.
    if constexpr (load_dependent_friction<Core>) {
      return make_loads(detail::load_on<k>(f) + core().friction(c, end),
                        transmit(core().relative(detail::position_only(c)), end));
    } else {
      return make_loads(detail::load_on<k>(f),                                      // (4)
                        transmit(core().relative(detail::position_only(c)), end));  // (3)
    }
  }

  /// A joint that may be held (contract/coordinate_lock.hpp), whose mode is between coordinate and base; or a joint
  /// with two coordinates before the base.
  template <class C, class Second, class Third, class... Others>
  KTE_INLINE constexpr auto doMotion(const C& c, const Second& second, const Third& third,
                                     const Others&... others) const {
    if constexpr (detail::coordinates_of<Core> == 1) {
      return compose(third, core().relative(c));  // (2)
    } else {
      return moved(std::tie(c, second, third, others...), coordinates_in<>{});
    }
  }
  template <class C, class Second, class Third, class Fourth, class... Others>
  KTE_INLINE constexpr auto doForce(const C& c, const Second& second, const Third& third, const Fourth& fourth,
                                    const Others&... others) const {
    if constexpr (detail::coordinates_of<Core> == 1) {
      return make_loads(detail::power(core().relative(detail::unit_rate<kind::gen, 0>(c)), fourth) +
                            core().friction(c, second, fourth),
                        transmit(core().relative(detail::position_only(c)), fourth));
    } else {
      return loaded(std::tie(c, second, third, fourth, others...), coordinates_in<>{});
    }
  }

  // Hidden by the passes of the core.
  static void doMotion(const detail::no_pass&);
  static void doForce(const detail::no_pass&);

 private:
  KTE_INLINE constexpr const Core& core() const { return static_cast<const Core&>(*this); }
  template <class C = Core>
  using coordinates_in = std::make_index_sequence<detail::coordinates_of<C>>;
  /// (2), then (4) and (3), for several coordinates. `things`: the items at the ports, with the wrench of the end as
  /// the last.
  template <class Things, std::size_t... K>
  KTE_INLINE constexpr auto moved(const Things& things, std::index_sequence<K...>) const {
    return compose(std::get<sizeof...(K)>(things), core().relative(std::get<K>(things)...));
  }
  template <class Things, std::size_t... K>
  KTE_INLINE constexpr auto loaded(const Things& things, std::index_sequence<K...> all) const {
    const auto& end = std::get<sizeof...(K) + 1>(things);
    return make_loads(detail::power(detail::axis_among<K>(core(), things, all), end)...,
                      transmit(core().relative(detail::position_only(std::get<K>(things))...), end));
  }
};

namespace detail {

/// A core with `relative`: a rigid connection between two frames. Its ports are the coordinates, the base and the end.
template <class Core>
inline constexpr bool is_transmission = std::is_base_of_v<transmission<Core>, Core>;

/// Whether doMotion and doForce follow from `relative`.
template <class Core>
inline constexpr bool moves_by_relative = requires {
  static_cast<void (*)(const no_pass&)>(&Core::doMotion);
};
template <class Core>
inline constexpr bool loads_by_relative = !is_transmission<Core> || requires {
  static_cast<void (*)(const no_pass&)>(&Core::doForce);
};

/// The rotation of a link, or of a joint at a coordinate in plain numbers; nothing if it requires other numbers.
template <class Core>
constexpr auto rotation_of(const Core& core) {
  if constexpr (port_count<Core> == 2) {
    return core.relative().rotation;
  } else if constexpr (coordinates_of<Core> > 1) {
    constexpr coordinate<double, double, double, double, double> c{};
    return [&core, &c ]<std::size_t... K>(std::index_sequence<K...>) { return core.relative((void(K), c)...).rotation; }
    (std::make_index_sequence<coordinates_of<Core>>{});
  } else if constexpr (Core::ports[0].what == kind::gen) {
    return core.relative(coordinate<double, double, double, double, double>{}).rotation;
  } else if constexpr (Core::ports[0].what == kind::pose_2D) {
    using in_plane = vec3<double, double, zero_t>;
    using about_z = vec3<zero_t, zero_t, double>;
    return core.relative(motion<in_plane, rotation_2D<>, in_plane, about_z, in_plane, about_z>{}).rotation;
  } else {
    return no_rotation{};
  }
}

template <class Core>
requires is_transmission<Core>
struct check_core<Core> {
  using turn = decltype(rotation_of(std::declval<const Core&>()));
  static constexpr bool in_space = Core::ports.back().what == kind::frame_3D;
  static constexpr bool fits = std::is_same_v<turn, no_rotation> || is_planar_rotation<turn> != in_space;
  static constexpr bool passed = fits && moves_by_relative<Core>;
  static_assert(rule < Core, turn, fits || !in_space >,
                "kte: a joint or link in space turns by a matrix or a quaternion: kte::matrix(c.rotation), "
                "kte::rotation_about(axis, angle)");
  static_assert(rule < Core, turn, fits || in_space >,
                "kte: a joint or link in the plane turns by a kte::rotation_2D: kte::rotation_by(angle)");
  static_assert(rule<Core, turn, moves_by_relative<Core>>,
                "kte: the motion of a joint or link follows from its `relative`: it must not have its own `doMotion`");
};

}  // namespace detail

}  // namespace kte

#include <kte/contract/placement.hpp>  // so that all joints have .at()
