#pragma once

#include <kte/contract/core_in_scalar.hpp>
#include <kte/errors.hpp>
#include <kte/math/vec.hpp>

#include <boost/hana/at.hpp>
#include <boost/hana/tuple.hpp>
#include <boost/hana/unpack.hpp>

#include <array>
#include <limits>

/// The gravity of a chain, m/s^2 in the axes of its bases. Zero is none.
namespace kte::detail {

/// Rejects gravity that is not finite, in any lane.
template <class X, class Y, class Z>
constexpr void check_gravity(const vec3<X, Y, Z>& gravity) {
  if constexpr (has_packs_or_duals<vec3<X, Y, Z>>) {
    for (std::size_t lane = 0; lane < lanes_in<vec3<X, Y, Z>>; ++lane) {
      in_scalar<vec3<X, Y, Z>, double> g{};
      convert_numbers(gravity, g, to_lane<double>{lane});
      check_gravity(g);
    }
  } else {
    const vec3<> g = as<double>(gravity);
    constexpr double largest = (std::numeric_limits<double>::max)();
    for (const double x : {g.x, g.y, g.z}) {
      const auto text = [x] { return "kte: gravity must be finite, got " + number(x); };
      require<bad_parameter>(-largest <= x && x <= largest, text, "kte: gravity must be finite", x);
    }
  }
}

/// Rejects parts with different gravities.
template <class... G>
constexpr void check_one_gravity(const boost::hana::tuple<G...>& all) {
  const auto numbers = boost::hana::unpack(
      all, [](const auto&... part) { return std::array<vec3<>, sizeof...(part)>{as<double>(part)...}; });
  vec3<> g{};
  for (const auto& x : numbers) {
    if (g == vec3<>{}) g = x;
    const auto text = [&g, &x] {
      const auto numbers_of = [](const vec3<>& v) {
        // Operator + causes spurious warnings of g++ 12 at -O3.
        return std::string("(").append(number(v.x)).append(", ").append(number(v.y)).append(", ").append(number(v.z)) +
               ")";
      };
      return "kte: parts of a chain have different gravities; give them the same by .gravity(): one has " +
             numbers_of(g) + ", another " + numbers_of(x);
    };
    require<bad_wiring>(x == g || x == vec3<>{}, text,
                        "kte: parts of a chain have different gravities; give them the same by .gravity()", g.x, g.y,
                        g.z, x.x, x.y, x.z);
  }
}
/// The gravity of a chain of two parts: that of the part that has one.
template <class A, class B>
constexpr auto gravity_of_both(const A& a, const B& b) {
  if constexpr (std::is_same_v<A, zero3>) {
    return b;
  } else if constexpr (std::is_same_v<B, zero3>) {
    return a;
  } else {
    const bool none = as<double>(a) == vec3<>{};
    if constexpr (std::is_same_v<A, B>) {
      return none ? b : a;
    } else {
      using sum = decltype(a.x + b.x + a.y + b.y + a.z + b.z);
      using S = std::conditional_t<typed_constant<sum>, double, sum>;
      return none ? as<S>(b) : as<S>(a);
    }
  }
}
/// The gravity of a tuple of parts, from number I on.
template <std::size_t I = 0, class... G>
constexpr auto gravity_of_all(const boost::hana::tuple<G...>& all) {
  if constexpr (I == sizeof...(G)) {
    return zero3{};
  } else {
    return gravity_of_both(boost::hana::at_c<I>(all), gravity_of_all<I + 1>(all));
  }
}

}  // namespace kte::detail
