#pragma once

#include <charconv>
#include <string>
#include <string_view>
#include <vector>

/// Numbers as text that reads back as the same bits, whatever the locale.
namespace kte::detail {

/// "0 0 -9.81": the shortest digits that give the same doubles.
inline std::string numbers_to_text(const std::vector<double>& values) {
  std::string s;
  char digits[40];
  for (const double x : values) {
    const auto end = std::to_chars(digits, digits + sizeof digits, x).ptr;
    if (!s.empty()) s += ' ';
    s.append(digits, end);
  }
  return s;
}

/// The reverse: numbers with blanks between them. Gives what is wrong with the text, or nullptr.
inline const char* text_to_numbers(std::string_view text, std::vector<double>& values) {
  const char* p = text.data();
  const char* const end = p + text.size();
  const auto blank = [](char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r'; };
  for (;;) {
    while (p != end && blank(*p)) ++p;
    if (p == end) return nullptr;
    double x{};
    const auto [next, error] = std::from_chars(p, end, x);
    if (error == std::errc::invalid_argument || (next != end && !blank(*next))) return "is not a list of numbers";
    if (error == std::errc::result_out_of_range) return "holds a number too large or too small for a double";
    values.push_back(x);
    p = next;
  }
}

}  // namespace kte::detail
