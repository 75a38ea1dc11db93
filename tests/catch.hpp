#pragma once

/// Catch2, version 2 or 3: the same names from either.
#if __has_include(<catch2/catch.hpp>)
#  include <catch2/catch.hpp>
#else
#  include <catch2/catch_all.hpp>
using Catch::Approx;
#endif

#include <string>

namespace kte::test {

/// Matches a text that contains `part`.
inline auto contains_text(const std::string& part) {
#if defined(CATCH_VERSION_MAJOR) && CATCH_VERSION_MAJOR < 3
  return Catch::Matchers::Contains(part);
#else
  return Catch::Matchers::ContainsSubstring(part);
#endif
}

}  // namespace kte::test
