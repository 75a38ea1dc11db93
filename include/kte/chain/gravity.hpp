#pragma once

#include <kte/errors.hpp>
#include <kte/math/vec.hpp>

#include <boost/hana/at.hpp>
#include <boost/hana/tuple.hpp>

/// The gravity of a chain, m/s^2 in the axes of its bases. Zero is none.
namespace kte::detail {

[[noreturn]] inline void reject_gravity(const char* rule, double value) {
  raise<bad_parameter>(std::string(rule) + ", got " + number(value));
}
constexpr void require_gravity(bool ok, const char* rule, double value) {
  if (!ok) reject_gravity(rule, value);
}
/// Refuses what is no finite number.
template <class X, class Y, class Z>
constexpr void check_gravity(const vec3<X, Y, Z>& gravity) {
  const vec3<> g = as<double>(gravity);
  for (const double x : {g.x, g.y, g.z}) require_gravity(x - x == 0, "kte: gravity must be finite", x);
}

[[noreturn]] inline void reject_gravities(const char* rule, const vec3<>& one, const vec3<>& other) {
  const auto text = [](const vec3<>& g) { return "(" + number(g.x) + ", " + number(g.y) + ", " + number(g.z) + ")"; };
  raise<bad_wiring>(std::string(rule) + ": one has " + text(one) + ", another " + text(other));
}
/// By numbers, which compilers print when this stops them.
constexpr void require_one_gravity(bool ok, const char* rule, double x1, double y1, double z1, double x2, double y2,
                                   double z2) {
  if (!ok) reject_gravities(rule, {x1, y1, z1}, {x2, y2, z2});
}
/// Of a chain of two parts: that of the part which has one. Refuses two that differ.
template <class A, class B>
constexpr auto gravity_of_both(const A& a, const B& b) {
  if constexpr (std::is_same_v<A, zero3>) {
    return b;
  } else if constexpr (std::is_same_v<B, zero3>) {
    return a;
  } else {
    const vec3<> one = as<double>(a), other = as<double>(b), none{};
    require_one_gravity(one == other || one == none || other == none,
                        "kte: parts of a chain have different gravities; give them the same by .gravity()", one.x,
                        one.y, one.z, other.x, other.y, other.z);
    if constexpr (std::is_same_v<A, B>) {
      return one == none ? b : a;
    } else {
      using sum = decltype(a.x + b.x + a.y + b.y + a.z + b.z);
      using S = std::conditional_t<typed_constant<sum>, double, sum>;
      return one == none ? as<S>(b) : as<S>(a);
    }
  }
}
/// Of a tuple of them, from number I on.
template <std::size_t I = 0, class... G>
constexpr auto gravity_of_all(const boost::hana::tuple<G...>& all) {
  if constexpr (I == sizeof...(G)) {
    return zero3{};
  } else {
    return gravity_of_both(boost::hana::at_c<I>(all), gravity_of_all<I + 1>(all));
  }
}

}  // namespace kte::detail
