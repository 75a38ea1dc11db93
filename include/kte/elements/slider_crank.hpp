#pragma once

#include <kte/contract/crank_follower.hpp>
#include <kte/elements/joint_series.hpp>
#include <kte/errors.hpp>
#include <kte/kernels/dyad.hpp>
#include <kte/math/select.hpp>

namespace kte {

/// Lengths of a slider-crank in the plane: a crank turns about a pivot of the ground, and a rod connects its end to a
/// slider on a line.
struct slider_crank_lengths {
  double crank;       ///< from pivot to rod, m, along x of the crank
  double rod;         ///< from crank to slider, m, along x of the rod
  double offset = 0;  ///< distance of the line from the pivot, m, to the left of its direction, x of the ground
  double side = 1;    ///< 1: the slider is ahead of the end of the crank, -1: behind it
};

namespace core {

/// Parameters of both following coordinates. With the end of the crank at a (cos q, sin q),
///
///   d = sqrt(b^2 - (h - a sin q)^2),   x = a cos q + s d          (1)
///
/// and for the angle f of the rod in the ground, w = (s d, h - a sin q) = b (cos f, sin f),
///
///   f' w_x = -a cos q,   f'' w_x = a sin q + f'^2 w_y                        (2)
///   x' = -a sin q - f' w_y,   x'' = -a cos q - f'^2 w_x - f'' w_y            (3)
struct slider_crank_parameters {
  slider_crank_lengths lengths;

  constexpr void check(const parameter_check& where) const {
    for (const double length : {lengths.crank, lengths.rod}) {
      where.finite(length, "lengths must be finite and positive");
      where.require(length > 0, "lengths must be finite and positive", length);
    }
    where.finite(lengths.offset, "offset must be finite");
    where.require(lengths.side == 1 || lengths.side == -1, "side must be 1 or -1", lengths.side);
  }
  template <class Self, class Visit>
  static constexpr void parameters(Self& self, Visit&& visit) {
    visit("crank", self.lengths.crank), visit("rod", self.lengths.rod), visit("offset", self.lengths.offset);
    visit("side", self.lengths.side);
  }

 public:
  /// The vector w from the end of the crank to the slider at a crank angle.
  template <class S>
  KTE_INLINE constexpr vec2<S> solved(const S& q, const vec2<S>& e, bool rates) const {
    using std::sqrt;
    const S b(lengths.rod), across = S(lengths.offset) - S(lengths.crank) * e.y, k = (b - across) * (b + across);
    detail::require_transmission(
        k, S(b * b), {"slider_crank_2D", "crank angle", "the rod is across the slider's line"},
        [&q] { return detail::text_of_angle(q); }, rates);
    return {S(lengths.side) * S(sqrt(k)), across};  // (1)
  }

 protected:
  /// f' and f'', (2).
  template <class S>
  KTE_INLINE constexpr std::pair<S, S> rod_slopes(const vec2<S>& e, const vec2<S>& w) const {
    const S a(lengths.crank), inverse = S(1) / w.x, f = -a * e.x * inverse;
    return {f, S((a * e.y + f * f * w.y) * inverse)};
  }
};

/// The position of the slider on its line.
struct slider_crank_slider : crank_follower<slider_crank_slider>, slider_crank_parameters {
  static constexpr type_name type{"slider_crank_slider", kind::frame_2D};
  static constexpr std::array<port, 2> ports{{{kind::gen, access::in, "crank"}, {kind::gen, access::out, "slider"}}};
  static constexpr const char* arguments = "{crank, rod, offset, side}";

  slider_crank_slider() = default;
  constexpr explicit slider_crank_slider(const slider_crank_lengths& l) : slider_crank_parameters{l} {}

  template <class S>
  constexpr S value(const S& q) const {
    const vec2<S> e = detail::direction_at(q);
    return S(lengths.crank) * e.x + solved(q, e, is_dual<S>).x;
  }
  template <class S>
  KTE_INLINE constexpr auto position(const vec2<S>& e, const vec2<S>& w) const {
    return coordinate{S(S(lengths.crank) * e.x + w.x), skip{}, skip{}, skip{}, skip{}};
  }
  template <class S>
  KTE_INLINE constexpr auto slopes(const vec2<S>& e, const vec2<S>& w) const {
    const S a(lengths.crank);
    const auto [f, f2] = rod_slopes(e, w);
    return std::pair{S(-a * e.y - f * w.y), S(-a * e.x - f * f * w.x - f2 * w.y)};  // (3)
  }
};
/// The angle of the rod in the crank.
struct slider_crank_rod : crank_follower<slider_crank_rod>, slider_crank_parameters {
  static constexpr type_name type{"slider_crank_rod", kind::frame_2D};
  static constexpr std::array<port, 2> ports{{{kind::gen, access::in, "crank"}, {kind::gen, access::out, "rod"}}};
  static constexpr const char* arguments = "{crank, rod, offset, side}";

  slider_crank_rod() = default;
  constexpr explicit slider_crank_rod(const slider_crank_lengths& l) : slider_crank_parameters{l} {}

  template <class S>
  constexpr S value(const S& q) const {
    const vec2<S> e = detail::direction_at(q);
    return detail::angle_from(e, solved(q, e, is_dual<S>));
  }
  template <class S>
  KTE_INLINE constexpr auto position(const vec2<S>& e, const vec2<S>& w) const {
    const S to_unit = S(1) / S(lengths.rod);
    return detail::angle_along(vec2<S>{detail::along(e, w) * to_unit, detail::across(e, w) * to_unit});
  }
  template <class S>
  KTE_INLINE constexpr auto slopes(const vec2<S>& e, const vec2<S>& w) const {
    const auto [f, f2] = rod_slopes(e, w);
    return std::pair{S(f - S(1)), f2};
  }
};

}  // namespace core

/// The angle of the rod in the crank, rad; see `slider_crank_2D`.
template <class Q, class R>
[[nodiscard]] constexpr auto slider_crank_rod_2D(const Q& crank, const R& rod, const slider_crank_lengths& lengths) {
  return connect(core::slider_crank_rod(lengths), crank, rod);
}
/// The position of the slider on its line, m; see `slider_crank_2D`.
template <class Q, class X>
[[nodiscard]] constexpr auto slider_crank_slider_2D(const Q& crank, const X& slider,
                                                    const slider_crank_lengths& lengths) {
  return connect(core::slider_crank_slider(lengths), crank, slider);
}

/// The angle of the rod in the crank, rad, and the position of the slider, m, of a slider-crank, as functions of the
/// crank angle. Makes two elements.
template <class Q, class R, class X>
[[nodiscard]] constexpr auto slider_crank_2D(const Q& crank, const R& rod, const X& slider,
                                             const slider_crank_lengths& lengths) {
  return detail::in_series(slider_crank_rod_2D(crank, rod, lengths), slider_crank_slider_2D(crank, slider, lengths));
}

KTE_CALL(slider_crank_2D, "(crank, rod, slider, lengths); lengths are {.crank = 0.1, .rod = 0.3}")

}  // namespace kte
