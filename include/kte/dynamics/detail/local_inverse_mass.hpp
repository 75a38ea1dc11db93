#pragma once

#include <kte/dynamics/detail/local_articulated.hpp>
#include <kte/dynamics/detail/unit_forces.hpp>

namespace kte::detail {

/// The inverse of the mass matrix by the articulated-body algorithm on local variables. A unit force on axis j goes
/// down to its base, and at each joint i on the way leaves a force e_ij on its axes besides what they pass on, which
/// they answer by D_i^-1 e_ij ((4) of kernels/articulate.hpp). Then
///
///   (M^-1)_jk = sum_i e_ij . D_i^-1 e_ik        over the joints i below both          (1)
///
/// the innovations form of M^-1 (Rodriguez, Jain and Kreutz-Delgado, Int. J. Robotics Research 10, 1991). No sum is
/// larger than the geometric mean of two numbers of the diagonal. Axes that stand one on the other share a register
/// (unit_forces.hpp).
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
  static constexpr bool is_free = is_free_joint_under<Chain, Given, I>;

  /// Whether a wrench in numbers S is one in S again beyond element I: with parameters of other precision it is not,
  /// and registers hold numbers of one kind.
  template <std::size_t I>
  static constexpr bool keeps_numbers() {
    if constexpr (is_transmission<core_t<I>>)
      return is_wrench_of<S,
                          decltype(transmit(std::declval<const local_motion<Chain, Given>&>().template joint_pose<I>(),
                                            wrench<vec3<S>, vec3<S>>{}))>;
    else
      return true;
  }
  static constexpr std::size_t width = (keeps_numbers<E>() && ...) ? tree::simd_of<S>::count : 1;
  using simd = std::conditional_t<width == 1, S, tree::simd<S>>;
  template <std::size_t I>
  static constexpr joint_place place = joint_place_of<Chain, I, is_free<I>>();
  static constexpr auto forces = side_by_side<width, Chain::dofs>(std::array{joint_place(place<E>)..., joint_place{}});

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
    load_all_down(std::make_index_sequence<forces.groups>{});
    sum_answers<forces>(left_, rate_, m);
    masses_inverted(m, std::make_index_sequence<wiring::freedoms>{});
  }
  template <std::size_t... G>
  KTE_INLINE void load_all_down(std::index_sequence<G...>) {
    const int done[]{(load_down<std::size_t{forces.group[G].tip}, G>(no_wrench), 0)..., 0};
    (void)done;
  }
  /// The loads at the end of element I that the forces of group G make, and its forces on the axes of I, down to the
  /// base and further.
  template <std::size_t I, std::size_t G, class W>
  KTE_INLINE void load_down(const W& load) {
    if constexpr (is_free<I>) {
      auto force = forces.template units<simd, S, G, place<I>.row, place<I>.axes>();
      std::array<simd, std::size_t{place<I>.axes}> rate;
      const auto w =
          transmitted_by_joint<S>(this->chain_.template core<I>(), base::template joint_coordinate<I>(),
                                  base::template mass_on<I>(), load, this->template response<I>(), force, rate);
      for (std::size_t n = 0; n < std::size_t{place<I>.axes}; ++n) {
        const auto row = std::size_t{place<I>.row} + n;
        tree::store<S>(force[n], left_[row].data() + width * G);
        tree::store<S>(rate[n], rate_[row].data() + width * G);
      }
      if constexpr (place<I>.below >= 0) load_down<std::size_t{place<I>.below}, G>(w);
    } else if constexpr (place<I>.below >= 0) {
      load_down<std::size_t{place<I>.below}, G>(transmit(base::template joint_pose<I>(), load));
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
      m.col(at.v).setZero(), m.row(at.v).setZero();
      m(at.v, at.v) =
          S(1) / as<S>(this->template coordinate_mass<at.what, at.slot>(base::template readers<at.what, at.slot>));
    }
  }

  template <std::size_t N>
  using rows = std::array<std::array<S, N>, std::size_t{Chain::dofs}>;
  rows<forces.groups * width> left_, rate_;  ///< e_ij and D_i^-1 e_ij: row i, the column of j
};

}  // namespace kte::detail
