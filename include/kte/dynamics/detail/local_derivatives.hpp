#pragma once

#include <kte/dynamics/detail/given.hpp>
#include <kte/dynamics/detail/tree.hpp>
#include <kte/kernels/variation.hpp>

/// Derivatives of inverse dynamics on local variables.
namespace kte::detail {

/// Motion, forces, and the derivatives of the forces on joints, of a tree of joints (kernels/variation.hpp): column j
/// runs from joint j down to the base as a change of wrench, row i as a sensitivity.
template <class S, class Chain, class Given>
class local_derivatives : local_pass<Chain, Given> {
  using typename local_pass<Chain, Given>::types;
  using typename local_pass<Chain, Given>::wiring;
  template <std::size_t I>
  using core_t = typename types::template core<I>;

 public:
  using matrix = joint_matrix<S, Chain::dofs>;

  /// Adds the derivatives to matrices of zeros.
  KTE_INLINE local_derivatives(const Chain& c, const Given& g, matrix& by_q, matrix& by_v, matrix& by_a)
      : local_pass<Chain, Given>(c, g), by_q_(by_q), by_v_(by_v), by_a_(by_a) {
    for_each_base<wiring>([&]<kind K, int Slot>() KTE_INLINE_LAMBDA { (void)carried<K, Slot>(); });
  }
  /// The forces themselves.
  using local_pass<Chain, Given>::load;
  using typename local_pass<Chain, Given>::chain_type;

 private:
  // ---- elements
  template <std::size_t I>
  static constexpr int row_of = wiring::template at<coordinate_kind<core_t<I>>, wiring::slot(I, 0)>.v;
  template <std::size_t I>
  static constexpr int axes = is_free_joint<Chain, I> ? joint_dofs<core_t<I>> : 0;
  template <std::size_t I>
  KTE_INLINE constexpr auto relative() const {
    if constexpr (coordinates_of<core_t<I>> == 1) {
      return this->chain_.template core<I>().relative(this->template joint_coordinate<I>());
    } else {
      return this->chain_.template core<I>().relative();
    }
  }
  template <std::size_t I>
  static constexpr kind frame_kind = types::template output_kind<I>;
  template <std::size_t I>
  static constexpr int base_slot = wiring::slot(I, port_count<core_t<I>> - 2);
  template <std::size_t I>
  KTE_INLINE constexpr decltype(auto) at_base() const {
    return this->template get<frame_kind<I>, base_slot<I>>();
  }
  template <std::size_t I, int N>
  KTE_INLINE constexpr auto displaced() const {
    return by_displacement(relative<I>(), this->template joint_axis<I, N>(), at_base<I>());
  }
  template <std::size_t I, int N>
  KTE_INLINE constexpr auto faster() const {
    return by_rate(relative<I>(), this->template joint_axis<I, N>(), at_base<I>());
  }

  // ---- up the tree: what a frame carries
  /// `sum`, and what comes through the readers from number N on: one after the other, as in local_mass.hpp.
  template <kind K, int Slot, std::size_t N = 0, class Sum = std::remove_const_t<decltype(no_turning_body)>>
  KTE_INLINE constexpr auto carried(const Sum& sum = {}) {
    if constexpr (N == loads_on<wiring, K, Slot>.size()) {
      return sum;
    } else {
      return carried<K, Slot, N + 1>(sum + part<loads_on<wiring, K, Slot>[N].element>());
    }
  }
  template <std::size_t I>
  KTE_INLINE constexpr auto part() {
    if constexpr (is_transmission<core_t<I>>) {
      const auto c = carried<frame_kind<I>, types::template output_slot<I>>();
      for_each_number<axes<I>>([&]<int N>() KTE_INLINE_LAMBDA { own<I, N>(c); });
      const auto x = relative<I>();
      return turning_body{transported(x.rotation, x.position, c.inertia),
                          gyration_through(x, at_base<I>().ang_velocity, c.inertia, c.gyration)};
    } else if constexpr (has_mass<core_t<I>, S>) {
      const auto i = this->chain_.template core<I>().template mass<S>();
      const auto& at = this->template get<core_t<I>::ports[0].what, wiring::slot(I, 0)>();
      return turning_body{i, gyration_of(i, at.ang_velocity)};
    } else {
      return no_turning_body;
    }
  }

  // ---- axis N of joint I
  template <class T>
  KTE_INLINE static void put(matrix& m, int i, int j, const T& x) {
    m(i, j) = as<S>(x);
  }
  template <std::size_t I, int N, class C>
  KTE_INLINE constexpr void own(const C& c) {
    constexpr int j = row_of<I> + N;
    const auto s = this->template joint_axis<I, N>();
    const auto at_end = this->template load<frame_kind<I>, types::template output_slot<I>>();  // -W
    const auto by_q = varied_wrench(c.inertia, c.gyration, displaced<I, N>());
    const auto by_v = varied_wrench(c.inertia, c.gyration, faster<I, N>());
    const auto z = sensitivity_along(c.inertia, c.gyration, s);
    for_each_number<axes<I>>([&]<int K>() KTE_INLINE_LAMBDA {
      put(by_q_, row_of<I> + K, j, power(this->template joint_axis<I, K>(), by_q));
      put(by_v_, row_of<I> + K, j, power(this->template joint_axis<I, K>(), by_v));
      put(by_a_, row_of<I> + K, j, power(this->template joint_axis<I, K>(), z.to_acceleration));
    });
    down<I>(by_q - by_displacement(s, at_end), by_v, z, j);
  }
  /// Column and row j, from the end of element I to its base, and to the joint whose end that is.
  template <std::size_t I, class Q, class V, class Z>
  KTE_INLINE constexpr void down(const Q& by_q, const V& by_v, const Z& z, int j) {
    constexpr int below = wiring::writer(frame_kind<I>, base_slot<I>);
    if constexpr (below >= 0) {
      constexpr std::size_t b{below};
      const auto x = relative<I>();
      const auto q = transmit(x, by_q);
      const auto v = transmit(x, by_v);
      const auto y = sensitivity_through(x, at_base<I>().ang_velocity, z);
      for_each_number<axes<b>>([&]<int K>() KTE_INLINE_LAMBDA {
        constexpr int i = row_of<b> + K;
        const auto s = this->template joint_axis<b, K>();
        put(by_q_, i, j, power(s, q)), put(by_q_, j, i, change(y, displaced<b, K>()));
        put(by_v_, i, j, power(s, v)), put(by_v_, j, i, change(y, faster<b, K>()));
        const auto m = power(s, y.to_acceleration);
        put(by_a_, i, j, m), put(by_a_, j, i, m);
      });
      down<b>(q, v, y, j);
    }
  }

  matrix& by_q_;
  matrix& by_v_;
  matrix& by_a_;
};

}  // namespace kte::detail
