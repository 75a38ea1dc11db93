#pragma once

#include <kte/contract/joint.hpp>
#include <kte/dynamics/detail/given.hpp>
#include <kte/dynamics/detail/static_loops.hpp>
#include <kte/dynamics/detail/tree.hpp>
#include <kte/kernels/joint_vector.hpp>

/// The composite-rigid-body algorithm on local variables.
namespace kte::detail {

/// The mass matrix over all coordinates of a chain: the degrees of freedom first, then followers. `Given` has positions
/// without rates and bases of `skip`.
template <class S, class Chain, class Given>
class local_mass {
  using types = local_types<Chain, Given>;
  using wiring = typename Chain::wiring;
  template <std::size_t I>
  using core_t = typename types::template core<I>;

 public:
  static constexpr int coordinates = wiring::dofs + wiring::count(kind::gen) - wiring::gen_dofs;
  using matrix_type = joint_matrix<S, coordinates>;

  KTE_INLINE local_mass(const Chain& c, const Given& g, matrix_type& m) : M(m), chain_(c), motion_(c, g) {
    M.setZero();
    for_each_base<wiring>([&]<kind K, int Slot>() KTE_INLINE_LAMBDA { (void)carried<K, Slot>(); });
    coordinate_masses(std::make_index_sequence<Chain::size>{});
    if constexpr (!written_once) sum_ = detail::zero_or_nan(M.data(), static_cast<std::size_t>(M.size()));
  }
  /// 0 if all numbers are finite, unless they are near to overflow.
  KTE_INLINE S zero_or_nan() const { return sum_ * S(0); }

 private:
  /// The row of the coordinate of element I, which is that of its first port, or of number N of it.
  template <kind K, int Slot>
  static constexpr int row =
      wiring::template is_free<K, Slot> ? wiring::template at<K, Slot>.v : wiring::dofs + Slot - wiring::gen_dofs;
  template <std::size_t I>
  static constexpr int row_of = row<coordinate_kind<core_t<I>>, wiring::slot(I, 0)>;
  template <std::size_t I>
  static constexpr int axes = joint_dofs<core_t<I>>;

  // ---- up the tree: composite inertias, and a column of M at each joint
  /// The inertia carried by a frame, about it and in its axes: `sum`, and that of its readers from number N on. One
  /// after the other: of a sum in one expression g++ makes the last part first, whose numbers then wait in memory.
  template <kind K, int Slot, std::size_t N = 0, class Sum = std::remove_const_t<decltype(no_mass)>>
  KTE_INLINE constexpr auto carried(const Sum& sum = {}) {
    if constexpr (N == loads_on<wiring, K, Slot>.size()) {
      return sum;
    } else {
      return carried<K, Slot, N + 1>(sum + part<loads_on<wiring, K, Slot>[N].element>());
    }
  }
  /// The part of it that comes through element I.
  template <std::size_t I>
  KTE_INLINE constexpr auto part() {
    if constexpr (has_mass<core_t<I>, S>) {
      return chain_.template core<I>().template mass<S>();
    } else if constexpr (is_transmission<core_t<I>>) {
      constexpr kind k = types::template output_kind<I>;
      constexpr int end = types::template output_slot<I>;
      const auto c = carried<k, end>();
      if constexpr (coordinates_of<core_t<I>> == 1)
        for_each_number<axes<I>>([&]<int N>() KTE_INLINE_LAMBDA { column<I, N>(c); });
      const auto x = motion_.template joint_pose<I>();
      return transported(x.rotation, x.position, c);
    } else {
      return no_mass;
    }
  }

