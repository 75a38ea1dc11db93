#pragma once

#include <kte/dynamics/detail/local_articulated.hpp>

namespace kte::detail {

/// The inverse of the mass matrix by the articulated-body algorithm on local variables: column j is what a unit force
/// on axis j does to a chain at rest without other loads.
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
    vector column;
    this->tau_ = &none, this->a_ = &column;
    for_each_base<wiring>([&]<kind K, int Slot>() KTE_INLINE_LAMBDA { (void)this->template carried<K, Slot>(); });
    this->masses(std::make_index_sequence<wiring::freedoms>{});
    this->check_good();
    const int done[]{(unit_forces<E>(m, std::make_integer_sequence<int, axes<E>>{}), 0)..., 0};
    (void)done;
    masses_inverted(m, std::make_index_sequence<wiring::freedoms>{});
  }

 private:
  /// The columns of joint I.
  template <std::size_t I, class Matrix, int... N>
  KTE_INLINE void unit_forces(Matrix& m, std::integer_sequence<int, N...>) {
    const int done[]{(m.col(base::template row_of<I> + N) = answer<I>(N), 0)..., 0};
    (void)done;
  }
  /// Accelerations by a unit force on axis n of joint I.
  template <std::size_t I>
  KTE_INLINE const auto& answer(int n) {
    std::array<S, std::size_t{axes<I>}> force{};
    force[static_cast<std::size_t>(n)] = S(1);
    const int cleared[]{(clear_rate<E>(), 0)..., 0};
    (void)cleared;
    this->a_->setZero();
    load_down<I>(no_wrench, force);
    for_each_base<wiring>([&]<kind K, int Slot>() KTE_INLINE_LAMBDA {
      this->template accelerate_all<K, Slot>(acceleration{zero3{}, zero3{}}, base::template readers<K, Slot>);
    });
    return *this->a_;
  }
  template <std::size_t I>
  KTE_INLINE void clear_rate() {
    if constexpr (yields<I>) boost::hana::at_c<I>(this->responses_).rate = {};
  }
  /// A load at the end of element I, and forces on its axes, down to its base and further.
  template <std::size_t I, class W>
  KTE_INLINE void load_down(const W& load, const std::array<S, std::size_t{axes<I>}>& force) {
    constexpr int below = wiring::writer(types::template output_kind<I>, wiring::slot(I, port_count<core_t<I>> - 2));
    if constexpr (yields<I>) {
      const auto w =
          transmitted_by_joint<S>(this->chain_.template core<I>(), base::template coordinate<I>(),
                                  base::template mass_on<I>(), load, force, boost::hana::at_c<I>(this->responses_));
      if constexpr (below >= 0) load_down<std::size_t{below}>(w, {});
    } else if constexpr (below >= 0) {
      load_down<std::size_t{below}>(transmit(base::template pose<I>(), load), {});
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
};

}  // namespace kte::detail
