#pragma once

#include <kte/testing/element_laws.hpp>

#include <boost/multiprecision/cpp_bin_float.hpp>

#include <limits>

#include "random.hpp"

/// The laws of elements at double and at 50 digits.
namespace kte::test {

using digits50 = boost::multiprecision::cpp_bin_float_50;

template <class S>
const S eps = std::numeric_limits<S>::epsilon();

/// Each value of a law is a sum of products of a few entries of size 1 and of terms of size 1 along at most four
/// matrix products: some 30 roundings of eps/2, relative to a result of size 1 (or the larger sum of its terms).
template <class S>
const S rounding = 16 * eps<S>;

/// By five points, h = eps^(1/6): rounding of p and R, a few eps each, is summed with weights 64/12 and divided by h^2,
/// which gives 10 times 3 eps^(2/3); the terms left out are h^4/90 of the sixth derivative, which for motions as tried
/// here is below 1e3.
template <class S>
const S by_differences = 50 * pow(eps<S>, S(2) / S(3));

/// An element with a random state of its own.
template <class S = double, class Element>
auto trial_of(const Element& e, unsigned seed) {
  random_numbers draw(seed);
  testing::detail::trial<S, typename Element::core_type> x(e.core, draw);
  if constexpr (Element::core_type::ports.back().how == access::out) x.doMotion();
  return x;
}

/// Whether two vectors agree to a tolerance; NaN agrees with nothing.
template <class S, class A, class B>
bool near(const A& a, const B& b, const S& tolerance) {
  const auto d = as<S>(as<S>(a) - as<S>(b));
  const auto small = [&tolerance](const S& x) { return x <= tolerance && x >= -tolerance; };
  return small(d.x) && small(d.y) && small(d.z);
}

constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN(),
                 infinity = std::numeric_limits<double>::infinity();

/// The text of the bad_parameter that f throws, "" if it throws none.
template <class F>
std::string complaint(const F& f) {
  try {
    f();
  } catch (const bad_parameter& e) {
    return e.what();
  }
  return "";
}

}  // namespace kte::test
