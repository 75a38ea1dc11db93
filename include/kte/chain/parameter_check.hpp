#pragma once

#include <kte/chain/port.hpp>
#include <kte/errors.hpp>
#include <kte/math/rigid_body.hpp>

#include <cmath>
#include <span>
#include <string>

namespace kte {

/// Given to the `check` of an element core: knows which element it is, and rejects bad parameters in its name. In a
/// constexpr chain a rejection stops the compilation there.
struct parameter_check {
  std::string_view type;
  std::span<const port> ports;
  std::span<const std::string_view> names;

  /// Rejects `value` unless ok, e.g. require(m >= 0, "mass must not be negative", m).
  constexpr void require(bool ok, const char* rule, double value) const {
    if (!ok) reject(rule, value);
  }
  /// A finite number.
  template <class T>
  constexpr void finite(const T& x, const char* rule) const {
    if constexpr (!typed_constant<T>) {
      const auto v = static_cast<double>(x);
      require(v - v == 0, rule, v);
    }
  }
  /// A finite number >= 0.
  template <class T>
  constexpr void not_negative(const T& x, const char* rule) const {
    finite(x, rule);
    require(as<double>(x) >= 0, rule, as<double>(x));
  }
  template <class X, class Y, class Z>
  constexpr void finite(const vec3<X, Y, Z>& v, const char* rule) const {
    finite(v.x, rule), finite(v.y, rule), finite(v.z, rule);
  }
  /// A vector of length 1 to 1e-9: a rounded axis is meant as one, a wrong axis is not.
  template <class X, class Y, class Z>
  constexpr void unit(const vec3<X, Y, Z>& v, const char* rule) const {
    finite(v, rule);
    unit_length(dot(as<double>(v), as<double>(v)), rule);
  }
  constexpr void rotation(no_rotation, const char*) const {}
  /// Orthonormal with determinant 1, each to 1e-9. A quaternion of any length could give such a matrix.
  template <class R>
  constexpr void rotation(const R& r, const char* rule) const {
    if constexpr (requires { r.w; }) unit_length(as<double>(dot(r, r)), rule);
    const auto m = as<double>(matrix(r));
    unit(m.x, rule), unit(m.y, rule), unit(m.z, rule);
    const double det = dot(m.x, cross(m.y, m.z));
    require(det > 1 - 1e-8, rule, det);
  }
  /// Physical: the second moments tr(I)/2 1 - I, which are integrals of x x^T dm, have no negative eigenvalue. That is
  /// the triangle inequality of the principal moments. Tested by principal minors, with room for printed digits.
  template <class... T>
  constexpr void physical(const sym3<T...>& inertia) const {
    const auto i = as<double>(inertia);
    const double t = (i.xx + i.yy + i.zz) / 2;
    finite(t, "inertia must be finite");
    finite(i.xy + i.xz + i.yz, "inertia must be finite");
    const double a = t - i.xx, b = t - i.yy, c = t - i.zz, slack = 1e-9 * t;
    physical_if(a >= -slack && t >= 0, i.xx);
    physical_if(b >= -slack, i.yy);
    physical_if(c >= -slack, i.zz);
    physical_if(a * b - i.xy * i.xy >= -slack * t, i.xy);
    physical_if(a * c - i.xz * i.xz >= -slack * t, i.xz);
    physical_if(b * c - i.yz * i.yz >= -slack * t, i.yz);
    const double det = a * (b * c - i.yz * i.yz) - i.xy * (i.xy * c + i.yz * i.xz) - i.xz * (i.xy * i.yz + b * i.xz);
    physical_if(det >= -slack * t * t, det);
  }

  constexpr void unit_length(double squared, const char* rule) const {
    if (!(squared > 1 - 2e-9 && squared < 1 + 2e-9)) reject_length(rule, squared);
  }
  [[noreturn]] void reject_length(const char* rule, double squared) const { reject(rule, std::sqrt(squared)); }
  constexpr void physical_if(bool ok, double value) const {
    require(ok, "inertia must be physical: not negative, each principal moment at most the sum of the others", value);
  }
  [[noreturn]] void reject(const char* rule, double value) const {
    detail::raise<bad_parameter>("kte: " + describe() + ": " + rule + ", got " + detail::number(value));
  }
  std::string describe() const { return describe_element(type, ports, names); }
};

}  // namespace kte
