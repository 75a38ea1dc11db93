#pragma once

#include <kte/contract/core_checks.hpp>
#include <kte/contract/thing.hpp>
#include <kte/detail/numbered.hpp>
#include <kte/detail/unroll.hpp>
#include <kte/frames/motion.hpp>
#include <kte/math/sincos.hpp>

#include <utility>

/// The passes of one element on frames stored in a state, for static and runtime chains.
namespace kte::detail {

/// The index of port P among the loads of an element. Ports for signals have none.
template <class Core, std::size_t P>
inline constexpr std::size_t load_index = [] {
  std::size_t i = 0;
  for (std::size_t p = 0; p < P; ++p) i += !is_signal(Core::ports[p].what);
  return i;
}();

/// The port of internal state N; the number of ports if there is none.
template <class Core, std::size_t N = 0>
inline constexpr std::size_t kept_port = [] {
  std::size_t p = 0, n = 0;
  while (p < port_count<Core> &&
         (Core::ports[p].how != access::keep || Core::ports[p].what != kind::internal || n++ != N))
    ++p;
  return p;
}();
/// Rate N in the result of `z_dot` of an element: one rate, or several from `make_rates`.
template <std::size_t N, class Rate>
KTE_INLINE constexpr const auto& rate_of_kept(const Rate& rate) {
  return rate;
}
template <std::size_t N, class... R>
KTE_INLINE constexpr const auto& rate_of_kept(const values<R...>& rates) {
  return nth<N>(rates);
}

/// A motion or a coordinate without its accelerations, as elements that write signals see it.
template <class X>
KTE_INLINE constexpr auto without_accelerations(const X& x) {
  if constexpr (requires { x.q; }) {
    return coordinate{x.q, x.q_dot, skip{}, x.cos, x.sin};
  } else {
    constexpr vec3<skip> unknown{};
    return motion{x.position, x.rotation, x.velocity, x.ang_velocity, unknown, unknown};
  }
}

/// Whether a load or a signal contains a quantity that was not computed.
template <class T>
inline constexpr bool has_skip = std::is_same_v<T, skip>;
template <class X, class Y, class Z>
inline constexpr bool has_skip<vec3<X, Y, Z>> = has_skip<X> || has_skip<Y> || has_skip<Z>;
template <class F, class T>
inline constexpr bool has_skip<wrench<F, T>> = has_skip<F> || has_skip<T>;
template <class... L>
inline constexpr bool has_skip<values<L...>> = (has_skip<L> || ...);

/// The energies, J, of an element that sees x..., and the first moment m c of a distributed mass in axes of the base,
/// kg m; typed zeros if it has none.
template <class Core, class... X>
KTE_INLINE constexpr auto kinetic_energy_of(const Core& core, const X&... x) {
  if constexpr (has_kinetic_energy<Core, X...>)
    return core.kinetic_energy(x...);
  else
    return zero;
}
template <class Core, class... X>
KTE_INLINE constexpr auto potential_energy_of(const Core& core, const X&... x) {
  if constexpr (has_potential_energy<Core, X...>)
    return core.potential_energy(x...);
  else
    return zero;
}
template <class Core, class... X>
KTE_INLINE constexpr auto first_moment_of(const Core& core, const X&... x) {
  if constexpr (has_first_moment<Core, X...>)
    return core.first_moment(x...);
  else
    return zero3{};
}

/// The connections of an element as a list of indices.
struct by_index {
  const int* index;
  template <std::size_t P>
  KTE_INLINE constexpr int at() const {
    return index[P];
  }
};

/// Connects the ports of an element to a state: Where::at<port>() is the index of the item at the port.
template <class Core, class State, class Where>
struct stored_element {
  const Core& core;
  State& state;
  Where where;

  static constexpr std::size_t ports = port_count<Core>;
  template <std::size_t P>
  static constexpr port at = Core::ports[P];

