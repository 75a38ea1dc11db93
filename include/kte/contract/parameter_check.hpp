#pragma once

#include <kte/contract/port.hpp>
#include <kte/errors.hpp>
#include <kte/math/principal_moments.hpp>
#include <kte/math/rigid_body.hpp>

#include <array>
#include <cmath>
#include <cstdio>
#include <limits>
#include <span>
#include <string>
#include <type_traits>

namespace kte {

/// The argument of `check` of an element core. It stores the first rule that a parameter breaks, in `broken`; the
/// caller then reports it, by `bad_parameter` or, for a constexpr chain, at compile time. `names` are those of the
/// connections of the element.
struct parameter_check {
  /// A broken rule.
  struct breach {
    const char* rule = nullptr;       ///< the rule, or null
    double value = 0;                 ///< the value that breaks it
    std::array<double, 3> moments{};  ///< principal moments of a body; `value` is the excess of the first
  };
  std::string_view type;
  std::span<const port> ports;
  std::span<const std::string_view> names;
  breach& broken;

  /// Rejects `value` unless ok, e.g. require(m >= 0, "mass must not be negative", m).
  constexpr void require(bool ok, const char* rule, double value) const {
    if (ok || broken.rule) return;
    broken = {rule, value};
#if !defined(__clang__)  // g++ prints a line for each call, and only of literals what they are: so here
    if (std::is_constant_evaluated()) detail::require<bad_parameter>(ok, *this, rule, value);
#endif
  }
  /// Requires a finite number or finite entries.
  template <class T>
  constexpr void finite(const T& x, const char* rule) const {
    if constexpr (!typed_constant<T>) {
      const auto v = static_cast<double>(x);
      constexpr double largest = (std::numeric_limits<double>::max)();
      require(-largest <= v && v <= largest, rule, v);  // no arithmetic, because clang rejects NaN results
    }
  }
  /// Requires a finite number >= 0.
  template <class T>
  constexpr void not_negative(const T& x, const char* rule) const {
    finite(x, rule);
    require(as<double>(x) >= 0, rule, as<double>(x));
  }
  /// Requires a finite number > 0.
  template <class T>
  constexpr void positive(const T& x, const char* rule) const {
    finite(x, rule);
    require(as<double>(x) > 0, rule, as<double>(x));
  }
  template <class X, class Y, class Z>
  constexpr void finite(const vec3<X, Y, Z>& v, const char* rule) const {
    finite(v.x, rule), finite(v.y, rule), finite(v.z, rule);
  }
  /// Requires a vector of length 1, to 1e-9: rounded axes are accepted.
  template <class X, class Y, class Z>
  constexpr void unit(const vec3<X, Y, Z>& v, const char* rule) const {
    finite(v, rule);
    if (!broken.rule) unit_length(dot(as<double>(v), as<double>(v)), rule);
  }
  constexpr void rotation(no_rotation, const char*) const {}
  /// Requires a rotation matrix: orthonormal with determinant 1, each to 1e-9.
  template <class R>
  constexpr void rotation(const R& r, const char* rule) const {
    if constexpr (requires { r.w; }) unit_length(as<double>(dot(r, r)), rule);
    const auto m = as<double>(matrix(r));
    unit(m.x, rule), unit(m.y, rule), unit(m.z, rule);
    if (broken.rule) return;
    const double det = dot(m.x, cross(m.y, m.z));
    require(det > 1 - 1e-8, rule, det);
  }
  template <class... T>
  constexpr void finite(const sym3<T...>& i, const char* rule) const {
    finite(i.xx, rule), finite(i.xy, rule), finite(i.xz, rule);
    finite(i.yy, rule), finite(i.yz, rule), finite(i.zz, rule);
  }
  /// Requires the triangle inequality of the principal moments, which is equivalent to positive semidefinite second
  /// moments tr(I)/2 1 - I, the integrals of x x^T dm. With a tolerance for rounded digits, relative to the inertia of
  /// the body about its frame.
  template <class M, class C, class I>
  constexpr void physical(const rigid_body<M, C, I>& body) const {
    finite(body.inertia, "inertia must be finite");
    if (broken.rule) return;
    const auto i = as<double>(body.inertia);
    const auto c = as<double>(body.com);
    const auto [largest, middle, smallest] = principal_moments(i);
    const double scale = as<double>(body.mass) * dot(c, c) + (i.xx + i.yy + i.zz), excess = largest - middle - smallest;
    require(excess <= 1e-9 * scale,
            "inertia must be physical: no principal moment above the sum of the other two "
            "(rigid_body{...}.as_published() is not checked for this)",
            excess);
    if (broken.rule) broken.moments = {largest, middle, smallest};
  }

  /// Requires a square of 1, to 2e-9.
  constexpr void unit_length(double squared, const char* rule) const {
    if (squared > 1 - 2e-9 && squared < 1 + 2e-9) return;
    if (std::is_constant_evaluated())
      require(false, rule,
              0 < squared && squared < 1 ? 1 / detail::constexpr_sqrt(1 / squared) : detail::constexpr_sqrt(squared));
    else
      require(false, rule, std::sqrt(squared));
  }
  /// The message of `bad_parameter`.
  std::string operator()() const {
    char moments[120] = "";
    const auto& [largest, middle, smallest] = broken.moments;
    std::snprintf(moments, sizeof moments, ", but %.6g is above %.6g + %.6g by %.6g", largest, middle, smallest,
                  broken.value);
    return "kte: " + describe() + ": " + broken.rule +
           (broken.moments != std::array<double, 3>{} ? moments : ", got " + detail::number(broken.value));
  }
  /// The element in messages: its type and connections.
  std::string describe() const { return describe_element(type, ports, names); }
};

}  // namespace kte
