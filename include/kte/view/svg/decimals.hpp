#pragma once

#include <algorithm>
#include <charconv>
#include <cmath>
#include <string>

/// Lengths in pictures as text, in hundredths.
namespace kte::detail::svg {

/// A length in hundredths, limited to ten million.
inline long hundredths(double x) { return std::isnan(x) ? 0 : std::lround(std::clamp(x, -1e5, 1e5) * 100); }

/// Appends "1.25", "-.5", "0".
inline void append_hundredths(std::string& out, long n) {
  if (n < 0) out += '-', n = -n;
  const long whole = n / 100, rest = n % 100;
  if (whole != 0 || rest == 0) out += std::to_string(whole);
  if (rest == 0) return;
  out += '.', out += static_cast<char>('0' + rest / 10);
  if (rest % 10 != 0) out += static_cast<char>('0' + rest % 10);
}
inline std::string decimal(double x) {
  std::string s;
  append_hundredths(s, hundredths(x));
  return s;
}

/// A number for readers, with four digits: "0.001235", "1.5e-09".
inline std::string four_digits(double x) {
  char digits[32];
  return {digits, std::to_chars(digits, digits + sizeof digits, x, std::chars_format::general, 4).ptr};
}

}  // namespace kte::detail::svg
