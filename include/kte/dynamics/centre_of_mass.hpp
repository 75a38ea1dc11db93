#ifndef KTE_CENTRE_OF_MASS_HPP
#define KTE_CENTRE_OF_MASS_HPP

#include <kte/dynamics/detail/moved_freely.hpp>

namespace kte {

/// A mass, kg, and where its centre is, m.
template <class S = double>
struct mass_centre {
  S mass;
  vec3<S> position;
};

namespace detail {

/// A mass and its first moment m c about the origin of a frame.
template <class M, class H>
struct weighted_point {
  using geometry = weighted_point;
  M mass;
  H moment;
};
template <class M, class H>
weighted_point(M, H) -> weighted_point<M, H>;
template <class M, class H, class N, class K>
KTE_INLINE constexpr auto operator+(const weighted_point<M, H>& a, const weighted_point<N, K>& b) {
  return weighted_point{a.mass + b.mass, a.moment + b.moment};
}

/// What the frames of a chain carry, from the tips to the bases: (1) and (2) of `centre_of_mass`.
template <class S, class Chain, class Given>
struct local_weight {
  using types = local_types<Chain, Given>;
  using wiring = typename Chain::wiring;
  template <std::size_t I>
  using core_t = typename types::template core<I>;

  const Chain& chain;
  const Given& given;

  /// Of all bases, which have one origin and one set of axes.
  KTE_INLINE constexpr auto total() const {
    return from_bases<kind::frame_2D>(std::make_integer_sequence<int, wiring::count(kind::frame_2D)>{}) +
           from_bases<kind::frame_3D>(std::make_integer_sequence<int, wiring::count(kind::frame_3D)>{}) +
           from_given_bases(typename given_bases<Chain>::type{});
  }

