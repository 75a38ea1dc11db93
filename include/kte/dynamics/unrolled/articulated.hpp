#pragma once

#include <kte/detail/unroll.hpp>
#include <kte/dynamics/unrolled/bodies.hpp>
#include <kte/dynamics/unrolled/given.hpp>
#include <kte/recursions/articulated_body.hpp>

#include <algorithm>
#include <cstdint>

/// Forward dynamics of static chains by articulated bodies (recursions/articulated_body.hpp).
namespace kte::detail {

/// The axes of joints whose accelerations are unknown: those whose accelerations in `Given` are typed zeros. Others are
/// prescribed.
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

/// Axes that move no mass: a bit for each row, the last bit for all rows from 64 on. (Branches at each joint would take
/// longer.)
struct unmoved_axes {
  std::uint64_t all = 0;
  std::uint64_t non_finite =
      0;  ///< axes whose inertia is not finite, including those inward of an axis that moves nothing
};
template <class S>
KTE_INLINE constexpr void note(unmoved_axes& x, int axis, bool moves, const S& moved) {
  const std::uint64_t here = std::uint64_t{1} << (std::min)(axis, 63);
  x.all |= moves ? 0 : here;
  x.non_finite |= all(moved * S(0) == S(0)) ? 0 : here;
}

/// Whether the loads of an element with several ports are computed early. Loads of elements with one port are computed
/// when needed.
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

/// The drive of a joint or link: forces on its axes, and the bias acceleration due to rates.
template <class Forces, class Bias>
struct joint_drive {
  Forces forces;
  Bias bias;
};
template <class Forces, class Bias>
joint_drive(Forces, Bias) -> joint_drive<Forces, Bias>;
/// A body as the recursion reads it.
struct force_of_body {
  template <class B>
  KTE_INLINE constexpr auto operator()(const B& b) const {
    return [&b]<int K>(std::integral_constant<int, K>) KTE_INLINE_LAMBDA { return nth<std::size_t{K}>(b.more.forces); };
  }
};
struct bias_of_body {
  template <class Part>
  KTE_INLINE constexpr engine::no_value at(const Part&) const {
    return {};
  }
  template <engine::body B>
  KTE_INLINE constexpr const auto& of(const B& b) const {
    return b.more.bias;
  }
};
struct own_bias_force {
  template <class Part>
  KTE_INLINE constexpr auto operator()(const Part& part, engine::no_value) const {
    return no_wrench - part.more;
  }
};

/// The bodies of an `articulated_chain` under forces `tau`.
template <class S, class Chain, class Axes>
class driven_bodies : public typed_bodies<S, Chain, Axes> {
  using base = typed_bodies<S, Chain, Axes>;
  using vector = typename Chain::vector;
  const vector& tau_;

 public:
  KTE_INLINE constexpr driven_bodies(const Chain& c, const vector& tau) : base(c), tau_(tau) {}

  template <std::size_t I>
  KTE_INLINE constexpr auto body() const {
    using frame = typename base::template end<I>;
    const auto& x = this->motion_.template get<frame::what, frame::slot>();
    return [&]<int... K>(std::integer_sequence<int, K...>) KTE_INLINE_LAMBDA {
      return base::template body_with<I>(base::template own_mass<I>(), [&]() KTE_INLINE_LAMBDA {
        return joint_drive{
            make_loads(this->motion_.template force_on_axis<I, K>(tau_)...),
            engine::bias_motion{skip{}, zero3{}, engine::fresh(x.acceleration), engine::fresh(x.ang_acceleration)}};
      });
    }
    (std::make_integer_sequence<int, Axes::template axes<I>>{});
  }
  template <class Frame, std::size_t N>
  KTE_INLINE constexpr auto fixed() const {
    return base::template fixed_with<Frame, N>([this]() KTE_INLINE_LAMBDA {
      constexpr load_place at = base::template place<Frame, N>;
      return this->motion_.template load<Frame::what, Frame::slot, at.element, at.index>();
    });
  }
  static constexpr auto none() { return base::none_with(no_wrench); }
};

struct no_change {
  template <class Bodies>
  KTE_INLINE constexpr void operator()(const Bodies&) const {}
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
  template <std::size_t I>
  using core_t = typename types::template core<I>;

