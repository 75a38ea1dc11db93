#pragma once

#include <kte/contract/coordinate_follower.hpp>
#include <kte/elements/joint_series.hpp>
#include <kte/kernels/dyad.hpp>

namespace kte {

/// Lengths of a five-bar linkage in the plane: two cranks on pivots of the ground, and two bars between their ends.
struct dyad_lengths {
  vec2<double> pivot;  ///< of the second crank, from that of the first, in axes of the ground, m
  double crank1;       ///< from pivot to bar, m, along x of the first crank; 0: the bar is at the pivot
  double bar1;         ///< from the first crank to the other bar, m, along x of the bar
  double bar2;         ///< from the second crank to the other bar, m, along x of the bar
  double crank2;       ///< from pivot to bar, m, along x of the crank
  double side = 1;     ///< 1: the bars meet to the left of the line from the first crank end to the second; -1: right
};

namespace core {

/// Parameters of both following coordinates (kernels/dyad.hpp).
struct dyad_parameters {
  dyad_lengths lengths;

  constexpr void check(const parameter_check& where) const {
    where.finite(lengths.pivot.x, "pivot must be finite"), where.finite(lengths.pivot.y, "pivot must be finite");
    where.not_negative(lengths.crank1, "crank1 must be finite and not negative");
    where.not_negative(lengths.crank2, "crank2 must be finite and not negative");
    where.positive(lengths.bar1, "bar1 must be finite and positive");
    where.positive(lengths.bar2, "bar2 must be finite and positive");
    where.require(lengths.side == 1 || lengths.side == -1, "side must be 1 or -1", lengths.side);
  }
  template <class Self, class Visit>
  static constexpr void parameters(Self& self, Visit&& visit) {
    visit("pivot_x", self.lengths.pivot.x), visit("pivot_y", self.lengths.pivot.y);
    visit("crank1", self.lengths.crank1), visit("bar1", self.lengths.bar1);
    visit("bar2", self.lengths.bar2), visit("crank2", self.lengths.crank2);
    visit("side", self.lengths.side);
  }

 protected:
  /// The vectors from the end of the first crank to the joint of the bars, and to the end of the second crank. The
  /// cranks point along `first` and `second`, at the angles q1 and q2.
  template <class S>
  constexpr std::pair<vec2<S>, vec2<S>> joint(const vec2<S>& first, const vec2<S>& second, const S& q1,
                                              const S& q2) const {
    const auto& [pivot, crank1, bar1, bar2, crank2, side] = lengths;
    const vec2<S> r{S(pivot.x) + S(crank2) * second.x - S(crank1) * first.x,
                    S(pivot.y) + S(crank2) * second.y - S(crank1) * first.y};
    return {detail::dyad(r, S(bar1), S(bar2), S(side), {"dyad_2D", "crank angles", "its bars are in line"},
                         [&] { return detail::text_of_angle(q1) + ", " + detail::text_of_angle(q2); }),
            r};
  }
};

/// The angle of the first bar in the first crank.
struct dyad_bar1 : coordinate_follower<dyad_bar1>, dyad_parameters {
  static constexpr type_name type{"dyad_bar1", kind::frame_2D};
  static constexpr std::array<port, 3> ports{
      {{kind::gen, access::in, "crank1"}, {kind::gen, access::in, "crank2"}, {kind::gen, access::out, "bar"}}};
  static constexpr const char* arguments = "{{pivot_x, pivot_y}, crank1, bar1, bar2, crank2, side}";

  dyad_bar1() = default;
  constexpr explicit dyad_bar1(const dyad_lengths& l) : dyad_parameters{l} {}

  template <class S>
  constexpr S value(const S& q1, const S& q2) const {
    const auto e = detail::direction_at(q1);
    return detail::angle_from(e, joint(e, detail::direction_at(q2), q1, q2).first);
  }
};
/// The angle of the second bar in the second crank.
struct dyad_bar2 : coordinate_follower<dyad_bar2>, dyad_parameters {
  static constexpr type_name type{"dyad_bar2", kind::frame_2D};
  static constexpr std::array<port, 3> ports{
      {{kind::gen, access::in, "crank1"}, {kind::gen, access::in, "crank2"}, {kind::gen, access::out, "bar"}}};
  static constexpr const char* arguments = "{{pivot_x, pivot_y}, crank1, bar1, bar2, crank2, side}";

  dyad_bar2() = default;
  constexpr explicit dyad_bar2(const dyad_lengths& l) : dyad_parameters{l} {}

  template <class S>
  constexpr S value(const S& q1, const S& q2) const {
    const auto e = detail::direction_at(q2);
    const auto [w, r] = joint(detail::direction_at(q1), e, q1, q2);
    return detail::angle_from(e, vec2<S>{w.x - r.x, w.y - r.y});
  }
};

}  // namespace core

/// The angle of the first bar in the first crank, rad; see `dyad_2D`.
template <class Q1, class Q2, class B>
[[nodiscard]] constexpr auto dyad_bar1_2D(const Q1& crank1, const Q2& crank2, const B& bar,
                                          const dyad_lengths& lengths) {
  return connect(core::dyad_bar1(lengths), crank1, crank2, bar);
}
/// The angle of the second bar in the second crank, rad; see `dyad_2D`.
template <class Q1, class Q2, class B>
[[nodiscard]] constexpr auto dyad_bar2_2D(const Q1& crank1, const Q2& crank2, const B& bar,
                                          const dyad_lengths& lengths) {
  return connect(core::dyad_bar2(lengths), crank1, crank2, bar);
}

/// The angles of the two bars between two cranks, rad, each in axes of its crank, as functions of the crank angles.
/// With a revolute joint for each of the four angles the loop is closed exactly. Makes two elements. Angles are in
/// (-pi, pi], and jump by a turn at the ends.
template <class Q1, class Q2, class B1, class B2>
[[nodiscard]] constexpr auto dyad_2D(const Q1& crank1, const Q2& crank2, const B1& bar1, const B2& bar2,
                                     const dyad_lengths& lengths) {
  return detail::in_series(dyad_bar1_2D(crank1, crank2, bar1, lengths), dyad_bar2_2D(crank1, crank2, bar2, lengths));
}

KTE_CALL(dyad_2D, "(crank1, crank2, bar1, bar2, lengths); lengths are {.pivot = {0.3, 0.0}, .crank1 = 0.1, ...}")

}  // namespace kte