  /// The item connected to port P.
  template <std::size_t P>
  KTE_INLINE constexpr auto& stored() const {
    return state.template get<at<P>.what>(where.template at<P>());
  }
  /// The item at port P in the form that kernels take.
  template <std::size_t P>
  KTE_INLINE constexpr decltype(auto) input() const {
    if constexpr (writes_signal<Core> && !reads_accelerations<Core> && !is_signal(at<P>.what)) {
      if constexpr (at<P>.what == kind::gen)
        return without_accelerations(stored<P>());
      else
        return without_accelerations(spatial(stored<P>()));
    } else if constexpr (at<P>.what == kind::gen) {
      return std::as_const(stored<P>());
    } else if constexpr (is_signal(at<P>.what)) {
      return number_of_signal<at<P>.what>(stored<P>());
    } else {
      return spatial(stored<P>());
    }
  }
  template <std::size_t P>
  KTE_INLINE constexpr auto load() const {
    if constexpr (at<P>.what == kind::gen) {
      return stored<P>().f;
    } else {
      return load_of(stored<P>());
    }
  }
  static constexpr bool has_output = at<ports - 1>.how == access::out;
  static constexpr std::size_t inputs = input_count<Core>;

  template <std::size_t... P>
  KTE_INLINE constexpr void motion(std::index_sequence<P...>) const {
    update_angles(std::index_sequence<P...>{});
    move(std::index_sequence<P...>{});
  }
  /// doMotion without an update of sines, cosines and matrices.
  template <std::size_t... P>
  KTE_INLINE constexpr void move(std::index_sequence<P...>) const {
    if constexpr (has_output) write(core.doMotion(input<P>()...));
    if constexpr (kept_count < Core >> 0) write_rates(core.z_dot(input<P>()...));
    if constexpr (is_closure<Core>) core.put_residual(stored<P>()...);
    if constexpr (is_contact<Core>) core.put_contact(stored<P>()...);
  }
  /// Updates the sines, cosines and matrices of the coordinates that it reads as angles and rotations.
  template <std::size_t... P>
  KTE_INLINE constexpr void update_angles(std::index_sequence<P...>) const {
    unroll(std::index_sequence<P...>{}, [this]<std::size_t N>() KTE_INLINE_LAMBDA {
      if constexpr (at<N>.how == access::angle) update_angle(this->template stored<N>());
    });
  }
  template <std::size_t... P>
  KTE_INLINE constexpr void force(std::index_sequence<P...>) const {
    if constexpr (writes_signal<Core>) {
      return;
    } else if constexpr (has_output) {
      spread<P...>(core.doForce(input<P>()..., load<ports - 1>()));
    } else if constexpr (has_force<Core, decltype(input<P>())...>) {
      spread<P...>(core.doForce(input<P>()...));
    } else {
      (void)check_load_count<Core, load_count<decltype(core.doForce(input<P>()...))>>{};
    }
  }
  /// Whether it holds its coordinate, and the largest holding force. For a joint whose force depends on what it
  /// carries, call doForce first.
  template <std::size_t... P>
  KTE_INLINE constexpr bool holds(std::index_sequence<P...>) const {
    if constexpr (locks_coordinate<Core>) {
      return core.holds(input<P>()...);
    } else {
      return false;
    }
  }
  template <std::size_t... P>
  KTE_INLINE constexpr auto capacity(std::index_sequence<P...>) const {
    if constexpr (locks_by_load<Core>) {
      return core.capacity(input<P>()..., load<ports - 1>());
    } else if constexpr (locks_coordinate<Core>) {
      return core.capacity(input<P>()...);
    } else {
      return zero;
    }
  }
  /// The internal states after its law has changed; unchanged without `switched`.
  template <std::size_t... P>
  KTE_INLINE constexpr void switch_over(std::index_sequence<P...>) const {
    if constexpr (has_switched<Core, decltype(input<P>())...>) write_kept(core.switched(input<P>()...));
  }
  /// The loads of a distributed mass due to accelerations only.
  template <std::size_t... P>
  KTE_INLINE constexpr void mass_force(std::index_sequence<P...>) const {
    if constexpr (distributed_mass<Core>) spread<P...>(core.mass_loads(input<P>()...));
  }
  /// The friction of a joint that carries a wrench at its end.
  template <class Wrench>
  KTE_INLINE constexpr auto friction(const Wrench& end) const {
    if constexpr (locks_by_load<Core>) {
      return core.friction(input<0>(), input<1>(), end);
    } else if constexpr (load_dependent_friction<Core>) {
      return core.friction(input<0>(), end);
    } else {
      return zero;
    }
  }
  template <std::size_t... P>
  KTE_INLINE constexpr auto kinetic_energy(std::index_sequence<P...>) const {
    return kinetic_energy_of(core, input<P>()...);
  }
  template <std::size_t... P>
  KTE_INLINE constexpr auto potential_energy(std::index_sequence<P...>) const {
    return potential_energy_of(core, input<P>()...);
  }
  template <std::size_t... P>
  KTE_INLINE constexpr auto first_moment(std::index_sequence<P...>) const {
    return first_moment_of(core, input<P>()...);
  }
  /// A function that passes through zero where the law of the element changes; 1 if it never does.
  template <std::size_t... P>
  KTE_INLINE constexpr auto switching(std::index_sequence<P...>) const {
    if constexpr (has_switching<Core, decltype(input<P>())...>) {
      return core.switching(input<P>()...);
    } else {
      return one;
    }
  }
  template <std::size_t... P>
  KTE_INLINE constexpr void clear(std::index_sequence<P...>) const {
    const int done[]{(clear_one<P>(), 0)..., 0};
    (void)done;
  }

