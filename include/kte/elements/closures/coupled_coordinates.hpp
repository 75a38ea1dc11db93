#pragma once

#include <kte/contract/coordinate_closure.hpp>

namespace kte {

namespace core {

/// Two coordinates coupled by a linear relation, a gear or a cable between them:
///
///   g = c_1 q_1 + c_2 q_2 - c_0          (1)
struct coupled_coordinates : coordinate_closure<coupled_coordinates> {
  static constexpr std::string_view type = "coupled_coordinates";
  static constexpr auto ports = detail::coordinate_closure_ports<2>;

  double factor1, factor2, constant;

  coupled_coordinates() = default;
  constexpr coupled_coordinates(double c1, double c2, double c0) : factor1(c1), factor2(c2), constant(c0) {}
  template <class Q>
  constexpr auto value(const Q& q1, const Q& q2) const {
    return factor1 * q1 + factor2 * q2 - constant;
  }
  static constexpr std::array<std::string_view, 3> parameter_names{"factor1", "factor2", "constant"};
  template <class Q>
  constexpr Q by_parameter(int k, const Q& q1, const Q& q2) const {
    return k == 0 ? q1 : k == 1 ? q2 : Q(-1);
  }
  constexpr void check(const parameter_check& where) const {
    where.finite(factor1, "factor1 must be finite"), where.finite(factor2, "factor2 must be finite");
    where.finite(constant, "constant must be finite");
    where.require(factor1 != 0 || factor2 != 0, "factor1 and factor2 must not both be zero", factor1);
  }
  template <class Self, class Visit>
  static constexpr void parameters(Self& self, Visit&& visit) {
    visit("factor1", self.factor1), visit("factor2", self.factor2), visit("constant", self.constant);
  }
};

/// Two coordinates coupled by a polynomial:
///
///   g = q_1 - (c_0 + c_1 q_2 + c_2 q_2^2 + c_3 q_2^3 + c_4 q_2^4)          (2)
struct coupled_by_polynomial : coordinate_closure<coupled_by_polynomial> {
  static constexpr std::string_view type = "coupled_by_polynomial";
  static constexpr auto ports = detail::coordinate_closure_ports<2>;

  double c0, c1, c2, c3, c4;

  coupled_by_polynomial() = default;
  constexpr coupled_by_polynomial(double a0, double a1, double a2, double a3, double a4)
      : c0(a0), c1(a1), c2(a2), c3(a3), c4(a4) {}
  template <class Q>
  constexpr auto value(const Q& q1, const Q& q2) const {
    return q1 - (c0 + q2 * (c1 + q2 * (c2 + q2 * (c3 + q2 * c4))));
  }
  static constexpr std::array<std::string_view, 5> parameter_names{"c0", "c1", "c2", "c3", "c4"};
  /// The derivative of (2) by parameter k.
  template <class Q>
  constexpr Q by_parameter(int k, const Q&, const Q& q2) const {
    Q power(-1);
    for (int i = 0; i < k; ++i) power = power * q2;
    return power;
  }
  constexpr void check(const parameter_check& where) const {
    for (const double c : {c0, c1, c2, c3, c4}) where.finite(c, "coefficients must be finite");
  }
  template <class Self, class Visit>
  static constexpr void parameters(Self& self, Visit&& visit) {
    visit("c0", self.c0), visit("c1", self.c1), visit("c2", self.c2), visit("c3", self.c3), visit("c4", self.c4);
  }
};

/// One to four coordinates coupled by a user-defined function that is zero.
template <class Law, std::size_t N>
struct coupled_by : coordinate_closure<coupled_by<Law, N>> {
  static constexpr std::string_view type = "coupled_by";
  static constexpr bool holds_code = true;
  static constexpr auto ports = detail::coordinate_closure_ports<N>;

  Law law;

  constexpr explicit coupled_by(const Law& f) : law(f) {}
  template <class... Q>
  constexpr auto value(const Q&... q) const {
    return law(q...);
  }
  constexpr void check(const parameter_check&) const {}
  template <class Self, class Visit>
  static constexpr void parameters(Self&, Visit&&) {}
};

}  // namespace core

/// Couples two coordinates: factor1 q1 + factor2 q2 = constant. Both must be degrees of freedom. 1 row; its force, Nm,
/// is `torque.x` of the loop, and acts on each coordinate multiplied by its factor.
template <class L, class Q1, class Q2>
constexpr auto coupled_coordinates(const L& loop, const Q1& q1, const Q2& q2, double factor1, double factor2,
                                   double constant = 0) {
  return connect(core::coupled_coordinates(factor1, factor2, constant), q1, q2, loop);
}
/// Couples two coordinates by a polynomial: q1 = c0 + c1 q2 + c2 q2^2 + c3 q2^3 + c4 q2^4. Both must be degrees of
/// freedom. 1 row, as of `coupled_coordinates`.
template <class L, class Q1, class Q2>
constexpr auto coupled_by_polynomial(const L& loop, const Q1& q1, const Q2& q2, double c0, double c1, double c2 = 0,
                                     double c3 = 0, double c4 = 0) {
  return connect(core::coupled_by_polynomial(c0, c1, c2, c3, c4), q1, q2, loop);
}
/// Couples one to four coordinates by your function, which is kept at zero. The function must accept numbers of any
/// type, such as dual numbers for derivatives:
///
///   coupled_by("cam", "q1", "q2", [](const auto& q1, const auto& q2) { using std::sin; return q2 - 0.1 * sin(q1); })
///
/// A chain with it cannot be saved.
template <class L, class Q1, class Law>
constexpr auto coupled_by(const L& loop, const Q1& q1, const Law& law) {
  return connect(core::coupled_by<Law, 1>(law), q1, loop);
}
template <class L, class Q1, class Q2, class Law>
constexpr auto coupled_by(const L& loop, const Q1& q1, const Q2& q2, const Law& law) {
  return connect(core::coupled_by<Law, 2>(law), q1, q2, loop);
}
template <class L, class Q1, class Q2, class Q3, class Law>
constexpr auto coupled_by(const L& loop, const Q1& q1, const Q2& q2, const Q3& q3, const Law& law) {
  return connect(core::coupled_by<Law, 3>(law), q1, q2, q3, loop);
}
template <class L, class Q1, class Q2, class Q3, class Q4, class Law>
constexpr auto coupled_by(const L& loop, const Q1& q1, const Q2& q2, const Q3& q3, const Q4& q4, const Law& law) {
  return connect(core::coupled_by<Law, 4>(law), q1, q2, q3, q4, loop);
}

KTE_CALL(coupled_coordinates, "(loop, coordinate1, coordinate2, factor1, factor2[, constant])")
KTE_CALL(coupled_by_polynomial, "(loop, coordinate1, coordinate2, c0, c1[, c2, c3, c4])")

}  // namespace kte
