#pragma once

#include <kte/contract/joint.hpp>
#include <kte/detail/no_value.hpp>
#include <kte/detail/numbers_where.hpp>
#include <kte/dynamics/unrolled/no_load.hpp>
#include <kte/static_chain/connections.hpp>
#include <kte/static_chain/static_chain.hpp>

/// Data flow between the elements of a static chain in one pass: the types of frames, coordinates and loads, which are
/// local variables (dynamics/unrolled/passes.hpp).
namespace kte::detail {

/// The index of the first false entry; the last entry is false.
template <std::size_t N>
constexpr std::size_t first_false(const bool (&x)[N]) {
  std::size_t i = 0;
  while (x[i]) ++i;
  return i;
}

/// A load on an item: load `index` of element `element`.
struct load_place {
  std::size_t element;
  std::size_t index;
};
/// The loads on item Slot of kind K, last element first, in the order of doForce.
template <class Wiring, kind K, int Slot>
inline constexpr auto loads_on = [] {
  constexpr auto& t = Wiring::table;
  constexpr int last = t.reader[static_cast<std::size_t>(K)][Slot];
  constexpr auto at = [](const auto& of_ports, int p) { return of_ports[static_cast<std::size_t>(p)]; };
  constexpr std::size_t count = [at] {
    std::size_t n = 0;
    for (int p = t.reader[static_cast<std::size_t>(K)][Slot]; p >= 0; p = at(t.previous, p)) ++n;
    return n;
  }();
  std::array<load_place, count> places{};
  std::size_t n = 0;
  for (int p = last; p >= 0; p = at(t.previous, p))
    places[n++] = {static_cast<std::size_t>(at(t.element, p)), static_cast<std::size_t>(at(t.load, p))};
  return places;
}();

/// Whether an element core writes an item in doMotion; it is then at its last port.
template <class Core>
inline constexpr bool has_output = Core::ports[port_count<Core> - 1].how == access::out;

/// A coordinate written by an element, with its sine and cosine.
template <class Q, class QD, class QDD, class C, class S>
KTE_INLINE constexpr auto with_angle(const coordinate<Q, QD, QDD, C, S>& c) {
  if constexpr (!has_skip<C>) {
    return c;
  } else if constexpr (variable<Q>) {
    coordinate<Q, QD, QDD, Q, Q> r{c.q, c.q_dot, c.q_ddot, Q{}, Q{}};
    sincos(c.q, r.sin, r.cos);
    return r;
  } else {
    static_assert(std::is_same_v<Q, zero_t>);
    return coordinate{c.q, c.q_dot, c.q_ddot, one, zero};
  }
}

/// Which quantities of an item an element reads.
enum class view { whole, no_accelerations, rates };
/// The view of an element that reads no accelerations, or of an evaluation without them: frames then have none.
constexpr view view_of(kind k, bool knows_none, bool rates_only) {
  if (is_signal(k)) return view::whole;
  if (knows_none) return view::no_accelerations;
  return is_frame(k) && rates_only ? view::rates : view::whole;
}
template <view V, class M>
KTE_INLINE constexpr auto viewed(const M& m) {
  if constexpr (V == view::no_accelerations) {
    return without_accelerations(m);
  } else {
    static_assert(V == view::rates);
    return motion{m.position, m.rotation, m.velocity, m.ang_velocity, zero3{}, zero3{}};
  }
}
template <view V, class T>
struct viewed_type {
  using type = decltype(viewed<V>(std::declval<const T&>()));
};
template <class T>
struct viewed_type<view::whole, T> {
  using type = T;
};

/// Whether the positions, and on request rates, that an element reads are evaluated.
template <bool Rates, class X>
inline constexpr bool is_known = !has_skip<X>;
template <bool Rates, class Q, class QD, class QDD, class C, class S>
inline constexpr bool is_known<Rates, coordinate<Q, QD, QDD, C, S>> = !has_skip<Q> && (!Rates || !has_skip<QD>);
template <bool Rates, class P, class R, class V, class W, class A, class AL>
inline constexpr bool is_known<Rates, motion<P, R, V, W, A, AL>> =
    !has_skip<P> && !has_skip<R> && (!Rates || (!has_skip<V> && !has_skip<W>));

/// The elements of a chain that write items, as an index_sequence.
template <class Chain, class Elements = std::make_index_sequence<Chain::size>>
struct writing;
template <class Chain, std::size_t... E>
struct writing<Chain, std::index_sequence<E...>>
    : numbers_where<std::array<bool, sizeof...(E) + 1>{has_output<core_of<Chain, E>>...}> {};

/// The types of the data flow in one evaluation of a chain; `Given` is explained at `unrolled_passes`.
template <class Chain, class Given>
struct flow_types {
  using wiring = typename Chain::wiring;
  template <std::size_t I>
  using core = std::remove_cvref_t<decltype(std::declval<const Chain&>().template core<I>())>;
  template <std::size_t I>
  using inputs = std::make_index_sequence<input_count<core<I>>>;
  template <std::size_t I, std::size_t P>
  static constexpr kind what = core<I>::ports[P].what;
  template <std::size_t I>
  static constexpr kind output_kind = core<I>::ports.back().what;
  template <std::size_t I>
  static constexpr int output_slot = wiring::slot(I, port_count<core<I>> - 1);