 private:
  template <class M>
  KTE_INLINE constexpr void write(const M& m) const {
    auto& x = stored<ports - 1>();
    if constexpr (writes_signal<Core>) {
      static_assert(sizeof(check_signal<Core, has_skip<M>>) > 0);
      if constexpr (!has_skip<M>) x = as<typename State::scalar>(m);
    } else if constexpr (at<ports - 1>.what == kind::gen) {
      using S = std::remove_cvref_t<decltype(x.q)>;
      x.q = as<S>(m.q), x.q_dot = as<S>(m.q_dot), x.q_ddot = as<S>(m.q_ddot);
    } else {
      set_motion(x, m);
    }
  }
  template <class Rates>
  KTE_INLINE constexpr void write_rates(const Rates& rates) const {
    unroll<kept_count<Core>>([&]<std::size_t N>() KTE_INLINE_LAMBDA {
      auto& z = this->template stored<kept_port<Core, N>>();
      z.z_dot = as<std::remove_cvref_t<decltype(z.z_dot)>>(rate_of_kept<N>(rates));
    });
  }
  template <class Kept>
  KTE_INLINE constexpr void write_kept(const Kept& kept) const {
    unroll<kept_count<Core>>([&]<std::size_t N>() KTE_INLINE_LAMBDA {
      auto& z = this->template stored<kept_port<Core, N>>().z;
      z = as<std::remove_cvref_t<decltype(z)>>(rate_of_kept<N>(kept));
    });
  }
  template <std::size_t... P, class Loads>
  KTE_INLINE constexpr void spread(const Loads& l) const {
    const int done[]{(add<P>(l), 0)..., 0};
    (void)done;
  }
  template <std::size_t P, class Loads>
  KTE_INLINE constexpr void add(const Loads& l) const {
    if constexpr (at<P>.what == kind::gen) {
      auto& x = stored<P>();
      using S = std::remove_cvref_t<decltype(x.f)>;
      x.f = S(x.f + nth<load_index<Core, P>>(l));  // parameters may have more digits
    } else if constexpr (!is_signal(at<P>.what)) {
      add_load(stored<P>(), nth<load_index<Core, P>>(l));
    }
  }
  template <std::size_t P>
  KTE_INLINE constexpr void clear_one() const {
    if constexpr (at<P>.what == kind::gen) {
      stored<P>().f = {};
    } else if constexpr (!is_signal(at<P>.what)) {
      clear_load(stored<P>());
    }
  }
};

}  // namespace kte::detail
