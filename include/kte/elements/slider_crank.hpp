#pragma once

#include <kte/contract/coordinate_follower.hpp>
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

 protected:
  /// From the end of the crank to the slider.
  template <class S>
  constexpr vec2<S> along_rod(const S& q, const S& s) const {
    using std::sqrt;
    const S b(lengths.rod), across = S(lengths.offset) - S(lengths.crank) * s, k = (b - across) * (b + across);
    detail::require_transmission(k, S(b * b), {"slider_crank_2D", "crank angle", "the rod is across the slider's line"},
                                 [&q] { return detail::text_of_angle(q); });
    return {S(lengths.side) * S(sqrt(k)), across};  // (1)
  }
};

/// The position of the slider on its line.
struct slider_crank_slider : coordinate_follower<slider_crank_slider>, slider_crank_parameters {
  static constexpr type_name type{"slider_crank_slider", kind::frame_2D};
  static constexpr std::array<port, 2> ports{{{kind::gen, access::in, "crank"}, {kind::gen, access::out, "slider"}}};
  static constexpr const char* arguments = "{crank, rod, offset, side}";

  slider_crank_slider() = default;
  constexpr explicit slider_crank_slider(const slider_crank_lengths& l) : slider_crank_parameters{l} {}

  template <class S>
  constexpr S value(const S& q) const {
    using std::cos;
    using std::sin;
    return S(lengths.crank) * S(cos(q)) + along_rod(q, S(sin(q))).x;
  }
};
/// The angle of the rod in the crank.
struct slider_crank_rod : coordinate_follower<slider_crank_rod>, slider_crank_parameters {
  static constexpr type_name type{"slider_crank_rod", kind::frame_2D};
  static constexpr std::array<port, 2> ports{{{kind::gen, access::in, "crank"}, {kind::gen, access::out, "rod"}}};
  static constexpr const char* arguments = "{crank, rod, offset, side}";

  slider_crank_rod() = default;
  constexpr explicit slider_crank_rod(const slider_crank_lengths& l) : slider_crank_parameters{l} {}

  template <class S>
  constexpr S value(const S& q) const {
    using std::cos;
    using std::sin;
    const S c = cos(q), s = sin(q);
    const vec2<S> w = along_rod(q, s);
    return detail::angle_from(vec2<S>{c, s}, w);
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
