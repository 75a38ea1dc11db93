#pragma once

#include <kte/dynamics/detail/moved_freely.hpp>

/// Masses of static chains, their centre and their momentum.
namespace kte::detail {

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
template <class S, class M, class X, class Diagnose = too_large>
KTE_INLINE vec3<S> divided_by_mass(const M& mass, const X& sum, const Diagnose& why = {"a centre of mass"}) {
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

}  // namespace kte::detail
