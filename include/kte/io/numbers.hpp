#pragma once

#include <charconv>
#include <cmath>
#include <string>
#include <string_view>
#include <vector>

/// Numbers as text that reads back to the same bits in any locale.
namespace kte::detail {

/// Appends a number to a text; every NaN is "nan".
template <class Real>
void append_number(std::string& text, Real x) {
  char digits[64];
  if (!text.empty()) text += ' ';
  text.append(digits, std::to_chars(digits, digits + sizeof digits, std::isnan(x) ? std::abs(x) : x).ptr);
}
/// "0 0 -9.81": the shortest digits that give the same doubles.
inline std::string numbers_to_text(const std::vector<double>& values) {
  std::string s;
  for (const double x : values) append_number(s, x);
  return s;
}

/// Numbers with more digits than a double are texts with a suffix, 0.1L.
inline std::string numbers_to_text(const std::vector<long double>& values) {
  std::string s;
  for (const long double x : values) {
    const auto d = static_cast<double>(x);
    if (std::isnan(x) || d == x) {
      append_number(s, d);
    } else {
      append_number(s, x), s += 'L';
    }
  }
  return s;
}

/// Reads one number of a text as double directly; reading more digits first and rounding again would round twice.
inline std::from_chars_result take_number(const char* p, const char* end, double& x) {
  return std::from_chars(p, end, x);
}
inline std::from_chars_result take_number(const char* p, const char* end, long double& x) {
  double d{};
  const auto r = std::from_chars(p, end, d);
  x = d;
  if (r.ec == std::errc::invalid_argument || r.ptr == end || *r.ptr != 'L') return r;
  const auto wide = std::from_chars(p, r.ptr, x);
  return {wide.ptr == r.ptr ? r.ptr + 1 : p, wide.ec};
}
/// The reverse: numbers separated by blanks. Returns the error in the text, or nullptr.
template <class Real>
const char* text_to_numbers(std::string_view text, std::vector<Real>& values) {
  const char* p = text.data();
  const char* const end = p + text.size();
  const auto blank = [](char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r'; };
  for (;;) {
    while (p != end && blank(*p)) ++p;
    if (p == end) return nullptr;
    Real x{};
    const auto [next, error] = take_number(p, end, x);
    if (error == std::errc::invalid_argument || (next != end && !blank(*next))) return "is not a list of numbers";
    if (error == std::errc::result_out_of_range) return "holds a number too large or too small for a double";
    values.push_back(x);
    p = next;
  }
}

}  // namespace kte::detail
