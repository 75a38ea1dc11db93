#pragma once

#include <kte/dynamics/unrolled/flow.hpp>

/// The passes of a static chain on frames that are local variables, from which the fused algorithms are built. Each
/// frame has its own type, with typed constants, and `skip` for quantities that are not computed, and is kept in
/// registers.
namespace kte::detail {

/// The motion of a chain in local variables. `Given` provides the inputs:
///   given.template coordinate<K, i>()  coordinate i of kind K, which is a degree of freedom (or several)
///   given.template fixed<i>()          coordinate i, which no element writes and which is no degree of freedom
///   given.template base<K, i>()        frame i of kind K, which no element writes
///   given.template input<i>()          input i, which no element writes; vector<i>() of three numbers
template <class Chain, class Given, class Elements = typename writing<Chain>::type>
class unrolled_motion;

template <class Chain, class Given, std::size_t... E>
class unrolled_motion<Chain, Given, std::index_sequence<E...>>
    : protected flow_types<Chain, Given>::template written<E>... {
 protected:
  template <std::size_t I>
  using written = typename flow_types<Chain, Given>::template written<I>;

 public:
  using chain_type = Chain;
  using types = flow_types<Chain, Given>;
  using wiring = typename Chain::wiring;

  /// doMotion of all elements.
  KTE_INLINE constexpr unrolled_motion(const Chain& c, const Given& g) : chain_(c), given_(g) {
    const int done[]{(static_cast<written<E>&>(*this).value = move<E>(typename types::template inputs<E>{}), 0)..., 0};
    (void)done;
  }
  /// Item Slot of kind K: a coordinate, a frame or an input.
  template <kind K, int Slot, view V = view::whole>
  KTE_INLINE constexpr decltype(auto) get() const {
    constexpr int writer = types::template writer<K, Slot>;
    if constexpr (V != view::whole) {
      return viewed<V>(get<K, Slot>());
    } else if constexpr (writer >= 0) {
      return (static_cast<const written<std::size_t{writer}>&>(*this).value);
    } else {
      return types::template given<K, Slot>(given_);
    }
  }

  /// The coordinate of joint I; a tuple for several.
  template <std::size_t I>
  KTE_INLINE constexpr decltype(auto) joint_coordinate() const {
    using core = typename types::template core<I>;
    if constexpr (coordinates_of < core >> 1) {
      return tuple_of_coordinates<core>([this]<std::size_t K>() { return get<kind::gen, wiring::slot(I, K)>(); });
    } else {
      return get<coordinate_kind<core>, wiring::slot(I, 0)>();
    }
  }
  /// The pose of joint or link I at its current position.
  template <std::size_t I>
  KTE_INLINE constexpr auto joint_pose() const {
    if constexpr (coordinates_of<typename types::template core<I>> == 0) {
      return chain_.template core<I>().relative();
    } else {
      return relative_at(chain_.template core<I>(), position_only(joint_coordinate<I>()));
    }
  }
  /// Axis N of joint I, in the axes of its end.
  template <std::size_t I, int N>
  KTE_INLINE constexpr auto joint_axis() const {
    return axis_of<N>(chain_.template core<I>(), joint_coordinate<I>());
  }
  KTE_INLINE constexpr const Chain& chain() const { return chain_; }
  /// The sum of the masses on coordinate Slot of kind K, kg or kg m^2.
  template <class S, kind K, int Slot>
  KTE_INLINE constexpr auto mass_on_coordinate() const {
    const auto mass = [this]<std::size_t I>() KTE_INLINE_LAMBDA {
      if constexpr (K == kind::gen && has_mass<typename types::template core<I>, S>) {
        return chain_.template core<I>().template mass<S>();
      } else {
        return zero;
      }
    };
    return [&mass]<std::size_t... N>(std::index_sequence<N...>) KTE_INLINE_LAMBDA {
      return (zero + ... + mass.template operator()<loads_on<wiring, K, Slot>[N].element>());
    }
    (std::make_index_sequence<loads_on<wiring, K, Slot>.size()>{});
  }

 protected:
  const Chain& chain_;
  const Given& given_;

 private:
  template <std::size_t I, std::size_t... P>
  KTE_INLINE constexpr typename written<I>::type move(std::index_sequence<P...>) const {
    return types::template moved<I>(
        chain_.template core<I>(),
        get<types::template what<I, P>, wiring::slot(I, P), types::template shown<I, P>>()...);
  }
};

/// Motion, then forces, of a chain in local variables.
template <class Chain, class Given, class Elements = std::make_index_sequence<Chain::size>>
class unrolled_passes;

/// The loads are its base classes from the last element to the first. Types are therefore complete without deep
/// recursion, because compilers limit the depth of templates.
template <class Chain, class Given, std::size_t... E>
class unrolled_passes<Chain, Given, std::index_sequence<E...>>
    : public unrolled_motion<Chain, Given>, flow_types<Chain, Given>::template loads<Chain::size - 1 - E>... {
 public:
  using typename unrolled_motion<Chain, Given>::types;
  using typename unrolled_motion<Chain, Given>::wiring;
  template <std::size_t I>
  using loads = typename types::template loads<I>;

  /// doMotion, then doForce of all elements.
  KTE_INLINE constexpr unrolled_passes(const Chain& c, const Given& g) : unrolled_motion<Chain, Given>(c, g) {
    static_assert(sizeof(need) > 0);
    const int done[]{(static_cast<loads<Chain::size - 1 - E>&>(*this).value =
                          push<Chain::size - 1 - E>(typename types::template inputs<Chain::size - 1 - E>{}),
                      0)...,
                     0};
    (void)done;
  }
  /// The sum of the loads of elements on item Slot of kind K.
  template <kind K, int Slot>
  KTE_INLINE constexpr auto load() const {
    return sum<K, Slot>(typename types::template readers<K, Slot>{});
  }

 private:
  template <std::size_t I, std::size_t... P>
  KTE_INLINE constexpr typename loads<I>::type push(std::index_sequence<P...>) const {
    using core = typename types::template core<I>;
    if constexpr (writes_signal<core> || !loads<I>::usable) {
      return {};
    } else if constexpr (has_output<core>) {
      if constexpr (loads<I>::pulls_back) {
        constexpr kind k = types::template output_kind<I>;
        constexpr int slot = types::template output_slot<I>;
        return this->chain_.template core<I>().doForce(
            this->template get<types::template what<I, P>, wiring::slot(I, P), types::template shown<I, P>>()...,
            sum<k, slot>(typename types::template readers<k, slot>{}));
      } else {
        return {};
      }
    } else {
      return this->chain_.template core<I>().doForce(
          this->template get<types::template what<I, P>, wiring::slot(I, P), types::template shown<I, P>>()...);
    }
  }
  template <kind K, int Slot, std::size_t... N>
  KTE_INLINE constexpr auto sum(std::index_sequence<N...>) const {
    constexpr auto& places = loads_on<wiring, K, Slot>;
    return (no_load<K>() + ... + nth<places[N].index>(static_cast<const loads<places[N].element>&>(*this).value));
  }

 public:
  /// A rule about the needs of elements. Public functions check it, so that its message appears near the top.
  using need = typename types::template need<first_false({loads<E>::usable..., false})>::type;
};

}  // namespace kte::detail