  /// Computes the motion due to rates.
  KTE_INLINE constexpr articulated_chain(const Chain& c, const Given& g) : motion_type(c, g) {}

  /// Accelerations under forces `tau`. Throws `singular_mass_matrix`, and `bad_argument` for NaN. Before the outward
  /// recursion it calls change(bodies), which may change `factors_`.
  template <class Change = no_change>
  KTE_INLINE void accelerate(const vector& tau, vector& a, const Change& change = {}) {
    static_assert(sizeof(need) > 0);
    const int done[]{(push<E>(typename types::template inputs<E>{}), 0)..., 0};
    (void)done;
    using bodies_type = driven_bodies<S, articulated_chain, axes>;
    const bodies_type bodies(*this, tau);
    const engine::unrolled<bodies_type> d{bodies};
    engine::articulate<engine::no_value>(d, engine::no_value{}, bias_of_body{}, own_bias_force{}, force_of_body{},
                                         factors_.data(), unmoved_);
    change(bodies);
    unroll<wiring::freedoms>([&]<std::size_t F>() KTE_INLINE_LAMBDA { this->template without_joint<F>(tau, a); });
    const int given[]{(put_given<E>(a), 0)..., 0};
    (void)given;
    engine::accelerate<engine::no_value>(
        d,
        [this]<class Frame>(Frame) KTE_INLINE_LAMBDA {
          const auto& x = this->template get<Frame::what, Frame::slot>();
          return engine::body_motion{skip{}, skip{}, engine::fresh(x.acceleration), engine::fresh(x.ang_acceleration)};
        },
        bias_of_body{}, factors_.data(), a.data());
    check_moved();  // last, because compilers would reorder code across it
    check_accelerations<wiring>(a, this->given_, tau);
  }

  /// Load Index of element I, on item Slot of kind K.
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
  /// The force on axis K of joint I, and the own mass of its coordinate.
  template <std::size_t I, int K>
  KTE_INLINE constexpr auto force_on_axis(const vector& tau) const {
    constexpr kind k = coordinate_kind<core_t<I>>;
    return tau[axes::template row<I> + K] + number_of<k, K>(coordinate_load<k, wiring::slot(I, 0)>());
  }

 protected:
  KTE_INLINE void check_moved() const {
    if (unmoved_.all != 0) [[unlikely]]
      diagnose_axes<wiring>(unmoved_.all, unmoved_.non_finite, this->given_.at.q);
  }

  // ---- loads of elements on frames and coordinates
  template <std::size_t I>
  using early = early_loads<types, I>;
  template <std::size_t I, std::size_t... P>
  KTE_INLINE constexpr void push(std::index_sequence<P...>) {
    // No force depends on freely written items here, so their loads are zero.
    if constexpr (puts_early<core_t<I>> && early<I>::usable && !writes_freely<core_t<I>>)
      static_cast<early<I>&>(*this).value = this->chain_.template core<I>().doForce(
          this->template get<types::template what<I, P>, wiring::slot(I, P), types::template shown<I, P>>()...);
  }
  template <kind K, int Slot>
  KTE_INLINE constexpr auto coordinate_load() const {
    return [this]<std::size_t... N>(std::index_sequence<N...>) KTE_INLINE_LAMBDA {
      constexpr auto& places = loads_on<wiring, K, Slot>;
      return (no_load<K>() + ... + this->template load<K, Slot, places[N].element, places[N].index>());
    }
    (std::make_index_sequence<loads_on<wiring, K, Slot>.size()>{});
  }
  /// Stores the prescribed accelerations of joint I.
  template <std::size_t I>
  KTE_INLINE constexpr void put_given(vector& a) const {
    if constexpr (is_free_joint<Chain, I> && !axes::template is_free<I>)
      unroll<joint_dofs<core_t<I>>>([&]<int N>() KTE_INLINE_LAMBDA {
        constexpr int row = axes::template row<I> + N;
        a[row] = this->given_.a.template at<row>();
      });
  }
  /// A degree of freedom that moves no joint, only its own mass.
  template <std::size_t F>
  static constexpr bool moves_no_joint() {
    constexpr bool is_joint[]{is_transmission<core_t<E>>...};
    for (const auto& place : loads_on<wiring, wiring::template free<F>.what, wiring::template free<F>.slot>)
      if (is_joint[place.element]) return false;
    return true;
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