 private:
  static constexpr weighted_point<zero_t, zero3> none{};
  /// What stands on the end of element I, about the origin of x and in its axes, x to the end.
  template <std::size_t I, class X>
  KTE_INLINE constexpr auto at_end(const X& x) const {
    constexpr kind k = types::template output_kind<I>;
    constexpr int end = types::template output_slot<I>;
    const auto b = carried<k, end>(std::make_index_sequence<loads_on<wiring, k, end>.size()>{});
    return weighted_point{b.mass, x.rotation * b.moment + b.mass * x.position};  // (2)
  }
  template <std::size_t... I>
  KTE_INLINE constexpr auto from_given_bases(std::index_sequence<I...>) const {
    return (none + ... +
            at_end<I>(motion_of<types, types::template output_kind<I>, types::template output_slot<I>>(chain, given)));
  }
  template <kind K, int... Slot>
  KTE_INLINE constexpr auto from_bases(std::integer_sequence<int, Slot...>) const {
    return (none + ... + from_base<K, Slot>());
  }
  template <kind K, int Slot>
  KTE_INLINE constexpr auto from_base() const {
    if constexpr (wiring::writer(K, Slot) < 0) {
      return carried<K, Slot>(std::make_index_sequence<loads_on<wiring, K, Slot>.size()>{});
    } else {
      return none;
    }
  }
  template <kind K, int Slot, std::size_t... N>
  KTE_INLINE constexpr auto carried(std::index_sequence<N...>) const {
    return (none + ... + part<loads_on<wiring, K, Slot>[N].element>());
  }
  template <std::size_t I>
  KTE_INLINE constexpr auto part() const {
    if constexpr (is_body<core_t<I>>) {
      const auto b = chain.template core<I>().template mass<S>();
      return weighted_point{b.mass, b.moment};
    } else if constexpr (is_transmission<core_t<I>>) {
      return at_end<I>(relative<I>());
    } else {
      static_assert(sizeof(pass_over<Chain, I>) > 0);
      return none;
    }
  }
  template <std::size_t I>
  KTE_INLINE constexpr auto relative() const {
    const auto& core = chain.template core<I>();
    if constexpr (coordinates_of<core_t<I>> == 0) {
      return core.relative();
    } else {
      return core.relative(
          position_only(motion_of<types, coordinate_kind<core_t<I>>, wiring::slot(I, 0)>(chain, given)));
    }
  }
};

inline constexpr same_base base_of_nothing{motion{skip{}, skip{}, skip{}, skip{}, skip{}, skip{}}};

template <class S, class Chain, class At>
KTE_INLINE auto weight_of(const Chain& c, const At& at) {
  const given g{at, same<skip>{}, same<skip>{}, base_with_pose};
  return local_weight<S, Chain, std::remove_const_t<decltype(g)>>{c, g}.total();
}
/// A sum of m x divided by the mass.
template <class S, class M, class X, class Blame = too_large>
KTE_INLINE vec3<S> divided_by_mass(const M& mass, const X& sum, const Blame& why = {"a centre of mass"}) {
  static_assert(!std::is_same_v<M, zero_t>, "kte: a chain without bodies has no centre of mass");
  const vec3<S> s = as<S>(sum), r{s.x / as<S>(mass), s.y / as<S>(mass), s.z / as<S>(mass)};
  const S numbers[]{r.x, r.y, r.z};
  check_result(numbers, 3, [&]() KTE_INLINE_LAMBDA {
    if (!all(as<S>(mass) == S(0))) why();
    raise<bad_argument>("kte: a chain whose mass is zero has no centre of mass");
  });
  return r;
}

/// The sum of the loads that a pass has put on bases, which have one origin and one set of axes.
template <class Pass>
KTE_INLINE auto load_on_bases(const Pass& pass) {
  using wiring = typename Pass::chain_type::wiring;
  const auto on = [&pass]<kind K, int Slot>() KTE_INLINE_LAMBDA {
    if constexpr (wiring::writer(K, Slot) < 0) {
      return pass.template load<K, Slot>();
    } else {
      return no_wrench;
    }
  };
  return [&on]<int... P, int... Q>(std::integer_sequence<int, P...>, std::integer_sequence<int, Q...>)
      KTE_INLINE_LAMBDA {
    return (no_wrench + ... + on.template operator()<kind::frame_2D, P>()) +
           (no_wrench + ... + on.template operator()<kind::frame_3D, Q>());
  }
  (std::make_integer_sequence<int, wiring::count(kind::frame_2D)>{},
   std::make_integer_sequence<int, wiring::count(kind::frame_3D)>{});
}
/// The sum of the momenta of all bodies at rest bases, at their origin and in their axes.
template <class S, class Chain, class At, class V>
KTE_INLINE auto momentum_at_base(const Chain& c, const At& at, const V& v) {
  const given g{at, v, same<skip>{}, rest_base_of<Chain>(base_with_velocity)};
  const with_loads<Chain, momenta<S>> bodies{c};
  return load_on_bases(local_pass<with_loads<Chain, momenta<S>>, std::remove_const_t<decltype(g)>>(bodies, g));
}

}  // namespace detail

/// The mass of all bodies (kg) and their centre of mass (m, in axes of the base, from its origin): with h = m c the
/// first moment of what a frame carries,
///
///   c = h_base / m                                       (1)
///   h_base += R h_end + m_end p,  m_base += m_end        (2)
///
/// from the tips to the base, for a link or joint R, p between base and end. Of a runtime chain `centre_of_mass(c, s,
/// q)`, or `centre_of_mass(c, s)` at the positions of the state s, in the axes in which its bases are given. Arguments
/// and errors as for `inverse_dynamics`. Throws `bad_argument` also for a mass of zero, and for masses between several
/// things.
template <class Gravity, class... E, indexable Q>
auto centre_of_mass(const static_chain<Gravity, E...>& c, const Q& q) {
  using chain_type = static_chain<Gravity, E...>;
  using S = value_of<Q>;
  static_assert(sizeof(detail::check_bodies_of<chain_type>) > 0);
  detail::check_configuration<chain_type>(q);
  const detail::configuration<S, typename chain_type::wiring, Q> at(q);
  at.check();
  const auto w = detail::weight_of<S>(c, at);
  return mass_centre<S>{as<S>(w.mass), detail::divided_by_mass<S>(w.mass, w.moment, [&]() KTE_INLINE_LAMBDA {
                          detail::blame<typename chain_type::wiring>("a centre of mass", at.q, detail::same<zero_t>{},
                                                                     detail::same<zero_t>{}, "a");
                        })};
}

/// The velocity of the centre of mass, m/s, in axes of the base, bases at rest: momentum by mass. Of a runtime chain
/// `centre_of_mass_velocity(c, s, q, v)` or `(c, s)`; bases that elements move as signals say move.
template <class Gravity, class... E, indexable Q, indexable V>
auto centre_of_mass_velocity(const static_chain<Gravity, E...>& c, const Q& q, const V& v) {
  using namespace detail;
  using chain_type = static_chain<Gravity, E...>;
  using S = value_of<Q>;
  static_assert(sizeof(detail::check_bodies_of<chain_type>) > 0);
  check_configuration<chain_type>(q), check_velocities<chain_type>(v);
  const configuration<S, typename chain_type::wiring, Q> at(q);
  at.check();
  return divided_by_mass<S>(
      weight_of<S>(c, at).mass, momentum_at_base<S>(c, at, each<S, V>{v}).force, [&]() KTE_INLINE_LAMBDA {
        blame<typename chain_type::wiring>("a velocity", at.q, each<S, V>{v}, same<zero_t>{}, "a");
      });
}

}  // namespace kte

