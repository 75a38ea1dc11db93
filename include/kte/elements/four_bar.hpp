#pragma once

#include <kte/contract/crank_follower.hpp>
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

 public:
  /// The linkage at a crank angle: vectors from the end of the crank to the joint of coupler and rocker, `w`, and to
  /// the pivot of the rocker, `r`.
  template <class S>
  struct linkage {
    vec2<S> w, r;
  };
  template <class S>
  KTE_INLINE constexpr linkage<S> solved(const S& q, const vec2<S>& e, bool rates) const {
    const auto& [pivot, crank, coupler, rocker, side] = lengths;
    const vec2<S> r{S(pivot.x) - S(crank) * e.x, S(pivot.y) - S(crank) * e.y};
    return {detail::dyad(
                r, S(coupler), S(rocker), S(side), {"four_bar_2D", "crank angle", "coupler and rocker are in line"},
                [&q] { return detail::text_of_angle(q); }, rates),
            r};
  }

 protected:
  /// Unit vectors along coupler and rocker.
  template <class S>
  KTE_INLINE constexpr vec2<S> along_coupler(const linkage<S>& x) const {
    const S to_unit = S(1) / S(lengths.coupler);
    return {x.w.x * to_unit, x.w.y * to_unit};
  }
  template <class S>
  KTE_INLINE constexpr vec2<S> along_rocker(const linkage<S>& x) const {
    const S to_unit = S(1) / S(lengths.rocker);
    return {(x.w.x - x.r.x) * to_unit, (x.w.y - x.r.y) * to_unit};
  }
  /// First and second derivatives, by the angle of the crank, of those of coupler and rocker in the ground.
  template <class S>
  struct derivatives {
    S coupler, rocker, coupler2, rocker2;
  };
  /// With unit vectors e, u, v along crank a, coupler b and rocker d, their normals e_n, u_n, v_n to the left, and the
  /// angles f of the coupler and g of the rocker, the loop at a rate of one of the crank is
  ///
  ///   a e_n + b f' u_n = d g' v_n                                              (1)
  ///   -a e - b f'^2 u + b f'' u_n = -d g'^2 v + d g'' v_n                      (2)
  ///
  /// each times v and times u: u_n.v = -u.v_n is the sine between coupler and rocker.
  template <class S>
  KTE_INLINE constexpr derivatives<S> derive(const vec2<S>& e, const linkage<S>& at) const {
    const S a(lengths.crank), b(lengths.coupler), d(lengths.rocker);
    const vec2<S> u = along_coupler(at), v = along_rocker(at);
    const S sine = detail::across(u, v), cosine = detail::along(u, v), inverse = S(1) / sine;
    const S by_coupler = inverse * (S(1) / b), by_rocker = inverse * (S(1) / d);
    derivatives<S> x;
    x.coupler = -a * detail::across(e, v) * by_coupler, x.rocker = -a * detail::across(e, u) * by_rocker;
    const S b_ff = b * x.coupler * x.coupler, d_gg = d * x.rocker * x.rocker;
    x.coupler2 = (a * detail::along(e, v) + b_ff * cosine - d_gg) * by_coupler;
    x.rocker2 = (a * detail::along(e, u) + b_ff - d_gg * cosine) * by_rocker;
    return x;
  }
};

/// The angle of the coupler in the crank.
struct four_bar_coupler : crank_follower<four_bar_coupler>, four_bar_parameters {
  static constexpr type_name type{"four_bar_coupler", kind::frame_2D};
  static constexpr std::array<port, 2> ports{{{kind::gen, access::in, "crank"}, {kind::gen, access::out, "coupler"}}};
  static constexpr const char* arguments = "{{pivot_x, pivot_y}, crank, coupler, rocker, side}";

  four_bar_coupler() = default;
  constexpr explicit four_bar_coupler(const four_bar_lengths& l) : four_bar_parameters{l} {}

  template <class S>
  constexpr S value(const S& q) const {
    const vec2<S> e = detail::direction_at(q);
    return detail::angle_from(e, solved(q, e, is_dual<S>).w);
  }
  template <class S>
  KTE_INLINE constexpr auto position(const vec2<S>& e, const linkage<S>& x) const {
    const vec2<S> u = along_coupler(x);
    return detail::angle_along(vec2<S>{detail::along(e, u), detail::across(e, u)});
  }
  template <class S>
  KTE_INLINE constexpr auto slopes(const vec2<S>& e, const linkage<S>& at) const {
    const auto x = derive(e, at);
    return std::pair{S(x.coupler - S(1)), x.coupler2};
  }
};
/// The angle of the rocker in the ground.
struct four_bar_rocker : crank_follower<four_bar_rocker>, four_bar_parameters {
  static constexpr type_name type{"four_bar_rocker", kind::frame_2D};
  static constexpr std::array<port, 2> ports{{{kind::gen, access::in, "crank"}, {kind::gen, access::out, "rocker"}}};
  static constexpr const char* arguments = "{{pivot_x, pivot_y}, crank, coupler, rocker, side}";

  four_bar_rocker() = default;
  constexpr explicit four_bar_rocker(const four_bar_lengths& l) : four_bar_parameters{l} {}

  template <class S>
  constexpr S value(const S& q) const {
    using std::atan2;
    const auto [w, r] = solved(q, detail::direction_at(q), is_dual<S>);
    return atan2(S(w.y - r.y), S(w.x - r.x));
  }
  template <class S>
  KTE_INLINE constexpr auto position(const vec2<S>&, const linkage<S>& x) const {
    return detail::angle_along(along_rocker(x));
  }
  template <class S>
  KTE_INLINE constexpr auto slopes(const vec2<S>& e, const linkage<S>& at) const {
    const auto x = derive(e, at);
    return std::pair{x.rocker, x.rocker2};
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