  /// External items.
  template <kind K, int Slot>
  KTE_INLINE static constexpr decltype(auto) given(const Given& g) {
    if constexpr (K == kind::input) {
      return g.template input<Slot>();
    } else if constexpr (K == kind::vector) {
      return g.template vector<Slot>();
    } else if constexpr (K == kind::internal) {
      return g.template internal<Slot>();
    } else if constexpr (K == kind::loop) {
      return loop_state<>{};  // of a tree: no forces
    } else if constexpr (K == kind::contact) {
      return contact_state<zero_t>{};
    } else if constexpr (is_frame(K)) {
      return g.template base<K, Slot>();
    } else if constexpr (wiring::template is_free<K, Slot>) {
      return g.template coordinate<K, Slot>();
    } else {
      return g.template fixed<Slot>();
    }
  }
  template <kind K, int Slot>
  static constexpr int writer = K == kind::internal || K == kind::loop || K == kind::contact ? -1
                                                                                             : wiring::writer(K, Slot);

  /// Whether element I writes a coordinate that turns a joint, which needs its sine and cosine.
  template <std::size_t I>
  static constexpr bool turns = output_kind<I> == kind::gen&& wiring::angle(output_slot<I>);

  /// The result of doMotion of element I; empty if it writes nothing. Results are bases of a pass, because the
  /// constructors and functions of tuples, which compilers instantiate for each chain, cost more than everything else.
  template <std::size_t I, class Inputs = inputs<I>>
  struct written {
    using type = no_value;
  };
  /// An item as kernels see it.
  template <kind K, int Slot>
  struct thing {
    using type = typename written<std::size_t{writer<K, Slot>}>::type;
  };
  template <kind K, int Slot>
  requires(writer<K, Slot> < 0) struct thing<K, Slot> {
    using type = std::remove_cvref_t<decltype(given<K, Slot>(std::declval<const Given&>()))>;
  };
  /// The view of element I on the item at port P.
  template <std::size_t I, std::size_t P>
  static constexpr view shown = view_of(what<I, P>, writes_signal<core<I>> && !reads_accelerations<core<I>>,
                                        Given::rates_only);
  template <std::size_t I, std::size_t P>
  using seen = typename viewed_type<shown<I, P>, typename thing<what<I, P>, wiring::slot(I, P)>::type>::type;

