#pragma once

#include <kte/elements/law_spring.hpp>
#include <kte/math/monotone_cubic.hpp>

namespace kte {

namespace core {

/// A `law_spring` whose force is a monotone cubic through a table of lengths and forces (math/monotone_cubic.hpp),
/// straight beyond its ends. V is the integral of the curve from the first length.
template <kind Dim, class List>
struct table_spring : law_spring<Dim, monotone_cubic<List>> {
  static constexpr type_name type{"table_spring", Dim};
  static constexpr bool holds_code = false;

  constexpr void check(const parameter_check& where) const {
    const auto& [x, y] = std::tie(this->law.x, this->law.y);
    for (const double length : x) where.finite(length, "lengths must be finite");
    for (const double force : y) where.finite(force, "forces must be finite");
    where.require(x.size() == y.size() && x.size() > 1, "there must be as many forces as lengths, at least two",
                  static_cast<double>(y.size()));
    for (std::size_t i = 1; i < x.size(); ++i) where.require(x[i - 1] < x[i], "lengths must increase", x[i]);
  }
  template <class Self, class Visit>
  static constexpr void parameters(Self& self, Visit&& visit) {
    visit("lengths", self.law.x), visit("forces", self.law.y);
    if constexpr (!std::is_const_v<Self>) self.law.prepare();
  }
};

}  // namespace core

namespace detail {
template <kind Dim, class List, class F1, class F2>
constexpr auto make_table_spring(const F1& anchor1, const F2& anchor2, const List& lengths, const List& forces) {
  return connect(core::table_spring<Dim, List>{{monotone_cubic<List>(lengths, forces)}}, anchor1, anchor2);
}
}  // namespace detail

/// A spring between two coordinates: lengths (m, rad), increasing, and the force at each (N, Nm); positive pulls. Lists
/// of a fixed length make constexpr chains:
///
///   table_spring_gen(q1, q2, std::array{0.0, 0.1, 0.2}, std::array{0.0, 30.0, 100.0})
template <class Q1, class Q2, class List = std::vector<double>>
[[nodiscard]] constexpr auto table_spring_gen(const Q1& anchor1, const Q2& anchor2, const List& lengths,
                                              const List& forces) {
  return detail::make_table_spring<kind::gen>(anchor1, anchor2, lengths, forces);
}
/// A spring between the origins of two frames in the plane: lengths, m, increasing, and the force at each, N; positive
/// pulls.
template <class F1, class F2, class List = std::vector<double>>
[[nodiscard]] constexpr auto table_spring_2D(const F1& anchor1, const F2& anchor2, const List& lengths,
                                             const List& forces) {
  return detail::make_table_spring<kind::frame_2D>(anchor1, anchor2, lengths, forces);
}
/// A spring between the origins of two frames in space: lengths, m, increasing, and the force at each, N; positive
/// pulls.
template <class F1, class F2, class List = std::vector<double>>
[[nodiscard]] constexpr auto table_spring_3D(const F1& anchor1, const F2& anchor2, const List& lengths,
                                             const List& forces) {
  return detail::make_table_spring<kind::frame_3D>(anchor1, anchor2, lengths, forces);
}

KTE_CALL(table_spring_gen, "(anchor1, anchor2, lengths, forces); both are a std::vector or a std::array, of one length")
KTE_CALL(table_spring_2D, "(anchor1, anchor2, lengths, forces); both are a std::vector or a std::array, of one length")
KTE_CALL(table_spring_3D, "(anchor1, anchor2, lengths, forces); both are a std::vector or a std::array, of one length")

}  // namespace kte
