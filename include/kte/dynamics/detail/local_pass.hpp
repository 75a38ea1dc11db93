#pragma once

#include <kte/dynamics/detail/local_types.hpp>

/// The passes of a static chain on frames that are local variables: the fused algorithms are made of these. Each frame
/// has its own type, with typed constants and `skip` where nothing is to be computed, and lives in registers.
namespace kte::detail {

/// The motion of a chain on local variables. `Given` says what comes from outside:
///   given.template coordinate<K, i>()  coordinate i of kind K, which is a degree of freedom (or several)
///   given.template fixed<i>()          coordinate i, which no element writes and which is no degree of freedom
///   given.template base<K, i>()        frame i of kind K, which no element writes
///   given.template input<i>()          input i, which no element writes; vector<i>() of three numbers
template <class Chain, class Given, class Elements = std::make_index_sequence<Chain::size>>
class local_motion;

template <class Chain, class Given, std::size_t... E>
class local_motion<Chain, Given, std::index_sequence<E...>> {
 protected:
  using types = local_types<Chain, Given>;
  using wiring = typename Chain::wiring;

 public:
  /// doMotion of all elements.
  KTE_INLINE constexpr local_motion(const Chain& c, const Given& g) : chain_(c), given_(g) {
    const int done[]{(move<E>(typename types::template inputs<E>{}), 0)..., 0};
    (void)done;
  }
  /// Thing Slot of kind K: a coordinate, a frame, an input.
  template <kind K, int Slot>
  KTE_INLINE constexpr decltype(auto) get() const {
    constexpr int writer = types::template writer<K, Slot>;
    if constexpr (writer >= 0) {
      return (boost::hana::at_c<std::size_t{writer}>(motions_));
    } else {
      return types::template given<K, Slot>(given_);
    }
  }

  /// The coordinate of joint I.
  template <std::size_t I>
  KTE_INLINE constexpr decltype(auto) joint_coordinate() const {
    return get<coordinate_kind<typename types::template core<I>>, wiring::slot(I, 0)>();
  }
  /// Joint or link I in its present position, without rates.
  template <std::size_t I>
  KTE_INLINE constexpr auto joint_pose() const {
    if constexpr (coordinates_of<typename types::template core<I>> == 0) {
      return chain_.template core<I>().relative();
    } else {
      return chain_.template core<I>().relative(position_only(joint_coordinate<I>()));
    }
  }
  /// Axis N of joint I, in axes of its end.
  template <std::size_t I, int N>
  KTE_INLINE constexpr auto joint_axis() const {
    return axis_of<N>(chain_.template core<I>(), joint_coordinate<I>());
  }

 protected:
  /// What port P of element I sees.
  template <std::size_t I, std::size_t P>
  KTE_INLINE constexpr decltype(auto) seen() const {
    constexpr kind k = types::template what<I, P>;
    if constexpr (types::template as_it_is<I, k>) {
      return get<k, wiring::slot(I, P)>();
    } else {
      return types::template shown<I, k>(get<k, wiring::slot(I, P)>());
    }
  }
  const Chain& chain_;
  const Given& given_;

 private:
  template <std::size_t I, std::size_t... P>
  KTE_INLINE constexpr void move(std::index_sequence<P...>) {
    if constexpr (has_output<typename types::template core<I>>)
      boost::hana::at_c<I>(motions_) = types::template finish<I>(chain_.template core<I>().doMotion(seen<I, P>()...));
  }
  boost::hana::tuple<typename types::template written<E>::type...> motions_;
};

/// Motion, then forces, of a chain on local variables.
template <class Chain, class Given, class Elements = std::make_index_sequence<Chain::size>>
class local_pass;

template <class Chain, class Given, std::size_t... E>
class local_pass<Chain, Given, std::index_sequence<E...>> : public local_motion<Chain, Given> {
 protected:
  using typename local_motion<Chain, Given>::types;
  using typename local_motion<Chain, Given>::wiring;

 public:
  using chain_type = Chain;
  /// doMotion, then doForce of all elements.
  KTE_INLINE constexpr local_pass(const Chain& c, const Given& g) : local_motion<Chain, Given>(c, g) {
    static_assert(sizeof(need) > 0);
    const int done[]{(push<Chain::size - 1 - E>(typename types::template inputs<Chain::size - 1 - E>{}), 0)..., 0};
    (void)done;
  }
  /// The sum of the loads that elements have put on thing Slot of kind K.
  template <kind K, int Slot>
  KTE_INLINE constexpr auto load() const {
    return sum<K, Slot>(std::make_index_sequence<loads_on<wiring, K, Slot>.size()>{});
  }

 private:
  template <std::size_t I, std::size_t... P>
  KTE_INLINE constexpr void push(std::index_sequence<P...>) {
    const auto& core = this->chain_.template core<I>();
    if constexpr (writes_signal<typename types::template core<I>>) {
      (void)core;
    } else if constexpr (has_output<typename types::template core<I>>) {
      boost::hana::at_c<I>(loads_) = core.doForce(
          this->template seen<I, P>()..., load<types::template output_kind<I>, types::template output_slot<I>>());
    } else if constexpr (types::template loads<I>::usable) {
      boost::hana::at_c<I>(loads_) = core.doForce(this->template seen<I, P>()...);
    }
  }
  template <kind K, int Slot, std::size_t... N>
  KTE_INLINE constexpr auto sum(std::index_sequence<N...>) const {
    constexpr auto& places = loads_on<wiring, K, Slot>;
    return (no_load<K>() + ... + boost::hana::at_c<places[N].index>(boost::hana::at_c<places[N].element>(loads_)));
  }

  // Asks for the types from the last element to the first, so that none has to wait for a long row of others: compilers
  // limit the depth of templates.
  static_assert(sizeof(void (*)(typename types::template loads<Chain::size - 1 - E>::type*...)) > 0);
  boost::hana::tuple<typename types::template loads<E>::type...> loads_;

 public:
  /// A rule about what elements need. Functions that users call ask for it, so that little stands above its sentence.
  using need = typename types::template need<first_false({types::template loads<E>::usable..., false})>::type;
};

}  // namespace kte::detail