  /// The result of doMotion of an element that writes freely. It is evaluated only if everything that it may read is
  /// known.
  template <std::size_t I, class... Seen>
  KTE_INLINE static constexpr auto written_freely(const core<I>& element, const Seen&... x) {
    if constexpr ((is_known<writes_signal<core<I>>, Seen> && ...)) {
      return element.doMotion(x...);
    } else if constexpr (output_kind<I> == kind::input) {
      return skip{};
    } else if constexpr (output_kind<I> == kind::vector) {
      return vec3<skip>{};
    } else {
      constexpr vec3<skip> none{};
      return motion{none, skip{}, none, none, none, none};
    }
  }
  /// What doMotion of element I writes, with the sine and cosine of a coordinate that turns a joint.
  template <std::size_t I, class... Seen>
  KTE_INLINE static constexpr auto moved(const core<I>& element, const Seen&... x) {
    if constexpr (writes_freely<core<I>>) {
      return written_freely<I>(element, x...);
    } else if constexpr (turns<I>) {
      return with_angle(element.doMotion(x...));
    } else {
      return element.doMotion(x...);
    }
  }
  template <std::size_t I, std::size_t... P>
  requires(has_output<core<I>>) struct written<I, std::index_sequence<P...>> {
    using type =
        decltype(flow_types::template moved<I>(std::declval<const core<I>&>(), std::declval<const seen<I, P>&>()...));
    type value;
  };
  /// The indices of the loads on an item.
  template <kind K, int Slot>
  using readers = std::make_index_sequence<loads_on<wiring, K, Slot>.size()>;
  /// The sum of the loads on an item, and the result of doForce of element I.
  template <kind K, int Slot>
  struct total;
  template <std::size_t I, class Inputs = inputs<I>>
  struct loads;
  template <std::size_t I, std::size_t Index>
  using load_at = std::remove_cvref_t<decltype(nth<Index>(std::declval<const typename loads<I>::type&>()))>;
  template <std::size_t I, std::size_t... P>
  struct loads<I, std::index_sequence<P...>> {
    using put = decltype(std::declval<const core<I>&>().doForce(std::declval<const seen<I, P>&>()...));
    static constexpr bool usable = !has_skip<put>;
    using type = typename std::conditional_t<usable, std::type_identity<put>, no_loads<core<I>>>::type;
    type value;
  };
  template <std::size_t I, std::size_t... P>
  requires(writes_signal<core<I>>) struct loads<I, std::index_sequence<P...>> {
    static constexpr bool usable = true;
    using type = typename no_loads<core<I>>::type;
    type value;
  };
  template <std::size_t I, std::size_t... P>
  requires(has_output<core<I>> && !writes_signal<core<I>>) struct loads<I, std::index_sequence<P...>> {
    using load = typename total<output_kind<I>, output_slot<I>>::type;
    /// Whether loads can be evaluated, and whether the element pulls them back: a freely written frame without bodies
    /// has none if positions are omitted.
    static constexpr bool usable = true, pulls_back = !writes_freely<core<I>> ||
                                                      !std::is_same_v<load, std::remove_cvref_t<decltype(no_wrench)>> ||
                                                      (is_known<false, seen<I, P>> && ...);
    template <bool Known>
    struct put {
      using type = typename no_loads<core<I>>::type;
    };
    template <bool Known>
    requires Known struct put<Known> {
      using type = decltype(std::declval<const core<I>&>().doForce(std::declval<const seen<I, P>&>()...,
                                                                   std::declval<const load&>()));
    };
    using type = typename put<pulls_back>::type;
    type value;
  };
  /// The rule that the first element I whose forces depend on omitted quantities has violated; I is `size` if there is
  /// none.
  template <std::size_t I>
  struct need {
    using type = check_need<void, true>;
  };
  template <std::size_t I>
  requires(I < Chain::size) struct need<I> {
    using type = check_need<core<I>, false>;
  };
  template <kind K, int Slot>
  struct total {
    template <std::size_t... I>
    static auto sum(std::index_sequence<I...>) -> decltype((
        no_load<K>() + ... +
        std::declval<load_at<loads_on<wiring, K, Slot>[I].element, loads_on<wiring, K, Slot>[I].index>>()));
    using type = decltype(sum(readers<K, Slot>{}));
  };
};

}  // namespace kte::detail
