#pragma once

#include <kte/contract/coordinate_follower.hpp>
#include <kte/elements/joint_series.hpp>
#include <kte/kernels/dyad.hpp>

namespace kte {

/// Lengths of a four-bar linkage in the plane: a crank and a rocker turn about pivots of the ground, and a coupler
/// connects their ends.
struct four_bar_lengths {
  vec2<double> pivot;  ///< of the rocker, from that of the crank, in axes of the ground, m
  double crank;        ///< from pivot to coupler, m, along x of the crank
  double coupler;      ///< from crank to rocker, m, along x of the coupler
  double rocker;       ///< from pivot to coupler, m, along x of the rocker
  double side = 1;  ///< 1: the coupler meets the rocker to the left of the line from crank to pivot, -1: to the right
};

namespace core {

/// Parameters of both following coordinates (kernels/dyad.hpp).
struct four_bar_parameters {
  four_bar_lengths lengths;

  constexpr void check(const parameter_check& where) const {
    where.finite(lengths.pivot.x, "pivot must be finite"), where.finite(lengths.pivot.y, "pivot must be finite");
    for (const double length : {lengths.crank, lengths.coupler, lengths.rocker}) {
      where.finite(length, "lengths must be finite and positive");
      where.require(length > 0, "lengths must be finite and positive", length);
    }
    where.require(lengths.side == 1 || lengths.side == -1, "side must be 1 or -1", lengths.side);
  }
  template <class Self, class Visit>
  static constexpr void parameters(Self& self, Visit&& visit) {
    visit("pivot_x", self.lengths.pivot.x), visit("pivot_y", self.lengths.pivot.y);
    visit("crank", self.lengths.crank), visit("coupler", self.lengths.coupler);
    visit("rocker", self.lengths.rocker), visit("side", self.lengths.side);
  }

 protected:
  /// The vectors at q, with c, s = cos q, sin q, from the end of the crank to the joint of coupler and rocker, and to
  /// the pivot.
  template <class S>
  constexpr std::pair<vec2<S>, vec2<S>> joint(const S& q, const S& c, const S& s) const {
    const auto& [pivot, crank, coupler, rocker, side] = lengths;
    const vec2<S> r{S(pivot.x) - S(crank) * c, S(pivot.y) - S(crank) * s};
    return {detail::dyad(r, S(coupler), S(rocker), S(side),
                         {"four_bar_2D", "crank angle", "coupler and rocker are in line"},
                         [&q] { return detail::text_of_angle(q); }),
            r};
  }
};

/// The angle of the coupler in the crank.
struct four_bar_coupler : coordinate_follower<four_bar_coupler>, four_bar_parameters {
  static constexpr type_name type{"four_bar_coupler", kind::frame_2D};
  static constexpr std::array<port, 2> ports{{{kind::gen, access::in, "crank"}, {kind::gen, access::out, "coupler"}}};
  static constexpr const char* arguments = "{{pivot_x, pivot_y}, crank, coupler, rocker, side}";

  four_bar_coupler() = default;
  constexpr explicit four_bar_coupler(const four_bar_lengths& l) : four_bar_parameters{l} {}

  template <class S>
  constexpr S value(const S& q) const {
    using std::cos;
    using std::sin;
    const S c = cos(q), s = sin(q);
    const auto [w, r] = joint(q, c, s);
    return detail::angle_from(vec2<S>{c, s}, w);
  }
};
/// The angle of the rocker in the ground.
struct four_bar_rocker : coordinate_follower<four_bar_rocker>, four_bar_parameters {
  static constexpr type_name type{"four_bar_rocker", kind::frame_2D};
  static constexpr std::array<port, 2> ports{{{kind::gen, access::in, "crank"}, {kind::gen, access::out, "rocker"}}};
  static constexpr const char* arguments = "{{pivot_x, pivot_y}, crank, coupler, rocker, side}";

  four_bar_rocker() = default;
  constexpr explicit four_bar_rocker(const four_bar_lengths& l) : four_bar_parameters{l} {}

  template <class S>
  constexpr S value(const S& q) const {
    using std::atan2;
    using std::cos;
    using std::sin;
    const auto [w, r] = joint(q, S(cos(q)), S(sin(q)));
    return atan2(S(w.y - r.y), S(w.x - r.x));
  }
};

}  // namespace core

/// The angle of the coupler in the crank, rad; see `four_bar_2D`.
template <class Q, class C>
[[nodiscard]] constexpr auto four_bar_coupler_2D(const Q& crank, const C& coupler, const four_bar_lengths& lengths) {
  return connect(core::four_bar_coupler(lengths), crank, coupler);
}
/// The angle of the rocker in the ground, rad; see `four_bar_2D`.
template <class Q, class R>
[[nodiscard]] constexpr auto four_bar_rocker_2D(const Q& crank, const R& rocker, const four_bar_lengths& lengths) {
  return connect(core::four_bar_rocker(lengths), crank, rocker);
}

/// The angles of the coupler in the crank and of the rocker in the ground, rad, as functions of the crank angle. With
/// three revolute joints the loop is closed exactly. Makes two elements. Angles are in (-pi, pi], and jump by a turn at
/// the ends.
template <class Q, class C, class R>
[[nodiscard]] constexpr auto four_bar_2D(const Q& crank, const C& coupler, const R& rocker,
                                         const four_bar_lengths& lengths) {
  return detail::in_series(four_bar_coupler_2D(crank, coupler, lengths), four_bar_rocker_2D(crank, rocker, lengths));
}

KTE_CALL(four_bar_2D, "(crank, coupler, rocker, lengths); lengths are {.pivot = {0.3, 0.0}, .crank = 0.1, ...}")

}  // namespace kte
