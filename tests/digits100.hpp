#pragma once

#include <boost/multiprecision/cpp_bin_float.hpp>

#include <string>

#include "digits50.hpp"

/// Numbers of 100 digits, for references of those of 50.
namespace kte::test {

using digits100 = boost::multiprecision::cpp_bin_float_100;

template <class S>
digits100 to_100(const S& x) {
  return digits100(x);
}
inline digits100 to_100(const digits50& x) { return digits100(std::string(x)); }

template <class S>
S from_100(const digits100& x) {
  if constexpr (std::is_same_v<S, digits50>)
    return S(x.str(70));
  else
    return S(x);
}

}  // namespace kte::test