  // ---- down the tree: the force of a unit acceleration of joint J, felt at all joints below
  template <std::size_t J, int N, class C>
  KTE_INLINE constexpr void column(const C& composite_inertia) {
    const auto w = accelerating_wrench(composite_inertia, motion_.template joint_axis<J, N>());
    constexpr int j = row_of<J> + N;
    column_ = S(0);
    for_each_number<axes<J>>([&]<int R>() KTE_INLINE_LAMBDA {
      const auto m = power(motion_.template joint_axis<J, R>(), w);
      if constexpr (R < N) put(row_of<J> + R, j, m);
      if constexpr (R == N) M(j, j) = written_once ? as<S>(m) : as<S>(M(j, j) + m), watch(m);
    });
    down<J>(w, j);
    sum_ += column_;
  }
  template <std::size_t I, class W>
  KTE_INLINE constexpr void down(const W& at_end, int column) {
    constexpr std::size_t base_port = port_count<core_t<I>> - 2;
    constexpr int below = wiring::writer(types::template output_kind<I>, wiring::slot(I, base_port));
    if constexpr (below >= 0) {
      const auto w = transmit(motion_.template joint_pose<I>(), at_end);
      if constexpr (coordinates_of<core_t<std::size_t{below}>> == 1)
        for_each_number<axes<std::size_t{below}>>([&]<int N>() KTE_INLINE_LAMBDA {
          put(row_of<std::size_t{below}> + N, column, power(motion_.template joint_axis<std::size_t{below}, N>(), w));
        });
      down<std::size_t{below}>(w, column);
    }
  }
  /// While it is in a register.
  template <class T>
  KTE_INLINE constexpr void watch(const T& x) {
    if constexpr (written_once && variable<T>) column_ += as<S>(x);
  }
  /// Two joints may share a coordinate, so entries add up; where they cannot, each is written once.
  template <class T>
  KTE_INLINE constexpr void put(int i, int j, const T& x) {
    watch(x);
    if constexpr (written_once) {
      M(i, j) = M(j, i) = as<S>(x);
    } else {
      M(i, j) = as<S>(M(i, j) + x);
      M(j, i) = as<S>(M(j, i) + x);
    }
  }
  static constexpr bool written_once = [] {
    bool once = coordinates == wiring::dofs;
    const auto look = [&]<class Core>(std::type_identity<Core>) {
      if (Core::ports[0].what == kind::gen && has_mass<Core, S>) once = false;
      return 0;
    };
    const auto all = [&]<std::size_t... I>(std::index_sequence<I...>) {
      const int done[]{look(std::type_identity<core_t<I>>{})..., 0};
      (void)done;
    };
    all(std::make_index_sequence<Chain::size>{});
    constexpr auto& t = wiring::table;
    for (std::size_t f = 0; f < wiring::freedoms; ++f) {
      int users = 0;
      int p = t.reader[static_cast<std::size_t>(t.free[f].what)][static_cast<std::size_t>(t.free[f].slot)];
      for (; p >= 0; p = t.previous[static_cast<std::size_t>(p)]) ++users;
      once &= users == 1;
    }
    return once;
  }();

  // ---- coordinates: their own masses, and followers
  template <std::size_t... I>
  KTE_INLINE void coordinate_masses(std::index_sequence<I...>) {
    const int done[]{(coordinate_mass<Chain::size - 1 - I>(), 0)..., 0};
    (void)done;
  }
  template <std::size_t I>
  KTE_INLINE void coordinate_mass() {
    constexpr int b = row_of<I>;
    if constexpr (core_t<I>::ports[0].what != kind::gen) {
      return;
    } else if constexpr (has_mass<core_t<I>, S>) {
      M(b, b) = as<S>(M(b, b) + chain_.template core<I>().template mass<S>());
    } else if constexpr (has_output<core_t<I>> && types::template output_kind<I> == kind::gen) {
      constexpr int e = row<kind::gen, types::template output_slot<I>>;  // q_e' = ratio q_b': both its row and column
      const auto& q_b = motion_.template get<kind::gen, wiring::slot(I, 0)>();  // count for b too
      const auto ratio = chain_.template core<I>().doMotion(unit_rate<kind::gen, 0>(q_b)).q_dot;
      for (int c = 0; c < coordinates; ++c) M(b, c) = as<S>(M(b, c) + ratio * M(e, c));
      for (int c = 0; c < coordinates; ++c) M(c, b) = as<S>(M(c, b) + ratio * M(c, e));
    }
  }

  matrix_type& M;
  S column_{0}, sum_{0};  ///< of a column, and of all
  const Chain& chain_;
  const local_motion<Chain, Given> motion_;
};

/// A function of its own: only a variable of its outermost block is made where the caller wants it.
template <class S, class Chain, class Given>
KTE_INLINE auto unrolled_mass_matrix(const Chain& c, const Given& g, S& zero_or_nan) {
  using mass_type = local_mass<S, Chain, Given>;
  typename mass_type::matrix_type m;
  zero_or_nan = mass_type(c, g, m).zero_or_nan();
  if constexpr (mass_type::coordinates == Chain::dofs) {
    return m;
  } else {
    return joint_matrix<S, Chain::dofs>(m.template block<Chain::dofs, Chain::dofs>(0, 0));
  }
}
/// The mass matrix over the degrees of freedom. Of the bases only coordinates that are given matter.
template <class S, class Chain, class Positions, class Base>
KTE_INLINE auto local_mass_matrix(const Chain& c, const Positions& at, const Base& base) {
  static_assert(sizeof(check_loads_of<Chain>) > 0);
  at.check(), base.check();
  const auto bases = only_positions{base, motion{skip{}, skip{}, skip{}, skip{}, skip{}, skip{}}};
  const auto g = given{at, same<skip>{}, same<skip>{}, bases};
  S zero_or_nan;
  const auto m = [&]() KTE_INLINE_LAMBDA {
    if constexpr (is_unrolled<Chain, S>) {
      return unrolled_mass_matrix<S>(c, g, zero_or_nan);
    } else {
      const auto stored = mass_by_tree<S>(c, g);
      zero_or_nan = detail::zero_or_nan(stored.data(), static_cast<std::size_t>(stored.size()));
      return stored;
    }
  }();
  if (!all(zero_or_nan == S(0))) [[unlikely]]  // it may be NaN though all is well
    diagnose_non_finite<typename Chain::wiring>(m, at.q);
  return m;
}

}  // namespace kte::detail
