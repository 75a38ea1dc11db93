#pragma once

#include <kte/dynamics/unrolled/bodies.hpp>
#include <kte/dynamics/unrolled/given.hpp>
#include <kte/recursions/articulated_body.hpp>

#include <algorithm>
#include <cstdint>

/// Forward dynamics of static chains by articulated bodies (recursions/articulated_body.hpp).
namespace kte::detail {

/// The axes of joints whose accelerations are asked for: in `Given` they are typed zeros. Those of others are given.
template <class Chain, class Given>
struct axes_free_under : axes_of_dofs<Chain> {
  template <std::size_t I>
  static constexpr bool is_free = [] {
    if constexpr (is_free_joint<Chain, I>) {
      constexpr int row = axes_of_dofs<Chain>::template row<I>;
      return std::is_same_v<decltype(std::declval<const Given&>().a.template at<row>()), zero_t>;
    } else {
      return false;
    }
  }();
  template <std::size_t I>
  static constexpr int axes = is_free<I> ? joint_dofs<core_of<Chain, I>> : 0;
};

/// Which axes have nothing to move: a bit for each row, the last for all from the 64th on. (Branches at each joint take
/// longer.)
struct unmoved_axes {
  std::uint64_t all = 0;
  std::uint64_t non_finite = 0;  ///< what they move is not finite; of those behind one that moves nothing, neither
};
template <class S>
KTE_INLINE constexpr void note(unmoved_axes& x, int axis, bool moves, const S& moved) {
  const std::uint64_t here = std::uint64_t{1} << (std::min)(axis, 63);
  x.all |= moves ? 0 : here;
  x.non_finite |= all(moved * S(0) == S(0)) ? 0 : here;
}

/// What an element puts that has several ports; that of one with a single port is made when it is wanted.
template <class Core>
inline constexpr bool puts_early = !is_transmission<Core> && (port_count<Core> > 1);
template <class Types, std::size_t I>
struct early_loads {
  static constexpr bool usable = true;
};
template <class Types, std::size_t I>
requires puts_early<typename Types::template core<I>>
struct early_loads<Types, I> {
  static constexpr bool usable = Types::template loads<I>::usable;
  typename Types::template loads<I>::type value{};
};

/// Articulated inertias inward, accelerations outward. `Given` has positions and rates (`rates_only`).
template <class S, class Chain, class Given, class Elements = std::make_index_sequence<Chain::size>>
class articulated_chain;

template <class S, class Chain, class Given, std::size_t... E>
class articulated_chain<S, Chain, Given, std::index_sequence<E...>>
    : public unrolled_motion<Chain, Given>, protected early_loads<flow_types<Chain, Given>, E>... {
  using motion_type = unrolled_motion<Chain, Given>;

 public:
  using typename motion_type::types;
  using typename motion_type::wiring;
  using vector = joint_vector<S, Chain::dofs>;
  using axes = axes_free_under<Chain, Given>;
  using bodies_type = typed_bodies<S, motion_type, axes>;
  template <std::size_t I>
  using core_t = typename types::template core<I>;

  /// The motion that the rates make.
  KTE_INLINE constexpr articulated_chain(const Chain& c, const Given& g) : motion_type(c, g) {}

  /// Accelerations under forces `tau`. Throws `singular_mass_matrix`, and `bad_argument` for NaN.
  KTE_INLINE void accelerate(const vector& tau, vector& a) {
    static_assert(sizeof(need) > 0);
    const int done[]{(push<E>(typename types::template inputs<E>{}), 0)..., 0};
    (void)done;
    const bodies_type bodies{*this};
    const engine::unrolled<bodies_type> d{bodies};
    articulate(d, tau);
    without_joints(tau, a, std::make_index_sequence<wiring::freedoms>{});
    const int given[]{(put_given<E>(a), 0)..., 0};
    (void)given;
    engine::accelerate<engine::nothing>(
        d,
        [this]<class Frame>(Frame) KTE_INLINE_LAMBDA {
          const auto& x = this->template get<Frame::what, Frame::slot>();
          return engine::body_motion{skip{}, skip{}, x.acceleration, x.ang_acceleration};
        },
        rate_biases{*this}, factors_.data(), a.data());
    check_moved();  // not on the way: compilers would move what comes before it behind it
    check_accelerations<wiring>(a, this->given_, tau);
  }

 protected:
  /// What the rates make of the acceleration of the end of a body, in its axes.
  struct rate_biases {
    const articulated_chain& chain;
    template <class Part>
    KTE_INLINE constexpr engine::nothing at(const Part&) const {
      return {};
    }
    template <engine::body B>
    KTE_INLINE constexpr auto of(const B&) const {
      const auto& x = chain.template get<B::end::what, B::end::slot>();
      return engine::bias_motion{skip{}, zero3{}, x.acceleration, x.ang_acceleration};
    }
  };
  /// Into `factors_`.
  template <class Driver>
  KTE_INLINE void articulate(const Driver& d, const vector& tau) {
    engine::articulate<engine::nothing>(
        d, engine::nothing{}, rate_biases{*this},
        [this](const auto& part, engine::nothing) KTE_INLINE_LAMBDA { return no_wrench - load_of(part); },
        [this, &tau]<class B>(const B&) KTE_INLINE_LAMBDA {
          return [this, &tau]<int K>(std::integral_constant<int, K>)
                     KTE_INLINE_LAMBDA { return force_on_axis<B, K>(tau); };
        },
        factors_.data(), unmoved_);
  }
  KTE_INLINE void check_moved() const {
    if (unmoved_.all != 0) [[unlikely]]
      diagnose_axes<wiring>(unmoved_.all, unmoved_.non_finite, this->given_.at.q);
  }

  // ---- what elements put on frames and coordinates
  template <std::size_t I>
  using early = early_loads<types, I>;
  template <std::size_t I, std::size_t... P>
  KTE_INLINE constexpr void push(std::index_sequence<P...>) {
    // No force depends on what writes freely here: what it puts is nothing, as it is made.
    if constexpr (puts_early<core_t<I>> && early<I>::usable && !writes_freely<core_t<I>>)
      static_cast<early<I>&>(*this).value = this->chain_.template core<I>().doForce(
          this->template get<types::template what<I, P>, wiring::slot(I, P), types::template shown<I, P>>()...);
  }
  /// Load Index of element I, which is on thing Slot of kind K.
  template <kind K, int Slot, std::size_t I, std::size_t Index>
  KTE_INLINE constexpr auto load() const {
    if constexpr (is_transmission<core_t<I>>) {
      return no_load<K>();
    } else if constexpr (puts_early<core_t<I>>) {
      return nth<Index>(static_cast<const early<I>&>(*this).value);
    } else {
      return nth<Index>(
          this->chain_.template core<I>().doForce(this->template get<K, Slot, types::template shown<I, 0>>()));
    }
  }
  KTE_INLINE static constexpr auto load_of(no_part) { return no_wrench; }
  template <class Part>
  KTE_INLINE constexpr auto load_of(const Part&) const {
    return load<Part::frame::what, Part::frame::slot, Part::element, Part::index>();
  }
  template <kind K, int Slot>
  KTE_INLINE constexpr auto coordinate_load() const {
    return [this]<std::size_t... N>(std::index_sequence<N...>) KTE_INLINE_LAMBDA {
      constexpr auto& places = loads_on<wiring, K, Slot>;
      return (no_load<K>() + ... + this->template load<K, Slot, places[N].element, places[N].index>());
    }
    (std::make_index_sequence<loads_on<wiring, K, Slot>.size()>{});
  }
  template <class B, int K>
  KTE_INLINE constexpr auto force_on_axis(const vector& tau) const {
    constexpr kind k = coordinate_kind<core_t<B::element>>;
    return tau[B::first() + K] + number_of<k, K>(coordinate_load<k, wiring::slot(B::element, 0)>());
  }

  /// The accelerations of joint I that are given.
  template <std::size_t I>
  KTE_INLINE constexpr void put_given(vector& a) const {
    if constexpr (is_free_joint<Chain, I> && !axes::template is_free<I>)
      for_each_number<joint_dofs<core_t<I>>>([&]<int N>() KTE_INLINE_LAMBDA {
        constexpr int row = axes::template row<I> + N;
        a[row] = this->given_.a.template at<row>();
      });
  }
  /// A degree of freedom that moves no joint, only a mass of its own.
  template <std::size_t F>
  static constexpr bool moves_no_joint() {
    constexpr bool is_joint[]{is_transmission<core_t<E>>...};
    for (const auto& place : loads_on<wiring, wiring::template free<F>.what, wiring::template free<F>.slot>)
      if (is_joint[place.element]) return false;
    return true;
  }
  template <std::size_t... F>
  KTE_INLINE void without_joints(const vector& tau, vector& a, std::index_sequence<F...>) {
    const int done[]{(without_joint<F>(tau, a), 0)..., 0};
    (void)done;
  }
  template <std::size_t F>
  KTE_INLINE constexpr void without_joint(const vector& tau, vector& a) {
    if constexpr (moves_no_joint<F>()) {
      constexpr freedom at = wiring::template free<F>;
      if constexpr (!std::is_same_v<decltype(this->given_.a.template at<at.v>()), zero_t>) {
        a[at.v] = this->given_.a.template at<at.v>();
      } else {
        const S m = as<S>(this->template mass_on_coordinate<S, at.what, at.slot>());
        note(unmoved_, at.v, all(m > S(0)), m);
        a[at.v] = as<S>(tau[at.v] + number_of<at.what, 0>(coordinate_load<at.what, at.slot>())) / m;
      }
    }
  }

  std::array<engine::axis_factors<S>, std::size_t{Chain::dofs} + 1> factors_;  ///< by row
  unmoved_axes unmoved_;

 public:
  using need = typename types::template need<first_false({early<E>::usable..., false})>::type;  // unrolled_passes
};

}  // namespace kte::detail
