#pragma once

#include <kte/integrators/tableau.hpp>
#include <kte/integrators/time_grid.hpp>

namespace kte::detail {

/// Dense output that needs more than the s stages of a step: additional stages, and a polynomial:
///
///   k_i = f(t + c_i h, x + h sum_{j<i} a_ij k_j),   i > s                                           (1)
///   p(theta) = sum_l p_l theta^l,   p_l = sum_i d_li k_i                                            (2)
///
/// Computed once per step, when a time between step ends is first requested. A `Tableau` may have an `extension` with
/// `stages`, `c`, `a` of these stages, and `dense` (d_l). Without one this class is empty.
template <class Tableau, class Rate>
class continuous_extension {
 public:
  static constexpr std::size_t stages = 0;
  explicit continuous_extension(const Rate&) {}
  void forget() {}
};

template <class Tableau, class Rate>
requires requires { typename Tableau::extension; }
class continuous_extension<Tableau, Rate> {
  using extension = typename Tableau::extension;
  using S = time_scalar<typename Rate::Scalar>;

 public:
  static constexpr std::size_t stages = extension::stages;

  explicit continuous_extension(const Rate& zero) { p_.fill(zero); }

  /// Discards the stages, for a new step.
  void forget() { made_ = false; }
  /// (1) and (2) for the step h from t, if not yet computed. k: all stages; those of the step are given.
  /// slope(t, d, k): the rate k of the displacement d from the start of the step. Returns whether the result is finite.
  template <class Slopes, class Slope>
  bool make(const S& t, const S& h, Slopes& k, const Slope& slope) {
    if (made_) return true;
    constexpr std::size_t first = std::tuple_size_v<Slopes> - stages;
    [&]<std::size_t... I>(std::index_sequence<I...>) {
      (slope(S(t + coefficient<S, extension::c[I]>() * h), h * combination<extension::a[I]>(k), k[first + I]), ...);
    }
    (std::make_index_sequence<stages>{});
    [&]<std::size_t... L>(std::index_sequence<L...>) {
      ((p_[L] = combination<extension::dense[L]>(k)), ...);  // (2)
      made_ = (all_finite(p_[L]) && ...);
    }
    (std::make_index_sequence<extension::dense.size()>{});
    return made_;
  }
  /// p(theta) as an Eigen expression.
  template <std::size_t L = 0>
  auto polynomial(const S& theta, const S& power = S(1)) const {
    if constexpr (L + 1 == extension::dense.size()) {
      return power * p_[L];
    } else {
      return power * p_[L] + polynomial<L + 1>(theta, S(power * theta));
    }
  }

 private:
  std::array<Rate, extension::dense.size()> p_;
  bool made_ = false;
};

}  // namespace kte::detail
