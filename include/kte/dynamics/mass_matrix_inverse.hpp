#ifndef KTE_MASS_MATRIX_INVERSE_HPP
#define KTE_MASS_MATRIX_INVERSE_HPP

#include <kte/dynamics/looped/static_chains.hpp>
#include <kte/dynamics/mass_matrix.hpp>
#include <kte/dynamics/unrolled/inverse_mass.hpp>

namespace kte {

namespace detail {
template <class S, class Chain, class At, class Base>
KTE_INLINE auto inverse_mass(const Chain& c, const At& at, const Base& base) {
  static_assert(sizeof(check_loads_of<Chain>) > 0 && sizeof(check_closures_of<Chain>) > 0);
  at.check(), base.check();
  joint_matrix<S, Chain::dofs> m;
  if constexpr (is_tree_of_joints<Chain>) {
    const auto resting = [&] {
      if constexpr (Chain::reads_positions) {
        return only_positions{base, motion{zero3{}, no_rotation{}, zero3{}, zero3{}, zero3{}, zero3{}}};
      } else {
        return only_positions{base, motion{skip{}, skip{}, skip{}, zero3{}, zero3{}, zero3{}}};
      }
    }();
    const given<At, same<zero_t>, same<zero_t>, std::remove_const_t<decltype(resting)>, true> g{at, {}, {}, resting};
    if constexpr (is_unrolled<Chain, S>) {
      inverted_mass<S, Chain, std::remove_const_t<decltype(g)>>(c, g).invert(m);
    } else {
      m = inverse_mass_by_tree<S>(c, g);
    }
  } else {
    auto factors = mass_matrix_at<S>(c, at, base);
    invert_by_factors(factors, m, [&at](int row) { diagnose_mass<typename Chain::wiring>(row, true, at.q); });
  }
  check_inverse(m, [&]() KTE_INLINE_LAMBDA { diagnose_non_finite<typename Chain::wiring>(m, at.q); });
  return m;
}
}  // namespace detail

/// The inverse of the mass matrix, dofs x dofs, by the recursion of the articulated-body algorithm: column j is the
/// acceleration due to a unit force on degree of freedom j, with the chain at rest, without gravity or other forces. M
/// is formed and factorized only if coordinates follow others. Arguments, results and errors are those of
/// `mass_matrix`. Throws also `singular_mass_matrix`.
template <class Gravity, class... E, indexable Q>
[[nodiscard]] auto mass_matrix_inverse(const static_chain<Gravity, E...>& c, const Q& q) {
  using chain_type = static_chain<Gravity, E...>;
  using S = value_of<Q>;
  detail::check_configuration<chain_type>(q);
  const detail::configuration<S, typename chain_type::wiring, Q> at(q);
  return detail::inverse_mass<S>(c, at, detail::base_under_gravity(c));
}
template <class Gravity, class... E, class S>
[[nodiscard]] auto mass_matrix_inverse(const static_chain<Gravity, E...>& c,
                                       const chain_state<S, detail::wiring<E...>>& s) {
  const auto q = positions(s);
  const detail::configuration<S, detail::wiring<E...>, std::remove_const_t<decltype(q)>> at(q);
  return detail::inverse_mass<S>(c, at, detail::base_of_state<chain_state<S, detail::wiring<E...>>>{s});
}

}  // namespace kte

#endif

// ---- runtime chains (kte/runtime_chain.hpp)

#if defined(KTE_RUNTIME_CHAINS) && !defined(KTE_MASS_MATRIX_INVERSE_OF_RUNTIME_CHAINS)
#define KTE_MASS_MATRIX_INVERSE_OF_RUNTIME_CHAINS

#include <kte/dynamics/mass_matrix.hpp>
#include <kte/dynamics/runtime/elements.hpp>

namespace kte {

namespace detail {
/// As `mass_matrix_inverse`, for positions that have been checked.
template <class S>
const runtime_matrix<S>& inverse_of_masses(const runtime_chain& c, basic_runtime_state<S>& s) {
  runtime_matrix<S>& inverse = s.work.inverse;
  if (s.tree().plan.tree) {
    articulate_and_invert(runtime_elements{c}, s, inverse);
  } else {
    mass_of_coordinates(runtime_elements{c}, s);
    inverse.resize(s.dofs(), s.dofs());
    invert_by_factors(s.work.mass, inverse, [&s](int row) { diagnose_mass(s, row, true); });
  }
  check_inverse(inverse, [&] { check_masses(s, inverse); });
  return inverse;
}
}  // namespace detail

template <class S>
const runtime_matrix<S>& mass_matrix_inverse(const runtime_chain& c, basic_runtime_state<S>& s) {
  detail::check_regular_tree(c, s), detail::refuse_loops(c);
  detail::check_positions(s);
  return detail::inverse_of_masses(c, s);
}
template <class S, indexable Q>
const runtime_matrix<S>& mass_matrix_inverse(const runtime_chain& c, basic_runtime_state<S>& s, const Q& q) {
  detail::check_regular_tree(c, s), detail::refuse_loops(c);
  return detail::take(c, s, q).call([&]() -> const auto& { return detail::inverse_of_masses(c, s); });
}

#ifdef KTE_EXTERN
KTE_EXTERN template const runtime_matrix<double>& mass_matrix_inverse(const runtime_chain&, runtime_state&);
namespace detail {
KTE_EXTERN template const runtime_matrix<double>& inverse_of_masses(const runtime_chain&, runtime_state&);
}
#endif

}  // namespace kte

#endif
