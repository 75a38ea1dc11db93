#pragma once

#include <kte/contract/coordinate_follower.hpp>
#include <kte/frames/motion.hpp>
#include <kte/math/atan2.hpp>
#include <kte/math/sincos.hpp>
#include <kte/math/vec.hpp>

namespace kte {

namespace detail {
/// The unit vector at the angle of a coordinate. Its cosine and sine are those of the coordinate, if it is not one of a
/// state, where these may be out of date.
template <class S, class C>
KTE_INLINE constexpr vec2<S> direction_of(const C& c) {
  if constexpr (has_skip<std::remove_cvref_t<decltype(c.cos)>> || requires { c.f; }) {
    vec2<S> e{};
    sincos_each<S>(
        1, [&c](std::size_t) KTE_INLINE_LAMBDA { return as<S>(c.q); },
        [&e](std::size_t, const S& sine, const S& cosine) KTE_INLINE_LAMBDA {
          e = {cosine, sine};
        });
    return e;
  } else {
    return {as<S>(c.cos), as<S>(c.sin)};
  }
}
/// The angle of a unit vector, with its cosine and sine, as a coordinate without rates.
template <class S>
KTE_INLINE constexpr auto angle_along(const vec2<S>& e) {
  return coordinate{angle_of(e.y, e.x), skip{}, skip{}, e.x, e.y};
}
}  // namespace detail

/// A `coordinate_follower` of one angle whose derivatives are known in closed form, at a third of the time. A core
/// derived from it also has these functions of q and e = (cos q, sin q):
///
///   solved(q, e, rates)    the linkage, for those below; throws `dead_point` for rates at dead points
///   position(e, linkage)   y(q) as a coordinate without rates; with its cosine and sine if it is an angle, which
///                          unrolled chains use
///   slopes(e, linkage)     dy/dq and d2y/dq2, a std::pair
template <class Core>
struct crank_follower : coordinate_follower<Core> {
  template <class C>
  KTE_INLINE constexpr auto doMotion(const C& crank) const {
    constexpr bool still = detail::has_skip<std::remove_cvref_t<decltype(crank.q_dot)>>;
    const auto e = direction(crank);
    const auto linkage = linkage_at(crank, e, !still);
    const auto y = core().position(e, linkage);
    if constexpr (still) {
      return y;
    } else {
      const auto [ratio, curvature] = core().slopes(e, linkage);
      const auto rate = ratio * crank.q_dot;
      if constexpr (detail::has_skip<std::remove_cvref_t<decltype(crank.q_ddot)>>)
        return coordinate{y.q, rate, skip{}, y.cos, y.sin};
      else
        return coordinate{y.q, rate, ratio * crank.q_ddot + curvature * (crank.q_dot * crank.q_dot), y.cos, y.sin};
    }
  }
  template <class C, class F>
  KTE_INLINE constexpr auto doForce(const C& crank, const F& f) const {
    const auto e = direction(crank);
    return make_loads(core().slopes(e, linkage_at(crank, e, true)).first * f);
  }

 private:
  KTE_INLINE constexpr const Core& core() const { return static_cast<const Core&>(*this); }
  template <class C>
  using scalar = typename detail::scalar_among<std::remove_cvref_t<decltype(std::declval<const C&>().q)>>::type;
  template <class C>
  KTE_INLINE static constexpr vec2<scalar<C>> direction(const C& crank) {
    return detail::direction_of<scalar<C>>(crank);
  }
  template <class C, class E>
  KTE_INLINE constexpr auto linkage_at(const C& crank, const E& e, bool rates) const {
    return core().solved(as<scalar<C>>(crank.q), e, rates);
  }
};

}  // namespace kte
