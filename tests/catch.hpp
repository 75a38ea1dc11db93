#pragma once

/// Catch2, version 2 or 3: the same names from either.
#if __has_include(<catch2/catch.hpp>)
#  include <catch2/catch.hpp>
#else
#  include <catch2/catch_all.hpp>
#endif

#include <cmath>
#include <exception>
#include <ostream>
#include <string>
#include <string_view>

namespace kte::test {

/// What a number must lie near: `CHECK(x == within(2.5, 1e-14))` means |x - 2.5| <= 1e-14, and nothing else. NaN is
/// near nothing. (What Catch2 has for this also takes whatever is within a relative error of 1.2e-5: no test uses it.)
class within {
 public:
  within(double expected, double margin) : expected_(expected), margin_(margin) {}
  friend bool operator==(double x, const within& w) {
    return x == w.expected_ || std::abs(x - w.expected_) <= w.margin_;
  }
  friend std::ostream& operator<<(std::ostream& out, const within& w) {
    const auto digits = out.precision(17);
    out << w.expected_ << " +- " << w.margin_;
    out.precision(digits);
    return out;
  }

 private:
  double expected_, margin_;
};
/// `within` with a margin relative to the expected number.
inline within within_relative(double expected, double epsilon) { return {expected, epsilon * std::abs(expected)}; }

/// The larger of two errors. NaN is worse than all numbers and stays: of std::max(x, NaN) nothing is left but x.
template <class T>
T worse(const T& a, const T& b) {
  return a != a || b <= a ? a : b;
}

/// Matches an error whose text contains `part`: `CHECK_THROWS_MATCHES(f(x), bad_argument, says("is not finite"))`.
inline auto says(const std::string& part) {
  return Catch::Matchers::Predicate<std::exception>(
      [part](const std::exception& e) { return std::string_view(e.what()).find(part) != std::string_view::npos; },
      "says \"" + part + '"');
}

/// Matches a text that contains `part`.
inline auto contains_text(const std::string& part) {
#if defined(CATCH_VERSION_MAJOR) && CATCH_VERSION_MAJOR < 3
  return Catch::Matchers::Contains(part);
#else
  return Catch::Matchers::ContainsSubstring(part);
#endif
}

}  // namespace kte::test
using kte::test::within, kte::test::within_relative;