#endif

// ---- of runtime chains (kte/dynamics/runtime_parts.hpp)

#if defined(KTE_RUNTIME_CHAINS) && !defined(KTE_CENTRE_OF_MASS_OF_RUNTIME_CHAINS)
#define KTE_CENTRE_OF_MASS_OF_RUNTIME_CHAINS

#include <kte/dynamics/detail/runtime_bodies.hpp>

namespace kte {

template <class S>
mass_centre<S> centre_of_mass(const kte_map_chain& c, basic_runtime_state<S>& s) {
  detail::check_regular(c, s), detail::check_positions(s);
  detail::carry(c, s);
  const auto w = tree::weight_in_world(s.tree().forest, s.work);
  return {w.mass, detail::divided_by_mass<S>(w.mass, w.moment, detail::blame_state{"a centre of mass", s})};
}
template <class S>
vec3<S> centre_of_mass_velocity(const kte_map_chain& c, basic_runtime_state<S>& s) {
  detail::check_regular(c, s), detail::check_state_velocities(s);
  detail::carry(c, s);
  return detail::divided_by_mass<S>(tree::weight_in_world(s.tree().forest, s.work).mass,
                                    detail::momentum_of_coordinates(s, vec3<S>{}).force,
                                    detail::blame_state{"a velocity", s});
}
template <class S, indexable Q>
mass_centre<S> centre_of_mass(const kte_map_chain& c, basic_runtime_state<S>& s, const Q& q) {
  return detail::take(c, s, q).call([&] { return centre_of_mass(c, s); });
}
template <class S, indexable Q, indexable V>
vec3<S> centre_of_mass_velocity(const kte_map_chain& c, basic_runtime_state<S>& s, const Q& q, const V& v) {
  return detail::take(c, s, q, v).call([&] { return centre_of_mass_velocity(c, s); });
}

#ifdef KTE_EXTERN
KTE_EXTERN template mass_centre<double> centre_of_mass(const kte_map_chain&, runtime_state&);
KTE_EXTERN template vec3<> centre_of_mass_velocity(const kte_map_chain&, runtime_state&);
#endif

}  // namespace kte

#endif
