#pragma once

#include <kte/dynamics/detail/given.hpp>
#include <kte/dynamics/detail/tree.hpp>
#include <kte/kernels/articulate.hpp>

/// The articulated-body algorithm on local variables.
namespace kte::detail {

/// Whether element I is a joint whose acceleration is asked for: in `Given` it is then a typed zero.
template <class Chain, class Given, std::size_t I>
inline constexpr bool is_free_joint_under = [] {
  if constexpr (is_free_joint<Chain, I>) {
    constexpr freedom at =
        Chain::wiring::template at<coordinate_kind<typename Chain::template core_type<I>>, Chain::wiring::slot(I, 0)>;
    return std::is_same_v<decltype(std::declval<const Given&>().a.template at<at.v>()), zero_t>;
  } else {
    return false;
  }
}();

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
/// How joint I answers forces, if it moves under them.
template <class S, class Chain, class Given, std::size_t I>
struct response_of {};
template <class S, class Chain, class Given, std::size_t I>
requires is_free_joint_under<Chain, Given, I>
struct response_of<S, Chain, Given, I> {
  joint_response<S, joint_dofs<core_of<Chain, I>>> value{};
};

/// Articulated inertias up the tree, accelerations down the tree. `Given` has positions and rates (`rates_only`).
template <class S, class Chain, class Given, class Elements = std::make_index_sequence<Chain::size>>
class local_articulated;

template <class S, class Chain, class Given, std::size_t... E>
class local_articulated<S, Chain, Given, std::index_sequence<E...>>
    : protected local_motion<Chain, Given>,
      protected early_loads<local_types<Chain, Given>, E>...,
      protected response_of<S, Chain, Given, E>... {
 protected:
  using typename local_motion<Chain, Given>::types;
  using typename local_motion<Chain, Given>::wiring;
  template <std::size_t I>
  using core_t = typename types::template core<I>;
  template <std::size_t I>
  static constexpr bool rigid = is_transmission<core_t<I>>;
  /// Whether joint I moves under forces; otherwise its acceleration is given.
  template <std::size_t I>
  static constexpr bool is_free = is_free_joint_under<Chain, Given, I>;

 public:
  using vector = joint_vector<S, Chain::dofs>;

  /// The motion that the rates make.
  KTE_INLINE constexpr local_articulated(const Chain& c, const Given& g) : local_motion<Chain, Given>(c, g) {}
  /// Accelerations under forces `tau`. Throws `singular_mass_matrix`, and `bad_argument` for NaN.
  KTE_INLINE void accelerate(const vector& tau, vector& a) {
    static_assert(sizeof(need) > 0);
    const int done[]{(push<E>(typename types::template inputs<E>{}), 0)..., 0};
    (void)done;
    tau_ = &tau, a_ = &a;
    for_each_base<wiring>([&]<kind K, int Slot>() KTE_INLINE_LAMBDA { (void)carried<K, Slot>(); });
    masses(std::make_index_sequence<wiring::freedoms>{});
    for_each_base<wiring>([&]<kind K, int Slot>() KTE_INLINE_LAMBDA { from_base<K, Slot>(); });
    check_good();  // not on the way: compilers would move what comes before it behind it
    check_accelerations<wiring>(a, this->given_, tau);
  }

 protected:
  KTE_INLINE void check_good() const {
    if (unmoved_.all != 0) [[unlikely]]
      diagnose_masses<wiring>(unmoved_.all, unmoved_.non_finite, this->given_.at.q);
  }
  template <std::size_t... F>
  KTE_INLINE void masses(std::index_sequence<F...>) {
    const int done[]{(without_joint<F>(), 0)..., 0};
    (void)done;
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
  template <kind K, int Slot, std::size_t N>
  KTE_INLINE constexpr auto load() const {
    constexpr auto place = loads_on<wiring, K, Slot>[N];
    if constexpr (rigid<place.element>) {
      return no_load<K>();
    } else if constexpr (puts_early<core_t<place.element>>) {
      return nth<place.index>(static_cast<const early<place.element>&>(*this).value);
    } else {
      return nth<place.index>(this->chain_.template core<place.element>().doForce(
          this->template get<K, Slot, types::template shown<place.element, 0>>()));
    }
  }
  template <kind K, int Slot, std::size_t... N>
  KTE_INLINE constexpr auto coordinate_load(std::index_sequence<N...>) const {
    return (no_load<K>() + ... + load<K, Slot, N>());
  }
  template <kind K, int Slot, std::size_t... N>
  KTE_INLINE constexpr auto coordinate_mass(std::index_sequence<N...>) const {
    const auto mass = [this]<std::size_t I>() KTE_INLINE_LAMBDA {
      if constexpr (K == kind::gen && has_mass<core_t<I>, S>) {
        return this->chain_.template core<I>().template mass<S>();
      } else {
        return zero;
      }
    };
    return (zero + ... + mass.template operator()<loads_on<wiring, K, Slot>[N].element>());
  }

  // ---- joints
  template <std::size_t I>
  static constexpr kind kind_of = coordinate_kind<core_t<I>>;
  template <std::size_t I>
  static constexpr int slot_of = wiring::slot(I, 0);
  template <std::size_t I>
  static constexpr int row_of = wiring::template at<kind_of<I>, slot_of<I>>.v;
  template <std::size_t I>
  KTE_INLINE constexpr auto& response() {
    return static_cast<response_of<S, Chain, Given, I>&>(*this).value;
  }
  /// The further mass on the coordinate of joint I.
  template <std::size_t I>
  KTE_INLINE constexpr auto mass_on() const {
    return coordinate_mass<kind_of<I>, slot_of<I>>(readers<kind_of<I>, slot_of<I>>);
  }
  /// The acceleration that the rates make, at the end of element I.
  template <std::size_t I>
  KTE_INLINE constexpr decltype(auto) bias() const {
    return this->template get<types::template output_kind<I>, types::template output_slot<I>>();
  }

  /// The place of a coordinate among those that are free.
  template <kind K, int Slot>
  static constexpr std::size_t number_of_freedom = [] {
    std::size_t f = 0;
    while (wiring::table.free[f].what != K || wiring::table.free[f].slot != Slot) ++f;
    return f;
  }();

  // ---- up the tree
  template <kind K, int Slot>
  static constexpr auto readers = std::make_index_sequence<loads_on<wiring, K, Slot>.size()>{};
  /// `sum`, and what the readers of a frame from number N on put on it: one after the other, as in local_mass.hpp.
  template <kind K, int Slot, std::size_t N = 0, class Sum = std::remove_const_t<decltype(no_articulated_frame)>>
  KTE_INLINE constexpr auto carried(const Sum& sum = {}) {
    if constexpr (N == loads_on<wiring, K, Slot>.size()) {
      return sum;
    } else {
      return carried<K, Slot, N + 1>(sum + part<K, Slot, N>());
    }
  }
  template <kind K, int Slot, std::size_t N>
  KTE_INLINE constexpr auto part() {
    constexpr std::size_t element = loads_on<wiring, K, Slot>[N].element;
    if constexpr (rigid<element>) {
      return through<element>();
    } else if constexpr (has_mass<core_t<element>, S>) {
      return articulated_frame{to_articulated(this->chain_.template core<element>().template mass<S>()),
                               load<K, Slot, N>()};
    } else {
      return articulated_frame{no_articulated, load<K, Slot, N>()};
    }
  }
  /// What the end of element I carries, seen from its base.
  template <std::size_t I>
  KTE_INLINE constexpr auto through() {
    const auto b = carried<types::template output_kind<I>, types::template output_slot<I>>();
    if constexpr (is_free<I>) {
      constexpr kind k = kind_of<I>;
      constexpr int slot = slot_of<I>, v = wiring::template at<k, slot>.v;
      const auto f = coordinate_load<k, slot>(readers<k, slot>);
      unmoved_.at(number_of_freedom<k, slot>);
      return carried_by_joint<S>(
          this->chain_.template core<I>(), this->template joint_coordinate<I>(), bias<I>(), b,
          [&]<int N>() KTE_INLINE_LAMBDA { return (*tau_)[v + N] + number_of<k, N>(f); }, mass_on<I>(), response<I>(),
          unmoved_);
    } else {
      return carried_rigidly(this->template joint_pose<I>(), bias<I>(), b);
    }
  }

  // ---- down the tree
  template <kind K, int Slot>
  KTE_INLINE constexpr void from_base() {
    const auto& x = this->template get<K, Slot>();
    accelerate_all<K, Slot>(acceleration{x.acceleration, x.ang_acceleration}, readers<K, Slot>);
  }
  template <kind K, int Slot, class A, std::size_t... N>
  KTE_INLINE constexpr void accelerate_all(const A& a, std::index_sequence<N...>) {
    const int done[]{(accelerate<loads_on<wiring, K, Slot>[N].element>(a), 0)..., 0};
    (void)done;
  }
  template <std::size_t I, class A>
  KTE_INLINE constexpr void accelerate(const A& base) {
    if constexpr (rigid<I>) accelerate_one<I>(base);
  }
  template <std::size_t I, class A>
  KTE_INLINE constexpr void accelerate_one(const A& base) {
    constexpr kind k = types::template output_kind<I>;
    constexpr int end = types::template output_slot<I>;
    const auto before = carried_acceleration(this->template joint_pose<I>(), bias<I>(), base);
    if constexpr (is_free<I>) {
      constexpr int v = wiring::template at<kind_of<I>, slot_of<I>>.v;
      accelerate_all<k, end>(
          accelerated(this->chain_.template core<I>(), this->template joint_coordinate<I>(), response<I>(),
                      mass_on<I>(), before, [this](int n, const S& x) KTE_INLINE_LAMBDA { (*a_)[v + n] = x; }),
          readers<k, end>);
    } else {
      if constexpr (is_free_joint<Chain, I>) put_given<I>(std::make_integer_sequence<int, joint_dofs<core_t<I>>>{});
      accelerate_all<k, end>(before, readers<k, end>);
    }
  }
  /// The accelerations of a joint that are given.
  template <std::size_t I, int... N>
  KTE_INLINE constexpr void put_given(std::integer_sequence<int, N...>) {
    constexpr int v = wiring::template at<kind_of<I>, slot_of<I>>.v;
    const int done[]{((*a_)[v + N] = this->given_.a.template at<v + N>(), 0)...};
    (void)done;
  }
  /// A degree of freedom that moves no joint, only a mass of its own.
  template <std::size_t F>
  static constexpr bool moves_no_joint() {
    constexpr bool is_rigid[]{rigid<E>...};
    for (const auto& place : loads_on<wiring, wiring::template free<F>.what, wiring::template free<F>.slot>)
      if (is_rigid[place.element]) return false;
    return true;
  }
  template <std::size_t F>
  KTE_INLINE constexpr void without_joint() {
    if constexpr (moves_no_joint<F>()) {
      constexpr freedom at = wiring::template free<F>;
      if constexpr (!std::is_same_v<decltype(this->given_.a.template at<at.v>()), zero_t>) {
        (*a_)[at.v] = this->given_.a.template at<at.v>();
      } else {
        const S m = as<S>(coordinate_mass<at.what, at.slot>(readers<at.what, at.slot>));
        unmoved_.at(F);
        judge(unmoved_, all(m > S(0)), m);
        const auto f = coordinate_load<at.what, at.slot>(readers<at.what, at.slot>);
        (*a_)[at.v] = as<S>((*tau_)[at.v] + number_of<at.what, 0>(f)) / m;
      }
    }
  }

  const vector* tau_ = nullptr;
  vector* a_ = nullptr;
  unmoved unmoved_;

 public:
  using need = typename types::template need<first_false({early<E>::usable..., false})>::type;  // local_pass
};

}  // namespace kte::detail
