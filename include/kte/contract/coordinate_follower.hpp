#pragma once

#include <kte/contract/passes.hpp>
#include <kte/contract/transmission.hpp>
#include <kte/math/dual.hpp>

#include <array>
#include <tuple>
#include <utility>

namespace kte {

namespace detail {
/// The scalar of some arguments: the type of the first one that is not a typed constant, or double.
template <class... X>
struct scalar_among {
  using type = double;
};
template <class First, class... Rest>
struct scalar_among<First, Rest...>
    : std::conditional_t<kte::variable<First>, std::type_identity<First>, scalar_among<Rest...>> {};
}  // namespace detail

/// A coordinate that is a function of others. A core derived from it has this function,
///
///   value(q_1, q_2, ...)   of the coordinates at its first ports, m or rad                    (1)
///
/// which is called with dual numbers (functions as `using std::sin; sin(q)`). The passes follow from it, exact to
/// rounding:
/// rounding:
///
///   q = F(q_i),   q' = sum F_i q_i',   q'' = sum F_i q_i'' + sum F_ij q_i' q_j'            (2)
///   f_i += F_i f                                                                              (3)
///
/// Its ports are the coordinates, then the coordinate that it writes.
///
/// `value` raises `bad_argument` if there is no value, for example if a loop cannot be closed, and `dead_point` if
/// there are no derivatives; runtime chains then name the element.
template <class Core>
struct coordinate_follower {
  /// Declares to the algorithms that `value` may throw.
  static constexpr bool may_have_no_value = true;

  template <class... C>
  KTE_INLINE constexpr auto doMotion(const C&... c) const {
    using S = typename detail::scalar_among<std::remove_cvref_t<decltype(c.q)>...>::type;
    if constexpr ((detail::has_skip<std::remove_cvref_t<decltype(c.q_dot)>> || ...)) {
      return coordinate{S(core().value(as<S>(c.q)...)), skip{}, skip{}, skip{}, skip{}};
    } else if constexpr ((detail::has_skip<std::remove_cvref_t<decltype(c.q_ddot)>> || ...)) {
      const dual<S, 1> y = core().value(along(as<S>(c.q), as<S>(c.q_dot))...);
      return coordinate{y.value, y.derivative[0], skip{}, skip{}, skip{}};
    } else {  // twice along the motion
      const dual<dual<S, 1>, 1> y =
          core().value(along(along(as<S>(c.q), as<S>(c.q_dot)), along(as<S>(c.q_dot), as<S>(c.q_ddot)))...);
      return coordinate{y.value.value, y.value.derivative[0], y.derivative[0].derivative[0], skip{}, skip{}};
    }
  }
  template <class... X>
  KTE_INLINE constexpr auto doForce(const X&... x) const {
    return spread(std::tie(x...), std::make_index_sequence<sizeof...(X) - 1>{});
  }

 private:
  KTE_INLINE constexpr const Core& core() const { return static_cast<const Core&>(*this); }
  /// A number and its rate.
  template <class T>
  KTE_INLINE static constexpr dual<T, 1> along(const T& x, const T& rate) {
    dual<T, 1> n(x);
    n.derivative[0] = rate;
    return n;
  }
  template <class Things, std::size_t... I>
  KTE_INLINE constexpr auto spread(const Things& x, std::index_sequence<I...>) const {
    using S = typename detail::scalar_among<std::remove_cvref_t<decltype(std::get<I>(x).q)>...>::type;
    using number = dual<S, static_cast<int>(sizeof...(I))>;
    std::array<number, sizeof...(I)> q{number(as<S>(std::get<I>(x).q))...};
    for (std::size_t i = 0; i < sizeof...(I); ++i) q[i].derivative[i] = S(1);
    const number y = core().value(q[I]...);
    return make_loads(y.derivative[I] * std::get<sizeof...(I)>(x)...);  // (3)
  }
};

}  // namespace kte
