#pragma once

#include <kte/dynamics/detail/local_articulated.hpp>

namespace kte::detail {

/// The inverse of the mass matrix by the articulated-body algorithm on local variables. A unit force on axis j goes
/// down to its base, and at each joint i on the way leaves a force e_ij on its axes besides what they pass on, which
/// they answer by D_i^-1 e_ij ((4) of kernels/articulate.hpp). Then
///
///   (M^-1)_jk = sum_i e_ij . D_i^-1 e_ik        over the joints i below both          (1)
///
/// the innovations form of M^-1 (Rodriguez, Jain and Kreutz-Delgado, Int. J. Robotics Research 10, 1991). No sum is
/// larger than the geometric mean of two numbers of the diagonal.
template <class S, class Chain, class Given, class Elements = std::make_index_sequence<Chain::size>>
class local_inverse_mass;

template <class S, class Chain, class Given, std::size_t... E>
class local_inverse_mass<S, Chain, Given, std::index_sequence<E...>> : local_articulated<S, Chain, Given> {
  using base = local_articulated<S, Chain, Given>;
  using typename base::types;
  using typename base::vector;
  using typename base::wiring;
  template <std::size_t I>
  using core_t = typename types::template core<I>;
  template <std::size_t I>
  static constexpr bool yields = gives_way_under<Chain, Given, I>;
  template <std::size_t I>
  static constexpr int axes = yields<I> ? joint_dofs<core_t<I>> : 0;

 public:
  using base::base;

  /// Throws `singular_mass_matrix`.
  template <class Matrix>
  KTE_INLINE void invert(Matrix& m) {
    const vector none = vector::Zero();
    vector unused;
    this->tau_ = &none, this->a_ = &unused;
    for_each_base<wiring>([&]<kind K, int Slot>() KTE_INLINE_LAMBDA { (void)this->template carried<K, Slot>(); });
    this->masses(std::make_index_sequence<wiring::freedoms>{});
    columns(m);
    this->check_good();
  }
  /// The same after accelerations under forces `tau`, which go the same way up the tree.
  template <class Matrix>
  KTE_INLINE void accelerate_and_invert(const vector& tau, vector& a, Matrix& m) {
    this->accelerate(tau, a);
    columns(m);
  }

 private:
  template <class Matrix>
  KTE_INLINE void columns(Matrix& m) {
    left_.setZero();
    const int done[]{(unit_forces<E>(m, std::make_integer_sequence<int, axes<E>>{}), 0)..., 0};
    (void)done;
    masses_inverted(m, std::make_index_sequence<wiring::freedoms>{});
  }
  /// The columns of joint I. Joints in order: what those to come add is zero here, and put by them.
  template <std::size_t I, class Matrix, int... N>
  KTE_INLINE void unit_forces(Matrix& m, std::integer_sequence<int, N...>) {
    const int done[]{(unit_force<I, N>(m), 0)..., 0};
    (void)done;
  }
  template <std::size_t I, int N, class Matrix>
  KTE_INLINE void unit_force(Matrix& m) {
    constexpr int row = base::template row_of<I> + N;
    std::array<S, std::size_t{axes<I>}> force{};
    force[std::size_t{N}] = S(1);
    vector left = vector::Zero(), rate = vector::Zero();
    load_down<I>(no_wrench, force, left, rate);
    add_column(left_, row, left, rate, m);
  }
  /// A load at the end of element I, and forces on its axes, down to its base and further.
  template <std::size_t I, class W>
  KTE_INLINE void load_down(const W& load, std::array<S, std::size_t{axes<I>}> force, vector& left, vector& rate) {
    constexpr int below = wiring::writer(types::template output_kind<I>, wiring::slot(I, port_count<core_t<I>> - 2));
    if constexpr (yields<I>) {
      auto& response = this->template response<I>();
      const auto w = transmitted_by_joint<S>(this->chain_.template core<I>(), base::template joint_coordinate<I>(),
                                             base::template mass_on<I>(), load, force, response);
      for (int n = 0; n < axes<I>; ++n) {
        left[base::template row_of<I> + n] = force[static_cast<std::size_t>(n)];
        rate[base::template row_of<I> + n] = response.rate[static_cast<std::size_t>(n)];
      }
      if constexpr (below >= 0) load_down<std::size_t{below}>(w, {}, left, rate);
    } else if constexpr (below >= 0) {
      load_down<std::size_t{below}>(transmit(base::template joint_pose<I>(), load), {}, left, rate);
    }
  }

  template <class Matrix, std::size_t... F>
  KTE_INLINE void masses_inverted(Matrix& m, std::index_sequence<F...>) {
    const int done[]{(mass_inverted<F>(m), 0)..., 0};
    (void)done;
  }
  template <std::size_t F, class Matrix>
  KTE_INLINE void mass_inverted(Matrix& m) {
    constexpr freedom at = wiring::template free<F>;
    if constexpr (base::template moves_no_joint<F>()) {
      m.col(at.v).setZero();
      m(at.v, at.v) =
          S(1) / as<S>(this->template coordinate_mass<at.what, at.slot>(base::template readers<at.what, at.slot>));
    }
  }

  joint_matrix<S, Chain::dofs> left_;  ///< e_ij: row j of column i
};

}  // namespace kte::detail
