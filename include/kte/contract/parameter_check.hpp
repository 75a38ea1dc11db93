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

/// Given to the `check` of an element core: knows which element it is, and keeps the first rule that a parameter
/// breaks. Who made the core then refuses it, by `bad_parameter` or, of a constexpr chain, at compile time.
struct parameter_check {
  struct breach {
    const char* rule = nullptr;
    double value = 0;
    std::array<double, 3> moments{};  ///< of a body, of which `value` says by how much the first is too large
  };
  std::string_view type;
  std::span<const port> ports;
  std::span<const std::string_view> names;
  breach& broken;

  /// Refuses `value` unless ok, e.g. require(m >= 0, "mass must not be negative", m).
  constexpr void require(bool ok, const char* rule, double value) const {
    if (ok || broken.rule) return;
    broken = {rule, value};
#if !defined(__clang__)  // g++ prints a line for each call, and only of literals what they are: so here
    if (std::is_constant_evaluated()) detail::require<bad_parameter>(ok, *this, rule, value);
#endif
  }
  /// A finite number.
  template <class T>
  constexpr void finite(const T& x, const char* rule) const {
    if constexpr (!typed_constant<T>) {
      const auto v = static_cast<double>(x);
      constexpr double largest = (std::numeric_limits<double>::max)();
      require(-largest <= v && v <= largest, rule, v);  // no arithmetic, at which clang stops where it gives NaN
    }
  }
  /// A finite number >= 0.
  template <class T>
  constexpr void not_negative(const T& x, const char* rule) const {
    finite(x, rule);
    require(as<double>(x) >= 0, rule, as<double>(x));
  }
  /// A finite number > 0.
  template <class T>
  constexpr void positive(const T& x, const char* rule) const {
    finite(x, rule);
    require(as<double>(x) > 0, rule, as<double>(x));
  }
  template <class X, class Y, class Z>
  constexpr void finite(const vec3<X, Y, Z>& v, const char* rule) const {
    finite(v.x, rule), finite(v.y, rule), finite(v.z, rule);
  }
  /// A vector of length 1 to 1e-9: a rounded axis is meant as one, a wrong axis is not.
  template <class X, class Y, class Z>
  constexpr void unit(const vec3<X, Y, Z>& v, const char* rule) const {
    finite(v, rule);
    if (!broken.rule) unit_length(dot(as<double>(v), as<double>(v)), rule);
  }
  constexpr void rotation(no_rotation, const char*) const {}
  /// Orthonormal with determinant 1, each to 1e-9. A quaternion of any length could give such a matrix.
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
  /// The triangle inequality of the principal moments, which says that the second moments tr(I)/2 1 - I, the integrals
  /// of x x^T dm, are not negative. With room for printed digits, relative to the body as its frame feels it.
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
            "(rigid_body{...}.as_published() is taken as it is)",
            excess);
    if (broken.rule) broken.moments = {largest, middle, smallest};
  }

  constexpr void unit_length(double squared, const char* rule) const {
    if (squared > 1 - 2e-9 && squared < 1 + 2e-9) return;
    if (std::is_constant_evaluated())
      require(false, rule,
              0 < squared && squared < 1 ? 1 / detail::constexpr_sqrt(1 / squared) : detail::constexpr_sqrt(squared));
    else
      require(false, rule, std::sqrt(squared));
  }
  /// What `bad_parameter` says.
  std::string operator()() const {
    char moments[120] = "";
    const auto& [largest, middle, smallest] = broken.moments;
    std::snprintf(moments, sizeof moments, ", but %.6g is above %.6g + %.6g by %.6g", largest, middle, smallest,
                  broken.value);
    return "kte: " + describe() + ": " + broken.rule +
           (broken.moments != std::array<double, 3>{} ? moments : ", got " + detail::number(broken.value));
  }
  std::string describe() const { return describe_element(type, ports, names); }
};

}  // namespace kte
