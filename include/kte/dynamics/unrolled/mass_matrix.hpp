#pragma once

#include <kte/detail/unroll.hpp>
#include <kte/dynamics/looped/static_chains.hpp>
#include <kte/dynamics/unrolled/bodies.hpp>
#include <kte/dynamics/unrolled/given.hpp>
#include <kte/kernels/joint_vector.hpp>
#include <kte/recursions/composite_body.hpp>

/// The mass matrix of static chains (recursions/composite_body.hpp).
namespace kte::detail {

/// Entries of a mass matrix of zeros, by column. Joints may share a coordinate, so entries are added; if they cannot
/// (`Once`), each is written once, and summed while it is in a register.
template <class S, int N, bool Once>
struct mass_entries {
  joint_matrix<S, N>& m;
  S &column, &sum;  ///< sums of the entries of a column, and of all previous columns
  template <class T>
  KTE_INLINE constexpr void diagonal(int j, const T& x) const {
    sum += column, column = S(0);
    watch(x);
    m(j, j) = Once ? as<S>(x) : as<S>(m(j, j) + x);
  }
  template <class T>
  KTE_INLINE constexpr void operator()(int i, int j, const T& x) const {
    watch(x);
    if constexpr (Once) {
      m(i, j) = m(j, i) = as<S>(x);
    } else {
      m(i, j) = as<S>(m(i, j) + x);
      m(j, i) = as<S>(m(j, i) + x);
    }
  }

 private:
  template <class T>
  KTE_INLINE constexpr void watch(const T& x) const {
    if constexpr (Once && variable<T>) column += as<S>(x);
  }
};

/// The mass matrix over all coordinates of a chain: degrees of freedom first, then dependent coordinates. `Given` has
/// positions, without rates, and bases of `skip`.
template <class S, class Chain, class Given>
class unrolled_mass {
  using types = flow_types<Chain, Given>;
  using wiring = typename Chain::wiring;
  using motion_type = unrolled_motion<Chain, Given>;
  using axes = axes_of_joints<Chain>;
  template <std::size_t I>
  using core_t = typename types::template core<I>;

 public:
  static constexpr int coordinates = wiring::dofs + wiring::count(kind::gen) - wiring::gen_dofs;
  using matrix_type = joint_matrix<S, coordinates>;

  KTE_INLINE unrolled_mass(const Chain& c, const Given& g, matrix_type& m) : M(m), chain_(c), motion_(c, g) {
    M.setZero();
    using bodies_type = typed_bodies<S, motion_type, axes>;
    const bodies_type bodies(motion_);
    S column(0);
    engine::mass_matrix(engine::unrolled<bodies_type>{bodies},
                        mass_entries<S, coordinates, written_once>{M, column, sum_});
    sum_ += column;
    unroll<Chain::size>([this]<std::size_t I>()
                            KTE_INLINE_LAMBDA { this->template coordinate_mass<Chain::size - 1 - I>(); });
    if constexpr (!written_once) sum_ = detail::zero_or_nan(M.data(), static_cast<std::size_t>(M.size()));
  }
  /// 0 if all numbers are finite, unless they are close to overflow.
  KTE_INLINE S zero_or_nan() const { return sum_ * S(0); }

 private:
  static constexpr bool written_once = [] {
    bool once = coordinates == wiring::dofs;
    unroll<Chain::size>([&once]<std::size_t I>() {
      if (core_t<I>::ports[0].what == kind::gen && has_mass<core_t<I>, S>) once = false;
    });
    constexpr auto& t = wiring::table;
    for (std::size_t f = 0; f < wiring::freedoms; ++f) {
      int users = 0;
      int p = t.reader[static_cast<std::size_t>(t.free[f].what)][static_cast<std::size_t>(t.free[f].slot)];
      for (; p >= 0; p = t.previous[static_cast<std::size_t>(p)]) ++users;
      once &= users == 1;
    }
    return once;
  }();

  // ---- coordinates: their own masses, and dependent coordinates
  template <std::size_t I>
  KTE_INLINE void coordinate_mass() {
    constexpr int b = axes::template row_of_coordinate<core_t<I>::ports[0].what, wiring::slot(I, 0)>;
    if constexpr (core_t<I>::ports[0].what != kind::gen) {
      return;
    } else if constexpr (has_mass<core_t<I>, S>) {
      M(b, b) = as<S>(M(b, b) + chain_.template core<I>().template mass<S>());
    } else if constexpr (has_output<core_t<I>> && types::template output_kind<I> == kind::gen) {
      // q_e' = ratio q_b': its row and column count for b too
      constexpr int e = axes::template row_of_coordinate<kind::gen, types::template output_slot<I>>;
      const auto& q_b = motion_.template get<kind::gen, wiring::slot(I, 0)>();
      const auto ratio = chain_.template core<I>().doMotion(unit_rate<kind::gen, 0>(q_b)).q_dot;
      for (int c = 0; c < coordinates; ++c) M(b, c) = as<S>(M(b, c) + ratio * M(e, c));
      for (int c = 0; c < coordinates; ++c) M(c, b) = as<S>(M(c, b) + ratio * M(c, e));
    }
  }

  matrix_type& M;
  S sum_{0};  ///< of all entries
  const Chain& chain_;
  const unrolled_motion<Chain, Given> motion_;
};

/// A separate function, because only a variable of the outermost block is constructed in place.
template <class S, class Chain, class Given>
KTE_INLINE auto unrolled_mass_matrix(const Chain& c, const Given& g, S& zero_or_nan) {
  using mass_type = unrolled_mass<S, Chain, Given>;
  typename mass_type::matrix_type m;
  zero_or_nan = mass_type(c, g, m).zero_or_nan();
  if constexpr (mass_type::coordinates == Chain::dofs) {
    return m;
  } else {
    return joint_matrix<S, Chain::dofs>(m.template block<Chain::dofs, Chain::dofs>(0, 0));
  }
}
/// The mass matrix over the degrees of freedom. Bases matter only for prescribed coordinates.
template <class S, class Chain, class Positions, class Base>
KTE_INLINE auto mass_matrix_at(const Chain& c, const Positions& at, const Base& base) {
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
  if (!all(zero_or_nan == S(0))) [[unlikely]]  // NaN is possible for valid results
    diagnose_non_finite<typename Chain::wiring>(m, at.q);
  return m;
}

}  // namespace kte::detail
